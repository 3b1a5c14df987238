"""Drives plans on another vehicle than the planner believes in: the multi-body model of CommonRoad, with
29 states (roll, pitch, suspension, wheels that spin, tyres of combined slip by wheel). Needs SciPy and
commonroad-vehicle-models; `python multi_body_plant.py` prints the tables of docs/vehicles.md.

What the planner's model does not know is the distance between the two after the same controls; a planner
that plans again every tex seconds makes up for it.
"""

import math

import numpy as np
import slalom
from scipy.integrate import solve_ivp
from vehiclemodels.init_mb import init_mb
from vehiclemodels.vehicle_dynamics_mb import vehicle_dynamics_mb
from vehiclemodels.vehicle_parameters import setup_vehicle_parameters

CARS = {"ford_escort": 1, "bmw_320i": 2, "vw_vanagon": 3}  # our names, their numbers
X, Y, V, R, PSI, SA, UX, AX = range(8)

# A double lane change of the proportions of ISO 3888-1: 3.5 m aside within 30 m, 25 m along, back within 25 m.
LANE_CHANGE = {
    "name": "double_lane_change",
    "start": {"x": 0, "y": 0},
    "goal": {"x": 0, "y": 165, "sigma": 6},
    "region": {"x_min": -5, "x_max": 2},
    "obstacles": [{"name": "blocked", "x": 0.5, "y": 55, "r": 1.2},
                  {"name": "oncoming side", "x": -3.5, "y": 95, "r": 1.2}],
    "loop": {"sm_crash": 0},
    "planner": {"base": "P_E"},
}


class MultiBody:
    """CommonRoad's vehicle `number`, driven by steering rate and longitudinal jerk as ours is."""

    def __init__(self, number, state):
        """At our `state`: x, y of the front axle's centre, v, r, psi, sa, ux, ax (SI, rad)."""
        self.p = setup_vehicle_parameters(vehicle_id=number)
        ahead = self.p.a
        core = [state[X] - ahead * math.cos(state[PSI]), state[Y] - ahead * math.sin(state[PSI]), state[SA],
                math.hypot(state[UX], state[V]), state[PSI], state[R], math.atan2(state[V], state[UX])]
        # Theirs is driven by the acceleration wanted; ours holds it as a state.
        self.x = np.array([*init_mb(core, self.p), state[AX]])

    def advance(self, control, t0, t1):
        """Drives from t0 to t1 [s]; `control(t)` is sr [rad/s], jx [m/s^3]."""

        def derivative(t, x):
            steering_rate, jerk = control(t)
            return [*vehicle_dynamics_mb(list(x[:-1]), [steering_rate, x[-1]], self.p), jerk]

        solution = solve_ivp(derivative, (t0, t1), self.x, method="RK45", rtol=1e-5, atol=1e-7)
        if not solution.success:
            raise RuntimeError(f"the multi-body model ends at {solution.t[-1]:.3f} s: {solution.message}")
        self.x = solution.y[:, -1]
        return self.state()

    def state(self):
        """Our eight states."""
        x, ahead = self.x, self.p.a
        return np.array([x[0] + ahead * math.cos(x[4]), x[1] + ahead * math.sin(x[4]), x[10], x[5], x[4], x[2],
                         x[3], x[-1]])


def controls_of(plan):
    """The plan's controls over absolute time, linear between its nodes; without a plan straight on."""
    if plan is None:
        return lambda t: (0.0, 0.0)
    t, u = plan.t_start + plan.t, plan.controls
    return lambda now: (np.interp(now, t, u[:, 0]), np.interp(now, t, u[:, 1]))


def lane_change(car, speed):
    return slalom.load_scenario(LANE_CHANGE, vehicle=car, set={"start.ux": speed})


def apart(ours, theirs):
    """From ours to theirs [m], along our heading and across it."""
    dx, dy, psi = theirs[X] - ours[X], theirs[Y] - ours[Y], ours[PSI]
    return dx * math.cos(psi) + dy * math.sin(psi), dy * math.cos(psi) - dx * math.sin(psi)


def same_controls(car, scenario, plan, instants):
    """{tyre: [where the multi-body model is from ours at each instant, along and across, m]} after the controls
    of a plan, or after none: steering angle and acceleration stay those of the scenario's start."""
    body, theirs, now = MultiBody(CARS[car], scenario.start), [], 0.0
    for instant in instants:
        theirs.append(body.advance(controls_of(plan), now, instant))
        now = instant
    result = {}
    for tyre in ("pure_slip", "combined_slip"):
        plant = slalom.Plant(scenario.replace(set={"vehicle.tyre": tyre}))
        result[tyre] = [apart(plant.advance(scenario.start, plan, 0.0, instant), at)
                        for instant, at in zip(instants, theirs)]
    return result


def in_the_lane_change(car, speed):
    """After the controls of our plan through it, for 1, 2 and 5 s."""
    scenario = lane_change(car, speed)
    plan = slalom.Planner(scenario).plan(scenario.start, tex=0.0)
    return same_controls(car, scenario, plan, (1.0, 2.0, 5.0))


def braking_in_a_bend(car, deceleration):
    """From 25 m/s, with the wheels at 0.03 rad and this deceleration [m/s^2] at once, for 0.5, 1 and 2 s."""
    scenario = lane_change(car, 25).replace(set={"start.sa": 0.03, "start.ax": -deceleration})
    return same_controls(car, scenario, None, (0.5, 1.0, 2.0))


def closed_loop(car, speed, tex=0.2, longest=30.0):
    """Plans every tex seconds and drives the multi-body model. Outcome, time [s], and the least distance [m]
    of the front axle's centre to an obstacle's edge at the instants of planning."""
    scenario = lane_change(car, speed)
    planner, believed = slalom.Planner(scenario), slalom.Plant(scenario)
    body, plan, t, least = MultiBody(CARS[car], scenario.start), None, 0.0, math.inf
    state = scenario.start
    while t < longest:
        if max(abs(state[X] - scenario.goal.x), abs(state[Y] - scenario.goal.y)) <= scenario.goal.sigma:
            return "goal", t, least
        next_plan = planner.plan(believed.advance(state, plan, t, t + tex), t0=t, tex=tex)
        state = body.advance(controls_of(plan), t, t + tex)
        plan, t = next_plan, t + tex
        least = min(least, *(math.dist(state[:2], (o.x, o.y)) - o.a for o in scenario.obstacles))
        if least < 0:
            return "crash", t, least
    return "timeout", t, least


def rows(car, condition, found):
    for tyre, places in found.items():
        print(f"| `{car}` | {condition} | `{tyre}` | " + " | ".join(f"{u:+.2f}, {w:+.2f}" for u, w in places) + " |")


def main():
    print("| car | speed [m/s] | tyre | after 1 s [m] | 2 s | 5 s |\n|---|---|---|---|---|---|")
    for car in CARS:
        for speed in (10, 20):
            rows(car, speed, in_the_lane_change(car, speed))
    print("\n| car | braking [m/s²] | tyre | after 0.5 s [m] | 1 s | 2 s |\n|---|---|---|---|---|---|")
    for car in CARS:
        for deceleration in (0, 2, 4):
            rows(car, deceleration, braking_in_a_bend(car, deceleration))
    print("\n| car | speed [m/s] | outcome | least distance [m] |\n|---|---|---|---|")
    for car in CARS:
        for speed in (10, 20):
            outcome, t, least = closed_loop(car, speed)
            print(f"| `{car}` | {speed} | {outcome} after {t:.1f} s | {least:.2f} |")


if __name__ == "__main__":
    main()
