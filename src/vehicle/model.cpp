#include "slalom/vehicle/model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "acceleration_limits.hpp"

namespace slalom::vehicle {
namespace {

using expr::Expr;

/// Coefficients of the tyre formula, from the published ones (formulation section 2):
/// PC1 = PCY1, PD1 = PDY1 - PDY2, PD2 = PDY2/FZ0, and so on.
struct TyreCoefficients {
  double PC1, PD1, PD2, PE1, PE2, PE3, PK1, PK2, PH1, PH2, PV1, PV2, EP;

  explicit TyreCoefficients(const Parameters& p)
      : PC1(p.PCY1),
        PD1(p.PDY1 - p.PDY2),
        PD2(p.PDY2 / p.FZ0),
        PE1(p.PEY1 - p.PEY2),
        PE2(p.PEY2 / p.FZ0),
        PE3(p.tyre_asymmetry ? p.PEY3 : 0),
        PK1(p.PKY1 * p.FZ0),
        PK2(1 / (p.PKY2 * p.FZ0)),
        PH1(p.tyre_asymmetry ? p.PHY1 - p.PHY2 : 0),
        PH2(p.tyre_asymmetry ? p.PHY2 / p.FZ0 : 0),
        PV1(p.tyre_asymmetry ? p.PVY1 - p.PVY2 : 0),
        PV2(p.tyre_asymmetry ? p.PVY2 / p.FZ0 : 0),
        EP(p.EP) {}
};

/// Lateral force [N] of an axle at slip angle `alpha` [rad] and load Fz [N]: pure-slip Pacejka,
/// formulation section 2.
///   a = alpha + PH2 Fz + PH1                        D = (PD2 Fz + PD1) Fz
///   B = PK1 sin(2 atan(PK2 Fz)) / (PC1 D)           E = (PE2 Fz + PE1)(1 - PE3 a/sqrt(a² + EP²))
///   Fy = D sin(PC1 atan(B a - E (B a - atan(B a)))) + (PV2 Fz + PV1) Fz + F_offset
/// With `derating` the peak is that share of D; the cornering stiffness B PC1 D stays.
Expr lateral_force(const TyreCoefficients& c, const Expr& alpha, const Expr& Fz, double F_offset,
                   const std::optional<Expr>& derating) {
  const Expr a = alpha + c.PH2 * Fz + c.PH1;
  const Expr pure = (c.PD2 * Fz + c.PD1) * Fz;
  const Expr D = derating ? *derating * pure : pure;
  const Expr B = c.PK1 * sin(2 * atan(c.PK2 * Fz)) / (c.PC1 * D);
  const Expr E = (c.PE2 * Fz + c.PE1) * (1 - c.PE3 * a / sqrt(square(a) + c.EP * c.EP));
  const Expr Ba = B * a;
  return D * sin(c.PC1 * atan(Ba - E * (Ba - atan(Ba)))) + (c.PV2 * Fz + c.PV1) * Fz + F_offset;
}

/// The same force linearised at zero slip: cornering stiffness B PC1 D = PK1 sin(2 atan(PK2 Fz))
/// times slip angle.
Expr linear_force(const TyreCoefficients& c, const Expr& alpha, const Expr& Fz) {
  return c.PK1 * sin(2 * atan(c.PK2 * Fz)) * alpha;
}

/// Between driving and braking the front axle's share of the longitudinal force changes over about
/// this much acceleration [m/s^2].
constexpr double kOverDrive = 0.1;
/// Rounds off the derating where the longitudinal force takes all friction.
constexpr double kAllFriction = 0.05;

/// Longitudinal force [N] of the front axle, then of the rear, for force over mass a [m/s^2].
std::array<Expr, 2> longitudinal_forces(const Parameters& p, const Expr& a) {
  const double mean = (p.drive_front + p.brake_front) / 2;
  const double difference = (p.drive_front - p.brake_front) / 2;
  const Expr sign = a / sqrt(square(a) + kOverDrive * kOverDrive);
  const Expr front = p.m * a * (mean + difference * sign);
  return {front, p.m * a - front};
}

/// What the longitudinal force Fx [N] leaves of an axle's greatest lateral one, as a share: the
/// friction ellipse sqrt(1 - (Fx/(mu Fz))²) (R. Y. Hindiyeh and J. C. Gerdes, "A controller
/// framework for autonomous drifting", J. Dyn. Sys. Meas. Control 136(5), 2014: derating factor of
/// a coupled tyre), with
/// w = 1 - (Fx/(mu Fz))² replaced by (w + sqrt(w² + e²))/2, and 1 where Fx = 0.
Expr derating_of(double mu, const Expr& Fx, const Expr& Fz) {
  constexpr double e = kAllFriction;
  const Expr w = 1 - square(Fx / (mu * Fz));
  // (w + sqrt(w² + e²))/2 = e²/2 / (sqrt(w² + e²) - w), which keeps its digits for w < 0.
  return sqrt((std::sqrt(1 + e * e) - 1) / (sqrt(square(w) + e * e) - w));
}

template <std::size_t N>
std::vector<Expr> list(const std::array<Expr, N>& from) {
  return {from.begin(), from.end()};
}

std::vector<Expr> state_and_control(const Model& model) {
  auto inputs = list(model.state);
  inputs.insert(inputs.end(), model.control.begin(), model.control.end());
  return inputs;
}

/// Symbols and parts of a model, and the axle loads [N] of its accelerations.
struct Frame {
  Model model;
  Expr FzF, FzR;
};

Frame make_frame() {
  Frame frame;
  Model& model = frame.model;
  for (std::size_t i = 0; i < kStates; ++i) model.state[i] = Expr::symbol(kStateNames[i]);
  for (std::size_t i = 0; i < kControls; ++i) model.control[i] = Expr::symbol(kControlNames[i]);
  model.role.fill(Role::state);
  model.value = model.state;
  model.used.fill(true);
  return frame;
}

/// Axle loads, formulation section 2 (the paper's equations of vertical load, which lost a
/// bracket):
///   FzF = FzF0 - KZX (ax - v r)        FzR = FzR0 + KZX (ax - v r)
void add_axle_loads(const Parameters& p, Frame& frame) {
  const auto& X = frame.model.state;
  const Expr transfer = p.KZX * (X[AX] - X[V] * X[R]);
  frame.FzF = p.FzF0 - transfer;
  frame.FzR = p.FzR0 + transfer;
}

/// Limits of acceleration, formulation section 2: ax_min(ux) <= ax <= ax_max(ux).
void add_acceleration_limits(const Parameters& p, Model& model) {
  model.ax_max = acceleration::most(p, model.state[UX]);
  model.ax_min = acceleration::least(p, model.state[UX]);
}

/// Wheel loads, formulation section 2, for `lateral` = (Fyf + Fyr)/m [m/s²]:
///   rl, rr = FzR/2 -+ KZYR (Fyf + Fyr)/m         fl, fr = FzF/2 -+ KZYF (Fyf + Fyr)/m
void add_wheel_loads(const Parameters& p, const Expr& lateral, Frame& frame) {
  auto& loads = frame.model.wheel_loads;
  loads[RL] = frame.FzR / 2 - p.KZYR * lateral;
  loads[RR] = frame.FzR / 2 + p.KZYR * lateral;
  loads[FL] = frame.FzF / 2 - p.KZYF * lateral;
  loads[FR] = frame.FzF / 2 + p.KZYF * lateral;
}

Model make_dynamic(const Parameters& p, ModelKind kind) {
  Frame frame = make_frame();
  Model& model = frame.model;
  const Expr &v = model.state[V], &r = model.state[R], &psi = model.state[PSI],
             &sa = model.state[SA], &ux = model.state[UX], &ax = model.state[AX];
  const Expr &sr = model.control[SR], &jx = model.control[JX];

  // Slip angles, formulation section 2:
  //   af = atan((v + la r)/(ux + EP)) - sa         ar = atan((v - lb r)/(ux + EP))
  model.alpha_f = atan((v + p.la * r) / (ux + p.EP)) - sa;
  model.alpha_r = atan((v - p.lb * r) / (ux + p.EP));

  add_axle_loads(p, frame);
  const TyreCoefficients tyre(p);
  if (kind != ModelKind::linear_tyre) {
    const auto offset = [&](double F) { return p.tyre_asymmetry ? F : 0; };
    std::array<std::optional<Expr>, 2> derating;
    if (p.tyre == TyreKind::combined_slip) {
      const auto Fx = longitudinal_forces(p, ax - v * r);
      derating = {derating_of(p.PDX1, Fx[0], frame.FzF), derating_of(p.PDX1, Fx[1], frame.FzR)};
    }
    model.Fyf =
        lateral_force(tyre, model.alpha_f, frame.FzF, offset(p.F_offset_front), derating[0]);
    model.Fyr = lateral_force(tyre, model.alpha_r, frame.FzR, offset(p.F_offset_rear), derating[1]);
  }
  model.Fyf_linear = linear_force(tyre, model.alpha_f, frame.FzF);
  model.Fyr_linear = linear_force(tyre, model.alpha_r, frame.FzR);
  if (kind == ModelKind::linear_tyre) {
    model.Fyf = model.Fyf_linear;
    model.Fyr = model.Fyr_linear;
  }
  const Expr lateral = (model.Fyf + model.Fyr) / p.m;
  add_wheel_loads(p, lateral, frame);

  // Equations of motion, paper Eqn. (6), formulation section 1; x, y of the front axle's centre:
  //   x' = ux cos(psi) - (v + la r) sin(psi)       y' = ux sin(psi) + (v + la r) cos(psi)
  //   v' = (Fyf + Fyr)/m - ux r                    r' = (la Fyf - lb Fyr)/Izz
  //   psi' = r        sa' = sr        ux' = ax     ax' = jx
  const Expr front = v + p.la * r;
  model.derivative[X] = ux * cos(psi) - front * sin(psi);
  model.derivative[Y] = ux * sin(psi) + front * cos(psi);
  model.derivative[V] = lateral - ux * r;
  model.derivative[R] = (p.la * model.Fyf - p.lb * model.Fyr) / p.Izz;
  model.derivative[PSI] = r;
  model.derivative[SA] = sr;
  model.derivative[UX] = ax;
  model.derivative[AX] = jx;
  add_acceleration_limits(p, model);
  return model;
}

/// The 3DoF vehicle whose speed is held: ax and jx are zero, ux is a number.
Model make_constant_speed(const Parameters& p) {
  Model model = make_dynamic(p, ModelKind::pacejka);
  model.role[UX] = Role::held;
  model.role[AX] = Role::derived;
  model.value[AX] = Expr(0.0);
  model.derivative[UX] = model.derivative[AX] = Expr(0.0);
  model.used[JX] = false;
  return model;
}

/// The kinematic bicycle (R. Rajamani, Vehicle Dynamics and Control, section 2.2; J. Kong et al.,
/// "Kinematic and dynamic vehicle models for autonomous driving control design", IEEE IV 2015),
/// steered in front and without slip at either axle:
///   rear   v - lb r = 0        front   v + la r = ux tan(sa)
/// hence r = ux tan(sa)/(la + lb), v = lb r, and the lateral acceleration v' + ux r.
Model make_kinematic(const Parameters& p) {
  Frame frame = make_frame();
  Model& model = frame.model;
  add_axle_loads(p, frame);
  add_acceleration_limits(p, model);
  const auto& X = model.state;
  const Expr tangent = tan(X[SA]);
  const Expr r = X[UX] * tangent / (p.la + p.lb);
  const Expr r_dot =
      (X[AX] * tangent + X[UX] * model.control[SR] * (1 + square(tangent))) / (p.la + p.lb);
  model.role[V] = model.role[R] = Role::derived;
  model.value[V] = p.lb * r;
  model.value[R] = r;

  const Expr front = X[UX] * tangent;
  model.derivative[slalom::vehicle::X] = X[UX] * cos(X[PSI]) - front * sin(X[PSI]);
  model.derivative[Y] = X[UX] * sin(X[PSI]) + front * cos(X[PSI]);
  model.derivative[V] = model.derivative[R] = Expr(0.0);
  model.derivative[PSI] = r;
  model.derivative[SA] = model.control[SR];
  model.derivative[UX] = X[AX];
  model.derivative[AX] = model.control[JX];
  add_wheel_loads(p, p.lb * r_dot + X[UX] * r, frame);
  return model;
}

}  // namespace

const std::vector<std::string>& model_names() {
  static const std::vector<std::string> names = {"pacejka", "linear_tyre", "constant_speed",
                                                 "kinematic"};
  return names;
}

Model make_model(const Parameters& parameters, ModelKind kind) {
  if (kind == ModelKind::kinematic) return make_kinematic(parameters);
  if (kind == ModelKind::constant_speed) return make_constant_speed(parameters);
  return make_dynamic(parameters, kind);
}

Dynamics::Dynamics(const Parameters& parameters) {
  const Model model = make_model(parameters);
  derivative_ = expr::Function(state_and_control(model), {}, list(model.derivative));
  loads_ = expr::Function(list(model.state), {}, list(model.wheel_loads));
  forces_ = expr::Function(list(model.state), {}, {model.Fyf, model.Fyr});
}

namespace {

using Inputs = std::array<double, std::size_t{kStates} + std::size_t{kControls}>;

Inputs inputs_of(const State& state, const Control& control) {
  Inputs inputs;
  std::copy(control.begin(), control.end(), std::copy(state.begin(), state.end(), inputs.begin()));
  return inputs;
}

}  // namespace

State Dynamics::derivative(const State& state, const Control& control) const {
  State result;
  derivative_(inputs_of(state, control), {}, result);
  return result;
}

std::array<State, kStates> Dynamics::jacobian(const State& state, const Control& control) const {
  State values;
  std::array<double, kStates * std::tuple_size_v<Inputs>> entries;
  const auto& pattern = derivative_.jacobian_pattern();
  derivative_.evaluate(1, inputs_of(state, control), {}, {}, {.jacobian = true}, values,
                       std::span(entries).first(pattern.size()), {});
  std::array<State, kStates> result{};
  for (std::size_t e = 0; e < pattern.size(); ++e)
    if (pattern[e].col < kStates) result[pattern[e].row][pattern[e].col] = entries[e];
  return result;
}

WheelLoads Dynamics::wheel_loads(const State& state) const {
  WheelLoads result;
  loads_(state, {}, result);
  return result;
}

std::array<double, 2> Dynamics::tyre_forces(const State& state) const {
  std::array<double, 2> result;
  forces_(state, {}, result);
  return result;
}

}  // namespace slalom::vehicle
