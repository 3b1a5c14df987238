#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "slalom/expr/function.hpp"

namespace slalom::expr {

/// A function made ready for many evaluations at a fixed number of lanes. What depends on data
/// alone is computed once after each change of data. Variables are read where they stand. Memory is
/// taken at construction and by `prepare`; evaluate takes none for what `prepare` was given.
///
/// Arrays are structure-of-arrays: element i of lane l stands at [i * lanes + l].
class Evaluator {
 public:
  Evaluator(const Function& function, std::size_t lanes);
  ~Evaluator();
  Evaluator(Evaluator&&) noexcept;
  Evaluator& operator=(Evaluator&&) noexcept;

  std::size_t lanes() const;
  /// Compiles what evaluate(wanted) needs.
  void prepare(Wanted wanted);

  /// Where variable i stands from now on: `lanes` numbers in a row, or, if `same`, one for all.
  void set_variable(std::size_t i, const double* numbers, bool same);
  std::span<const double> data() const;
  std::span<double> data();  ///< data x lanes; call data_changed after writing
  void data_changed();
  std::span<double> weights();  ///< outputs x lanes, for the Hessian

  void evaluate(Wanted wanted);
  std::span<const double> values() const;    ///< outputs x lanes
  std::span<const double> jacobian() const;  ///< Jacobian pattern x lanes
  std::span<const double> hessian() const;   ///< Hessian pattern x lanes

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace slalom::expr
