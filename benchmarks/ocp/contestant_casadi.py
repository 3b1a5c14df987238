"""Direct collocation written in CasADi, solved by its Ipopt with exact derivatives."""

import math
import time

import casadi as ca
import numpy as np

SCHEMES = ["hermite_simpson", "hermite_simpson linear", "radau3", "radau4"]
# As CasADi's users set it: SX graphs, exact Hessian, no output.
OPTIONS = {"ipopt.print_level": 0, "print_time": 0, "ipopt.sb": "yes", "ipopt.tol": 1e-8,
           "ipopt.max_iter": 1000, "expand": True}


def limits(bounds):
    """Lower and upper bounds as CasADi takes them."""
    return [b[0] for b in bounds], [b[1] for b in bounds]


class Builder:
    """Variables, constraints and cost of an NLP, in order of time."""

    def __init__(self):
        self.w, self.lbw, self.ubw, self.w0 = [], [], [], []
        self.g, self.lbg, self.ubg, self.cost = [], [], [], 0

    def variable(self, name, low, high, guess):
        w = ca.SX.sym(name, len(guess))
        self.w.append(w)
        self.lbw += list(low)
        self.ubw += list(high)
        self.w0 += list(guess)
        return w

    def equal(self, g):
        self.g.append(g)
        self.lbg += [0.0] * g.numel()
        self.ubg += [0.0] * g.numel()

    def at_most_zero(self, terms):
        for g in terms:
            self.g.append(g)
            self.lbg.append(-math.inf)
            self.ubg.append(0.0)


def build(statement, scheme, intervals):
    """The NLP solver, its arguments, and what reads its answer."""
    nx, nu = len(statement.states), len(statement.controls)
    b = Builder()
    tf = b.variable("tf", [statement.tf[0]], [statement.tf[1]], [statement.tf_guess])
    xs, us = ca.SX.sym("x", nx), ca.SX.sym("u", nu)
    parts_x, parts_u = ca.vertsplit(xs), ca.vertsplit(us)
    rates = ca.Function("rates", [xs, us], [ca.vertcat(*statement.rates(ca, parts_x, parts_u))])
    cost = statement.lagrange(ca, parts_x, parts_u) if statement.lagrange else 0
    integrand = ca.Function("integrand", [xs, us], [cost])
    xl, xu = limits(statement.state_bounds)
    ul, uu = limits(statement.control_bounds)

    def guess(names, tau):
        return [statement.line(n)[0] * (1 - tau) + statement.line(n)[1] * tau for n in names]

    def state(tau, end=None):
        low, high = list(xl), list(xu)
        for i, value in enumerate(end or []):
            if value is not None:
                low[i] = high[i] = value
        return b.variable("x", low, high, guess(statement.states, tau))

    def control(tau):
        return b.variable("u", ul, uu, guess(statement.controls, tau))

    def path(x, u):
        if statement.path:
            b.at_most_zero(statement.path(ca, ca.vertsplit(x), ca.vertsplit(u)))

    h = tf / intervals
    points = []  # of each interval: states at both ends, controls at the collocated points
    x = state(0, statement.first)
    if scheme.startswith("hermite_simpson"):
        u = control(0)
        path(x, u)
        for k in range(intervals):
            um = None if scheme.endswith("linear") else control((k + 0.5) / intervals)
            last = k + 1 == intervals
            x1 = state((k + 1) / intervals, statement.last if last else None)
            u1 = control((k + 1) / intervals)
            um = (u + u1) / 2 if um is None else um
            f0, f1 = rates(x, u), rates(x1, u1)
            xm = (x + x1) / 2 + h / 8 * (f0 - f1)
            b.equal(x1 - x - h / 6 * (f0 + 4 * rates(xm, um) + f1))
            b.cost += h / 6 * (integrand(x, u) + 4 * integrand(xm, um) + integrand(x1, u1))
            path(xm, um)
            path(x1, u1)
            points.append((x, x1, [u, um, u1]))
            x, u = x1, u1
        at = [0, 0.5, 1]
    else:
        degree = int(scheme[-1])
        at = ca.collocation_points(degree, "radau")
        c, d, weights = ca.collocation_coeff(at)
        for k in range(intervals):
            last = k + 1 == intervals
            inner, controls = [], []
            for j in range(degree):
                end = last and j + 1 == degree
                tau = (k + at[j]) / intervals
                inner.append(state(tau, statement.last if end else None))
                controls.append(control(tau))
            z = ca.horzcat(*inner)
            f = ca.horzcat(*[rates(z[:, j], controls[j]) for j in range(degree)])
            b.equal(ca.vec(h * f - ca.mtimes(ca.horzcat(x, z), c)))
            for j in range(degree):
                b.cost += h * weights[j] * integrand(z[:, j], controls[j])
                path(z[:, j], controls[j])
            points.append((x, inner[-1], controls))
            x = inner[-1]
    if statement.mayer:
        b.cost += statement.mayer(ca, ca.vertsplit(x), tf)
    w = ca.vertcat(*b.w)
    solver = ca.nlpsol("solver", "ipopt", {"x": w, "f": b.cost, "g": ca.vertcat(*b.g)}, OPTIONS)
    arguments = {"x0": b.w0, "lbx": b.lbw, "ubx": b.ubw, "lbg": b.lbg, "ubg": b.ubg}
    starts = [p[0] for p in points] + [points[-1][1]]
    read = ca.Function("read", [w], [tf, ca.horzcat(*starts),
                                     ca.horzcat(*[ca.horzcat(*p[2]) for p in points])])
    return solver, arguments, (read, np.array(at))


def lagrange_basis(points, s):
    """Value at s of each basis polynomial."""
    return [np.prod([(s - q) / (p - q) for q in points if q != p]) for p in points]


def solve(statement, scheme, intervals):
    """(answer or None, set-up seconds, solve seconds)."""
    begin = time.perf_counter()
    solver, arguments, (read, at) = build(statement, scheme, intervals)
    ready = time.perf_counter()
    result = solver(**arguments)
    done = time.perf_counter()
    if not solver.stats()["success"]:
        return None, ready - begin, done - ready
    tf, x, u = (np.array(v) for v in read(result["x"]))
    tf = float(tf.squeeze())
    t = np.linspace(0, tf, intervals + 1)
    per = len(at)
    u = u.reshape(len(statement.controls), intervals, per)

    def controls(k, time_):
        return u[:, k, :] @ lagrange_basis(at, (time_ - t[k]) / (t[k + 1] - t[k]))

    answer = {"t": t, "x": x.T, "u": controls, "objective": float(result["f"])}
    return answer, ready - begin, done - ready
