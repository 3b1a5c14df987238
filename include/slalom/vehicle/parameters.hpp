#pragma once

#include <array>
#include <string>

#include "slalom/base/options.hpp"

namespace slalom::vehicle {

/// What of a vehicle keeps off obstacles: the front axle's centre, or the body's rectangle.
enum class FootprintKind { point, rectangle };

/// Whether an axle's longitudinal force takes from its lateral one.
enum class TyreKind { pure_slip, combined_slip };

/// Parameters of the 3DoF vehicle: body, load transfer, Pacejka tyre and limits.
/// SI units; the defaults are the HMMWV's. A file or option sets them by the same names.
struct Parameters {
  std::string name = "hmmwv";

  // Body.
  double m = 2688.7;              ///< mass [kg]
  double Izz = 4110.1;            ///< yaw inertia about the c.g. [kg m^2]
  double la = 1.5775;             ///< c.g. to front axle [m]
  double lb = 1.7245;             ///< c.g. to rear axle [m]
  double width = 2.0;             ///< of the body [m]
  double length = 4.6;            ///< of the body [m]
  double front_overhang = 0.649;  ///< from the front axle to the body's front [m]
  FootprintKind footprint = FootprintKind::point;
  double h = 0.98985;  ///< height of the c.g. [m]; of KZX, KZYR and KZYF where they are not stated
  double track = 1.51994;  ///< between the wheels of an axle [m]; of KZYR and KZYF likewise

  // Axle loads and load transfer.
  double FzF0 = 13680;  ///< static front axle load [N]
  double FzR0 = 12696;  ///< static rear axle load [N]
  double KZX = 806;     ///< longitudinal transfer [N/(m/s^2)]
  double KZYR = 1076;   ///< lateral transfer, rear [N/(m/s^2)]
  double KZYF = 675;    ///< lateral transfer, front [N/(m/s^2)]

  // Lateral tyre force (Pacejka); section 2 of docs/formulation.md.
  TyreKind tyre = TyreKind::pure_slip;
  double FZ0 = 35000;  ///< nominal load [N]
  double PCY1 = 1.5874;
  double PDY1 = 0.73957, PDY2 = -0.075004;
  double PEY1 = 0.37562, PEY2 = -0.069325, PEY3 = 0.29168;
  double PKY1 = -10.289, PKY2 = 3.3343;
  double PHY1 = 0.0056509, PHY2 = -0.0020257;
  double PVY1 = 0.015216, PVY2 = -0.010365;
  double EP = 0.01;                           ///< regularises slip angle [m/s] and sign [rad]
  double F_offset_front = 278.2789450759981;  ///< makes Fyf(0) = 0 at static load [N]
  double F_offset_rear = 259.95925391136984;  ///< makes Fyr(0) = 0 at static load [N]
  /// Off: PH, PV, PE3 and F_offset are taken as zero, so that left and right mirror each other.
  bool tyre_asymmetry = true;
  double PDX1 = 0.73957;     ///< longitudinal friction; of combined slip and friction_share
  double drive_front = 0.5;  ///< the front axle's share of the driving force ...
  double brake_front = 0.5;  ///< ... and of the braking force

  // Limits.
  double psi_max = 6.283185307179586;  ///< |psi| [rad]
  double sa_max_deg = 30;              ///< |sa| [deg]
  double sr_max_deg = 5;               ///< |sr| [deg/s]
  double ux_min = 0.01, ux_max = 29;   ///< [m/s]
  double jx_max = 5;                   ///< |jx| [m/s^3]
  double Fz_min = 1000;                ///< least wheel load a plan may have [N]
  /// ax_max(ux), ax_min(ux): cubics, highest power first [m/s^2 over m/s].
  std::array<double, 4> ax_max = {-0.000128015180401862, 0.00858618595422724, -0.225657108071454,
                                  3.08283259993589};
  std::array<double, 4> ax_min = {-0.000138537090018958, 0.00684702729623608, -0.120391102052425,
                                  -3.55886697370079};

  double power = 0;           ///< of the drive [W]; 0 limits nothing
  double friction_share = 0;  ///< of an axle's friction that ax may take; 0 limits nothing

  double sa_max() const;  ///< [rad]
  double sr_max() const;  ///< [rad/s]
  /// Limits of longitudinal acceleration [m/s^2] at `speed` = ux [m/s]: the cubics, and within them
  /// those of power and friction where stated.
  double ax_max_at(double speed) const;
  double ax_min_at(double speed) const;
  /// Cornering stiffness of an axle [N/rad] at load Fz [N]: the slope of Pacejka's formula at zero
  /// slip (H. Pacejka, Tire and Vehicle Dynamics, 2012, Eqn. 4.E25), positive here.
  double cornering_stiffness(double Fz) const;
};

/// The registered options of Parameters, in file order, with unit, range, meaning and source.
const OptionTable<Parameters>& parameter_options();

/// Throws InvalidValue, naming `where`, when a value is outside its registered range or not finite,
/// when ux_min >= ux_max, or when ax_min(ux) >= ax_max(ux) at a speed within the bounds.
void check(const Parameters& parameters, const std::string& where);

}  // namespace slalom::vehicle
