#include "best_iterate.hpp"

#include <algorithm>

namespace slalom::nlp::ipm {

void BestIterate::begin(const SlackForm& form, double tolerance) {
  w_.resize(form.primal());
  y_.resize(form.rows());
  known_ = false;
  tolerance_ = tolerance;
}

void BestIterate::offer(const Iterate& at, double violation, double objective, double logs,
                        double mu) {
  const bool meets = violation <= tolerance_;
  if (known_) {
    if (feasible() && (!meets || objective - mu * logs >= objective_ - mu * logs_)) return;
    if (!feasible() && !meets && violation >= violation_) return;
  }
  w_ = at.w;
  y_ = at.y;
  known_ = true;
  violation_ = violation;
  objective_ = objective;
  logs_ = logs;
}

void BestIterate::restore(const SlackForm& form, double mu, Point& point) const {
  std::copy(w_.begin(), w_.end(), point.change_w().begin());
  std::copy(y_.begin(), y_.end(), point.change_y().begin());
  const auto zl = point.change_zl(), zu = point.change_zu();
  for (std::size_t k = 0; k < form.segments().count; ++k) {
    const Segment& s = form.segments().first[k];
    for (std::size_t i = s.begin; i < s.end; ++i) {
      if (s.lower) zl[i] = mu / (w_[i] - form.lower()[i]);
      if (s.upper) zu[i] = mu / (form.upper()[i] - w_[i]);
    }
  }
}

}  // namespace slalom::nlp::ipm
