#include "best_iterate.hpp"

namespace slalom::nlp::ipm {

void BestIterate::begin(const Model& model, double tolerance) {
  w_.resize(model.primal());
  y_.resize(model.rows());
  known_ = false;
  tolerance_ = tolerance;
}

void BestIterate::offer(const Iterate& at, double violation, double barrier) {
  const bool meets = violation <= tolerance_;
  if (known_) {
    if (feasible() && (!meets || barrier >= barrier_)) return;
    if (!feasible() && !meets && violation >= violation_) return;
  }
  w_ = at.w;
  y_ = at.y;
  known_ = true;
  violation_ = violation;
  barrier_ = barrier;
}

void BestIterate::restore(const Model& model, double mu, Iterate& at) const {
  at.w = w_;
  at.y = y_;
  for (std::size_t k = 0; k < model.segments().count; ++k) {
    const Segment& s = model.segments().first[k];
    for (std::size_t i = s.begin; i < s.end; ++i) {
      if (s.lower) at.zl[i] = mu / (w_[i] - model.lower()[i]);
      if (s.upper) at.zu[i] = mu / (model.upper()[i] - w_[i]);
    }
  }
}

}  // namespace slalom::nlp::ipm
