#pragma once

#include <cstddef>
#include <vector>

#include "slalom/vehicle/plant.hpp"
#include "slalom/vehicle/state.hpp"
#include "slalom/world/pose.hpp"

namespace slalom::planner {

/// Times nearer than this are one [s].
constexpr double kSameTime = 1e-6;

/// A motion through time: states and controls at knots of absolute time [s], the controls linear
/// between them.
struct Motion {
  std::vector<double> t;
  std::vector<vehicle::State> states;
  std::vector<vehicle::Control> controls;

  std::size_t size() const { return t.size(); }
  double begin() const { return t.front(); }
  double end() const { return t.back(); }
  void add(double at, const vehicle::State& state, const vehicle::Control& control) {
    t.push_back(at);
    states.push_back(state);
    controls.push_back(control);
  }
  void append(const Motion& other);

  void drop_last() {
    t.pop_back();
    states.pop_back();
    controls.pop_back();
  }

  /// Linear between knots; the first before them, and the last after them.
  vehicle::State state_at(double at) const;
  vehicle::Control control_at(double at) const;
};

/// The knots of a motion before `at` [s].
Motion part_before(const Motion& motion, double at);

/// What there is of a motion from t0 on, which is not before it begins. The state between two knots
/// is the plant's. Throws PlantError.
Motion part_from(const Motion& motion, double t0, const vehicle::Plant& plant);

/// Some places along a motion, its first and last among them.
std::vector<world::Point> path_of(const Motion& motion);

/// Between the places of two states [m].
double apart(const vehicle::State& a, const vehicle::State& b);

}  // namespace slalom::planner
