#include "best_iterate.hpp"

namespace slalom::nlp::ipm {

void BestIterate::begin(const Model& model, double tolerance) {
  if (at_.w.size() != model.primal()) at_.resize(model.primal(), model.rows());
  known_ = false;
  tolerance_ = tolerance;
}

void BestIterate::offer(const Iterate& at, double violation, double barrier) {
  const bool meets = violation <= tolerance_;
  if (known_) {
    if (feasible() && (!meets || barrier >= barrier_)) return;
    if (!feasible() && !meets && violation >= violation_) return;
  }
  at_ = at;
  known_ = true;
  violation_ = violation;
  barrier_ = barrier;
}

}  // namespace slalom::nlp::ipm
