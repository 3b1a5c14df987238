"""The planner's problem as fatrop and acados want it: multiple shooting.

Another NLP than ours: x(0) is fixed at the predicted state (no slacks there), controls are constant
in an interval, one Runge-Kutta step of order 4 takes a node to the next, and tf is a ninth state.
Cost and rows are those of docs/formulation.md at the nodes k >= 1, for none at node 0 can be moved.
In range the slacks xfs stand at the last node, where they are its controls.
"""

import math

import casadi as ca
import numpy as np
from scipy.optimize import nnls

from planner_casadi import (
    AX, CONTROLS, ENVIRONMENTS, FZ_MIN, INF, NX, PLANNERS, SA, STATES, TF_MAX, TF_MIN, W_FZ, W_G,
    W_HAF, W_JX, W_SA, W_SR, W_XF, X, XF_TOL, Y, vehicle)  # fmt: skip

NS, NU = NX + 1, 2  # with tf
TF = NX
DEG = math.pi / 180
U_MAX = np.array([5 * DEG, 5])
W_T = PLANNERS["P_D"][0]


class Model:
    """Functions of a stage, as expressions of state x (with tf), control u and parameters p: X0p
    (8), absolute time of node 0, then x, y, a, b, vx, vy of each obstacle."""

    def __init__(self, environment):
        self.env = env = ENVIRONMENTS[environment]
        self.N, self.obstacles = env["N"], env["obstacles"]
        self.np = 9 + self.obstacles.size
        box = np.array([env["x_range"], (-INF, INF), (-INF, INF), (-INF, INF),
                        (-2 * math.pi, 2 * math.pi), (-30 * DEG, 30 * DEG), (0.01, 29),
                        (-INF, INF), (TF_MIN, TF_MAX)])  # fmt: skip
        self.x_min, self.x_max = box.T

    def step(self, x, u):
        """The next node's state: Runge-Kutta of order 4 over tf / N."""
        h = x[TF] / self.N
        rate = lambda s: vehicle(ca.vertcat(s, u))[0]
        s = x[:NX]
        k1 = rate(s)
        k2 = rate(s + h / 2 * k1)
        k3 = rate(s + h / 2 * k2)
        k4 = rate(s + h * k3)
        return ca.vertcat(s + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), x[TF])

    def state_cost(self, x):
        """What the integrand has of the state, by the trapezoidal rule's weight at an inner node."""
        loads = vehicle(ca.vertcat(x[:NX], 0, 0))[1]
        goal, psi_g = self.env["goal"], math.pi / 2
        aside = math.sin(psi_g) * (x[X] - goal[0]) - math.cos(psi_g) * (x[Y] - goal[1])
        wheels = sum(ca.tanh(-(loads[i] - 1300) / 100) for i in (0, 1))
        return x[TF] / self.N * (W_HAF * aside**2 + W_FZ * wheels + W_SA * x[SA] ** 2)

    def control_cost(self, x, u):
        return x[TF] / self.N * (W_SR * u[0] ** 2 + W_JX * u[1] ** 2)

    def goal_cost(self, x, p):
        """Out of range: distance to the goal beside that at the start."""
        to = lambda s: (s[X] - self.env["goal"][0]) ** 2 + (s[Y] - self.env["goal"][1]) ** 2
        return W_G * to(x) / (to(p) + 0.01)

    def rows(self, x, p, tau, root=False):
        """All >= 0, at nodes k >= 1; with `root` an obstacle's is a distance, not its square."""
        _, loads, ax_min, ax_max = vehicle(ca.vertcat(x[:NX], 0, 0))
        margin, t = 2.5 + 1.5 * tau, p[8] + tau * x[TF]
        obstacle = ca.reshape(p[9 : self.np], 6, len(self.obstacles))
        xo, yo = obstacle[0, :] + obstacle[4, :] * t, obstacle[1, :] + obstacle[5, :] * t
        square = (((x[X] - xo) / (obstacle[2, :] + margin)) ** 2
                  + ((x[Y] - yo) / (obstacle[3, :] + margin)) ** 2)  # fmt: skip
        outside = (ca.sqrt(square) if root else square) - 1
        reach = self.env["L_range"] + self.env["kappa"]
        return ca.vertcat(x[AX] - ax_min, ax_max - x[AX], loads - FZ_MIN, outside.T,
                          reach**2 - self.distance(x, p))  # fmt: skip

    def distance(self, x, p):
        return (x[X] - p[X]) ** 2 + (x[Y] - p[Y]) ** 2

    def edge(self, x, p):
        """Out of range, at the last node: >= 0 (its outer edge is the LiDAR row)."""
        return self.distance(x, p) - (self.env["L_range"] - self.env["kappa"]) ** 2

    def parameters(self, cycle):
        return np.concatenate([cycle.X0p, [cycle.meta["t_start"]], self.obstacles.ravel()])

    def start(self, cycle, names, warm):
        """States (N+1, 9) and controls (N, 2) from our start: its nodes, intervals' mean controls."""
        value = dict(zip(names["variables"], cycle.warm_x if warm else cycle.cold_x))
        nodes = np.array([[value[f"{name} at node {k}"] for name in STATES + CONTROLS]
                          for k in range(self.N + 1)])  # fmt: skip
        states = np.column_stack([nodes[:, :NX], np.full(self.N + 1, value["tf"])])
        states[0, :NX] = cycle.X0p
        return states, 0.5 * (nodes[:-1, NX:] + nodes[1:, NX:])


class FlatNlp:
    """The stages in a row, x0 u0 x1 u1 ... xN (xfs), with rows stage by stage: the next state, then
    the rows of the node. For fatrop, and for the judge of both peers' answers."""

    def __init__(self, environment, in_range):
        self.model = m = Model(environment)
        self.in_range, N = in_range, m.N
        self.N, self.nx = N, [NS] * (N + 1)
        self.nu = [NU] * N + [2 if in_range else 0]
        rows = 7 + len(m.obstacles)
        self.ng = [0] + [rows] * (N - 1) + [rows + (4 if in_range else 1)]
        p = ca.SX.sym("p", m.np)
        x = [ca.SX.sym(f"x{k}", NS) for k in range(N + 1)]
        u = [ca.SX.sym(f"u{k}", n) for k, n in enumerate(self.nu)]
        # One tape for all stages: a stage is a call of these.
        xs, us, ts = ca.SX.sym("x", NS), ca.SX.sym("u", NU), ca.SX.sym("tau")
        step = ca.Function("step", [xs, us], [m.step(xs, us)])
        node = ca.Function("node", [xs, p, ts], [m.state_cost(xs), m.rows(xs, p, ts)])
        f, g = W_T * x[N][TF], []
        for k in range(N + 1):
            cost, at_node = node(x[k], p, k / N)
            f += cost * (0.5 if k in (0, N) else 1)
            if k < N:
                f += m.control_cost(x[k], u[k])
                g.append(x[k + 1] - step(x[k], u[k]))
            if k > 0:
                g.append(at_node)
        goal = ca.DM(m.env["goal"])
        if in_range:
            gap = x[N][:2] - goal
            f += W_XF * ca.sum1(u[N])
            g += [gap + u[N], u[N] - gap]
        else:
            f += m.goal_cost(x[N], p)
            g.append(m.edge(x[N], p))
        w = ca.vertcat(*(v for pair in zip(x, u) for v in pair))
        self.nlp = {"x": w, "p": p, "f": f, "g": ca.vertcat(*g)}
        self._bounds()

    def _bounds(self):
        m, N = self.model, self.N
        self.equality = []
        for k in range(N + 1):
            self.equality += [True] * (NS if k < N else 0) + [False] * self.ng[k]
        self.equality = np.array(self.equality)
        u_min = [-U_MAX] * N + ([np.full(2, -INF)] if self.in_range else [np.zeros(0)])
        u_max = [U_MAX] * N + ([np.full(2, XF_TOL)] if self.in_range else [np.zeros(0)])
        self.lbx = np.concatenate([v for k in range(N + 1) for v in (m.x_min, u_min[k])])
        self.ubx = np.concatenate([v for k in range(N + 1) for v in (m.x_max, u_max[k])])
        self.lbg = np.zeros(len(self.equality))
        self.ubg = np.where(self.equality, 0, INF)

    def bounds(self, X0p):
        """Of a cycle: x(0) is fixed, its tf free."""
        lbx, ubx = self.lbx.copy(), self.ubx.copy()
        lbx[:NX] = ubx[:NX] = X0p
        return lbx, ubx

    def flat(self, states, controls):
        parts = [v for k in range(self.N) for v in (states[k], controls[k])] + [states[-1]]
        if self.in_range:
            gap = np.abs(states[-1, :2] - self.model.env["goal"])
            parts.append(np.minimum(gap + 0.1, 0.99 * XF_TOL))
        return np.concatenate(parts)

    def path(self, w):
        at = (NS + NU) * np.arange(self.N + 1)
        return np.column_stack([w[at + X], w[at + Y]]).ravel()


class Judge:
    """Residuals of an answer from the NLP's functions and the answer's primal alone: multipliers
    are those that make stationarity and complementarity least (non-negative least squares)."""

    def __init__(self, flat, level):
        self.flat = flat
        self.weight = level.stationarity / level.complementarity  # of complementarity, beside it
        x, p, f, g = (flat.nlp[k] for k in ("x", "p", "f", "g"))
        self.functions = ca.Function("all", [x, p], [f, ca.gradient(f, x), g, ca.jacobian(g, x)])

    def __call__(self, w, cycle):
        flat = self.flat
        f, gradient, g, jacobian = (np.array(v.full() if hasattr(v, "full") else v) for v in
                                    self.functions(w, flat.model.parameters(cycle)))  # fmt: skip
        gradient, g = gradient.ravel(), g.ravel()
        lbx, ubx = flat.bounds(cycle.X0p)
        free = lbx < ubx
        below, above = lbx - w, w - ubx
        violation = max(np.max(np.abs(g[flat.equality])), -np.min(g[~flat.equality]),
                        np.max(below), np.max(above))  # fmt: skip
        eye = np.eye(len(w))
        slack = np.concatenate([g[~flat.equality], (-below)[free], (-above)[free]])
        rows = np.vstack([jacobian[~flat.equality], eye[free], -eye[free]])[:, free]
        near = slack < 1.0
        stationarity, complementarity = self.least(
            gradient[free], jacobian[flat.equality][:, free], rows[near],
            np.maximum(slack[near], 0))  # fmt: skip
        return {"violation": float(max(violation, 0)), "stationarity": stationarity,
                "complementarity": complementarity, "f": float(f.ravel()[0]), "phi": None,
                "path": flat.path(w).tolist(), "tf": float(w[TF]), "cycle": cycle.index}  # fmt: skip

    def least(self, gradient, equations, rows, slack):
        if not (np.all(np.isfinite(gradient)) and np.all(np.isfinite(equations))):
            return None, None
        q = np.linalg.qr(equations.T, mode="complete")[0][:, len(equations) :]
        matrix = np.vstack([q.T @ rows.T, self.weight * np.diag(slack)])
        z, _ = nnls(matrix, np.concatenate([q.T @ gradient, np.zeros(len(slack))]), maxiter=10000)
        rest = q.T @ (gradient - rows.T @ z)
        return float(np.max(np.abs(q @ rest))), float(np.max(slack * z, initial=0))
