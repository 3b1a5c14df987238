#include "slalom/world/way_finder.hpp"

#include <algorithm>
#include <cmath>

#include "place_search.hpp"

namespace slalom::world {
namespace {

using vehicle::State;

/// The side of a region at `side`, moved inwards as far as the search wants and the start allows;
/// `inwards` is 1 for the lower side, -1 for the upper.
double side_for(double side, double start, double inset, double inwards) {
  const double inner = side + inwards * inset;
  if (inwards * (start - inner) >= 0) return inner;
  return inwards * (start - side) >= 0 ? side : start - inwards * 0.5;
}

PlaceSearch::Place first_place(const State& start, const Goal& goal,
                               const vehicle::Parameters& vehicle) {
  const double v = std::max(start[vehicle::UX], 0.0);
  const double slip =
      std::atan2(start[vehicle::V] + vehicle.la * start[vehicle::R], std::max(v, 0.3));
  PlaceSearch::Place place;
  place.x = static_cast<float>(start[vehicle::X] - goal.x);
  place.y = static_cast<float>(start[vehicle::Y] - goal.y);
  place.heading = static_cast<float>(start[vehicle::PSI] + slip);
  place.v = static_cast<float>(v);
  place.kappa = static_cast<float>(v > 1 ? start[vehicle::R] / v : 0);
  return place;
}

}  // namespace

class WayFinder::Impl {
 public:
  Impl(const Environment& environment, const vehicle::Parameters& vehicle)
      : goal_(environment.goal),
        region_(environment.region),
        vehicle_(vehicle),
        search_(environment.goal, vehicle) {}

  std::optional<Way> find(const State& start, double t_start,
                          const std::vector<Obstacle>& obstacles, const WaySearch& search,
                          const std::function<bool()>& out_of_budget) {
    ellipses_.clear();
    for (const auto& o : obstacles) add(o, start, t_start, search.clearance);
    const auto place = first_place(start, goal_, vehicle_);
    const bool found =
        search_.run(place, region_for(place, search), ellipses_, search, out_of_budget);
    looked_at_ += search_.looked_at();
    if (!found) return std::nullopt;
    Way way;
    search_.write(t_start, way);
    return way;
  }

  int looked_at_ = 0;

 private:
  Region region_for(const PlaceSearch::Place& start, const WaySearch& search) const {
    const auto x = static_cast<double>(start.x), y = static_cast<double>(start.y);
    return {side_for(region_.x_min - goal_.x, x, search.inset, 1),
            side_for(region_.x_max - goal_.x, x, search.inset, -1),
            side_for(region_.y_min - goal_.y, y, search.inset, 1),
            side_for(region_.y_max - goal_.y, y, search.inset, -1)};
  }

  /// The obstacle as the search counts it, so that the start is outside.
  void add(const Obstacle& o, const State& start, double t_start, double clearance) {
    const double dx = start[vehicle::X] - o.x_at(t_start), dy = start[vehicle::Y] - o.y_at(t_start);
    Ellipse e = {o.x_at(t_start) - goal_.x,
                 o.y_at(t_start) - goal_.y,
                 o.vx,
                 o.vy,
                 o.a + clearance,
                 o.b + clearance};
    if (std::hypot(dx / e.a, dy / e.b) < 1) {
      const double inside = std::hypot(dx / o.a, dy / o.b);
      if (inside == 0) return;
      e.a = o.a * (inside < 1 ? inside / 2 : 1);
      e.b = o.b * (inside < 1 ? inside / 2 : 1);
    }
    ellipses_.push_back(e);
  }

  const Goal goal_;
  const Region region_;
  const vehicle::Parameters vehicle_;
  PlaceSearch search_;
  std::vector<Ellipse> ellipses_;
};

WayFinder::WayFinder(const Environment& environment, const vehicle::Parameters& vehicle)
    : impl_(std::make_unique<Impl>(environment, vehicle)) {}
WayFinder::~WayFinder() = default;
WayFinder::WayFinder(WayFinder&&) noexcept = default;
WayFinder& WayFinder::operator=(WayFinder&&) noexcept = default;

std::optional<Way> WayFinder::find(const State& start, double t_start,
                                   const std::vector<Obstacle>& obstacles, const WaySearch& search,
                                   const std::function<bool()>& out_of_budget) {
  impl_->looked_at_ = 0;
  return impl_->find(start, t_start, obstacles, search, out_of_budget);
}

std::vector<Way> WayFinder::find_ways(const State& start, double t_start,
                                      const std::vector<Obstacle>& obstacles,
                                      const WaySearch& search, int most,
                                      const std::function<bool()>& out_of_budget) {
  impl_->looked_at_ = 0;
  std::vector<Way> ways;
  if (most > 0)
    if (auto way = impl_->find(start, t_start, obstacles, search, out_of_budget))
      ways.push_back(std::move(*way));
  return ways;
}

int WayFinder::looked_at() const {
  return impl_->looked_at_;
}

}  // namespace slalom::world
