#include "slalom/vehicle/parameters.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "acceleration_limits.hpp"
#include "slalom/base/error.hpp"

namespace slalom::vehicle {
namespace {

using Range = OptionRange;
constexpr const char* kTable = "formulation section 2; paper, table of vehicle parameters";
constexpr const char* kSection = "formulation section 2";

void add_body(OptionTable<Parameters>& table) {
  using P = Parameters;
  table.text("name", &P::name, "Name of the vehicle, shown in reports.")
      .real("m", &P::m, Range::positive(), "kg", "Mass.", kTable)
      .real("Izz", &P::Izz, Range::positive(), "kg m^2", "Yaw inertia about the c.g.", kTable)
      .real("la", &P::la, Range::positive(), "m", "Distance from the c.g. to the front axle.",
            kTable)
      .real("lb", &P::lb, Range::positive(), "m", "Distance from the c.g. to the rear axle.",
            kTable)
      .real("width", &P::width, Range::positive(), "m", "Width of the body.")
      .real("length", &P::length, Range::positive(), "m", "Length of the body.")
      .real("front_overhang", &P::front_overhang, Range::any(), "m",
            "From the front axle to the front of the body.")
      .choice("footprint", &P::footprint, {"point", "rectangle"},
              "What keeps off obstacles and stays on the road: the front axle's centre, so that "
              "margins have to make up for the body as in the paper, or the body's rectangle.")
      .real(
          "h", &P::h, Range::positive(), "m",
          "Height of the c.g. No equation uses it; KZX, KZYR and KZYF follow from it where a file "
          "states it and not them. The HMMWV's is the one that its KZX comes to.")
      .real(
          "track", &P::track, Range::positive(), "m",
          "Distance between the wheels of an axle. No equation uses it; KZYR and KZYF follow from "
          "it where a file states it and not them. The HMMWV's is the one that these come to.")
      .real(
          "FzF0", &P::FzF0, Range::positive(), "N",
          "Static load of the front axle. Where a file states m, la or lb and not this, it follows "
          "from them; the HMMWV's is a number of its own.",
          kSection)
      .real("FzR0", &P::FzR0, Range::positive(), "N", "Static load of the rear axle; else as FzF0.",
            kSection)
      .real("KZX", &P::KZX, Range::non_negative(), "N/(m/s^2)",
            "Load moved from the front axle to the rear by 1 m/s^2 of ax - v r.", kTable)
      .real("KZYR", &P::KZYR, Range::non_negative(), "N/(m/s^2)",
            "Load moved from rear left to rear right by 1 m/s^2 of lateral force over mass.",
            kTable)
      .real("KZYF", &P::KZYF, Range::non_negative(), "N/(m/s^2)",
            "Load moved from front left to front right by 1 m/s^2 of lateral force over mass.",
            kTable);
}

void add_tyre(OptionTable<Parameters>& table) {
  using P = Parameters;
  const auto any = Range::any();
  table
      .choice("tyre", &P::tyre, {"pure_slip", "combined_slip"},
              "combined_slip: the longitudinal force of an axle takes from its lateral one "
              "(docs/vehicles.md); the paper's tyre is pure_slip.")
      .real("FZ0", &P::FZ0, Range::positive(), "N", "Nominal load of the tyre formula, per axle.",
            kSection)
      .real("PCY1", &P::PCY1, Range::positive(), "1", "Shape factor C.", kSection)
      .real("PDY1", &P::PDY1, Range::positive(), "1", "Lateral friction at nominal load.", kSection)
      .real("PDY2", &P::PDY2, any, "1", "Change of friction with load.", kSection)
      .real("PEY1", &P::PEY1, any, "1", "Curvature factor E at nominal load.", kSection)
      .real("PEY2", &P::PEY2, any, "1", "Change of curvature with load.", kSection)
      .real("PEY3", &P::PEY3, any, "1", "Dependence of curvature on the slip angle's sign.",
            kSection)
      .real("PKY1", &P::PKY1, any, "1/rad",
            "Greatest cornering stiffness over nominal load; negative, for a positive slip angle "
            "gives a force to the right.",
            kSection)
      .real("PKY2", &P::PKY2, Range::positive(), "1",
            "Load over nominal load at which cornering stiffness is greatest.", kSection)
      .real("PHY1", &P::PHY1, any, "rad", "Horizontal shift at nominal load.", kSection)
      .real("PHY2", &P::PHY2, any, "rad", "Change of horizontal shift with load.", kSection)
      .real("PVY1", &P::PVY1, any, "1", "Vertical shift over load at nominal load.", kSection)
      .real("PVY2", &P::PVY2, any, "1", "Change of vertical shift with load.", kSection)
      .real("EP", &P::EP, Range::positive(), "m/s, rad",
            "Small number that keeps slip angles finite at standstill [m/s] and smooths the sign "
            "of the slip angle [rad].",
            kSection)
      .real("F_offset_front", &P::F_offset_front, any, "N",
            "Makes the front axle's lateral force vanish at zero slip and static load.", kSection)
      .real("F_offset_rear", &P::F_offset_rear, any, "N",
            "Makes the rear axle's lateral force vanish at zero slip and static load.", kSection)
      .boolean("tyre_asymmetry", &P::tyre_asymmetry,
               "false takes PHY1, PHY2, PVY1, PVY2, PEY3 and both F_offset as zero, so that left "
               "and right mirror each other.",
               kSection);
}

void add_longitudinal(OptionTable<Parameters>& table) {
  using P = Parameters;
  const auto share = Range::closed(0, 1);
  table
      .real("PDX1", &P::PDX1, Range::positive(), "1",
            "Longitudinal friction, used by combined_slip and friction_share. Where a file states "
            "PDY1 and not this, it is PDY1.")
      .real("drive_front", &P::drive_front, share, "1",
            "Share of the driving force that the front axle has; of combined_slip and "
            "friction_share.")
      .real("brake_front", &P::brake_front, share, "1",
            "Share of the braking force that the front axle has; likewise.");
}

void add_limits(OptionTable<Parameters>& table) {
  using P = Parameters;
  table
      .real("psi_max", &P::psi_max, Range::positive(), "rad", "Bound of |psi|, the heading.",
            kTable)
      .real("sa_max_deg", &P::sa_max_deg, {.lo = 0, .hi = 90, .lo_open = true, .hi_open = true},
            "deg", "Bound of |sa|, the front steering angle.", kTable)
      .real("sr_max_deg", &P::sr_max_deg, Range::positive(), "deg/s",
            "Bound of |sr|, the steering rate.", kTable)
      .real("ux_min", &P::ux_min, Range::non_negative(), "m/s", "Least longitudinal speed.", kTable)
      .real("ux_max", &P::ux_max, Range::positive(), "m/s", "Greatest longitudinal speed.", kTable)
      .real("jx_max", &P::jx_max, Range::positive(), "m/s^3",
            "Bound of |jx|, the longitudinal jerk.", kTable)
      .real("Fz_min", &P::Fz_min, Range::non_negative(), "N", "Least wheel load a plan may have.",
            kTable)
      .vector("ax_max", &P::ax_max, Range::any(), "m/s^2 over m/s",
              "Greatest longitudinal acceleration as a cubic in ux, highest power first.", kSection)
      .vector("ax_min", &P::ax_min, Range::any(), "m/s^2 over m/s",
              "Least longitudinal acceleration as a cubic in ux, highest power first.", kSection)
      .real("power", &P::power, Range::non_negative(), "W",
            "Power of the drive: ax is also below power/(m ux), smoothly. 0 limits nothing.")
      .real("friction_share", &P::friction_share, Range::closed(0, 1), "1",
            "Share of its friction PDX1 Fz that driving and braking may take of an axle: ax is "
            "also within what that allows, smoothly. 0 limits nothing.");
}

}  // namespace

double Parameters::sa_max() const {
  return sa_max_deg * std::numbers::pi / 180;
}

double Parameters::sr_max() const {
  return sr_max_deg * std::numbers::pi / 180;
}

double Parameters::ax_max_at(double speed) const {
  return acceleration::most(*this, speed);
}

double Parameters::ax_min_at(double speed) const {
  return acceleration::least(*this, speed);
}

double Parameters::cornering_stiffness(double Fz) const {
  return -PKY1 * FZ0 * std::sin(2 * std::atan(Fz / (PKY2 * FZ0)));
}

const OptionTable<Parameters>& parameter_options() {
  static const auto table = [] {
    OptionTable<Parameters> options;
    add_body(options);
    add_tyre(options);
    add_longitudinal(options);
    add_limits(options);
    return options;
  }();
  return table;
}

void check(const Parameters& parameters, const std::string& where) {
  parameter_options().check(parameters, where);
  if (parameters.ux_min >= parameters.ux_max)
    throw InvalidValue(where, fmt::format("ux_min = {}", parameters.ux_min),
                       fmt::format("a number below ux_max = {}", parameters.ux_max),
                       {"ux_min", "ux_max"});
  constexpr int kPoints = 100;
  for (int i = 0; i <= kPoints; ++i) {
    const double speed =
        parameters.ux_min + (parameters.ux_max - parameters.ux_min) * i / double{kPoints};
    if (parameters.ax_min_at(speed) >= parameters.ax_max_at(speed))
      throw InvalidValue(
          where,
          fmt::format("ax_min = {:.6g} m/s^2 at ux = {:.6g} m/s", parameters.ax_min_at(speed),
                      speed),
          fmt::format("less than ax_max = {:.6g} m/s^2 there", parameters.ax_max_at(speed)),
          {"ax_min", "ax_max"});
  }
}

}  // namespace slalom::vehicle
