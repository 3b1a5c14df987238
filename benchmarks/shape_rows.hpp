#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "shape_scenes.hpp"
#include "slalom/ocp/guess.hpp"
#include "slalom/ocp/problem.hpp"
#include "slalom/vehicle/parameters.hpp"
#include "slalom/world/footprint.hpp"

namespace slalom::bench {

/// What the vehicle's rectangle keeps from bodies [m].
inline constexpr double kKept = 0.3;

/// The paper's vehicle with a body; its frame is that of the front axle's centre.
struct Vehicle {
  vehicle::Parameters parameters = with_body();
  world::Footprint footprint{parameters};

  static vehicle::Parameters with_body() {
    vehicle::Parameters p;
    p.footprint = vehicle::FootprintKind::rectangle;
    return p;
  }
  std::vector<world::Point> corners_at(const world::Pose& pose) const {
    std::vector<world::Point> out;
    for (const auto& p : footprint.corners()) out.push_back(pose.to_world(p));
    return out;
  }
};

/// Rows and variables that keep the vehicle off a scene's bodies.
class ShapeRows {
 public:
  using PoseAt = std::function<world::Pose(double t)>;  ///< of the vehicle, in the guess

  virtual ~ShapeRows() = default;
  virtual std::size_t rows() const = 0;       ///< at each point
  virtual std::size_t variables() const = 0;  ///< at each point
  /// Adds the variables' guess.
  virtual void guess(ocp::Guess& guess, const PoseAt& pose) const = 0;
};

/// The names that make_rows knows, as the page has them.
const std::vector<std::string>& shape_forms();
/// Adds them to a problem, with the states of the vehicle's pose: "discs-E" of cover excess E [m],
/// "superellipse-P" of exponent P, "axes", "line", or "dual".
std::unique_ptr<ShapeRows> make_rows(const std::string& form, const ShapeScene& scene,
                                     ocp::Problem& problem, const Vehicle& vehicle,
                                     const ocp::Expr& x, const ocp::Expr& y, const ocp::Expr& psi);

}  // namespace slalom::bench
