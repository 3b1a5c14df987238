"""Judges an answer to a statement: integrates it anew, whoever found it.

An answer is a dict: `t` (nodes of the mesh), `x` (states at the nodes, one row a node), `u` (a
function of interval number and time, giving the controls there), `objective`.
"""

import math

import numpy as np
from scipy.integrate import solve_ivp

TOLERANCE = 1e-6  # relative to twice a state's largest size: interval_errors, Statement.violation
OBJECTIVE = 1e-4  # relative to the converged one: equal intervals cannot meet a jump of the control


class Numbers:
    """The functions a statement is evaluated with here."""

    sin, cos, exp, sqrt = math.sin, math.cos, math.exp, math.sqrt


def interval_errors(statement, answer):
    """Of each interval: its end, integrated from its begin with the answer's controls, beside the
    answer's next node; relative to twice the state's largest size."""
    t, x = np.asarray(answer["t"], float), np.asarray(answer["x"], float)
    size = np.abs(x).max(axis=0)
    size = np.where(size > 0, 2 * size, 1.0)
    errors = []
    for k in range(len(t) - 1):

        def rates(time, state, k=k):
            return statement.rates(Numbers, state, answer["u"](k, time))

        ends = solve_ivp(rates, (t[k], t[k + 1]), x[k], method="DOP853", rtol=1e-10,
                         atol=1e-12 * size.max())
        errors.append(float(np.max(np.abs(ends.y[:, -1] - x[k + 1]) / size)) if ends.success
                      else math.inf)
    return errors


def judge(statement, answer, reference):
    """(largest error of an interval or violation, the objective's relative difference, whether both are good)."""
    error = max(*interval_errors(statement, answer),
                statement.violation(Numbers, answer["t"], answer["x"], answer["u"]))
    gap = abs(answer["objective"] - reference) / max(abs(reference), 1e-3)
    return error, gap, error <= TOLERANCE and gap <= OBJECTIVE
