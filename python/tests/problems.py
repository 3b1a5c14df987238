"""Problems that several tests solve."""

import numpy as np

import slalom


def bryson_denham(limit=1 / 9):
    """Optimum 4 / (9 l) for the limit l of x <= 1/6 (Bryson & Ho, 1975, section 3.11)."""
    p = slalom.Problem("Bryson-Denham")
    x = p.state("x", upper=limit, initial=0, final=0)
    v = p.state("v", initial=1, final=-1)
    u = p.control("u")
    p.dynamics(x, v)
    p.dynamics(v, u)
    p.lagrange("effort", u**2 / 2)
    return p


def swing():
    """A pendulum from hanging to standing in four seconds."""
    p = slalom.Problem("swing")
    a, w = p.state("a", initial=0, final=np.pi), p.state("w", initial=0, final=0)
    u = p.control("u")
    p.dynamics(a, w)
    p.dynamics(w, u - np.sin(a))
    p.lagrange("effort", u**2)
    p.final_time(equal=4)
    return p


def decay():
    """x' = -x + u at least x² + u²: closed form with rate sqrt(2)."""
    p = slalom.Problem("decay")
    x = p.state("x", initial=1)
    u = p.control("u")
    p.dynamics(x, -x + u)
    p.lagrange("cost", x**2 + u**2)
    p.final_time(equal=2)
    return p


def decay_at(t):
    """State and costate of decay(): costate' = -2 x + costate, costate(2) = 0, u = -costate / 2."""
    rate, tf = np.sqrt(2), 2.0
    shape = rate * np.cosh(rate * tf) + np.sinh(rate * tf)
    x = (rate * np.cosh(rate * (tf - t)) + np.sinh(rate * (tf - t))) / shape
    return x, 2 * np.sinh(rate * (tf - t)) / shape


def two_legs():
    """1 of distance at rest at both ends, |u| <= 1, in two phases: 1 of time each."""
    p = slalom.PhasedProblem("two legs")
    total = []
    for name, low, high in (("speed up", 0, 1), ("slow down", -1, 0)):
        leg = slalom.Problem(name)
        x, v = leg.state("x"), leg.state("v")
        u = leg.control("u", lower=low, upper=high)
        leg.dynamics(x, v)
        leg.dynamics(v, u)
        leg.initial_time(lower=0, upper=0 if low == 0 else 5)
        leg.final_time(lower=0.1, upper=5)
        for state, begin, end in ((x, 0, 1), (v, 0, 0)):
            if low == 0:
                leg.initial_bounds(state, equal=begin)
            else:
                leg.final_bounds(state, equal=end)
        total.append(leg)
    total[1].mayer("duration", total[1].tf)
    for leg in total:
        p.add(leg)
    p.connect(0, 1)
    return p
