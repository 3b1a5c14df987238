"""Derivatives of answers by the numbers of their problems, from Python."""

import math

import numpy as np
import pytest
from problems import bryson_denham

import slalom


def pendulum(mass=1.2, start=0.3):
    """A pendulum that is brought to rest in a free time."""
    p = slalom.Problem("pendulum")
    angle = p.state("angle", initial=start, final=0)
    rate = p.state("rate", lower=-0.5, initial=0, final=0)
    push = p.control("push", lower=-2, upper=2)
    m = p.parameter("mass", mass)
    p.dynamics(angle, rate)
    p.dynamics(rate, push / m - np.sin(angle))
    p.lagrange("effort", push**2)
    p.mayer("time", 0.7 * p.tf)
    p.final_time(lower=0.2, upper=6)
    return p


EXACT = {"tol": 1e-10, "constraint_tol": 1e-10, "dual_tol": 1e-5, "mesh": 12}


@pytest.mark.parametrize("scheme", ["trapezoidal", "hermite_simpson", "lgr"])
def test_derivatives_are_those_of_answers_to_other_numbers(scheme):
    s = pendulum().solve(scheme=scheme, **EXACT)
    h = 1e-5
    for number, other in [
        ("mass", lambda by: pendulum(mass=1.2 + by)),
        ("initial angle", lambda by: pendulum(start=0.3 + by)),
    ]:
        low, high = (other(by).solve(scheme=scheme, warm_start=s, **EXACT) for by in (-h, h))
        by = s.sensitivity(number)
        assert by.number == number
        assert by.objective == pytest.approx((high.objective - low.objective) / (2 * h), abs=1e-4)
        assert by.tf == pytest.approx((high.tf - low.tf) / (2 * h), abs=1e-3)
        for name in ("angle", "rate"):
            difference = (high.state(name) - low.state(name)) / (2 * h)
            np.testing.assert_allclose(by.state(name), difference, atol=2e-3)
            np.testing.assert_array_equal(by.states[name], by.state(name))
        difference = (high.control("push") - low.control("push")) / (2 * h)
        np.testing.assert_allclose(by.control("push"), difference, atol=5e-3)
        assert by.controls["push"].shape == s.t.shape == by.multiplier("push").shape


def test_what_a_bound_costs():
    s = bryson_denham().solve(mesh=60, tol=1e-10)
    bound = s.sensitivity_numbers["upper x"]
    by = s.sensitivity("upper x")
    assert by.objective == pytest.approx(-4 / (9 * bound**2), rel=1e-3)
    assert set(by.multipliers) == set(s.multipliers)


def test_predictions_are_answers_to_first_order():
    s = pendulum().solve(**EXACT)
    predicted = s.predict({"mass": 1.21, "initial angle": 0.302})
    exact = pendulum(mass=1.21, start=0.302).solve(**EXACT)
    assert predicted.tf == pytest.approx(exact.tf, abs=0.02 * abs(exact.tf - s.tf))
    assert predicted.state("angle")[0] == 0.302
    assert predicted.violation < 1e-3 and predicted.iterations == 0 and not predicted.solved
    warm = pendulum(mass=1.21, start=0.302).solve(warm_start=predicted, **EXACT)
    assert warm.solved and warm.objective == pytest.approx(exact.objective, rel=1e-8)

    other = pendulum()  # another problem by the same name, with symbols of its own
    with pytest.raises(slalom.UnknownName, match="perhaps 'mass'"):
        s.predict({"mas": 1})
    with pytest.raises(slalom.InvalidValue, match="set after its declaration"):
        s.predict({"upper push": 3})
    other.control("idle")
    with pytest.raises(slalom.InvalidValue, match="the problem that was transcribed"):
        s.predict(other)


def test_names_that_are_not_there():
    s = pendulum().solve()
    assert s.sensitivity_numbers["mass"] == 1.2 and s.sensitivity_numbers["t0"] == 0
    with pytest.raises(slalom.UnknownName, match="perhaps 'mass'"):
        s.sensitivity("mas")
    with pytest.raises(slalom.UnknownName, match="angle"):
        s.sensitivity("mass").state("angel")
    with pytest.raises(slalom.UnknownName):
        s.sensitivity("mass").slack("gap")


def test_answers_without_sensitivities():
    cut = pendulum().solve(max_iterations=1)
    with pytest.raises(slalom.InvalidValue, match="not solved: iteration_limit"):
        cut.sensitivity("mass")
    p = pendulum()
    p.control("idle")
    with pytest.raises(slalom.InvalidValue, match="least determined at idle at"):
        p.solve().sensitivity("mass")


def test_an_answer_has_the_numbers_that_it_was_solved_with():
    p = slalom.Problem("decay")
    x, k = p.state("x", initial=1), p.parameter("k", 1)
    u = p.control("u", lower=0, upper=1)
    p.dynamics(x, -k * x)
    p.lagrange("effort", u**2)
    s = p.solve(tol=1e-10)
    p.set_parameter(k, 5)
    assert s.sensitivity_numbers["k"] == 1
    np.testing.assert_allclose(s.sensitivity("k").state("x"), -s.t * np.exp(-s.t), atol=1e-6)


def test_saved_answers_have_them_too(tmp_path):
    p = pendulum()
    s = p.solve()
    s.save(tmp_path / "answer.json")
    again = p.load_solution(tmp_path / "answer.json").sensitivity("mass")
    np.testing.assert_allclose(again.state("rate"), s.sensitivity("mass").state("rate"), rtol=1e-6)


def test_several_phases():
    def flight(jump):
        phases = slalom.PhasedProblem("flight")
        gravity = 9.81
        states = []
        for name, up in (("first", 1), ("second", 2)):
            p = slalom.Problem(name)
            h, v = p.state("h"), p.state("v")
            u, m = p.control("u"), p.parameter("mass", 2.0)
            p.dynamics(h, v)
            p.dynamics(v, u / m - gravity)
            p.lagrange("effort", u**2)
            p.initial_time(equal=up - 1)
            p.final_time(equal=up)
            if up == 1:
                p.initial_bounds(h, equal=0)
                p.initial_bounds(v, equal=0)
            else:
                p.final_bounds(h, equal=8)
            states.append((p, h, v))
            phases.add(p)
        phases.connect(0, 1, without=["v"])
        (a, _, va), (b, _, vb) = states
        phases.link("jump", b.initial(vb) - a.final(va), equal=jump)
        return phases

    s = flight(1.0).solve(mesh=5, tol=1e-10)
    h = 1e-3  # the problem is quadratic: any step will do
    low, high = (flight(1.0 + by).solve(mesh=5, tol=1e-10) for by in (-h, h))
    by = s.sensitivity("jump")
    assert by.objective == pytest.approx((high.objective - low.objective) / (2 * h), rel=1e-5)
    for p in (0, 1):
        difference = (high[p].state("v") - low[p].state("v")) / (2 * h)
        np.testing.assert_allclose(by.phases[p].state("v"), difference, atol=1e-5)
    assert set(by.link_multipliers) == set(s.link_multipliers)
    # With the mass, forces grow alike, and the effort with its square: first order is exact.
    predicted = s.predict({"mass": 2.02})
    assert predicted.objective == pytest.approx(s.objective * 1.01**2, rel=1e-6)
    np.testing.assert_allclose(predicted[1].control("u"), 1.01 * s[1].control("u"), atol=1e-5)
    with pytest.raises(slalom.InvalidValue, match="the bound of a link"):
        s.predict({"jump": 1.1})
    assert s.sensitivity("mass").objective == pytest.approx(s.objective, rel=1e-5)
    assert math.isclose(s.sensitivity_numbers["second: final h"], 8)
    with pytest.raises(slalom.InvalidValue, match="the whole answer"):
        s[0].sensitivity("mass")
