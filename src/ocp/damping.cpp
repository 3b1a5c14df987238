#include "damping.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "slalom/expr/spline.hpp"
#include "slalom/ocp/interpolant.hpp"

namespace slalom::ocp {
namespace {

const std::string kName = "damping of controls that chatter";

/// Of a control's range: what counts as a swing.
constexpr double kSwing = 0.05;
/// Swings in a row that make chatter, each mostly from one point to the next and at most so many
/// points after the last. A mesh that resolves a control's jumps has more points between them.
constexpr int kSwings = 8, kDampedSwings = 4, kWithin = 12;
/// Of a swing: what is most of it.
constexpr double kMost = 0.5;
/// Of a control's largest size: a range below counts as this.
constexpr double kLeastWidth = 0.1;

struct Range {
  double low = kInfinity, high = -kInfinity;
  /// What the barrier keeps a control off its bound is no swing: see unresolved_controls.
  double width() const {
    return std::max(high - low, kLeastWidth * std::max(std::fabs(low), std::fabs(high)));
  }
};

Range range_of(const Solution& solution, std::size_t control) {
  Range range;
  for (const auto& u : solution.trajectory.controls) {
    range.low = std::min(range.low, u[control]);
    range.high = std::max(range.high, u[control]);
  }
  return range;
}

/// The interval of each point: of one at a break, that which begins there.
std::vector<std::size_t> intervals_of(const Solution& solution) {
  std::vector<std::size_t> list{0};
  const std::size_t count = solution.mesh.intervals();
  for (std::size_t k = 0; k < count; ++k) {
    list.insert(list.end(), solution.scheme.of(k).points.size() - 2, k);
    list.push_back(std::min(k + 1, count - 1));
  }
  return list;
}

/// Where a control turns, by more than a swing: points, rising.
std::vector<std::size_t> turns(const std::vector<double>& u, double swing) {
  std::vector<std::size_t> list;
  int direction = 0;
  for (std::size_t k = 1, extreme = 0; k < u.size(); ++k) {
    const double change = u[k] - u[extreme];
    if (direction == 0 ? std::fabs(change) <= swing : -direction * change <= swing) {
      if (direction * change > 0) extreme = k;
      continue;
    }
    direction = change > 0 ? 1 : -1;
    list.push_back(extreme);
    extreme = k;
  }
  return list;
}

bool is_steep(const std::vector<double>& u, std::size_t from, std::size_t to) {
  double step = 0;
  for (std::size_t k = from; k < to; ++k) step = std::max(step, std::fabs(u[k + 1] - u[k]));
  return step >= kMost * std::fabs(u[to] - u[from]);
}

/// Marks the intervals where a control chatters; whether there are any.
bool mark(const Solution& solution, std::size_t control, int swings, std::vector<char>& intervals) {
  const double width = range_of(solution, control).width();
  std::vector<double> u;
  for (const auto& all : solution.trajectory.controls) u.push_back(all[control]);
  const auto turn = turns(u, kSwing * width);
  const auto interval = intervals_of(solution);
  bool found = false;
  for (std::size_t first = 0, last = 0; first < turn.size(); first = last + 1) {
    last = first;
    while (last + 1 < turn.size() && turn[last + 1] - turn[last] <= kWithin &&
           is_steep(u, turn[last], turn[last + 1]))
      ++last;
    if (last - first < static_cast<std::size_t>(swings)) continue;
    found = true;
    for (std::size_t i = interval[turn[first]]; i <= interval[turn[last]]; ++i) intervals[i] = 1;
  }
  return found;
}

/// A control's mean over each interval.
std::vector<double> means(const Interpolant& polynomials, std::size_t control,
                          std::size_t intervals) {
  constexpr int kSamples = 12;
  std::vector<double> list(intervals, 0.0);
  for (std::size_t k = 0; k < intervals; ++k)
    for (int s = 0; s < kSamples; ++s)
      list[k] += polynomials.controls(k, (s + 0.5) / kSamples)[control] / kSamples;
  return list;
}

/// A control over tau, without what chatters.
Expr earlier_control(const Expr& tau, const Problem& problem, const Solution& earlier,
                     std::size_t control, bool chatters) {
  const Interpolant polynomials(problem, earlier.trajectory, earlier.mesh, earlier.scheme);
  const std::size_t n = earlier.mesh.intervals();
  std::vector<double> value = means(polynomials, control, n);
  if (chatters) {
    const auto raw = value;
    for (std::size_t k = 0; k < n; ++k)
      value[k] = (raw[k > 0 ? k - 1 : k] + 2 * raw[k] + raw[k + 1 < n ? k + 1 : k]) / 4;
  }
  std::vector<double> knots;
  const auto& breaks = earlier.mesh.breakpoints();
  for (std::size_t k = 0; k < n; ++k) knots.push_back((breaks[k] + breaks[k + 1]) / 2);
  if (n == 1) return value[0];
  return expr::cubic_spline(tau, knots, value, expr::Beyond::hold);
}

}  // namespace

double Chatter::share() const {
  return static_cast<double>(std::count(intervals.begin(), intervals.end(), 1)) /
         static_cast<double>(intervals.size());
}

bool Chatter::any() const {
  return std::count(controls.begin(), controls.end(), 1) > 0;
}

Chatter chatter_of(const Solution& solution, bool damped) {
  const std::size_t count = solution.control_names.size();
  Chatter found{std::vector<char>(count, 0), std::vector<char>(solution.mesh.intervals(), 0)};
  for (std::size_t i = 0; i < count; ++i)
    found.controls[i] =
        mark(solution, i, damped ? kDampedSwings : kSwings, found.intervals) ? 1 : 0;
  return found;
}

bool Damping::raised(const std::vector<Chatter>& chatter) {
  const auto any = [](const Chatter& each) { return each.any(); };
  const bool before = chattered_;
  chattered_ = std::any_of(chatter.begin(), chatter.end(), any);
  if (!wanted_ || !chattered_ || weight_ >= kMostWeight) return false;
  const auto mostly = [](const Chatter& each) { return each.share() > kMostly; };
  if (weight_ == 0 && !before && std::none_of(chatter.begin(), chatter.end(), mostly))
    return false;  // a finer mesh alone may end it
  if (lowered_) --lowerings_;
  weight_ = weight_ > 0 ? weight_ * kMoreWeight : kFirstWeight;
  chosen_.resize(chatter.size());
  for (std::size_t p = 0; p < chatter.size(); ++p) {
    const auto& now = chatter[p].controls;
    chosen_[p].resize(now.size(), 0);
    for (std::size_t i = 0; i < now.size(); ++i) chosen_[p][i] = std::max(chosen_[p][i], now[i]);
  }
  return true;
}

double Damping::calm(double change) {
  const double left = sum_ > 0 ? change * sum_ * weight_ : kInfinity, before = left_;
  sum_ += 1 / weight_;
  lowered_ = false;
  left_ = left;
  return std::max(left, before);
}

void Damping::lower() {
  lowered_ = weight_ > 0 && lowerings_ > 0;
  if (lowered_) weight_ /= kMoreWeight;
}

void add_damping(Problem& problem, const Solution& earlier, const std::vector<char>& chosen,
                 double weight) {
  const Chatter chatter = chatter_of(earlier, true);
  Expr sum = 0;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const double range = range_of(earlier, i).width();
    if (!chosen[i] || !(range > 0)) continue;
    const Expr& u = problem.controls()[i].symbol;
    sum +=
        square((u - earlier_control(problem.tau(), problem, earlier, i, chatter.controls[i] != 0)) /
               range);
  }
  const double duration = earlier.trajectory.tf - earlier.trajectory.t0;
  problem.lagrange(kName, weight / duration * sum);
}

double without_damping(Solution& solution) {
  const auto is_damping = [](const auto& term) { return term.first == kName; };
  const auto at = std::find_if(solution.cost_terms.begin(), solution.cost_terms.end(), is_damping);
  if (at == solution.cost_terms.end()) return 0;
  const double cost = at->second;
  solution.objective -= cost;
  solution.cost_terms.erase(at);
  return cost;
}

}  // namespace slalom::ocp
