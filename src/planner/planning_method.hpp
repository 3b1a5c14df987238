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
  /// Solves that are recorded are those of the paper's OCP; other methods record none.
  virtual void record(const Recorder&) {}
};

}  // namespace slalom::planner
