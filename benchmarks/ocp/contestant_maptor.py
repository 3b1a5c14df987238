"""MAPTOR: Radau collocation on CasADi and Ipopt, stated as its documentation does."""

import logging
import math
import time

import casadi as ca
import maptor
import numpy as np

logging.getLogger("maptor").setLevel(logging.ERROR)
SCHEMES = ["radau3", "radau5", "radau8"]
OPTIONS = {"ipopt.print_level": 0, "ipopt.sb": "yes", "print_time": 0, "record_time": True,
           "ipopt.tol": 1e-8,
           "ipopt.max_iter": 1000}


def optional(bounds):
    """Bounds as MAPTOR takes them."""
    low, high = (b if math.isfinite(b) else None for b in bounds)
    return None if low is None and high is None else (low, high)


def build(statement, degree, intervals):
    """The problem on its mesh."""
    problem = maptor.Problem(statement.name)
    phase = problem.set_phase(1)
    low, high = statement.tf
    t = phase.time(initial=0.0, final=low if low == high else (low, high))
    x = [phase.state(n, initial=statement.first[i], final=statement.last[i],
                     boundary=optional(statement.state_bounds[i]))
         for i, n in enumerate(statement.states)]
    u = [phase.control(n, boundary=optional(statement.control_bounds[i]))
         for i, n in enumerate(statement.controls)]
    phase.dynamics(dict(zip(x, statement.rates(ca, x, u))))
    if statement.path:
        phase.path_constraints(*[g <= 0 for g in statement.path(ca, x, u)])
    cost = 0
    if statement.lagrange:
        cost = cost + phase.add_integral(statement.lagrange(ca, x, u))
    if statement.mayer:
        cost = cost + statement.mayer(ca, [s.final for s in x], t.final)
    problem.minimize(cost)
    phase.mesh([degree] * intervals, list(np.linspace(-1, 1, intervals + 1)))
    at = [0.0, *ca.collocation_points(degree, "radau")]

    def guess(names, points):
        return [np.array([[statement.line(n)[0] * (1 - (k + c) / intervals)
                           + statement.line(n)[1] * (k + c) / intervals for c in points]
                          for n in names]) for k in range(intervals)]

    phase.guess(states=guess(statement.states, at), controls=guess(statement.controls, at[:-1]),
                initial_time=0.0, terminal_time=statement.tf_guess)
    return problem


def solve(statement, scheme, intervals):
    """(answer or None, set-up seconds, solve seconds)."""
    degree = int(scheme[5:])
    spent = []
    plain = ca.Opti.solve

    def timed(opti):
        try:
            return plain(opti)
        finally:
            spent.append(opti.stats()["t_wall_total"])

    ca.Opti.solve = timed
    begin = time.perf_counter()
    try:
        problem = build(statement, degree, intervals)
        solution = maptor.solve_fixed_mesh(problem, nlp_options=OPTIONS, show_summary=False)
    finally:
        ca.Opti.solve = plain
    total = time.perf_counter() - begin
    solving = sum(spent)
    if not solution.status["success"]:
        return None, total - solving, solving
    tf = solution.status["total_mission_time"]
    t = np.linspace(0, tf, intervals + 1)
    states = np.array([solution[(1, n)] for n in statement.states])
    controls = np.array([solution[(1, n)] for n in statement.controls])
    at_states, at_controls = solution[(1, "time_states")], solution[(1, "time_controls")]
    x = np.array([[np.interp(s, at_states, row) for row in states] for s in t])

    def control(k, time_):
        inside = (at_controls >= t[k] - 1e-9 * tf) & (at_controls < t[k + 1] - 1e-9 * tf)
        points, values = at_controls[inside], controls[:, inside]
        basis = [np.prod([(time_ - q) / (p - q) for q in points if q != p]) for p in points]
        return values @ np.array(basis)

    answer = {"t": t, "x": x, "u": control, "objective": solution.status["objective"]}
    return answer, total - solving, solving
