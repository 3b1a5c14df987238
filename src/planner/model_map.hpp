#pragma once

#include "slalom/expr/function.hpp"
#include "slalom/ocp/trajectory.hpp"
#include "slalom/vehicle/model.hpp"
#include "slalom/vehicle/parameters.hpp"
#include "slalom/vehicle/state.hpp"

namespace slalom::planner {

/// The planner's own model, and the way between its trajectories and those of the plant, which have
/// all states, all controls and a slack on every initial state. Where the two are the same model,
/// it leaves trajectories as they are.
class ModelMap {
 public:
  ModelMap(const vehicle::Parameters& vehicle, vehicle::ModelKind kind);

  const vehicle::Model& model() const { return model_; }

  /// Drops what the planner's model does not have; the slacks on initial states come first.
  void to_planner(ocp::Trajectory& trajectory) const;
  /// Adds it again: what is held as in X0p, what is derived by its formula, controls and slacks as
  /// zero.
  void to_plant(const vehicle::State& X0p, ocp::Trajectory& trajectory) const;

 private:
  void complete(const vehicle::State& X0p, std::vector<double>& state) const;

  vehicle::Model model_;
  expr::Function values_;  ///< of all entries of the state, from themselves
  bool same_;              ///< the model has all of the plant's states and controls
};

}  // namespace slalom::planner
