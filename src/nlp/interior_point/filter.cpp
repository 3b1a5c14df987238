#include "filter.hpp"

#include <algorithm>
#include <cmath>

namespace slalom::nlp::ipm {
namespace {

constexpr double kGammaTheta = 1e-5, kGammaPhi = 1e-8;  // Waechter & Biegler 2006, section 4
constexpr std::size_t kMostEntries = 256;               // room taken once; the oldest goes

}  // namespace

double rounding(double barrier) {
  return 1e-15 * 100 * std::fabs(barrier);
}

Filter::Filter() {
  entries_.reserve(kMostEntries + 1);
}

void Filter::reset(double most_violation) {
  most_violation_ = most_violation;
  entries_.clear();
}

bool Filter::accepts(const Merit& point) const {
  if (!(point.violation <= most_violation_)) return false;
  return std::all_of(entries_.begin(), entries_.end(), [&](const Merit& entry) {
    return point.violation <= entry.violation ||
           point.barrier <= entry.barrier + rounding(point.barrier);
  });
}

void Filter::add(const Merit& point) {
  const Merit corner{(1 - kGammaTheta) * point.violation,
                     point.barrier - kGammaPhi * point.violation};
  std::erase_if(entries_, [&](const Merit& entry) {
    return entry.violation >= corner.violation && entry.barrier >= corner.barrier;
  });
  entries_.push_back(corner);
  if (entries_.size() > kMostEntries) entries_.erase(entries_.begin());
}

}  // namespace slalom::nlp::ipm
