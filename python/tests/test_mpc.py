"""Receding horizons: the loop as a whole, step by step, and what its callbacks may do."""

import os
import signal
import threading

import numpy as np
import pytest

import slalom


def cart():
    """A cart to be brought to rest at 1: x'' = u, at least effort and distance."""
    p = slalom.Problem("cart")
    x, v = p.state("x", initial=0), p.state("v", initial=0)
    u = p.control("u", lower=-2, upper=2)
    wish = p.parameter("wish", 1)
    p.dynamics(x, v)
    p.dynamics(v, u)
    p.lagrange("cost", 10 * (x - wish) ** 2 + v**2 + 0.1 * u**2)
    p.final_time(equal=3)
    return p, wish


GOAL = {"x": (1, 0.01), "v": (0, 0.01)}


def test_the_loop_reaches_its_goal():
    p, _ = cart()
    result = slalom.Mpc(p, tex=0.25, mesh=20, goal=GOAL).run([0, 0])
    assert result.status == "goal" and "goal" in result.message
    assert abs(result.states["x"][-1] - 1) <= 0.01 and result.t.shape == result.controls["u"].shape
    cycle = result.cycles[1]
    assert cycle.used and cycle.solution.solved and cycle.solution.t0 == cycle.t_plan == 0.5
    np.testing.assert_allclose(cycle.x0, cycle.arrived, atol=1e-6)
    assert cycle.solution.estimate_errors().largest < 1e-4


def test_a_plant_outside():
    p, _ = cart()
    loop = slalom.Mpc(p, tex=0.25, mesh=20, goal=GOAL, planning="instant")
    state, t = [0.0, 0.0], 0.0
    while loop.step(state, t) == "running":
        driven = p.simulate(state, lambda now, x: loop.controls(now), t0=t, tf=t + 0.25)
        state, t = [float(c[-1]) for c in driven.states.values()], t + 0.25
    assert loop.status == "goal" and len(loop.cycles) == round(t / 0.25)


def test_another_plant():
    p, _ = cart()
    plant = slalom.Problem("heavier")
    x, v, u = plant.state("x"), plant.state("v"), plant.control("u")
    plant.dynamics(x, v)
    plant.dynamics(v, 0.8 * u - 0.1 * v)
    result = slalom.Mpc(p, tex=0.2, mesh=20, plant=plant, max_cycles=40).run([0, 0])
    assert result.status == "cycle_limit" and len(result.cycles) == 40
    assert result.states["x"][-1] == pytest.approx(1, abs=0.02)
    assert any(abs(c.x0 - c.arrived).max() > 1e-3 for c in result.cycles)


def test_a_plant_that_is_measured_by_a_function():
    p, _ = cart()
    plant = slalom.Problem("in other units")
    y, w, u = plant.state("y"), plant.state("w"), plant.control("u")
    plant.dynamics(y, w)
    plant.dynamics(w, 100 * u)  # centimetres
    with pytest.raises(slalom.InvalidValue, match="measure"):
        slalom.Mpc(p, plant=plant).run([0, 0])
    loop = slalom.Mpc(p, tex=0.25, mesh=20, goal=GOAL, plant=plant, measure=lambda states: states / 100)
    result = loop.run([0, 0])
    assert result.status == "goal" and result.states["y"][-1] == pytest.approx(100, abs=1)
    with pytest.raises(slalom.Error, match="another Mpc"):
        loop.run([0, 0])
    with pytest.raises(ZeroDivisionError):
        slalom.Mpc(p, plant=plant, measure=lambda states: 1 / 0).run([0, 0])


def test_callbacks():
    p, wish = cart()
    seen = []

    kept = []

    def update(problem, cycle):
        kept.append(problem)
        problem.set_parameter(wish, 2 if cycle.index >= 3 else 1)

    def check(cycle):
        seen.append(cycle.index)
        return "far enough" if cycle.solution.state("x").max() > 1.5 else None

    result = slalom.Mpc(p, tex=0.25, update=update, check=check).run([0, 0])
    assert result.status == "stopped" and "far enough" in result.message and seen == [1, 2, 3]
    assert kept[0].solve().solved  # outlives the loop
    with pytest.raises(ZeroDivisionError):
        slalom.Mpc(p, check=lambda cycle: str(1 / 0)).run([0, 0])
    with pytest.raises(ZeroDivisionError):
        slalom.Mpc(p, update=lambda problem, cycle: 1 / 0).run([0, 0])


def test_interrupt():
    p, _ = cart()
    loop = slalom.Mpc(p, tex=0.01, max_cycles=1000000, mesh=200)
    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        loop.run([0, 0])


@pytest.mark.parametrize("settings, error, message", [
    ({"tex": 0}, ValueError, "tex"),
    ({"planing": "instant"}, ValueError, "perhaps 'planning'"),
    ({"planning": "never"}, ValueError, "planning"),
    ({"goal": {"y": (1, 1)}}, ValueError, "y"),
    ({"goal": {"x": 1}}, TypeError, ""),
    ({"plant": 3}, TypeError, ""),
    ({"first_controls": [1, 2]}, ValueError, "2"),
    ({"tol": -1}, ValueError, "tol"),
])
def test_bad_settings(settings, error, message):
    with pytest.raises(error, match=message or "Mpc|argument"):
        slalom.Mpc(cart()[0], **settings)


def test_a_warm_up_is_among_the_cycles():
    p, _ = cart()
    result = slalom.Mpc(p, tex=0.25, mesh=20, warm_up=np.bool_(True), max_cycles=np.int64(2)).run([0, 0])
    assert [cycle.index for cycle in result.cycles] == [0, 1, 2]
    assert all(cycle.solution.solved for cycle in result.cycles)


def test_a_shrinking_horizon_ends_where_its_last_plans_fail():
    p = slalom.Problem("shrinking")
    x, v = p.state("x", initial=0), p.state("v", initial=0)
    u = p.control("u", lower=-2, upper=2)
    p.dynamics(x, v)
    p.dynamics(v, u)
    p.lagrange("effort", u * u)
    p.final_time(equal=5)
    off = p.parameter("off", 0.0)
    p.boundary("end", p.final(x) + off, equal=1)

    def spoil(problem, cycle):
        problem.set_parameter(off, 1e3 if cycle.t > 3.9 else 0.0)

    result = slalom.Mpc(p, tex=0.5, mesh=20, horizon="shrinking", goal={"x": (1, 1e-6)}, update=spoil).run([0, 0])
    assert result.status in ("goal", "expanded_goal", "goal_missed")
    assert abs(result.t[-1] - 5) < 1e-6 and abs(result.states["x"][-1] - 1) < 1e-3
