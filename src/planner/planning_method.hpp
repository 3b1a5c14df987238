#pragma once

#include "slalom/planner/planner.hpp"

namespace slalom::planner {

/// What a Planner is made of: one way to plan.
class PlanningMethod {
 public:
  PlanningMethod() = default;
  PlanningMethod(const PlanningMethod&) = delete;
  PlanningMethod& operator=(const PlanningMethod&) = delete;
  virtual ~PlanningMethod() = default;

  virtual Plan plan(const Request& request) = 0;
  virtual void reset() = 0;
  /// The paper's method records solves of its OCP, one that verifies its plans.
  virtual void record(const Recorder& recorder) = 0;
};

}  // namespace slalom::planner
