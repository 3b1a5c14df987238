#include "tracker.hpp"

#include <algorithm>
#include <cmath>

#include "../base/lu.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;
using Square = slalom::Square<kStates>;
constexpr std::size_t kInputs = std::size_t{kStates} + std::size_t{kControls};

/// Share of the controls' limits that tracking uses.
constexpr double kShare = 0.98;
/// Kept off the limits of steering angle [rad], of acceleration [m/s^2] and of the greatest speed
/// [m/s].
constexpr double kSteeringSpare = 0.01, kAccelerationSpare = 0.06, kSpeedSpare = 0.1;
/// How fast speed settles at the greatest [1/s].
constexpr double kSettling = 1.2;
/// Below this speed the linearisation is that of this speed [m/s]: tyres react ever faster.
constexpr double kSlowest = 0.8;
/// Of a body, along the reference [1/m^2] and of its speed [1/(m/s)^2].
constexpr double kBodyAlong = 10, kBodySpeed = 10;
/// The rate at which steering goes to the reference's where the vehicle all but stands [1/s].
constexpr double kSteeringBack = 3;
/// Weights of the controls [1/(rad/s)^2, 1/(m/s^3)^2] against those of state_weight().
constexpr double kSteeringRateWeight = 300, kJerkWeight = 0.15;

/// Weights of being off the reference: 25/m^2 across it and 2/m^2 along it, for where in time one
/// passes matters less than where. Of a body on a road they are greater along it and of its speed:
/// it passes others so close that time matters, and where it all but stands it could turn only by
/// driving on.
Square state_weight(const State& x, bool body) {
  const double across = 25, along = body ? kBodyAlong : 2;
  Square Q{};
  const double c = std::cos(x[PSI]), s = std::sin(x[PSI]);
  Q[X][X] = across * s * s + along * c * c;
  Q[Y][Y] = across * c * c + along * s * s;
  Q[X][Y] = Q[Y][X] = (along - across) * s * c;
  Q[V][V] = 0.2;
  Q[R][R] = 4;
  Q[PSI][PSI] = 60;
  Q[SA][SA] = 4;
  Q[UX][UX] = body ? kBodySpeed : 1;
  Q[AX][AX] = 0.3;
  return Q;
}

Square product(const Square& a, const Square& b) {
  Square result{};
  for (std::size_t i = 0; i < kStates; ++i)
    for (std::size_t l = 0; l < kStates; ++l)
      if (a[i][l] != 0)
        for (std::size_t j = 0; j < kStates; ++j) result[i][j] += a[i][l] * b[l][j];
  return result;
}

/// A step of h [s] of x' = f + A x + B u with u held, from x = 0 for f's part, by the (1, 2) Padé
/// approximation of exp(A h): of order 3, and L-stable, for tyres at low speed react within
/// milliseconds.
void discretise(double h, Square& A, std::array<Control, kStates>& B, State& f) {
  const Square A2 = product(A, A);
  Square left;
  std::array<std::array<double, kInputs + 1>, kStates> right{};
  for (std::size_t i = 0; i < kStates; ++i)
    for (std::size_t j = 0; j < kStates; ++j) {
      const double one = i == j ? 1 : 0;
      left[i][j] = one - 2 * h / 3 * A[i][j] + h * h / 6 * A2[i][j];
      right[i][j] = one + h / 3 * A[i][j];
      // (A h)^-1 (exp(A h) - 1) of the same approximation: (1 - A h / 6) over its denominator.
      for (std::size_t c = 0; c < kControls; ++c)
        right[i][kStates + c] += h * (one - h / 6 * A[i][j]) * B[j][c];
      right[i][kInputs] += h * (one - h / 6 * A[i][j]) * f[j];
    }
  Lu<kStates>(left).solve(right);
  for (std::size_t i = 0; i < kStates; ++i) {
    for (std::size_t j = 0; j < kStates; ++j) A[i][j] = right[i][j];
    for (std::size_t c = 0; c < kControls; ++c) B[i][c] = right[i][kStates + c];
    f[i] = right[i][kInputs];
  }
}

}  // namespace

Tracker::Tracker(const Parameters& vehicle, const Plant& plant, bool on_road)
    : vehicle_(vehicle),
      standing_(standing_of(vehicle, on_road)),
      body_(on_road && vehicle.footprint != FootprintKind::point),
      plant_(plant),
      derivative_(plant.dynamics().derivative_function()) {}

void Tracker::linearise(std::size_t steps, double h) {
  const std::size_t inputs = kInputs;
  const auto& pattern = derivative_.jacobian_pattern();
  inputs_.resize(inputs * steps);
  jacobian_.resize(pattern.size() * steps);
  for (std::size_t k = 0; k < steps; ++k) {
    for (std::size_t i = 0; i < kStates; ++i) inputs_[i * steps + k] = state_[k][i];
    inputs_[UX * steps + k] = std::max(state_[k][UX], kSlowest);
    for (std::size_t c = 0; c < kControls; ++c) inputs_[(kStates + c) * steps + k] = control_[k][c];
  }
  derivatives_.resize(kStates * steps);
  derivative_.evaluate(steps, inputs_, {}, {}, {.jacobian = true}, derivatives_, jacobian_, {});
  A_.assign(steps, {});
  B_.assign(steps, {});
  for (std::size_t e = 0; e < pattern.size(); ++e)
    for (std::size_t k = 0; k < steps; ++k) {
      const double value = jacobian_[e * steps + k];
      const auto row = pattern[e].row, column = pattern[e].col;
      if (column < kStates)
        A_[k][row][column] = value;
      else
        B_[k][row][column - kStates] = value;
    }
  defect_.resize(steps);
  for (std::size_t k = 0; k < steps; ++k) {
    for (std::size_t i = 0; i < kStates; ++i) defect_[k][i] = derivatives_[i * steps + k];
    discretise(h, A_[k], B_[k], defect_[k]);
    for (std::size_t i = 0; i < kStates; ++i) defect_[k][i] += state_[k][i] - state_[k + 1][i];
  }
}

/// The Riccati recursion, backwards: P = Q + A' P A - G' (R + B' P B) G, where
/// (R + B' P B) G = B' P A.
void Tracker::find_gains(std::size_t steps) {
  gain_.resize(steps + 1);
  Square P = state_weight(state_[steps], body_);
  for (std::size_t k = steps; k-- > 0;) {
    const Square& A = A_[k];
    const Inputs& B = B_[k];
    const Square PA = product(P, A);
    std::array<std::array<double, 2>, 2> S{{{kSteeringRateWeight, 0}, {0, kJerkWeight}}};
    Gain H{};
    for (std::size_t a = 0; a < kControls; ++a) {
      State PB{};
      for (std::size_t i = 0; i < kStates; ++i)
        for (std::size_t l = 0; l < kStates; ++l) PB[i] += P[i][l] * B[l][a];
      for (std::size_t c = 0; c < kControls; ++c)
        for (std::size_t l = 0; l < kStates; ++l) S[c][a] += B[l][c] * PB[l];
      for (std::size_t j = 0; j < kStates; ++j)
        for (std::size_t l = 0; l < kStates; ++l) H[a][j] += B[l][a] * PA[l][j];
    }
    const double determinant = S[0][0] * S[1][1] - S[0][1] * S[1][0];
    Square next = state_weight(state_[k], body_);
    for (std::size_t j = 0; j < kStates; ++j) {
      gain_[k][0][j] = (S[1][1] * H[0][j] - S[0][1] * H[1][j]) / determinant;
      gain_[k][1][j] = (S[0][0] * H[1][j] - S[1][0] * H[0][j]) / determinant;
    }
    for (std::size_t i = 0; i < kStates; ++i)
      for (std::size_t j = 0; j < kStates; ++j) {
        for (std::size_t l = 0; l < kStates; ++l) next[i][j] += A[l][i] * PA[l][j];
        for (std::size_t a = 0; a < kControls; ++a) next[i][j] -= H[a][i] * gain_[k][a][j];
      }
    for (std::size_t i = 0; i < kStates; ++i)
      for (std::size_t j = 0; j < kStates; ++j) P[i][j] = (next[i][j] + next[j][i]) / 2;
  }
  gain_[steps] = gain_[steps > 0 ? steps - 1 : 0];
}

/// A body that all but stands cannot turn: its steering angle goes to the reference's, and its
/// speed is no means against being beside it.
void Tracker::steady_gains(std::size_t steps) {
  for (std::size_t k = 0; k <= steps; ++k) {
    const State& x = state_[k];
    if (x[UX] >= kSlowest) continue;
    State &steer = gain_[k][SR], &push = gain_[k][JX];
    steer = {};
    steer[SA] = kSteeringBack;
    const double c = std::cos(x[PSI]), s = std::sin(x[PSI]), along = c * push[X] + s * push[Y];
    push = {0, 0, 0, 0, 0, 0, push[UX], push[AX]};
    push[X] = c * along;
    push[Y] = s * along;
  }
}

/// The acceleration a step ahead that the vehicle's limits leave of `ax`.
double Tracker::driven_acceleration(double ux, double ax) const {
  double most = vehicle_.ax_max_at(ux) - kAccelerationSpare;
  double least = vehicle_.ax_min_at(ux) + kAccelerationSpare;
  most = std::min(most, (vehicle_.ux_max - kSpeedSpare - ux) * kSettling);
  least = std::max(least, (vehicle_.ux_min + standing_.spare - ux) * standing_.settling);
  return std::clamp(ax, std::min(least, most), most);
}

/// The control at a knot where the vehicle is `off` the reference and `at` a state.
Control Tracker::steered(std::size_t knot, const State& off, const State& at, double h) const {
  Control u = control_[knot];
  for (std::size_t a = 0; a < kControls; ++a)
    for (std::size_t j = 0; j < kStates; ++j) u[a] -= gain_[knot][a][j] * off[j];
  const double sr = kShare * vehicle_.sr_max(), jx = kShare * vehicle_.jx_max;
  u[SR] = std::clamp(u[SR], -sr, sr);
  u[JX] = std::clamp(u[JX], -jx, jx);
  const double ax = driven_acceleration(at[UX], at[AX] + u[JX] * h);
  u[JX] = std::clamp((ax - at[AX]) / h, -jx, jx);
  const double sa = vehicle_.sa_max() - kSteeringSpare;
  u[SR] = std::clamp((std::clamp(at[SA] + u[SR] * h, -sa, sa) - at[SA]) / h, -sr, sr);
  return u;
}

Motion Tracker::released(Motion motion) const {
  const std::size_t k = motion.size() - 1;
  motion.controls[k] = {};
  if (k == 0) return motion;
  motion.states[k] = plant_.advance(motion.states[k - 1], motion.controls[k - 1], {},
                                    motion.t[k - 1], motion.t[k]);
  return motion;
}

Motion Tracker::driven_to(const Control& control, Motion motion, double duration) const {
  const double begin = motion.end(), steps = std::ceil(duration / kStep);
  const Control from = motion.controls.back();
  for (double k = 1; k <= steps; ++k) {
    Control u;
    for (std::size_t c = 0; c < kControls; ++c) u[c] = from[c] + k / steps * (control[c] - from[c]);
    const double t = begin + k / steps * duration;
    motion.add(t, plant_.advance(motion.states.back(), motion.controls.back(), u, motion.end(), t),
               u);
  }
  return motion;
}

Motion Tracker::driven_on(Motion motion, double until) const {
  while (motion.end() < until) {
    const double next = motion.end() + kStep;
    motion.add(next, plant_.advance(motion.states.back(), {}, {}, motion.end(), next), {});
  }
  return motion;
}

Motion Tracker::follow(const Motion& reference, const State& X0, double t0, double t_end) {
  Motion motion;
  if (t_end - t0 < kSameTime) {
    motion.add(t0, X0, {});
    return motion;
  }
  const auto steps =
      static_cast<std::size_t>(std::max(1.0, std::ceil((t_end - t0) / kStep - 1e-9)));
  const double h = (t_end - t0) / static_cast<double>(steps);
  state_.resize(steps + 1);
  control_.resize(steps + 1);
  for (std::size_t k = 0; k <= steps; ++k) {
    const double t = t0 + static_cast<double>(k) * h;
    state_[k] = reference.state_at(t);
    control_[k] = reference.control_at(t);
  }
  linearise(steps, h);
  find_gains(steps);
  if (body_) steady_gains(steps);

  State x = X0, off;
  for (std::size_t i = 0; i < kStates; ++i) off[i] = x[i] - state_[0][i];
  Control u = steered(0, off, x, h);
  motion.add(t0, x, u);
  for (std::size_t k = 0; k < steps; ++k) {
    // The next knot's control is found from where the linear model expects to be by then.
    State ahead = state_[k + 1], expected = defect_[k];
    for (std::size_t i = 0; i < kStates; ++i) {
      for (std::size_t j = 0; j < kStates; ++j) expected[i] += A_[k][i][j] * off[j];
      for (std::size_t c = 0; c < kControls; ++c)
        expected[i] += B_[k][i][c] * (u[c] - control_[k][c]);
    }
    ahead[UX] = x[UX] + h * x[AX];
    ahead[AX] = x[AX] + h * u[JX];
    ahead[SA] = x[SA] + h * u[SR];
    const Control next = steered(k + 1, expected, ahead, h);
    const double t = t0 + static_cast<double>(k) * h, t1 = t0 + static_cast<double>(k + 1) * h;
    try {
      x = plant_.advance(x, u, next, t, t1);
    } catch (const PlantError&) {
      break;
    }
    u = next;
    for (std::size_t i = 0; i < kStates; ++i) off[i] = x[i] - state_[k + 1][i];
    motion.add(t1, x, u);
  }
  return motion;
}

}  // namespace slalom::planner
