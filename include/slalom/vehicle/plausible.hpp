#pragma once

#include <string>
#include <vector>

#include "slalom/vehicle/parameters.hpp"

namespace slalom::vehicle {

/// What of a vehicle's parameters hardly belongs to one vehicle, a sentence each: static loads that
/// are not the weight or not those of the axles' places, load transfer that does not fit the c.g.'s
/// height, a body that does not hold its axles, accelerations or tyre forces that no tyre gives, a
/// vehicle that pulls to a side or spins below its top speed. None of it is refused.
std::vector<std::string> implausible(const Parameters& parameters);

}  // namespace slalom::vehicle
