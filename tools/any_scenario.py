#!/usr/bin/env python3
"""Drives random valid scenarios, of all families, at any place, heading, speed and difficulty and with options drawn at
random, and writes to docs/measured/any-scenario.md how they end and what is at fault: ends without a drive, messages
that name no cause, and plans through an obstacle that do not say so. Standard library only.

    tools/any_scenario.py [--program build/slalom] [--drives 2000] [--jobs 2]
"""

import collections
import concurrent.futures
import json
import math
import os
import random
import re
import subprocess
from typing import NamedTuple

from first_sight import obstacles_of
from measured import command_of, page_parser, stamp, write
from random_scenarios import FAMILIES, TIMED_FAMILIES, make_scenarios
from sweeps import head, interval, row, rows_of

SEED = 11
DIFFICULTIES = (0.0, 0.35, 0.7, 1.0)
ALL_FAMILIES = FAMILIES + TIMED_FAMILIES
LONGEST = 300  # of one drive by the clock [s]

# What each setting is drawn from, by itself; the first is the likeliest.
OPTIONS = {
    "planner.N": (10, 6, 15, 25, 40),
    "planner.scheme": ("trapezoidal", "hermite_simpson", "backward_euler"),
    "planner.moving_avoidance": ("true", "false"),
    "planner.model": ("pacejka", "linear_tyre", "constant_speed", "kinematic"),
    "planner.obstacle_choice": ("all", "in_reach", "nearest"),
    "planner.obstacle_constraint": ("hard", "hard", "soft"),
    "planner.floor": (0.9, 0.1, 0),
    "planner.L_range": (50, 30, 90),
    "planner.between_nodes": ("by_shape", "report", "refine"),
    "planner.retry_sides": ("false", "true"),
    "loop.tex": (0.5, 0.1, 0.25, 1),
    "loop.latency": ("paper", "instant"),
    "loop.on_failure": ("stop", "last_plan", "best_iterate"),
    "sensing.delay": (0, 0.1),
    "loop.compensate_delay": ("false", "true"),
}
CHANGED = 4  # of these in a drive, on average
# A plan's rows stand at its nodes; between them it may be as deep in a margin as this before it says so.
TOLERANCE = 0.1  # of the two ways to find how deep a plan is [m]

HEAD = """# Any scenario

{stamp}
Scenarios of {families} families at difficulties {difficulties}, each turned by quarters and whole turns, moved by up to
10 000 km, started at 0 to 28 m/s and driven by one of P_A to P_E with about {changed} of {options} other settings drawn at
random (seed {seed}), for 15 s at the most. Of {count}, {refused} are refused before they are driven, with a message that names
the item, its value and the rule; the others are driven.

"""

# What is at fault, by kind: of which drives it is judged, and what it is.
NO_DRIVE, NO_CAUSE, UNREPORTED = "no drive", "no cause", "unreported"
KINDS = {
    NO_DRIVE: ("all that are not refused", f"no end within {LONGEST} s, or an end with an error and without a drive"),
    NO_CAUSE: ("drives that end as `not_optimal`", "the message does not say what was in the way of a plan"),
    UNREPORTED: ("drives with solved plans by P_A to P_D",
                 "a plan whose status is `solved` is deeper in an obstacle's margin, at its nodes or between, than"
                 f" `planner.passage_depth` and {TOLERANCE:g} m more"),
}


class Drive(NamedTuple):
    name: str
    planner: str
    settings: dict
    outcome: str
    judged: dict  # what is at fault, or nothing, for each kind that it is judged by

    def faults(self):
        return [fault for fault in self.judged.values() if fault]


# --- the scenarios ------------------------------------------------------------------------------


def moved(text, quarters, turns, dx, dy):
    """A resolved scenario turned about the origin and then moved."""
    def place(x, y):
        for _ in range(quarters % 4):
            x, y = -y, x
        return x, y

    def turn_line(line):
        section = "obstacle" if line.startswith("  - {") else line.split(":")[0]
        if section not in ("start", "goal", "region", "obstacle") or "{" not in line:
            return line
        numbers = {k: float(v) for k, v in re.findall(r"(\w+): ([-+.\d][-+.\deE]*)", line)}
        if section == "region":
            numbers = turned_box(numbers, place, dx, dy)
        else:
            numbers["x"], numbers["y"] = (v + d for v, d in zip(place(numbers["x"], numbers["y"]), (dx, dy)))
            if "psi" in numbers:
                numbers["psi"] += quarters * math.pi / 2 + (2 * math.pi * turns if section == "start" else 0)
            if section == "obstacle":
                numbers["vx"], numbers["vy"] = place(numbers["vx"], numbers["vy"])
                if quarters % 2:
                    numbers["a"], numbers["b"] = numbers["b"], numbers["a"]
        items = [f"{k}: {v!r}" for k, v in numbers.items()]
        name = re.search(r"name: \"[^\"]*\"", line)
        return line.split("{")[0] + "{" + ", ".join(([name.group(0)] if name else []) + items) + "}"

    return "\n".join(map(turn_line, text.splitlines())) + "\n"


def turned_box(sides, place, dx, dy):
    """The sides that a region has, turned and moved."""
    result = {}
    for name, value in sides.items():
        sign = 1 if name.endswith("max") else -1
        to = place(sign, 0) if name[0] == "x" else place(0, sign)  # the way the side faces
        at = place(value, 0) if name[0] == "x" else place(0, value)
        axis = 0 if abs(to[0]) > 0.5 else 1
        result["xy"[axis] + ("_max" if to[axis] > 0 else "_min")] = at[axis] + (dx, dy)[axis]
    return result


def drawn(file):
    """The text of a scenario's variant, the planner that drives it, and its settings."""
    dice = random.Random(f"{SEED} {file.stem} {file.parent.name}")
    quarters, turns = dice.randrange(4), dice.randrange(-2, 3)
    far = 10 ** dice.uniform(0, 7)
    text = moved(file.read_text(), quarters, turns, dice.uniform(-far, far), dice.uniform(-far, far))
    settings = {key: dice.choice(values[1:]) for key, values in OPTIONS.items() if dice.random() < CHANGED / len(OPTIONS)}
    settings["start.ux"] = round(dice.choice((0, 0.02, dice.uniform(0, 5), dice.uniform(5, 28))), 3)
    settings["loop.timeout"] = 15
    return text, "P_" + dice.choice("ABCDE"), settings


# --- the drives and what is at fault -------------------------------------------------------------


def drive(options, file):
    """How one variant ends."""
    text, planner, settings = drawn(file)
    name = f"{file.parent.name}-{file.stem}"
    scenario, out = options.work / "variants" / f"{name}.yaml", options.work / "drives" / name
    scenario.write_text(text)
    command = [options.program, "simulate", scenario, "--planner", planner, "--out", out, "--force", "--quiet"]
    for key, value in settings.items():
        command += ["--set", f"{key}={value}"]
    try:
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=LONGEST, check=False)
    except subprocess.TimeoutExpired:
        return Drive(name, planner, settings, "hangs", {NO_DRIVE: f"not done after {LONGEST} s"})
    if done.returncode != 0:
        return Drive(name, planner, settings, *without_a_drive(done))
    summary = json.loads((out / "summary.json").read_text())
    judged = {NO_DRIVE: ""} | unexplained(summary) | unreported(out, planner)
    for path in out.glob("*"):  # but for what a fault is looked at by
        if not any(judged.values()) and path.is_file():
            path.unlink()
    return Drive(name, planner, settings, summary["outcome"], judged)


def without_a_drive(done):
    """Outcome and judgement of a program that ended with an error: a scenario that cannot be is refused, as it is to
    be."""
    line = done.stderr.strip().splitlines()[-1] if done.stderr.strip() else "no message"
    if done.returncode == 2 and ", expected " in line:
        return "refused", {}
    return f"exit code {done.returncode}", {NO_DRIVE: line}


def unexplained(summary):
    """A drive for which no plan was left says what was in the way."""
    message = summary["message"]
    if summary["outcome"] != "not_optimal":
        return {}
    causes = ("; ", "no usable plan was left: ", "passes_through: ")
    return {NO_CAUSE: "" if any(cause in message for cause in causes) else "names no cause: " + message}


def unreported(out, planner):
    """Plans that are called solved and go through an obstacle, at their nodes or between: as soft rows let them, or
    where no row stands."""
    if planner == "P_E":
        return {}
    resolved = (out / "resolved.yaml").read_text()
    value = lambda key: float(re.search(rf"(?m)^  {key}: ([-+.\deE]+)$", resolved).group(1))  # noqa: E731
    kept = min(value("sm_start"), value("sm_end")) - value("passage_depth") - TOLERANCE
    held = re.search(r"(?m)^  moving_avoidance: (\w+)$", resolved).group(1) == "false"
    la = value("la")
    obstacles = obstacles_of(resolved).values()
    cycles = {c["cycle"]: c for c in rows_of(out / "cycles.csv")}
    plans = collections.defaultdict(list)
    for node in rows_of(out / "plans.csv"):
        if cycles[node["cycle"]]["status"] == "solved":
            plans[node["cycle"]].append({k: float(v) for k, v in node.items()})
    for index, nodes in plans.items():
        least = min((depth(nodes, o, float(cycles[index]["t0"]) if held else None, la) for o in obstacles),
                    default=math.inf)
        if least < kept:
            return {UNREPORTED: f"cycle {index}: solved, and {least:.2f} m from an obstacle's edge"}
    return {UNREPORTED: ""} if plans else {}


def depth(nodes, o, held, la):
    """The least distance of a plan from a circle's edge, from 40 points between each two nodes; an ellipse counts by
    its shorter axis, within which it certainly is."""
    least, radius = math.inf, min(o["a"], o["b"])
    for p, q in zip(nodes, nodes[1:]):
        h = q["t"] - p["t"]
        if h <= 0:
            return least
        (ax, ay), (bx, by) = velocity(p, la), velocity(q, la)
        for k in range(41):
            s = k / 40
            h00, h10, h01, h11 = (1 + 2 * s) * (1 - s)**2, s * (1 - s)**2, s * s * (3 - 2 * s), s * s * (s - 1)
            t = p["t"] + s * h if held is None else held
            x = h00 * p["x"] + h01 * q["x"] + h * (h10 * ax + h11 * bx) - o["x"] - o["vx"] * t
            y = h00 * p["y"] + h01 * q["y"] + h * (h10 * ay + h11 * by) - o["y"] - o["vy"] * t
            least = min(least, math.hypot(x, y) - radius)
    return least


def velocity(node, la):
    front, c, s = node["v"] + la * node["r"], math.cos(node["psi"]), math.sin(node["psi"])
    return node["ux"] * c - front * s, node["ux"] * s + front * c


# --- the page ------------------------------------------------------------------------------------


def page(drives, stamped):
    text = HEAD.format(stamp=stamped, families=len(ALL_FAMILIES), difficulties=", ".join(map(str, DIFFICULTIES)),
                       changed=CHANGED, options=len(OPTIONS), seed=SEED, count=len(drives),
                       refused=sum(d.outcome == "refused" for d in drives))
    outcomes = sorted({d.outcome for d in drives})
    text += head(["planner", "drives", *outcomes, "at fault"])
    for planner in sorted({d.planner for d in drives}):
        own = [d for d in drives if d.planner == planner]
        text += row([planner, len(own), *(sum(d.outcome == o for d in own) for o in outcomes), sum(bool(d.faults()) for d in own)])
    text += "\nAt fault, each kind of those that can be judged by it:\n\n"
    text += head(["kind", "what", "judged", "at fault", "of", "95 %"])
    for kind, (of, what) in KINDS.items():
        own = [d for d in drives if kind in d.judged]
        bad = sum(bool(d.judged[kind]) for d in own)
        share = "{:.4f}–{:.4f}".format(*interval(bad, len(own))) if own else "–"
        text += row([kind, what, of, bad, len(own), share])
    bad = [d for d in drives if d.faults()]
    for d in bad:
        changed = ", ".join(f"{k}={v}" for k, v in d.settings.items())
        text += f"\n- {d.name}, {d.planner}, {d.outcome}: {'; '.join(d.faults())} ({changed})"
    return text + ("\n" if bad else "")


def main():
    parser = page_parser("any-scenario", __doc__, keeps="leaves scenarios and the drives at fault there, and begins anew")
    parser.add_argument("--drives", type=int, default=2000, help="about so many, of all families and difficulties")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    count = math.ceil(options.drives / (len(ALL_FAMILIES) * len(DIFFICULTIES)))
    files = []
    for difficulty in DIFFICULTIES:
        folder = options.work / "scenarios" / f"{difficulty:g}"
        files += make_scenarios(options.program, folder, ALL_FAMILIES, count, SEED, difficulty)
    for name in ("variants", "drives"):
        (options.work / name).mkdir(parents=True, exist_ok=True)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        results = list(pool.map(lambda file: drive(options, file), files))
    write(options.out, page(results, stamp(command_of(parser, options, "any-scenario", "drives", "jobs"), options.program)))


if __name__ == "__main__":
    main()
