#include "slalom/vehicle/derived.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "slalom/vehicle/model.hpp"

namespace slalom::vehicle {
namespace {

/// A setting, those it follows from, and how. `of` names others of these, too.
struct Rule {
  std::string name;
  std::vector<std::string> of;
  std::function<double(const Parameters&)> value;
};

double axle_distance(const Parameters& p) {
  return p.la + p.lb;
}

/// Lateral load transfer of both axles for 1 m/s^2, shared between them as it is now.
double lateral_transfer(const Parameters& p, double share_of) {
  return p.m * p.h / p.track * share_of / (p.KZYR + p.KZYF);
}

/// Lateral force of an axle at zero slip and static load [N]: 0 is the front one.
double force_at_rest(Parameters p, std::size_t axle) {
  p.F_offset_front = p.F_offset_rear = 0;
  State straight_on{};
  straight_on[UX] = 10;
  return Dynamics(p).tyre_forces(straight_on).at(axle);
}

/// In an order in which what one follows from comes before it.
const std::vector<Rule>& rules() {
  static const std::vector<std::string> tyre = {"FZ0",  "PCY1", "PDY1", "PDY2", "PEY1",
                                                "PEY2", "PEY3", "PKY1", "PKY2", "PHY1",
                                                "PHY2", "PVY1", "PVY2", "EP"};
  const auto with_tyre = [](const std::string& load) {
    auto of = tyre;
    of.push_back(load);
    return of;
  };
  static const std::vector<Rule> all = {
      {"FzF0",
       {"m", "la", "lb"},
       [](const auto& p) { return p.m * kGravity * p.lb / axle_distance(p); }},
      {"FzR0",
       {"m", "la", "lb"},
       [](const auto& p) { return p.m * kGravity * p.la / axle_distance(p); }},
      {"KZX", {"m", "la", "lb", "h"}, [](const auto& p) { return p.m * p.h / axle_distance(p); }},
      {"KZYR", {"m", "h", "track"}, [](const auto& p) { return lateral_transfer(p, p.KZYR); }},
      {"KZYF", {"m", "h", "track"}, [](const auto& p) { return lateral_transfer(p, p.KZYF); }},
      {"PDX1", {"PDY1"}, [](const auto& p) { return p.PDY1; }},
      {"F_offset_front", with_tyre("FzF0"), [](const auto& p) { return -force_at_rest(p, 0); }},
      {"F_offset_rear", with_tyre("FzR0"), [](const auto& p) { return -force_at_rest(p, 1); }},
  };
  return all;
}

}  // namespace

std::vector<std::string> derive(Parameters& parameters, const std::set<std::string>& stated,
                                const std::set<std::string>& kept) {
  const Parameters before = parameters;
  auto changed = stated;
  std::vector<std::string> derived;
  for (const auto& rule : rules()) {
    if (stated.count(rule.name) > 0 || kept.count(rule.name) > 0 ||
        std::none_of(rule.of.begin(), rule.of.end(),
                     [&](const auto& name) { return changed.count(name) > 0; }))
      continue;
    // Both shares of the lateral transfer are those of the vehicle that it is based on.
    Parameters from = parameters;
    from.KZYR = before.KZYR;
    from.KZYF = before.KZYF;
    const double value = rule.value(from);
    if (!std::isfinite(value)) continue;  // what is stated is at fault, and refused elsewhere
    parameter_options().find(rule.name)->set(parameters, OptionValue(value));
    changed.insert(rule.name);
    derived.push_back(rule.name);
  }
  return derived;
}

}  // namespace slalom::vehicle
