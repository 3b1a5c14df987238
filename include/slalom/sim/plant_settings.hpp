#pragma once

#include "slalom/base/options.hpp"
#include "slalom/vehicle/parameters.hpp"

namespace slalom::sim {

/// How the plant differs from the scenario's vehicle, which planner and prediction go on to believe
/// in; section 4 of docs/formulation.md. The defaults change nothing.
struct PlantSettings {
  double mass_factor = 1;                 ///< on m, Izz, static loads and load transfer
  double friction_factor = 1;             ///< on the peak of the tyres' lateral force
  double cornering_stiffness_factor = 1;  ///< on the slope of the lateral force at zero slip
  double cg_shift = 0;                    ///< of the centre of gravity, forward positive [m]
  double actuator_delay = 0;              ///< from a control's command to its effect [s]
};

const OptionTable<PlantSettings>& plant_options();

/// Whether the plant is the scenario's vehicle itself.
bool is_as_believed(const PlantSettings& settings);

/// The vehicle that is driven, `believed` being the scenario's. Throws InvalidValue, naming
/// `where`, for a c.g. beyond an axle and for what vehicle::check refuses.
vehicle::Parameters plant_vehicle(const vehicle::Parameters& believed,
                                  const PlantSettings& settings, const std::string& where);

}  // namespace slalom::sim
