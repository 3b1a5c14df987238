#include "free_way.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "road_way.hpp"
#include "slalom/vehicle/state.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;

/// Of the lattice [m].
constexpr double kStage = 1.5, kAside = 0.25;
/// The steepest change of offset along the road.
constexpr double kSteepest = 0.35;
/// What a metre of margin given up costs at a place, beside the squares of the slope of the
/// offset and of its change.
constexpr double kMissing = 20, kSlope = 1, kBend = 4;

/// A stage of the lattice: a point of the guess. Of a closed road s goes on rising beyond its
/// length.
struct Stage {
  std::size_t point;
  double s, t;
};

std::vector<Stage> stages_of(const ocp::Trajectory& guess, const world::Road& road) {
  std::vector<world::Point> places;
  for (const auto& state : guess.states) places.push_back({state[X], state[Y]});
  const auto along = follow(road, road.project(places[0]).s, places);
  std::vector<Stage> stages;
  for (std::size_t k = 0; k < along.size(); ++k)
    if (k == 0 || along[k] - stages.back().s >= kStage || k + 1 == along.size())
      stages.push_back({k, along[k], guess.time(k)});
  return stages;
}

/// How much of the margins a place leaves missing [m].
double missing(const world::Road& road, const world::Footprint& footprint, const ToPass& pass,
               const world::RoadPlace& at, double n, double t) {
  State x{};
  const world::Point place = at.point() + at.aside() * n;
  x[X] = place.x;
  x[Y] = place.y;
  x[PSI] = at.psi;
  double most = std::max(0., pass.edge - footprint.edge_distance(road, x));
  for (const auto& o : pass.obstacles) {
    if (!o.present(t, t)) continue;
    const double need = pass.margin + o.margin(t);
    const double far = std::hypot(place.x - o.x_at(t), place.y - o.y_at(t));
    if (far > need + o.reach() + footprint.reach()) continue;
    most = std::max(most, need - footprint.distance(o, x, t));
  }
  return most;
}

/// The lattice: offsets n0 + whole numbers of kAside, and the steps between stages.
class Lattice {
 public:
  Lattice(const std::vector<Stage>& stages, const world::Road& road, double n0)
      : stages_(stages), n0_(n0) {
    double left = n0, right = -n0;
    for (const Stage& stage : stages) {
      left = std::max(left, road.at(stage.s).left);
      right = std::max(right, road.at(stage.s).right);
    }
    below_ = static_cast<int>(std::ceil((n0 + right) / kAside));
    count_ = below_ + static_cast<int>(std::ceil((left - n0) / kAside)) + 1;
  }

  /// The offset of each stage; `missing` says how much of the margins stage k lacks at an offset.
  template <class Missing>
  std::vector<double> offsets(const Missing& missing) {
    cost_.assign(size(count_) * kSteps, kNever);
    cost_[place(below_, kSteepestStep)] = 0;
    std::vector<std::vector<std::size_t>> before{{}};
    for (std::size_t k = 1; k < stages_.size(); ++k) before.push_back(advance(k, missing));
    std::vector<double> n(stages_.size());
    auto at = size(std::min_element(cost_.begin(), cost_.end()) - cost_.begin());
    for (std::size_t k = stages_.size(); k-- > 0;) {
      n[k] = offset(static_cast<int>(at / kSteps));
      if (k > 0) at = before[k][at];
    }
    return n;
  }

 private:
  static constexpr int kSteepestStep = static_cast<int>(kSteepest * kStage / kAside);
  static constexpr std::size_t kSteps = 2 * kSteepestStep + 1;
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  static std::size_t size(std::ptrdiff_t number) { return static_cast<std::size_t>(number); }
  /// Of an offset and the step that led to it, which begins at 0 for the steepest to the right.
  static std::size_t place(int i, int step) { return size(i) * kSteps + size(step); }
  double offset(int i) const { return n0_ + (i - below_) * kAside; }

  /// From stage k - 1 to k: the places from which each is best reached.
  template <class Missing>
  std::vector<std::size_t> advance(std::size_t k, const Missing& missing) {
    std::vector<double> next(cost_.size(), kNever);
    std::vector<std::size_t> before(cost_.size(), 0);
    for (int i = 0; i < count_; ++i) {
      const double here = kMissing * missing(stages_[k], offset(i));
      for (int step = 0; step < static_cast<int>(kSteps); ++step) {
        const int slope = step - kSteepestStep, from = i - slope;
        if (from < 0 || from >= count_) continue;
        for (int last = 0; last < static_cast<int>(kSteps); ++last) {
          const int bend = step - last;
          const double total = cost_[place(from, last)] + here +
                               (kSlope * slope * slope + kBend * bend * bend) * kAside * kAside;
          if (total >= next[place(i, step)]) continue;
          next[place(i, step)] = total;
          before[place(i, step)] = place(from, last);
        }
      }
    }
    cost_ = std::move(next);
    return before;
  }

  const std::vector<Stage>& stages_;
  const double n0_;
  int below_ = 0, count_ = 0;
  std::vector<double> cost_;  ///< to reach each place of the stage
};

}  // namespace

ocp::Trajectory free_way(ocp::Trajectory guess, const world::Road& road,
                         const world::Footprint& footprint, double t_start, const ToPass& pass) {
  const auto stages = stages_of(guess, road);
  const double n0 = road.project({guess.states[0][X], guess.states[0][Y]}, stages[0].s).n;
  const auto n = Lattice(stages, road, n0).offsets([&](const Stage& stage, double offset) {
    return missing(road, footprint, pass, road.at(stage.s), offset, t_start + stage.t);
  });
  for (std::size_t k = 0; k + 1 < stages.size(); ++k) {
    const Stage &from = stages[k], &to = stages[k + 1];
    const double turned = std::atan2(n[k + 1] - n[k], std::max(to.s - from.s, 0.1));
    for (std::size_t p = from.point + (k == 0 ? 1 : 0); p <= to.point; ++p) {
      const double share = (guess.time(p) - from.t) / (to.t - from.t);
      const world::RoadPlace at = road.at(from.s + share * (to.s - from.s));
      const world::Point place = at.point() + at.aside() * (n[k] + share * (n[k + 1] - n[k]));
      auto& state = guess.states[p];
      state[X] = place.x;
      state[Y] = place.y;
      state[PSI] += std::remainder(at.psi + turned - state[PSI], 2 * std::numbers::pi);
    }
  }
  return guess;
}

}  // namespace slalom::planner
