"""ASSET (asset-asrl): its phase, its optimizer PSIOPT."""

import math
import time

import asset_asrl as ast
import numpy as np

vf, oc = ast.VectorFunctions, ast.OptimalControl
# With a line search and without: which is better depends on the problem.
SCHEMES = ["LGL3 L1", "LGL5 L1", "LGL7 L1", "LGL3 NOLS", "LGL5 NOLS", "LGL7 NOLS"]
POINTS = 101  # of the guess that the phase interpolates


class Functions:
    """The functions a statement is written with."""

    sin, cos, exp, sqrt = vf.sin, vf.cos, vf.exp, vf.sqrt


class Dynamics(oc.ODEBase):
    """A statement's rates."""

    def __init__(self, statement):
        nx, nu = len(statement.states), len(statement.controls)
        arguments = oc.ODEArguments(nx, nu)
        x = [arguments.XVar(i) for i in range(nx)]
        u = [arguments.UVar(i) for i in range(nu)]
        rates = statement.rates(Functions, x, u)
        super().__init__(vf.stack(rates) if nx > 1 else rates[0], nx, nu)


def bound(phase, region, index, low, high):
    """Bounds of a variable."""
    if math.isfinite(low) and math.isfinite(high):
        phase.addLUVarBound(region, index, low, high, 1.0)
    elif math.isfinite(low):
        phase.addLowerVarBound(region, index, low, 1.0)
    elif math.isfinite(high):
        phase.addUpperVarBound(region, index, high, 1.0)


def build(statement, scheme, intervals):
    """The phase."""
    mode, search = scheme.split()
    nx, nu = len(statement.states), len(statement.controls)
    guess = []
    for tau in np.linspace(0, 1, POINTS):
        row = [statement.line(n)[0] * (1 - tau) + statement.line(n)[1] * tau
               for n in statement.states]
        row.append(tau * statement.tf_guess)
        row += [statement.line(n)[0] * (1 - tau) + statement.line(n)[1] * tau
                for n in statement.controls]
        guess.append(row)
    phase = Dynamics(statement).phase(mode, guess, intervals)
    first = [i for i in range(nx) if statement.first[i] is not None]
    last = [i for i in range(nx) if statement.last[i] is not None]
    phase.addBoundaryValue("Front", first + [nx], [statement.first[i] for i in first] + [0])
    if last:
        phase.addBoundaryValue("Back", last, [statement.last[i] for i in last])
    if statement.tf[0] == statement.tf[1]:
        phase.addBoundaryValue("Back", [nx], [statement.tf[0]])
    else:
        bound(phase, "Back", nx, *statement.tf)
    for i in range(nx):
        bound(phase, "Path", i, *statement.state_bounds[i])
    for i in range(nu):
        bound(phase, "Path", nx + 1 + i, *statement.control_bounds[i])
    indices = list(range(nx)) + list(range(nx + 1, nx + 1 + nu))

    def of_point(function):
        z = vf.Arguments(nx + nu).tolist()
        return function(Functions, z[:nx], z[nx:])

    if statement.path:
        for i in range(len(of_point(statement.path))):
            phase.addInequalCon("Path", of_point(statement.path)[i], indices)
    if statement.lagrange:
        phase.addIntegralObjective(of_point(statement.lagrange), indices)
    if statement.mayer:
        z = vf.Arguments(nx + 1).tolist()
        phase.addStateObjective("Back", statement.mayer(Functions, z[:nx], z[nx]),
                                list(range(nx + 1)))
    phase.optimizer.PrintLevel = 3
    phase.optimizer.set_OptLSMode(search)
    phase.optimizer.set_QPOrderingMode("MINDEG")
    phase.optimizer.set_EContol(1e-9)
    phase.optimizer.set_KKTtol(1e-8)
    phase.optimizer.MaxIters = 1000
    phase.setThreads(1, 1)
    phase.transcribe(False, False)
    return phase


def solve(statement, scheme, intervals):
    """(answer or None, set-up seconds, solve seconds)."""
    nx = len(statement.states)
    begin = time.perf_counter()
    phase = build(statement, scheme, intervals)
    ready = time.perf_counter()
    flag = phase.optimize()
    done = time.perf_counter()
    if flag != ast.Solvers.ConvergenceFlags.CONVERGED:
        return None, ready - begin, done - ready
    rows = np.array(phase.returnTraj())
    per = (len(rows) - 1) // intervals
    nodes = rows[::per]
    table = phase.returnTrajTable()

    def controls(k, time_):
        return np.array(table.Interpolate(time_))[nx + 1:]

    answer = {"t": nodes[:, nx], "x": nodes[:, :nx], "u": controls,
              "objective": phase.optimizer.LastObjVal / phase.optimizer.ObjScale}
    return answer, ready - begin, done - ready
