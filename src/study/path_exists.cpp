#include "slalom/study/path_exists.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace slalom::study {
namespace {

struct Place {
  double x = 0, y = 0;
};

class Search {
 public:
  Search(const sim::Scenario& scenario, const PathSearch& search)
      : s_(scenario), p_(search), start_{s_.start[vehicle::X], s_.start[vehicle::Y]} {
    const double dx = s_.goal.x - start_.x, dy = s_.goal.y - start_.y;
    const double length = std::max(std::hypot(dx, dy), 1e-9);
    along_ = {dx / length, dy / length};
    rows_ = static_cast<int>(std::ceil((length + s_.goal.sigma) / p_.cell)) + 1;
    side_ = static_cast<int>(std::floor(p_.half_width / p_.cell));
    for (const auto& o : s_.obstacles) {
      auto grown = o;
      grown.a += s_.loop.sm_crash + p_.clearance;
      grown.b += s_.loop.sm_crash + p_.clearance;
      obstacles_.push_back(grown);
    }
  }

  bool run() const {
    const int columns = 2 * side_ + 1;
    std::vector<char> reached(index(rows_, 0), 0), next;
    reached[static_cast<std::size_t>(side_)] = 1;
    const int layers = static_cast<int>(std::ceil(p_.t_max / p_.dt));
    for (int layer = 0; layer < layers; ++layer) {
      next.assign(reached.size(), 0);
      bool any = false;
      for (int row = 0; row < rows_; ++row)
        for (int column = 0; column < columns; ++column)
          if (reached[index(row, column)] != 0) {
            if (at_goal(place(row, column))) return true;
            any = spread(row, column, layer * p_.dt, next) || any;
          }
      if (!any) return false;
      reached.swap(next);
    }
    return false;
  }

 private:
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(2 * side_ + 1) +
           static_cast<std::size_t>(column);
  }

  Place place(double row, double column) const {
    const double s = row * p_.cell, n = (column - side_) * p_.cell;
    return {start_.x + along_.x * s + along_.y * n, start_.y + along_.y * s - along_.x * n};
  }

  bool at_goal(const Place& p) const {
    return std::fabs(p.x - s_.goal.x) <= s_.goal.sigma &&
           std::fabs(p.y - s_.goal.y) <= s_.goal.sigma;
  }

  bool free(const Place& p, double t) const {
    if (p.x < s_.region.x_min || p.x > s_.region.x_max || p.y < s_.region.y_min ||
        p.y > s_.region.y_max)
      return false;
    return std::none_of(obstacles_.begin(), obstacles_.end(), [&](const auto& o) {
      const double dx = (p.x - o.x_at(t)) / o.a, dy = (p.y - o.y_at(t)) / o.b;
      return dx * dx + dy * dy < 1;
    });
  }

  bool move_free(int row, int column, int ahead, int across, double t) const {
    constexpr int kParts = 12;  // a metre at 24 m/s: thinner than any obstacle with its margins
    for (int part = kParts; part > 0; --part) {
      const double share = static_cast<double>(part) / kParts;
      if (!free(place(row + share * ahead, column + share * across), t + share * p_.dt))
        return false;
    }
    return true;
  }

  /// Marks where moves from one place lead; whether any is free.
  bool spread(int row, int column, double t, std::vector<char>& next) const {
    const int columns = 2 * side_ + 1;
    const int least = std::max(1, static_cast<int>(std::ceil(p_.v_min * p_.dt / p_.cell)));
    const int most = static_cast<int>(std::floor(p_.v_max * p_.dt / p_.cell));
    bool any = false;
    for (int ahead = most; ahead >= least; --ahead) {
      const int to_row = row + ahead;
      if (to_row >= rows_) continue;
      const int reach = static_cast<int>(std::floor(p_.slope * ahead));
      for (int across = -reach; across <= reach; ++across) {
        const int to = column + across;
        if (to < 0 || to >= columns) continue;
        auto& mark = next[index(to_row, to)];
        if (mark == 0 && move_free(row, column, ahead, across, t)) mark = 1;
        any = any || mark != 0;
      }
    }
    return any;
  }

  const sim::Scenario& s_;
  const PathSearch p_;
  Place start_, along_;
  int rows_ = 0, side_ = 0;
  std::vector<planner::Obstacle> obstacles_;  ///< grown
};

}  // namespace

bool path_exists(const sim::Scenario& scenario, const PathSearch& search) {
  return Search(scenario, search).run();
}

}  // namespace slalom::study
