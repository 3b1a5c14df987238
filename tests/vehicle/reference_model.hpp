#pragma once

#include <array>
#include <cmath>

#include "slalom/vehicle/state.hpp"

namespace slalom::reference {

/// The vehicle model a second time: scalar arithmetic with the HMMWV's published numbers written
/// out, sharing nothing with src but the order of states. Used to check src/vehicle and to
/// re-integrate drives. SI units; sections 1 and 2 of docs/formulation.md.
struct HMMWV {
  bool asymmetric = true;

  struct Forces {
    double front, rear;     // lateral axle forces [N]
    double rl, rr, fl, fr;  // wheel loads [N]
  };

  double tyre(double slip, double load, double offset) const {
    const double nominal = 35000, relative = load / nominal - 1;  // Pacejka's dfz
    const double on = asymmetric ? 1 : 0;
    // Pacejka writes each coefficient as p1 + p2 dfz; expanded, this is the page's form.
    const double friction = 0.73957 + -0.075004 * relative;
    const double curvature = 0.37562 + -0.069325 * relative;
    const double shift_h = on * (0.0056509 + -0.0020257 * relative);
    const double shift_v = on * (0.015216 + -0.010365 * relative);
    const double stiffness = -10.289 * nominal * std::sin(2 * std::atan(load / (3.3343 * nominal)));
    const double shape = 1.5874;
    const double s = slip + shift_h;
    const double smooth_sign = s / std::sqrt(s * s + 0.01 * 0.01);
    const double peak = friction * load;
    const double bend = curvature * (1 - on * 0.29168 * smooth_sign);
    const double z = stiffness / (shape * peak) * s;
    const double angle = std::atan(z * (1 - bend) + bend * std::atan(z));
    return peak * std::sin(shape * angle) + shift_v * load + on * offset;
  }

  Forces forces(const vehicle::State& X) const {
    const double lateral = X[2], yaw = X[3], steer = X[5], speed = X[6] + 0.01;
    const double shift = 806 * (X[7] - lateral * yaw);
    const double front_load = 13680 - shift, rear_load = 12696 + shift;
    const double front =
        tyre(std::atan((lateral + 1.5775 * yaw) / speed) - steer, front_load, 278.2789450759981);
    const double rear =
        tyre(std::atan((lateral - 1.7245 * yaw) / speed), rear_load, 259.95925391136984);
    const double ay = (front + rear) / 2688.7;
    return {front,
            rear,
            0.5 * rear_load - 1076 * ay,
            0.5 * rear_load + 1076 * ay,
            0.5 * front_load - 675 * ay,
            0.5 * front_load + 675 * ay};
  }

  vehicle::State derivative(const vehicle::State& X, const vehicle::Control& U) const {
    const Forces f = forces(X);
    const double c = std::cos(X[4]), s = std::sin(X[4]), side = X[2] + 1.5775 * X[3];
    return {X[6] * c - side * s,
            X[6] * s + side * c,
            (f.front + f.rear) / 2688.7 - X[6] * X[3],
            (1.5775 * f.front - 1.7245 * f.rear) / 4110.1,
            X[3],
            U[0],
            X[7],
            U[1]};
  }
};

}  // namespace slalom::reference
