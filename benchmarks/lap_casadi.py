"""The fastest lap of a road, in CasADi with its Ipopt: the same statement on the same mesh from the same start.

    python lap_casadi.py CASE.json OUT.json [--rule monotone|adaptive] [--limit S]

CASE.json is bench_lap's: numbers of road, vehicle, mesh and guess, and our answer. Everything between them is
stated anew from docs/laps.md, docs/formulation.md (sections 1 and 2) and docs/vehicles.md: the vehicle, the motion
along the line, limits, edges, cost, and Hermite-Simpson collocation with the middles of intervals as points of
their own. It is evaluated at our answer, too.

Ipopt with MUMPS and exact Hessian; the functions of a point are compiled (gcc -O3 -march=native) and mapped over
the points. Of the barrier rules, monotone takes fewer iterations here. Times are processor time.
"""

import argparse
import json
import math
import time

import casadi as ca
import numpy as np

NX, NZ, ROAD = 7, 9, 5
N, XI, V, R, SA, UX, AX, SR, JX = range(NZ)
NAMES = ("n", "xi", "v", "r", "sa", "ux", "ax", "sr", "jx")
OVER_DRIVE, ALL_FRICTION, ROUNDING, SLOW = 0.1, 0.05, 0.2, 1
SLIP_SHARE = 0.8
COMPILED = {"jit": True, "compiler": "shell", "jit_options": {"flags": ["-O3", "-march=native"]}}


# --- the vehicle ------------------------------------------------------------------------------


def lateral_force(p, alpha, Fz, peak):
    """Pacejka's formula without shifts; `peak` is what the longitudinal force leaves of D."""
    D = peak * ((p["PDY2"] / p["FZ0"] * Fz + p["PDY1"] - p["PDY2"]) * Fz)
    B = p["PKY1"] * p["FZ0"] * ca.sin(2 * ca.atan(Fz / (p["PKY2"] * p["FZ0"]))) / (p["PCY1"] * D)
    E = p["PEY2"] / p["FZ0"] * Fz + p["PEY1"] - p["PEY2"]
    return D * ca.sin(p["PCY1"] * ca.atan(B * alpha - E * (B * alpha - ca.atan(B * alpha))))


def left_by_friction(p, Fx, Fz):
    """The friction ellipse with its corner rounded (docs/vehicles.md); 1 where Fx = 0."""
    w = 1 - (Fx / (p["PDX1"] * Fz)) ** 2
    rounded = (w + ca.sqrt(w * w + ALL_FRICTION**2)) / 2
    return ca.sqrt(rounded / ((1 + math.sqrt(1 + ALL_FRICTION**2)) / 2))


def lesser(a, b):
    return (a + b - ca.sqrt((a - b) ** 2 + ROUNDING**2)) / 2


def friction_limit(p, forward, front):
    """The acceleration at which the first axle uses friction_share of its friction."""
    mu = p["friction_share"] * p["PDX1"]
    axles = ((front, p["FzF0"], forward * p["KZX"]), (1 - front, p["FzR0"], -forward * p["KZX"]))
    return min(mu * load / (part * p["m"] + mu * transfer) if part * p["m"] + mu * transfer > 0 else math.inf
               for part, load, transfer in axles)  # fmt: skip


def acceleration_limits(p, ux):
    def cubic(c):
        return ((c[0] * ux + c[1]) * ux + c[2]) * ux + c[3]

    most = lesser(cubic(p["ax_max"]), p["power"] / p["m"] / ca.sqrt(ux * ux + SLOW**2))
    return -lesser(-cubic(p["ax_min"]), friction_limit(p, -1, p["brake_front"])), lesser(
        most, friction_limit(p, 1, p["drive_front"]))  # fmt: skip


def forces(p, v, r, sa, ux, ax):
    """Lateral force of front and rear axle, and their loads [N]."""
    a = ax - v * r
    loads = p["FzF0"] - p["KZX"] * a, p["FzR0"] + p["KZX"] * a
    sign = a / ca.sqrt(a * a + OVER_DRIVE**2)
    front = (p["drive_front"] + p["brake_front"]) / 2 + (p["drive_front"] - p["brake_front"]) / 2 * sign
    driving = p["m"] * a * front, p["m"] * a * (1 - front)
    slips = (ca.atan((v + p["la"] * r) / (ux + p["EP"])) - sa, ca.atan((v - p["lb"] * r) / (ux + p["EP"])))
    return [lateral_force(p, slip, Fz, left_by_friction(p, Fx, Fz))
            for slip, Fz, Fx in zip(slips, loads, driving)], loads  # fmt: skip


def check_vehicle(p):
    """What this statement leaves away."""
    if p["tyre"] != "combined_slip" or p["tyre_asymmetry"] or not (p["power"] > 0 and p["friction_share"] > 0):
        raise SystemExit("lap_casadi: states vehicles of combined slip without asymmetry, with limits of power and "
                         "friction, alone")  # fmt: skip


# --- the lap ----------------------------------------------------------------------------------


def point_function(p, w_control):
    """At a point: rates along the line, the cost's integrand, the time's, and the rows, each >= 0."""
    z, road = ca.SX.sym("z", NZ), ca.SX.sym("road", ROAD)
    n, xi, v, r, sa, ux, ax, sr, jx = (z[i] for i in range(NZ))
    kappa, left, left_slope, right, right_slope = (road[i] for i in range(ROAD))
    (Fyf, Fyr), (FzF, FzR) = forces(p, v, r, sa, ux, ax)
    front = v + p["la"] * r
    progress = (ux * ca.cos(xi) - front * ca.sin(xi)) / (1 - n * kappa)
    lateral = (Fyf + Fyr) / p["m"]
    in_time = ca.vertcat(ux * ca.sin(xi) + front * ca.cos(xi), r - kappa * progress, lateral - ux * r,
                         (p["la"] * Fyf - p["lb"] * Fyr) / p["Izz"], sr, ax, jx)  # fmt: skip
    sr_max = math.radians(p["sr_max_deg"])
    effort = (sr / sr_max) ** 2 + (jx / p["jx_max"]) ** 2
    slowness = 1 / progress
    rows = limits(p, z, (FzF, FzR), lateral) + edges(p, n, xi, kappa, (left, left_slope), (right, right_slope))
    return ca.Function("point", [z, road], [in_time / progress, (1 + w_control * effort) * slowness, slowness,
                                            ca.vertcat(*rows)], COMPILED)  # fmt: skip


def limits(p, z, axle_loads, lateral):
    """Acceleration [m/s^2], wheel loads [kN], and the rear axle's slip [.1 rad]."""
    FzF, FzR = axle_loads
    least, most = acceleration_limits(p, z[UX])
    wheels = [load / 2 + side * share * lateral for load, share in ((FzR, p["KZYR"]), (FzF, p["KZYF"]))
              for side in (-1, 1)]  # fmt: skip
    B = -2 * p["PKY1"] / p["PKY2"] / (p["PCY1"] * p["PDY1"])  # of a tyre whose coefficients know no load
    if p["PDY2"] or p["PKY2"] < 100:
        B = -p["PKY1"] * p["FZ0"] * math.sin(2 * math.atan(p["FzR0"] / (p["PKY2"] * p["FZ0"]))) / (
            p["PCY1"] * p["PDY1"] * p["FzR0"])  # fmt: skip
    peak = SLIP_SHARE * math.tan(math.pi / (2 * p["PCY1"])) / B
    slip = (z[V] - p["lb"] * z[R]) / z[UX]
    return ([z[AX] - least, most - z[AX]] + [(wheel - p["Fz_min"]) / 1000 for wheel in wheels]
            + [10 * (peak - slip), 10 * (peak + slip)])  # fmt: skip


def edges(p, n, xi, kappa, left, right):
    """How far each corner of the body is from the edge on its side [m]."""
    rows = []
    for ahead in (p["front_overhang"], p["front_overhang"] - p["length"]):
        for side, (width, slope) in ((1, left), (-1, right)):
            aside = side * p["width"] / 2
            along = ahead * ca.cos(xi) - aside * ca.sin(xi)
            offset = n + ahead * ca.sin(xi) + aside * ca.cos(xi) - kappa * along**2 / 2
            rows.append(width + slope * along - side * offset)
    return rows


def statement(case):
    """The NLP in variables of the guess's size, its bounds and its start, and a function of the time."""
    p, count = case["vehicle"], 2 * case["intervals"] + 1
    check_vehicle(p)
    guess = np.array(case["guess"]).T
    bounds = [case["bounds"][name] for name in NAMES]
    low = np.array([-math.inf if b[0] is None else b[0] for b in bounds])
    high = np.array([math.inf if b[1] is None else b[1] for b in bounds])
    size = np.abs(guess).max(axis=1)
    size = np.where(size > 0, size, np.where(np.isfinite(high), high, 1))
    scaled = ca.MX.sym("w", NZ, count)
    z = ca.diag(ca.DM(size)) @ scaled
    rate, cost, slowness, rows = point_function(p, case["w_control"]).map("points", "serial", count, [], [])(
        z, ca.DM(np.array(case["road"]).T))  # fmt: skip
    h = case["length"] / case["intervals"]
    x = z[:NX, :]
    begin, middle, end = (slice(0, count - 2, 2), slice(1, count - 1, 2), slice(2, count, 2))
    defects = ca.vertcat(
        x[:, middle] - (x[:, begin] + x[:, end]) / 2 - h / 8 * (rate[:, begin] - rate[:, end]),
        x[:, end] - x[:, begin] - h / 6 * (rate[:, begin] + 4 * rate[:, middle] + rate[:, end]))  # fmt: skip
    defects = ca.diag(ca.DM(np.tile(1 / size[:NX], 2))) @ defects
    closed = (x[:, -1] - x[:, 0]) / ca.DM(size[:NX])

    def integral(values):
        return h / 6 * ca.sum2(values[0, begin] + 4 * values[0, middle] + values[0, end])

    g = ca.vertcat(ca.vec(defects), closed, ca.vec(rows[:, 1:]))
    equations = defects.numel() + NX
    ubg = np.full(g.numel(), math.inf)
    ubg[:equations] = 0
    w = ca.vec(scaled)
    flat = [np.tile(v / size, count) for v in (low, high)] + [(guess.T / size).ravel()]
    lap_time = ca.Function("lap_time", [w], [integral(slowness)])
    return {"x": w, "f": integral(cost), "g": g}, *flat, np.zeros(g.numel()), ubg, lap_time, size


def evaluated(case, points):
    """Cost, time and the worst violation of bounds and rows of this statement at given points."""
    nlp, low, high, _, lbg, ubg, lap_time, size = statement(case)
    w = (np.array(points) / size).ravel()
    f, g = ca.Function("nlp", [nlp["x"]], [nlp["f"], nlp["g"]])(w)
    g = np.array(g).ravel()
    violation = max(np.max(lbg - g), np.max(g - ubg), np.max(low - w), np.max(w - high))
    return {"cost": float(f), "time_s": float(lap_time(w)), "violation": float(violation)}


def options(args):
    chosen = {"print_level": 0, "sb": "yes", "linear_solver": "mumps", "tol": 1e-8, "max_iter": 1500,
              "max_cpu_time": args.limit, "mu_strategy": args.rule, "bound_relax_factor": 0}  # fmt: skip
    return {"print_time": False, "record_time": True, "calc_lam_p": False} | {
        "ipopt." + key: value for key, value in chosen.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("case")
    parser.add_argument("out")
    parser.add_argument("--rule", choices=["monotone", "adaptive"], default="monotone")
    parser.add_argument("--limit", type=float, default=600, help="of one solve [s]")
    args = parser.parse_args()
    with open(args.case) as file:
        case = json.load(file)
    at_ours = evaluated(case["statement"], case["ours"]["points"])
    began = time.process_time()
    nlp, lbx, ubx, start, lbg, ubg, lap_time, _ = statement(case["statement"])
    solver = ca.nlpsol("solver", "ipopt", nlp, options(args))
    setup_s = time.process_time() - began
    answer = solver(x0=start, lbx=lbx, ubx=ubx, lbg=lbg, ubg=ubg)
    stats = solver.stats()
    result = {
        "ours_here": at_ours, "casadi": ca.__version__, "solved": bool(stats["success"]),
        "status": stats["return_status"], "iterations": int(stats["iter_count"]), "cost": float(answer["f"]),
        "time_s": float(lap_time(answer["x"])), "cpu_s": stats["t_proc_total"], "setup_s": setup_s,
        "variables": int(start.size), "rows": int(lbg.size),
    }  # fmt: skip
    with open(args.out, "w") as file:
        json.dump(result, file)


if __name__ == "__main__":
    main()
