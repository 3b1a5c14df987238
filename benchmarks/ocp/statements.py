"""The problems that every contestant of peers.py solves, each stated once.

A statement's functions take a module `m` of the contestant's own functions (sin, cos, exp, sqrt) and
its own symbols, so that all state the same problem. One phase, states and controls bounded by
constants, ends fixed or free, time from 0 to a tf that is fixed or free. What the tools cannot all
state (several phases, static parameters, integral constraints, end values within the dynamics) is
not here.
"""

import dataclasses
import math
from collections.abc import Callable

FREE = (-math.inf, math.inf)


@dataclasses.dataclass
class Statement:
    """A problem; lists have one entry a state or a control, in order."""

    name: str
    source: str
    states: list
    controls: list
    rates: Callable  # (m, x, u) -> list
    first: list  # at t = 0: a number, or None where free
    last: list  # at tf
    tf: tuple  # lower, upper; equal for a fixed one
    tf_guess: float
    state_bounds: list = None
    control_bounds: list = None
    lagrange: Callable = None  # (m, x, u) -> integrand
    mayer: Callable = None  # (m, x, tf) at the end -> cost
    path: Callable = None  # (m, x, u) -> list, each <= 0
    guess: dict = dataclasses.field(default_factory=dict)  # name -> (from, to), lines in time

    def __post_init__(self):
        self.state_bounds = self.state_bounds or [FREE] * len(self.states)
        self.control_bounds = self.control_bounds or [FREE] * len(self.controls)

    def line(self, name):
        """Guess of a state or control at both ends."""
        if name in self.guess:
            return self.guess[name]
        if name in self.states:
            i = self.states.index(name)
            known = [v for v in (self.first[i], self.last[i]) if v is not None]
            a = self.first[i] if self.first[i] is not None else (known or [0.0])[0]
            b = self.last[i] if self.last[i] is not None else (known or [0.0])[0]
            return float(a), float(b)
        low, high = self.control_bounds[self.controls.index(name)]
        middle = (low + high) / 2 if math.isfinite(low) and math.isfinite(high) else 0.0
        return middle, middle

    def violation(self, m, t, x, u):
        """How far nodes at times `t` with states `x` are from what is asked at the ends, from the states' bounds and, after
        the first, from the path constraints, with controls u(interval, time): the largest, relative to twice the
        largest size of a state or constraint there. Controls are free between the points of some schemes, and their
        bounds are not looked at."""
        least, most = self.tf
        found = [abs(t[0]) / t[-1], (least - t[-1]) / t[-1], (t[-1] - most) / t[-1]]
        for i, (low, high) in enumerate(self.state_bounds):
            values = [row[i] for row in x]
            off = [abs(end - wanted) for end, wanted in ((values[0], self.first[i]), (values[-1], self.last[i]))
                   if wanted is not None]
            off += [low - min(values), max(values) - high]
            found.append(max(off) / (2 * max(map(abs, values)) or 1.0))
        rows = [self.path(m, list(x[k]), u(k - 1, t[k])) for k in range(1, len(t))] if self.path else []
        for values in zip(*rows):
            found.append(max(values) / (2 * max(map(abs, values)) or 1.0))
        return float(max(found))


def bryson_denham():
    return Statement(
        "Bryson-Denham", "Bryson & Ho 1975, section 3.11", ["x", "v"], ["u"],
        lambda m, x, u: [x[1], u[0]], [0, 1], [0, -1], (1, 1), 1,
        state_bounds=[(-math.inf, 1 / 9), FREE], lagrange=lambda m, x, u: u[0] ** 2 / 2)


def brachistochrone():
    return Statement(
        "brachistochrone", "Bryson & Ho 1975, section 2.7", ["x", "y", "v"], ["a"],
        lambda m, x, u: [x[2] * m.sin(u[0]), -x[2] * m.cos(u[0]), 9.80665 * m.cos(u[0])],
        [0, 10, 0], [10, 5, None], (0.1, 10), 1.5, control_bounds=[(0.01, math.pi)],
        state_bounds=[(-1, 20), (0, 20), (0, 50)], mayer=lambda m, x, tf: tf,
        guess={"v": (0, 10)})


def least_time():
    return Statement(
        "double integrator, least time", "Bryson & Ho 1975, section 3.9", ["x", "v"], ["u"],
        lambda m, x, u: [x[1], u[0]], [0, 0], [1, 0], (0.1, 10), 1.5, control_bounds=[(-1, 1)],
        mayer=lambda m, x, tf: tf)


def moon_lander():
    return Statement(
        "moon lander", "Meditch 1964", ["h", "v"], ["u"],
        lambda m, x, u: [x[1], -1.5 + u[0]], [10, -2], [0, 0], (1, 20), 4,
        control_bounds=[(0, 3)], lagrange=lambda m, x, u: u[0])


def van_der_pol():
    return Statement(
        "Van der Pol, state bounded", "Vassiliadis et al. 1994", ["x", "y"], ["u"],
        lambda m, x, u: [(1 - x[1] ** 2) * x[0] - x[1] + u[0], x[0]], [0, 1], [None, None],
        (5, 5), 5, state_bounds=[(-0.4, math.inf), FREE], control_bounds=[(-0.3, 1)],
        lagrange=lambda m, x, u: x[0] ** 2 + x[1] ** 2 + u[0] ** 2, guess={"x": (0, 0)})


def rayleigh():
    return Statement(
        "Rayleigh", "Betts 2010, section 4.10", ["x", "y"], ["u"],
        lambda m, x, u: [x[1], -x[0] + x[1] * (1.4 - 0.14 * x[1] ** 2) + 4 * u[0]], [-5, -5],
        [None, None], (4.5, 4.5), 4.5, lagrange=lambda m, x, u: u[0] ** 2 + x[0] ** 2)


def hyper_sensitive():
    return Statement(
        "hyper-sensitive, tf 40", "Rao & Mease 2000", ["x"], ["u"],
        lambda m, x, u: [-x[0] ** 3 + u[0]], [1.5], [1], (40, 40), 40,
        lagrange=lambda m, x, u: (x[0] ** 2 + u[0] ** 2) / 2)


def goddard():
    def rates(m, x, u):
        drag = 310 * x[1] ** 2 * m.exp(-500 * (x[0] - 1))
        return [x[1], (u[0] - drag) / x[2] - 1 / x[0] ** 2, -2 * u[0]]

    return Statement(
        "Goddard rocket", "COPS 3.0, problem 10", ["h", "v", "m"], ["T"], rates, [1, 0, 1],
        [None, None, 0.6], (0.02, 1), 0.2,
        state_bounds=[(1, math.inf), (0, math.inf), (0.6, 1)], control_bounds=[(0, 3.5)],
        mayer=lambda m, x, tf: -x[0], guess={"h": (1, 1.01), "v": (0, 0)})


def cart_pole():
    m1, m2, length, g = 1.0, 0.3, 0.5, 9.81

    def rates(m, x, u):
        s, c, w = m.sin(x[1]), m.cos(x[1]), x[3]
        mass = m1 + m2 * s * s
        return [x[2], w, (length * m2 * s * w * w + u[0] + m2 * g * c * s) / mass,
                -(length * m2 * c * s * w * w + u[0] * c + (m1 + m2) * g * s) / (length * mass)]

    return Statement(
        "cart-pole swing-up", "Kelly 2017, section 6", ["q", "a", "v", "w"], ["u"], rates,
        [0, 0, 0, 0], [1, math.pi, 0, 0], (2, 2), 2,
        state_bounds=[(-2, 2), FREE, FREE, FREE], control_bounds=[(-20, 20)],
        lagrange=lambda m, x, u: u[0] ** 2)


def catalyst():
    def rates(m, x, u):
        return [u[0] * (10 * x[1] - x[0]), u[0] * (x[0] - 10 * x[1]) - (1 - u[0]) * x[1]]

    return Statement(
        "catalyst mixing", "COPS 3.0, problem 14", ["a", "b"], ["u"], rates, [1, 0], [None, None],
        (1, 1), 1, control_bounds=[(0, 1)], mayer=lambda m, x, tf: x[0] + x[1] - 1,
        guess={"a": (1, 1), "b": (0, 0)})


def orbit_raising():
    def rates(m, x, u):
        thrust = 0.1405 / (1 - 0.0749 * x[3])
        return [x[1], x[2] ** 2 / x[0] - 1 / x[0] ** 2 + thrust * m.sin(u[0]),
                -x[1] * x[2] / x[0] + thrust * m.cos(u[0]), 1.0 + 0 * x[0]]

    return Statement(
        "orbit raising, least time", "after Bryson & Ho 1975, section 2.5",
        ["r", "vr", "vt", "clock"], ["a"], rates, [1, 0, 1, 0], [1.525, 0, 1.525 ** -0.5, None],
        (1, 6), 3.3, state_bounds=[(0.9, 1.6), (-1, 1), (0.5, 1.5), (0, 6)],
        control_bounds=[(-1, 7)], mayer=lambda m, x, tf: tf,
        guess={"a": (0.5, 5.5), "clock": (0, 3.3)})


def robot_arm():
    length = 5.0

    def rates(m, x, u):
        inertia = ((length - x[0]) ** 3 + x[0] ** 3) / 3
        return [x[3], x[4], x[5], u[0] / length, u[1] / (inertia * m.sin(x[2]) ** 2),
                u[2] / inertia]

    return Statement(
        "robot arm", "COPS 3.0, problem 8", ["r", "th", "ph", "vr", "vth", "vph"],
        ["ur", "uth", "uph"], rates, [4.5, 0, math.pi / 4, 0, 0, 0],
        [4.5, 2 * math.pi / 3, math.pi / 4, 0, 0, 0], (1, 30), 10,
        state_bounds=[(0, length), (-math.pi, math.pi), (0.01, math.pi), FREE, FREE, FREE],
        control_bounds=[(-1, 1)] * 3, mayer=lambda m, x, tf: tf)


def reentry():
    re, mu, mass, area = 20902900.0, 0.14076539e17, 203000 / 32.174, 2690.0
    deg = math.pi / 180

    # Heights in 1e5 ft, speeds in 1e4 ft/s, time in s.
    def rates(m, x, u):
        h, v, r = 1e5 * x[0], 1e4 * x[2], re + 1e5 * x[0]
        rho = 0.002378 * m.exp(-h / 23800)
        alpha = u[0] / deg
        lift = 0.5 * (-0.20704 + 0.029244 * alpha) * area * rho * v ** 2
        drag = 0.5 * (0.07854 - 0.61592e-2 * alpha + 0.621408e-3 * alpha ** 2) * area * rho * v ** 2
        g = mu / r ** 2
        sg, cg = m.sin(x[3]), m.cos(x[3])
        return [v * sg / 1e5, v / r * cg * m.cos(x[4]), (-drag / mass - g * sg) / 1e4,
                lift / (mass * v) * m.cos(u[1]) + cg * (v / r - g / v),
                lift * m.sin(u[1]) / (mass * v * cg)
                + v / r * cg * m.sin(x[4]) * m.sin(x[1]) / m.cos(x[1])]

    return Statement(
        "shuttle re-entry", "Betts 2010, section 6.1", ["h", "theta", "v", "gamma", "psi"],
        ["alpha", "beta"], rates, [2.6, 0, 2.56, -1 * deg, 90 * deg],
        [0.8, None, 0.25, -5 * deg, None], (500, 3000), 2000,
        state_bounds=[(0, 4), (-89 * deg, 89 * deg), (0.01, 5), (-89 * deg, 89 * deg), FREE],
        control_bounds=[(-90 * deg, 90 * deg), (-89 * deg, 1 * deg)],
        mayer=lambda m, x, tf: -x[1],
        guess={"theta": (0, 0.4), "psi": (90 * deg, 10 * deg), "alpha": (0.3, 0.3),
               "beta": (-0.8, -0.2)})


def bicycle():
    """A kinematic car past a circle, least time and effort."""

    def rates(m, x, u):
        return [x[3] * m.cos(x[2]), x[3] * m.sin(x[2]), x[3] / 2.5 * m.sin(x[4]) / m.cos(x[4]),
                u[0], u[1]]

    return Statement(
        "car past a disc", "this project; after Febbo et al. 2020",
        ["x", "y", "psi", "v", "delta"], ["a", "sr"], rates, [0, 0, math.pi / 2, 10, 0],
        [0, 60, None, None, None], (1, 30), 5.5,
        state_bounds=[(-20, 20), (-5, 80), (-1, 4), (1, 15), (-0.5, 0.5)],
        control_bounds=[(-3, 2), (-0.6, 0.6)],
        path=lambda m, x, u: [36 - (x[0] - 1) ** 2 - (x[1] - 30) ** 2],
        mayer=lambda m, x, tf: tf, lagrange=lambda m, x, u: 0.1 * u[1] ** 2 + 0.01 * u[0] ** 2,
        guess={"psi": (math.pi / 2, math.pi / 2), "v": (10, 10), "delta": (0, 0)})


STATEMENTS = [
    bryson_denham, brachistochrone, least_time, moon_lander, van_der_pol, rayleigh,
    hyper_sensitive, goddard, cart_pole, catalyst, orbit_raising, robot_arm, reentry, bicycle,
]


def by_name(name):
    """The statement of that name."""
    for make in STATEMENTS:
        if make.__name__ == name:
            return make()
    raise SystemExit(f"no problem '{name}'; there are {', '.join(s.__name__ for s in STATEMENTS)}")
