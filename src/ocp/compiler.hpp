#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "builder.hpp"
#include "symbols.hpp"

namespace slalom::ocp {

/// One of a function's outputs: a row or a cost term, with the lanes' coefficients decided later.
struct Output {
  std::string name;
  Expr value;
};

/// A symbol that stands, at each lane, for a variable other than its own point's.
struct Placed {
  Expr symbol;
  std::function<std::size_t(const Batch& batch, std::size_t lane)> variable;
};

/// A symbol for tau at another point than the lane's.
struct PlacedTau {
  Expr symbol;
  std::function<std::size_t(std::size_t point)> point;
};

/// Where a function is evaluated, and what its symbols stand for there.
struct Lanes {
  std::vector<std::size_t> points;
  std::size_t family = kNone;  ///< constraint whose members multiply the points
  const End* end = nullptr;    ///< of a boundary function
  std::vector<Placed> placed;
  std::vector<PlacedTau> taus;
  std::size_t soft = kNone;  ///< constraint whose weight `weight` stands for
  Expr weight = 0;
};

/// Compiles functions of a problem's symbols into batches.
class Compiler {
 public:
  /// `out`, with its layout and scales set, receives the batches.
  Compiler(const Problem& problem, const Symbols& symbols, Transcribed& out)
      : problem_(problem), symbols_(symbols), out_(out) {}

  /// Returns the batch's number. Throws InvalidValue for a symbol the problem did not make.
  std::size_t add(const std::vector<Output>& outputs, const Lanes& lanes);

 private:
  bool add_datum(const Expr& symbol, const Lanes& lanes, const Batch& batch, BatchData& data) const;
  std::optional<DataSource> data_source(Meaning meaning) const;
  Meaning meaning_of(const Expr& symbol, const std::vector<Output>& outputs) const;
  void add_gather(Batch& batch, Meaning meaning, const Expr& symbol, const End* end) const;
  void add_placed(Batch& batch, const Placed& placed) const;
  std::size_t variable_at(Meaning meaning, std::size_t point, const End* end) const;

  const Problem& problem_;
  const Symbols& symbols_;
  Transcribed& out_;
};

}  // namespace slalom::ocp
