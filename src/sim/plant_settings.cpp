#include "slalom/sim/plant_settings.hpp"

#include <fmt/format.h>

#include "slalom/base/error.hpp"
#include "slalom/vehicle/model.hpp"

namespace slalom::sim {
namespace {

using Range = OptionRange;

/// More mass in the same places: inertia, static loads and what accelerations move grow with it.
void scale_mass(vehicle::Parameters& p, double factor) {
  for (double* value : {&p.m, &p.Izz, &p.FzF0, &p.FzR0, &p.KZX, &p.KZYR, &p.KZYF}) *value *= factor;
}

/// The c.g. moves forward by `shift` [m], and the static loads by the balance of moments:
///   FzF0 + W shift/L, FzR0 - W shift/L        W = FzF0 + FzR0, L = la + lb
void move_cg(vehicle::Parameters& p, double shift) {
  const double moved = (p.FzF0 + p.FzR0) * shift / (p.la + p.lb);
  p.FzF0 += moved;
  p.FzR0 -= moved;
  p.la -= shift;
  p.lb += shift;
}

/// The scaling factors LMUX, LMUY and LKY of H. B. Pacejka, Tyre and Vehicle Dynamics,
/// section 4.3.2: friction scales D and the vertical shift, and leaves B C D, the cornering
/// stiffness, which has a factor of its own.
void scale_tyre(vehicle::Parameters& p, double friction, double stiffness) {
  for (double* value : {&p.PDX1, &p.PDY1, &p.PDY2, &p.PVY1, &p.PVY2}) *value *= friction;
  p.PKY1 *= stiffness;
}

/// Keys that may be at fault where values `of` of the plant's vehicle are: the settings that make
/// it another vehicle, and the values themselves.
std::vector<std::string> keys_behind(const PlantSettings& settings, const InvalidValue& of) {
  std::vector<std::string> keys;
  for (const char* name :
       {"mass_factor", "friction_factor", "cornering_stiffness_factor", "cg_shift"}) {
    const auto& entry = *plant_options().find(name);
    if (entry.get(settings) != entry.get(PlantSettings{}))
      keys.push_back(std::string("plant.") + name);
  }
  const auto own = of.within("vehicle").keys();
  keys.insert(keys.end(), own.begin(), own.end());
  return keys;
}

/// Forces [N] of the axles driving straight on at static load.
std::array<double, 2> straight_on_forces(const vehicle::Parameters& p) {
  vehicle::State state{};
  state[vehicle::UX] = p.ux_max;
  return vehicle::Dynamics(p).tyre_forces(state);
}

}  // namespace

const OptionTable<PlantSettings>& plant_options() {
  using P = PlantSettings;
  constexpr const char* kPacejka = "Pacejka, Tyre and Vehicle Dynamics, section 4.3.2";
  static const auto table = [] {
    OptionTable<PlantSettings> options;
    options
        .real(
            "mass_factor", &P::mass_factor, Range::closed(0.1, 10), "1",
            "The plant's mass over the vehicle's. Izz, FzF0, FzR0, KZX, KZYR and KZYF go with it.")
        .real("friction_factor", &P::friction_factor, Range::closed(0.05, 10), "1",
              "Scales the greatest forces of the plant's tyres (LMUX, LMUY), and their vertical "
              "shift. Cornering stiffness stays.",
              kPacejka)
        .real(
            "cornering_stiffness_factor", &P::cornering_stiffness_factor, Range::closed(0.05, 10),
            "1",
            "Scales the cornering stiffness of the plant's tyres (LKY). The greatest force stays.",
            kPacejka)
        .real("cg_shift", &P::cg_shift, Range::any(), "m",
              "How far the plant's centre of gravity lies ahead of the vehicle's. Static loads "
              "follow; m and Izz stay.")
        .real("actuator_delay", &P::actuator_delay, Range::closed(0, 10), "s",
              "The plant drives both controls this much later than they are commanded; prediction "
              "does not know.");
    return options;
  }();
  return table;
}

bool is_as_believed(const PlantSettings& settings) {
  const PlantSettings neutral;
  return settings.mass_factor == neutral.mass_factor &&
         settings.friction_factor == neutral.friction_factor &&
         settings.cornering_stiffness_factor == neutral.cornering_stiffness_factor &&
         settings.cg_shift == neutral.cg_shift;
}

vehicle::Parameters plant_vehicle(const vehicle::Parameters& believed,
                                  const PlantSettings& settings, const std::string& where) {
  if (is_as_believed(settings)) return believed;
  if (!(settings.cg_shift < believed.la && settings.cg_shift > -believed.lb))
    throw InvalidValue(where + ": plant", fmt::format("cg_shift = {:.9g}", settings.cg_shift),
                       fmt::format("between -lb = {:.9g} and la = {:.9g}, both excluded",
                                   -believed.lb, believed.la),
                       {"plant.cg_shift", "vehicle.la", "vehicle.lb"});
  vehicle::Parameters driven = believed;
  scale_mass(driven, settings.mass_factor);
  move_cg(driven, settings.cg_shift);
  scale_tyre(driven, settings.friction_factor, settings.cornering_stiffness_factor);
  try {
    vehicle::check(driven, where + ": the plant's vehicle");
  } catch (const InvalidValue& error) {
    throw InvalidValue(error.where(), error.found(), error.expected(),
                       keys_behind(settings, error));
  }
  // F_offset keeps its meaning: the force that is left at zero slip and static load stays as it is.
  const auto before = straight_on_forces(believed), after = straight_on_forces(driven);
  driven.F_offset_front += before[0] - after[0];
  driven.F_offset_rear += before[1] - after[1];
  return driven;
}

}  // namespace slalom::sim
