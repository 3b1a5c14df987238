"""The planner's OCP written for CasADi from the formulation's page alone.

Direct trapezoidal collocation of sections 1 to 3 of docs/formulation.md, shared with nothing of the
library: a peer to time against and a second opinion on the answer. Obstacles, predicted state and
time are run-time parameters, as a planner needs them. peer_ipopt.py solves recorded cycles with it,
time_casadi.py times its functions.
"""

import math

import casadi as ca
import numpy as np

INF = math.inf
NX, NU, NZ = 8, 2, 10
X, Y, V, R, PSI, SA, UX, AX = range(NX)
STATES, CONTROLS = ["x", "y", "v", "r", "psi", "sa", "ux", "ax"], ["sr", "jx"]
X0_TOL = [0.5, 0.5, 0.5, 0.005, 0.5, 0.025, 0.5, 0.5]
W_S0 = [1, 1, 10, 10, 10, 2, 0.1, 0.1]
W_G, W_HAF, W_FZ, W_SA, W_SR, W_JX, W_IC, W_XF = 10, 1, 0.5, 0.1, 1, 0.01, 100, 100
XF_TOL, TF_MIN, TF_MAX, FZ_MIN = 5, 0.1, 10, 1000
AX_MAX = [-0.000128015180401862, 0.00858618595422724, -0.225657108071454, 3.08283259993589]
AX_MIN = [-0.000138537090018958, 0.00684702729623608, -0.120391102052425, -3.55886697370079]

PLANNERS = {  # w_t, w_ce, moving avoidance
    "P_A": (0, 0, False),
    "P_B": (100, 0, False),
    "P_C": (100, 1, False),
    "P_D": (100, 1, True),
}


def _environment(obstacles, start, goal, N, L_range, kappa, sigma, x_range=(-INF, INF)):
    """Obstacles are rows x, y, a, b, vx, vy."""
    return {
        "obstacles": np.array(obstacles, dtype=float),
        "start": np.array([*start, 0, 0, math.pi / 2, 0, 17, 0]),
        "goal": goal,
        "N": N,
        "L_range": L_range,
        "kappa": kappa,
        "sigma": sigma,
        "x_range": x_range,
    }


def _circles(*rows):
    return [[x, y, r, r, vx, vy] for x, y, r, vx, vy in rows]


_CONES = [(12, 5 * k, 0.38735, 0, 0) for k in range(36)]
ENVIRONMENTS = {
    "E_A": _environment(
        _circles((205, 57, 5, 0, 0), (180, 75, 4, 0, 0), (200, 63, 2, 0, 0)),
        (200, 0), (200, 125), 10, 50, 5, 15),
    "E_B": _environment(
        _circles((205, 57, 5, -2, 0), (180, 75, 4, -1, 1), (200, 63, 2, -0.5, 6)),
        (200, 0), (200, 125), 10, 50, 5, 15),
    "E_C": _environment(
        _circles((6, 281, 6, 0, 0), (18, 650, 6, 0, -10), *_CONES),
        (6, 0), (18, 700), 15, 90, 10, 25, (0, 24)),
}  # fmt: skip


# --- the vehicle (sections 1 and 2) -----------------------------------------------------------


def tyre_force(alpha, Fz, offset):
    FZ0, EP = 35000, 0.01
    PCY1, PDY1, PDY2 = 1.5874, 0.73957, -0.075004
    PEY1, PEY2, PEY3 = 0.37562, -0.069325, 0.29168
    PKY1, PKY2 = -10.289, 3.3343
    PHY1, PHY2, PVY1, PVY2 = 0.0056509, -0.0020257, 0.015216, -0.010365
    PC1, PD1, PD2 = PCY1, PDY1 - PDY2, PDY2 / FZ0
    PE1, PE2, PE3 = PEY1 - PEY2, PEY2 / FZ0, PEY3
    PK1, PK2 = PKY1 * FZ0, 1 / (PKY2 * FZ0)
    PH1, PH2, PV1, PV2 = PHY1 - PHY2, PHY2 / FZ0, PVY1 - PVY2, PVY2 / FZ0
    a = alpha + PH2 * Fz + PH1
    D = (PD2 * Fz + PD1) * Fz
    B = PK1 * ca.sin(2 * ca.atan(PK2 * Fz)) / (PC1 * D)
    E = (PE2 * Fz + PE1) * (1 - PE3 * a / ca.sqrt(a * a + EP * EP))
    Ba = B * a
    force = D * ca.sin(PC1 * ca.atan(Ba - E * (Ba - ca.atan(Ba))))
    return force + (PV2 * Fz + PV1) * Fz + offset


def vehicle(z):
    """State and control to state', wheel loads rl rr fl fr, ax_min, ax_max, all as expressions."""
    m, Izz, la, lb = 2688.7, 4110.1, 1.5775, 1.7245
    FzF0, FzR0, KZX, KZYR, KZYF, EP = 13680, 12696, 806, 1076, 675, 0.01
    v, r, psi, sa, ux, ax, sr, jx = (z[i] for i in range(2, NZ))
    front, rear = FzF0 - KZX * (ax - v * r), FzR0 + KZX * (ax - v * r)
    Fyf = tyre_force(ca.atan((v + la * r) / (ux + EP)) - sa, front, 278.2789450759981)
    Fyr = tyre_force(ca.atan((v - lb * r) / (ux + EP)), rear, 259.95925391136984)
    ay = (Fyf + Fyr) / m
    rate = ca.vertcat(
        ux * ca.cos(psi) - (v + la * r) * ca.sin(psi),
        ux * ca.sin(psi) + (v + la * r) * ca.cos(psi),
        ay - ux * r,
        (la * Fyf - lb * Fyr) / Izz,
        r, sr, ax, jx)  # fmt: skip
    loads = ca.vertcat(
        rear / 2 - KZYR * ay, rear / 2 + KZYR * ay, front / 2 - KZYF * ay, front / 2 + KZYF * ay)
    cubic = lambda c: ((c[0] * ux + c[1]) * ux + c[2]) * ux + c[3]
    return rate, loads, cubic(AX_MIN), cubic(AX_MAX)


# --- the OCP (section 3) ----------------------------------------------------------------------


class Ocp:
    """One of the OCP's forms as an NLP.

    Variables: x0s (8), then state and control node by node, then xfs (in range only), then tf.
    Parameters: X0p (8), absolute time of node 0, then x, y, a, b(, vx, vy) of each obstacle.
    `form` is "sx" (one scalar graph) or "map" (one function a node, mapped over the nodes).
    """

    def __init__(self, environment, planner, in_range=False, form="sx"):
        self.env = env = ENVIRONMENTS[environment]
        self.w_t, self.w_ce, self.moving = PLANNERS[planner]
        self.in_range, self.N = in_range, env["N"]
        self.numbers = 6 if self.moving else 4
        self.obstacles = len(env["obstacles"])
        self.nxu = NZ * (self.N + 1)
        self.n = 8 + self.nxu + (2 if in_range else 0) + 1
        sym = ca.SX.sym if form == "sx" else ca.MX.sym
        x, p = sym("x", self.n), sym("p", 9 + self.numbers * self.obstacles)
        self.nlp = {"x": x, "p": p, **self._functions(x, p, form)}
        self._bounds()

    def _node_functions(self):
        """At node 0, and at a later one at tau, with the rows each has."""
        env, N = self.env, self.N
        z, tf, start, tau = (ca.SX.sym(s, k) for s, k in
                             (("z", NZ), ("tf", 1), ("start", 2), ("tau", 1)))  # fmt: skip
        p = ca.SX.sym("p", 9 + self.numbers * self.obstacles)
        rate, loads, ax_min, ax_max = vehicle(z)
        xg, yg, psi_g = *env["goal"], math.pi / 2
        integrand = W_HAF * (math.sin(psi_g) * (z[X] - xg) - math.cos(psi_g) * (z[Y] - yg)) ** 2
        integrand += W_FZ * sum(ca.tanh(-(loads[i] - 1300) / 100) for i in (0, 1))
        if self.w_ce:
            integrand += self.w_ce * (W_SA * z[SA] ** 2 + W_SR * z[8] ** 2 + W_JX * z[9] ** 2)
        rows = [z[AX] - ax_min, ax_max - z[AX], loads - FZ_MIN]
        first = ca.Function("first", [z, tf], [rate * tf / N, integrand * tf / N,
                                              ca.vertcat(*rows)])  # fmt: skip
        margin = 2.5 + 1.5 * tau
        obstacle = ca.reshape(p[9:], self.numbers, self.obstacles)
        for i in range(self.obstacles):
            xo, yo, a, b = (obstacle[j, i] for j in range(4))
            if self.moving:
                t = p[8] + tau * tf
                xo, yo = xo + obstacle[4, i] * t, yo + obstacle[5, i] * t
            rows.append(((z[X] - xo) / (a + margin)) ** 2 + ((z[Y] - yo) / (b + margin)) ** 2 - 1)
        reach = env["L_range"] + env["kappa"]
        rows.append(reach**2 - (z[X] - start[0]) ** 2 - (z[Y] - start[1]) ** 2)
        later = ca.Function("later", [z, tf, start, tau, p],
                            [rate * tf / N, integrand * tf / N, ca.vertcat(*rows)])  # fmt: skip
        return first, later

    def _functions(self, x, p, form):
        env, N = self.env, self.N
        x0s, tf = x[:8], x[self.n - 1]
        z = ca.reshape(x[8 : 8 + self.nxu], NZ, N + 1)
        start, end = z[:2, 0], z[:2, N]
        first, later = self._node_functions()
        rate, cost, rows = ([value] for value in first(z[:, 0], tf))
        taus = [k / N for k in range(1, N + 1)]
        if form == "sx":
            for k, tau in enumerate(taus, 1):
                for of, value in zip((rate, cost, rows), later(z[:, k], tf, start, tau, p)):
                    of.append(value)
        else:
            mapped = later.map("nodes", "serial", N, [1, 2, 4], [])
            for of, value in zip((rate, cost, rows),
                                 mapped(z[:, 1:], tf, start, ca.DM(taus).T, p)):  # fmt: skip
                of += ca.horzsplit(value)

        xg, yg = env["goal"]
        square = lambda a: a[0] ** 2 + a[1] ** 2
        goal = ca.vertcat(xg, yg)
        f = sum(0.5 * (cost[k] + cost[k + 1]) for k in range(N))
        f += W_IC * ca.dot(ca.DM(W_S0), x0s)
        if self.w_t:
            f += self.w_t * tf

        gap = z[:NX, 0] - p[:8]
        blocks = [gap + x0s, x0s - gap]
        if self.in_range:
            xfs = x[self.n - 3 : self.n - 1]
            f += W_XF * (xfs[0] + xfs[1])
            ends = [end - goal + xfs, xfs - (end - goal)]
        else:
            f += W_G * square(end - goal) / (square(start - goal) + 0.01)
            inner, outer = env["L_range"] - env["kappa"], env["L_range"] + env["kappa"]
            ends = [square(end - start) - inner**2, outer**2 - square(end - start)]
        equations = 0
        for k in range(N + 1):  # rows in the order of the nodes
            blocks.append(rows[k])
            if k < N:
                blocks.append(z[:NX, k + 1] - z[:NX, k] - 0.5 * (rate[k] + rate[k + 1]))
                equations += NX
        blocks += ends
        g = ca.vertcat(*blocks)
        self.is_equation = np.zeros(g.numel(), dtype=bool)
        at = 0
        for i, block in enumerate(blocks):
            size = block.numel()
            if 2 <= i < 2 + 2 * N + 1 and (i - 2) % 2 == 1:
                self.is_equation[at : at + size] = True
            at += size
        assert self.is_equation.sum() == equations
        return {"f": f, "g": g}

    def _bounds(self):
        deg = math.pi / 180
        box = np.array([self.env["x_range"], (-INF, INF), (-INF, INF), (-INF, INF),
                        (-2 * math.pi, 2 * math.pi), (-30 * deg, 30 * deg), (0.01, 29),
                        (-INF, INF), (-5 * deg, 5 * deg), (-5, 5)])  # fmt: skip
        lbx, ubx = [-INF] * 8, list(X0_TOL)
        for _ in range(self.N + 1):
            lbx += list(box[:, 0])
            ubx += list(box[:, 1])
        if self.in_range:
            lbx += [-INF] * 2
            ubx += [XF_TOL] * 2
        self.lbx, self.ubx = np.array(lbx + [TF_MIN]), np.array(ubx + [TF_MAX])
        self.lbg = np.zeros(len(self.is_equation))
        self.ubg = np.where(self.is_equation, 0, INF)

    # --- numbers in and out ---
    def parameters(self, X0p, t0, t_start):
        o = self.env["obstacles"].copy()
        if not self.moving:
            o[:, :2] += o[:, 4:] * t0
        return np.concatenate([X0p, [t_start], o[:, : self.numbers].ravel()])

    def straight_on(self, X0p, floor):
        xg, yg = self.env["goal"]
        distance = math.hypot(X0p[X] - xg, X0p[Y] - yg)
        tf = min(max(min(self.env["L_range"], distance) / max(X0p[UX], 5), 1.01 * TF_MIN),
                 0.99 * TF_MAX)  # fmt: skip
        z = np.zeros((self.N + 1, NZ))
        for k in range(self.N + 1):
            z[k, :2] = X0p[:2] + k / self.N * tf * X0p[UX] * np.array(
                [math.cos(X0p[PSI]), math.sin(X0p[PSI])])  # fmt: skip
            z[k, [PSI, UX]] = X0p[PSI], X0p[UX]
        z[0, :NX] = X0p
        return self.with_slacks(z, tf, X0p, floor)

    def with_slacks(self, z, tf, X0p, floor):
        """X(0) within half its tolerance of X0p, slacks 2 mu / weight inside their rows."""
        inside = lambda room, weight: min(2 * floor / weight, room / 2)
        slacks, ends = [], []
        for i in range(NX):
            z[0, i] = min(max(z[0, i], X0p[i] - X0_TOL[i] / 2), X0p[i] + X0_TOL[i] / 2)
            gap = abs(z[0, i] - X0p[i])
            slacks.append(gap + inside(X0_TOL[i] - gap, W_IC * W_S0[i]))
        if self.in_range:
            for i in range(2):
                gap = abs(z[-1, i] - self.env["goal"][i])
                near = gap < XF_TOL
                ends.append(gap + inside(XF_TOL - gap, W_XF) if near else 0.99 * XF_TOL)
        return np.concatenate([slacks, z.ravel(), ends, [tf]])

    def variable_names(self):
        """In the words of the library, for the mapping of starts and answers."""
        names = [f"x0s_{s}" for s in STATES]
        for k in range(self.N + 1):
            names += [f"{s} at node {k}" for s in STATES + CONTROLS]
        return names + (["xfs_x", "xfs_y"] if self.in_range else []) + ["tf"]

    def row_names(self, obstacle_names):
        names = [f"initial {s} from {side}" for side in ("below", "above") for s in STATES]
        for k in range(self.N + 1):
            names += [f"ax above ax_min at node {k}", f"ax below ax_max at node {k}"]
            names += [f"wheel load Fz_{w} at node {k}" for w in ("rl", "rr", "fl", "fr")]
            if k > 0:
                names += [f"obstacle[{o}] at node {k}" for o in obstacle_names]
                names.append(f"LiDAR region at node {k}")
            if k < self.N:
                names += [f"defect 0 of {s} in interval {k}" for s in STATES]
        if self.in_range:
            return names + [f"goal {s} from {side}" for side in ("below", "above") for s in "xy"]
        return names + ["LiDAR edge, inner", "LiDAR edge, outer"]

    def plan(self, x):
        x = np.asarray(x).ravel()
        return x[8 : 8 + self.nxu].reshape(self.N + 1, NZ), x[-1]
