#pragma once

#include <set>
#include <string>
#include <vector>

#include "slalom/vehicle/parameters.hpp"

namespace slalom::vehicle {

/// Standard gravity [m/s^2] (ISO 80000-3).
inline constexpr double kGravity = 9.80665;

/// Settings that follow from those that `stated` names, and are not stated themselves: static axle
/// loads of mass and axles, load transfer of these, the c.g.'s height and the track, and the
/// offsets that make the axles' lateral forces vanish at zero slip (docs/formulation.md, section
/// 2). A data sheet states the first; a vehicle that kept the others of the one it is based on
/// would pull to a side. Those that `kept` names stay too: they were stated before. Sets the others
/// and returns their names.
std::vector<std::string> derive(Parameters& parameters, const std::set<std::string>& stated,
                                const std::set<std::string>& kept = {});

}  // namespace slalom::vehicle
