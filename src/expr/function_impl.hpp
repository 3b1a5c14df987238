#pragma once

#include <array>
#include <atomic>
#include <mutex>
#include <vector>

#include "dag.hpp"
#include "slalom/expr/function.hpp"
#include "tape.hpp"

namespace slalom::expr {

constexpr unsigned mask_of(Wanted wanted) {
  return (wanted.values ? 1u : 0u) | (wanted.jacobian ? 2u : 0u) | (wanted.hessian ? 4u : 0u);
}

/// Derivatives and code are made when first wanted, once, whichever thread comes first. Inputs of
/// tapes: variables, data, weights; behind them what was computed from data alone.
struct Function::Impl {
  class Kept;

  std::size_t variables = 0, data = 0;
  std::vector<Dag::Id> outputs, weights;
  mutable std::mutex mutex;
  mutable Dag dag;
  mutable SparseDerivative jacobian, hessian;
  mutable std::atomic<bool> has_jacobian = false, has_hessian = false;

  void differentiate_once() const;
  void differentiate_twice() const;
  const Tape& tape(Wanted wanted) const {
    const unsigned mask = mask_of(wanted);
    return plain_.ready[mask].load(std::memory_order_acquire) ? plain_.tape[mask]
                                                              : get(plain_, wanted, {}, {});
  }

  /// What depends on data alone, computed ahead: its tape, then tapes that read it.
  const Tape& ahead() const;
  std::size_t ahead_count() const;
  const Tape& tape_behind(Wanted wanted) const;

 private:
  struct Tapes {
    std::array<Tape, 8> tape;
    std::array<std::atomic<bool>, 8> ready{};
  };
  const Tape& get(Tapes& tapes, Wanted wanted, const Given& given,
                  const std::vector<Dag::Id>& family) const;
  std::pair<std::size_t, std::size_t> cost(const SparseDerivative& candidate) const;
  std::vector<Dag::Id> results(Wanted wanted) const;
  void find_ahead() const;

  mutable Tapes plain_, behind_;
  mutable std::atomic<bool> has_ahead_ = false;
  mutable Given given_;
  mutable std::vector<Dag::Id> all_results_;
  mutable Tape ahead_;
};

}  // namespace slalom::expr
