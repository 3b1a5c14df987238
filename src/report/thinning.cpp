#include "thinning.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <set>

#include "slalom/sim/marks.hpp"

namespace slalom::report {
namespace {

using sim::Cycle;
using sim::PlantSample;

constexpr double kTopClearance = 20;  ///< [m]: what the chart of it shows
constexpr double kUnseen = 5e-4;      ///< of a signal's range
/// Of the most samples, the share that is even in time, and the most for marked times.
constexpr double kEvenShare = 0.2, kMarkedShare = 0.1;

/// What charts show of a sample.
constexpr std::size_t kSignals = std::tuple_size_v<vehicle::State> +
                                 std::tuple_size_v<vehicle::Control> +
                                 std::tuple_size_v<vehicle::WheelLoads> + 1;
using Signals = std::array<double, kSignals>;

Signals signals_of(const PlantSample& sample) {
  Signals all{};
  auto next = std::copy(sample.state.begin(), sample.state.end(), all.begin());
  next = std::copy(sample.control.begin(), sample.control.end(), next);
  next = std::copy(sample.wheel_loads.begin(), sample.wheel_loads.end(), next);
  *next = sample.clearance < kTopClearance ? sample.clearance : kTopClearance;
  for (double& value : all)
    if (!std::isfinite(value)) value = 0;
  return all;
}

double least_load(const PlantSample& sample) {
  return *std::min_element(sample.wheel_loads.begin(), sample.wheel_loads.end());
}

/// Chooses samples one after the other.
class Samples {
 public:
  Samples(const std::vector<PlantSample>& plant, std::size_t most)
      : plant_(plant), most_(most), kept_(plant.size(), 0) {}

  void keep(std::size_t k) {
    if (kept_[k] != 0 || count_ == most_) return;
    kept_[k] = 1;
    ++count_;
  }

  /// Each signal's least and greatest, which also say how large an error of it is.
  void keep_extremes() {
    Signals least = signals_of(plant_[0]), greatest = least;
    std::array<std::size_t, kSignals> first{}, last{};
    for (std::size_t k = 0; k < plant_.size(); ++k) {
      const Signals now = signals_of(plant_[k]);
      for (std::size_t i = 0; i < now.size(); ++i) {
        if (now[i] < least[i]) least[i] = now[i], first[i] = k;
        if (now[i] > greatest[i]) greatest[i] = now[i], last[i] = k;
      }
    }
    for (std::size_t i = 0; i < least.size(); ++i) {
      keep(first[i]);
      keep(last[i]);
      per_range_[i] = greatest[i] > least[i] ? 1 / (greatest[i] - least[i]) : 0;
    }
  }

  /// In each of even stretches the first, and the least wheel load and clearance, however brief.
  void keep_dips(std::size_t stretches) {
    const auto less_load = [&](std::size_t a, std::size_t b) {
      return least_load(plant_[a]) < least_load(plant_[b]);
    };
    const auto less_room = [&](std::size_t a, std::size_t b) {
      return plant_[a].clearance < plant_[b].clearance;
    };
    const auto edges = kept_evenly(plant_.size(), stretches);
    for (const std::size_t k : edges) keep(k);
    for (std::size_t e = 0; e + 1 < edges.size(); ++e) {
      std::size_t load = edges[e], room = edges[e];
      for (std::size_t k = edges[e] + 1; k <= edges[e + 1]; ++k) {
        if (less_load(k, load)) load = k;
        if (less_room(k, room)) room = k;
      }
      keep(load);
      keep(room);
    }
  }

  void keep_nearest(double t) {
    const auto after =
        std::lower_bound(plant_.begin(), plant_.end(), t,
                         [](const PlantSample& sample, double time) { return sample.t < time; });
    const auto at = static_cast<std::size_t>(after - plant_.begin());
    keep(std::min(at, plant_.size() - 1));
  }

  /// Keeps the sample that is farthest beside the line between those kept, until all are used or no
  /// error can be seen.
  void refine() {
    std::priority_queue<Stretch> worst;
    const auto add = [&](std::size_t first, std::size_t last) {
      const Stretch stretch = worst_between(first, last);
      if (stretch.error > kUnseen) worst.push(stretch);
    };
    std::size_t last = 0;
    for (std::size_t k = 1; k < plant_.size(); ++k) {
      if (kept_[k] == 0) continue;
      add(last, k);
      last = k;
    }
    while (!worst.empty() && count_ < most_) {
      const Stretch stretch = worst.top();
      worst.pop();
      keep(stretch.at);
      add(stretch.first, stretch.at);
      add(stretch.at, stretch.last);
    }
  }

  std::vector<std::size_t> all() const {
    std::vector<std::size_t> indices;
    for (std::size_t k = 0; k < kept_.size(); ++k)
      if (kept_[k] != 0) indices.push_back(k);
    return indices;
  }

 private:
  /// Between two kept samples: the one that a line between them misses most.
  struct Stretch {
    double error = 0;  ///< of a signal's range
    std::size_t first = 0, last = 0, at = 0;
    bool operator<(const Stretch& other) const {
      return error != other.error ? error < other.error : first > other.first;
    }
  };

  Stretch worst_between(std::size_t first, std::size_t last) const {
    Stretch stretch{0, first, last, first};
    if (last - first < 2) return stretch;
    const Signals a = signals_of(plant_[first]), b = signals_of(plant_[last]);
    const double dt = plant_[last].t - plant_[first].t;
    for (std::size_t k = first + 1; k < last; ++k) {
      const double share = dt > 0 ? (plant_[k].t - plant_[first].t) / dt : 0;
      const Signals now = signals_of(plant_[k]);
      double error = 0;
      for (std::size_t i = 0; i < now.size(); ++i)
        error = std::max(error, std::fabs(now[i] - a[i] - share * (b[i] - a[i])) * per_range_[i]);
      if (error > stretch.error) stretch.error = error, stretch.at = k;
    }
    return stretch;
  }

  const std::vector<PlantSample>& plant_;
  std::size_t most_, count_ = 0;
  std::vector<char> kept_;
  Signals per_range_{};
};

/// In an order of which every beginning is even: by the digits of the index, the last first.
std::vector<std::size_t> spread(const std::vector<std::size_t>& list) {
  std::size_t places = 1;
  while (places < list.size()) places *= 2;
  std::vector<std::size_t> order;
  order.reserve(list.size());
  for (std::size_t k = 0; k < places; ++k) {
    std::size_t turned = 0;
    for (std::size_t bit = 1, from = places / 2; bit < places; bit *= 2, from /= 2)
      if ((k & bit) != 0) turned += from;
    if (turned < list.size()) order.push_back(list[turned]);
  }
  return order;
}

/// The first, the last, and the worst of each kind.
std::set<std::size_t> outstanding(const std::vector<Cycle>& cycles) {
  const std::function<double(const Cycle&)> kinds[] = {
      [](const Cycle& c) { return c.plan.report.wall_s; },
      [](const Cycle& c) { return c.plan.report.cpu_s; },
      [](const Cycle& c) { return static_cast<double>(c.plan.report.iterations); },
      [](const Cycle& c) { return c.plan.report.worst_violation; },
      [](const Cycle& c) { return c.plan.report.passage.depth; },
      [](const Cycle& c) { return c.plan.report.road_exit.depth; },
      [](const Cycle& c) { return sim::start_slack(c).distance; },
      [](const Cycle& c) { return sim::start_slack(c).heading; },
      [](const Cycle& c) { return -c.plan.certificate.least_clearance; },
      [](const Cycle& c) { return -c.plan.certificate.least_wheel_load; }};
  std::set<std::size_t> found = {0, cycles.size() - 1};
  for (const auto& kind : kinds) {
    std::size_t at = 0;
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < cycles.size(); ++k) {
      const double value = kind(cycles[k]);
      if (cycles[k].index > 0 && value > most) most = value, at = k;
    }
    found.insert(at);
  }
  return found;
}

/// Whether a cycle is unlike the one before it.
bool changes(const Cycle& before, const Cycle& cycle) {
  const auto &a = before.plan, &b = cycle.plan;
  return a.report.status != b.report.status || a.report.solved != b.report.solved ||
         a.rung != b.rung || a.goal_in_range != b.goal_in_range || before.used != cycle.used;
}

}  // namespace

std::vector<std::size_t> kept_evenly(std::size_t count, std::size_t most) {
  std::vector<std::size_t> indices;
  most = std::min(std::max<std::size_t>(most, 2), count);
  for (std::size_t k = 0; k < most; ++k)
    indices.push_back(most == 1 ? 0 : k * (count - 1) / (most - 1));
  return indices;
}

std::vector<std::size_t> kept_samples(const std::vector<PlantSample>& plant,
                                      const std::vector<double>& marked, std::size_t most) {
  if (plant.size() <= most) return kept_evenly(plant.size(), most);
  const auto share = [&](double of) {
    return static_cast<std::size_t>(of * static_cast<double>(most));
  };
  Samples samples(plant, most);
  samples.keep(0);
  samples.keep(plant.size() - 1);
  samples.keep_extremes();
  for (const std::size_t k : kept_evenly(marked.size(), share(kMarkedShare)))
    samples.keep_nearest(marked[k]);
  samples.keep_dips(share(kEvenShare));
  samples.refine();
  return samples.all();
}

std::vector<std::size_t> by_weight(const std::vector<Cycle>& cycles,
                                   const std::vector<double>& marked) {
  if (cycles.empty()) return {};
  const std::set<std::size_t> worst = outstanding(cycles);
  const std::set<double> times(marked.begin(), marked.end());
  std::vector<std::size_t> order(worst.begin(), worst.end()), failed, changed, others;
  for (std::size_t k = 0; k < cycles.size(); ++k) {
    if (worst.count(k) > 0) continue;
    const bool grave = !cycles[k].plan.report.solved || times.count(cycles[k].t_swap) > 0;
    (grave ? failed : changes(cycles[k - 1], cycles[k]) ? changed : others).push_back(k);
  }
  failed = spread(failed);
  changed = spread(changed);
  others = spread(others);
  const auto take = [&order](const std::vector<std::size_t>& from, std::size_t at) {
    if (at < from.size()) order.push_back(from[at]);
  };
  for (std::size_t turn = 0; order.size() < cycles.size(); ++turn) {
    take(failed, 2 * turn);
    take(failed, 2 * turn + 1);
    take(changed, turn);
    take(others, turn);
  }
  return order;
}

}  // namespace slalom::report
