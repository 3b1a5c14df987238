#!/usr/bin/env python3
"""One long cold solve with the goal in range, hard and soft obstacles: docs/long-solves.md.

The paper's earlier work solved such problems once, offline, by backward Euler with MATLAB and Ipopt,
and prints the times. Here: E_B's three moving obstacles, and seventeen seeded ones, LiDAR range 200 m
so that the goal is in it, planner P_D without a barrier floor; by Slalom (`slalom plan`) and by
CasADi with its Ipopt (planner_casadi.py), the same mesh, scheme and start.

usage: long_solves.py --program build/slalom --python PYTHON_WITH_CASADI [--out DOC] [--N 200]
"""

import argparse
import json
import random
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SEED, REACH, WEIGHT, RUNS = 17, 200.0, 1000.0, 5
MATLAB = {(3, "hard"): 44.4, (17, "hard"): 193, (3, "soft"): 110, (17, "soft"): 2190}
E_B = [(205, 57, 5, -2, 0), (180, 75, 4, -1, 1), (200, 63, 2, -0.5, 6)]


def seventeen():
    """Moving circles x, y, r, vx, vy between start and goal, with room about both."""
    draw = random.Random(SEED)
    circles = []
    while len(circles) < 17:
        x, y, r = draw.uniform(150, 250), draw.uniform(30, 105), draw.uniform(1, 4)
        clear = all((x - a) ** 2 + (y - b) ** 2 > (r + c + 4) ** 2 for a, b, c, _, _ in circles)
        if clear:
            circles.append((round(x, 1), round(y, 1), round(r, 1), round(draw.uniform(-2, 2), 1),
                            round(draw.uniform(-2, 2), 1)))
    return circles


def scenario(circles):
    """E_B with these obstacles."""
    rows = "".join(f"  - {{name: O{i}, x: {x}, y: {y}, r: {r}, vx: {vx}, vy: {vy}}}\n"
                   for i, (x, y, r, vx, vy) in enumerate(circles, 1))
    return ("name: long\ntitle: one long solve\nvehicle: hmmwv\n"
            f"planner: {{base: P_D, L_range: {REACH:g}, kappa: 5}}\n"
            "start: {x: 200, y: 0, psi_deg: 90, ux: 17}\n"
            "goal: {x: 200, y: 125, psi_deg: 90, sigma: 15}\n"
            f"obstacles:\n{rows}loop: {{tex: 0.5}}\n")


def ours(program, circles, kind, intervals):
    """Median solve time [s], cost, iterations, solved."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "long.yaml"
        path.write_text(scenario(circles))
        command = [program, "plan", str(path), "--json"]
        for setting in (f"N={intervals}", "scheme=backward_euler", "floor=0",
                        f"obstacle_constraint={kind}", f"w_obstacle={WEIGHT}"):
            command += ["--set", "planner." + setting]
        runs = []
        for _ in range(RUNS):
            done = subprocess.run(command, capture_output=True, text=True, check=True)
            runs.append(json.loads(done.stdout))
    return {"s": statistics.median(r["solve_time_s"] for r in runs), "cost": runs[0]["cost"],
            "iterations": runs[0]["iterations"], "solved": runs[0]["solved"]}


def peer(circles, kind, intervals):
    """The same by CasADi and Ipopt, in this interpreter."""
    sys.path.insert(0, str(ROOT / "benchmarks"))
    import numpy as np  # noqa: PLC0415
    from levels import LEVELS  # noqa: PLC0415
    from peer_ipopt import Solver  # noqa: PLC0415
    from planner_casadi import Ocp, _circles, _environment  # noqa: PLC0415

    environment = _environment(_circles(*circles), (200, 0), (200, 125), intervals, REACH, 5, 15)
    ocp = Ocp(environment, "P_D", True, "map", "backward_euler",
              WEIGHT if kind == "soft" else None)
    level = next(each for each in LEVELS.values() if each.floor == 0 and each.tol <= 1e-6)
    solver = Solver(ocp, level, more={"max_iter": 3000})
    X0p = environment["start"].copy()
    X0p[1] = 8.5
    start = ocp.straight_on(X0p, 0.9)
    times = []
    for _ in range(3):
        answer = solver.solve(start, ocp.parameters(X0p, 0.0))
        times.append(answer[-1]["t_wall_total"])
    result, stats = answer[0], answer[-1]
    return {"s": statistics.median(times), "cost": float(result["f"]),
            "iterations": stats["iter_count"], "solved": bool(stats["success"]),
            "numpy": np.__version__}


def page(rows, intervals):
    """The text of docs/long-solves.md."""
    lines = [
        "# One long solve, hard and soft obstacles", "",
        "Made by `benchmarks/long_solves.py`, which says how. One cold solve to 1e-6 with the goal",
        f"in range, {intervals} intervals of backward Euler; soft: {WEIGHT:g} a second for each",
        "obstacle row's shortfall (l1). MATLAB's times are the paper's, of its authors' machine and",
        "mesh: they say what such a solve was taken to cost, no more.", "",
        "| obstacles | constraint | MATLAB + Ipopt (paper) | CasADi + Ipopt, here | Slalom, here |"
        " ratio | cost: CasADi, Slalom |", "|---|---|---|---|---|---|---|"]
    for (count, kind), a, b in rows:
        def cell(r):
            mark = "" if r["solved"] else ", not solved"
            return f"{r['s']:.3g} s ({r['iterations']} iterations{mark})"

        lines.append(f"| {count} | {kind} | {MATLAB[count, kind]} s | {cell(b)} | {cell(a)} | "
                     f"{b['s'] / a['s']:.1f} | {b['cost']:.4f}, {a['cost']:.4f} |")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(ROOT / "build/slalom"))
    parser.add_argument("--python", default=sys.executable)
    parser.add_argument("--out", default=str(ROOT / "docs/long-solves.md"))
    parser.add_argument("--N", type=int, default=200)
    parser.add_argument("--peer", nargs=2, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    sets = {3: E_B, 17: seventeen()}
    if arguments.peer:
        print(json.dumps(peer(sets[int(arguments.peer[0])], arguments.peer[1], arguments.N)))
        return
    rows = []
    for count, kind in MATLAB:
        a = ours(arguments.program, sets[count], kind, arguments.N)
        done = subprocess.run([arguments.python, __file__, "--N", str(arguments.N), "--peer",
                               str(count), kind], capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(done.stderr)
        b = json.loads(done.stdout.strip().splitlines()[-1])
        rows.append(((count, kind), a, b))
        print(count, kind, a, b, flush=True)
    Path(arguments.out).write_text(page(rows, arguments.N))


if __name__ == "__main__":
    main()
