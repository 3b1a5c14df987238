"""Simulations from Python: closed forms, and what bad ones say."""

import numpy as np
import pytest
from problems import decay, decay_at

import slalom


def test_simulation():
    p = decay()
    s = p.solve(mesh=20, scheme="lgr", points=5)
    again = p.simulate({"x": 1}, s)
    assert again.complete and again.t[-1] == 2
    np.testing.assert_allclose(again.states["x"], decay_at(again.t)[0], atol=1e-7)
    free = p.simulate([1], {"u": 0}, tf=1, steps=10)
    assert free.states["x"][-1] == pytest.approx(np.exp(-1), rel=1e-8) and len(free.t) == 11
    driven = p.simulate([0], {"u": np.sin}, tf=1)
    assert driven.states["x"][-1] == pytest.approx((np.exp(-1) + np.sin(1) - np.cos(1)) / 2, rel=1e-8)
    fed_back = p.simulate([1], lambda t, x: [-x[0]], tf=1)
    assert fed_back.states["x"][-1] == pytest.approx(np.exp(-2), rel=1e-8)
    np.testing.assert_allclose(fed_back.controls["u"], -fed_back.states["x"], atol=1e-12)
    whole = p.simulate([1], lambda t, x: [-x[0]])
    begun = p.solve(guess=whole, max_iterations=0)
    np.testing.assert_allclose(begun.state("x")[::20], np.exp(-2 * begun.t[::20]), atol=1e-3)


@pytest.mark.parametrize("call, error, message", [
    (lambda p: p.simulate({"y": 1}, [0]), KeyError, "x0.*'x'"),
    (lambda p: p.simulate({"x": 1, "xx": 1}, [0]), KeyError, "perhaps 'x'"),
    (lambda p: p.simulate({"x": "one"}, [0]), TypeError, "x0"),
    (lambda p: p.simulate([1, 2], [0]), ValueError, "2"),
    (lambda p: p.simulate([1], {"v": 0}), KeyError, "no 'u'"),
    (lambda p: p.simulate([1], "hold"), TypeError, "controls"),
    (lambda p: p.simulate([1], lambda t, x: "hold"), TypeError, "a number for each control"),
    (lambda p: p.simulate([1], lambda t, x: 1 / 0), ZeroDivisionError, "division"),
    (lambda p: p.simulate([1], [0], tf=-1), ValueError, "t"),
])
def test_bad_simulations(call, error, message):
    with pytest.raises(error, match=message):
        call(decay())


def test_states_that_are_lost_end_a_simulation():
    p = slalom.Problem("blow-up")
    x = p.state("x")
    p.dynamics(x, x**2 + p.control("u"))
    s = p.simulate([1], [0], tf=2)
    assert not s.complete and s.t[-1] < 1.01 and s.message
