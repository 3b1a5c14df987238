"""Slalom's Python package."""

import math
import time

import numpy as np
import slalom

SCHEMES = ["hermite_simpson", "hermite_simpson linear", "lgr 4", "lgl 4", "lgl 5"]


class Functions:
    """The functions a statement is written with."""

    sin, cos, exp, sqrt = np.sin, np.cos, np.exp, np.sqrt


def build(statement, form="scheme"):
    """The problem and the guess; `form` of the controls."""
    p = slalom.Problem(statement.name)
    x = []
    for i, name in enumerate(statement.states):
        low, high = statement.state_bounds[i]
        fixed = {k: v for k, v in [("initial", statement.first[i]), ("final", statement.last[i])]
                 if v is not None}
        x.append(p.state(name, lower=low if math.isfinite(low) else None,
                         upper=high if math.isfinite(high) else None, **fixed))
    u = []
    for i, name in enumerate(statement.controls):
        low, high = statement.control_bounds[i]
        u.append(p.control(name, lower=low if math.isfinite(low) else None,
                           upper=high if math.isfinite(high) else None, form=form))
    for state, rate in zip(x, statement.rates(Functions, x, u)):
        p.dynamics(state, rate)
    if statement.lagrange:
        p.lagrange("running cost", statement.lagrange(Functions, x, u))
    low, high = statement.tf
    if low == high:
        p.final_time(equal=low)
    else:
        p.final_time(lower=low, upper=high, guess=statement.tf_guess)
    if statement.mayer:
        p.mayer("final cost", statement.mayer(Functions, [p.final(s) for s in x], p.tf))
    for i, value in enumerate(statement.path(Functions, x, u) if statement.path else []):
        p.path(f"path {i}", value, upper=0)
    guess = {"tf": statement.tf_guess}
    for name in statement.states + statement.controls:
        guess[name] = list(statement.line(name))
    return p, guess


def solve(statement, scheme, intervals):
    """(answer or None, set-up seconds, solve seconds)."""
    name, _, rest = scheme.partition(" ")
    begin = time.perf_counter()
    p, guess = build(statement, "linear" if rest == "linear" else "scheme")
    s = p.solve(mesh=intervals, scheme=name, points=int(rest) if rest.isdigit() else 4,
                guess=guess)
    total = time.perf_counter() - begin
    if not s.solved:
        return None, total - s.wall_s, s.wall_s
    t = s.t[:: (len(s.t) - 1) // intervals]
    x = np.array([s.state(n) for n in statement.states]).T[:: (len(s.t) - 1) // intervals]

    def controls(k, time_):
        inside = min(max(time_, t[k] + 1e-12 * (t[k + 1] - t[k])),
                     t[k + 1] - 1e-12 * (t[k + 1] - t[k]))
        at = s(inside)
        return [at[n] for n in statement.controls]

    answer = {"t": t, "x": x, "u": controls, "objective": s.objective}
    return answer, total - s.wall_s, s.wall_s
