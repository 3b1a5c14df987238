#!/usr/bin/env python3
"""Drives E_B and E_C by P_D and P_E with a plant or sensors other than the planner believes, one quantity at a
time, and writes docs/measured/sensitivity.md. Standard library only.

    tools/sensitivity.py [--program build/slalom] [--jobs 2]
"""

import collections
import itertools
import json
from typing import NamedTuple

from measured import command_of, page_parser, stamp, write
from sweeps import head, interval, row, swept
from verified_planner import PLANNERS, settings_of

STARTS = {"E_B": (200, 0), "E_C": (6, 0)}  # [m]
# Of the start along x and y [m]. P_E, whose drives take longer, has fewer.
MOVES = {"P_D": ((-0.3, -0.1, 0, 0.1, 0.3), (-0.3, 0, 0.3)), "P_E": ((-0.3, 0, 0.3), (-0.3, 0.3))}
TEXES = (0.1, 0.25, 0.5)  # [s]
DROP = 0.10  # the fall of the pass rate that is looked for


class Quantity(NamedTuple):
    key: str
    unit: str
    neutral: float
    below: tuple  # outwards from neutral
    above: tuple


QUANTITIES = (
    Quantity("plant.mass_factor", "1", 1, (0.9, 0.8, 0.7, 0.6), (1.1, 1.2, 1.4, 1.6)),
    Quantity("plant.friction_factor", "1", 1, (0.9, 0.8, 0.6, 0.4), (1.1, 1.2, 1.4, 1.7)),
    Quantity("plant.cornering_stiffness_factor", "1", 1, (0.9, 0.8, 0.7, 0.6), (1.1, 1.2, 1.4, 1.6)),
    Quantity("plant.cg_shift", "m", 0, (-0.05, -0.1, -0.2, -0.3), (0.05, 0.1, 0.2, 0.3)),
    Quantity("plant.actuator_delay", "s", 0, (), (0.02, 0.05, 0.1, 0.15, 0.2)),
    Quantity("sensing.delay", "s", 0, (), (0.02, 0.05, 0.1, 0.15, 0.2)),
    Quantity("sensing.position_noise", "m", 0, (), (0.05, 0.1, 0.2, 0.3, 0.5)),
    Quantity("sensing.heading_noise", "rad", 0, (), (0.0025, 0.005, 0.01, 0.02, 0.05)),
    Quantity("sensing.speed_noise", "m/s", 0, (), (0.05, 0.1, 0.2, 0.5, 1)),
    Quantity("sensing.yaw_rate_noise", "rad/s", 0, (), (0.01, 0.02, 0.05, 0.1, 0.2)),
    Quantity("sensing.obstacle_velocity_factor", "1", 1, (0.9, 0.8, 0.6, 0.4), (1.1, 1.2, 1.4, 1.6)),
    Quantity("sensing.obstacle_position_noise", "m", 0, (), (0.05, 0.1, 0.2, 0.3, 0.5)),
)


def points():
    """All neutral, then each quantity away from it: (key, value)."""
    yield None, None
    for q in QUANTITIES:
        for value in q.below + q.above:
            yield q.key, value


def study(environment, planner):
    """The sweep of one environment by one planner; each start has a seed of its own."""
    x, y = STARTS[environment]
    starts = [[round(x + dx, 6), round(y + dy, 6), seed]
              for seed, (dx, dy) in enumerate(itertools.product(*MOVES[planner]))]
    values = [[value if q.key == key else q.neutral for q in QUANTITIES] for key, value in points()]
    axes = [{"keys": [q.key for q in QUANTITIES], "values": values},
            {"key": "loop.tex", "values": list(TEXES)},
            {"keys": ["start.x", "start.y", "sensing.noise_seed"], "values": starts}]
    return json.dumps({"title": f"sensitivity of {planner} in {environment}", "scenario": environment,
                       "planners": [planner], "axes": axes, "set": settings_of(planner)}, indent=1)  # JSON is YAML


def sweep(options, environment, planner):
    options.work.mkdir(parents=True, exist_ok=True)
    name = f"{environment}-{planner}"
    file = options.work / f"{name}.yaml"
    file.write_text(study(environment, planner))
    return swept(options.program, file, options.work / name, "--jobs", str(options.jobs))


def point_of(trial):
    """The quantity that is not neutral in a trial, and its value."""
    for q in QUANTITIES:
        if float(trial[q.key]) != q.neutral:
            return q.key, float(trial[q.key])
    return None, None


def end_of(trial):
    """How a drive ended; which cone it hit does not count."""
    if trial["outcome"] != "crash":
        return trial["outcome"]
    return "crash " + ("cone" if trial["hit"].startswith("cone") else trial["hit"])


def limit(rates, base, drop=DROP):
    """Where a pass rate first falls below base - drop: `rates` are (value, rate) outwards from
    neutral; linear between neighbours. None when it does not."""
    for (v0, r0), (v1, r1) in itertools.pairwise(rates):
        if r1 < base - drop <= r0:
            return v0 + (v1 - v0) * (r0 - (base - drop)) / (r0 - r1)
    return None


def share(k, n):
    return "{} | {:.2f} | {:.2f}–{:.2f}".format(k, k / n, *interval(k, n))


class Drives:
    """The drives of one planner, counted."""

    def __init__(self, planner, trials):
        self.planner = planner
        self.trials = [t for t in trials if t["planner"] == planner]
        self.n = sum(point_of(t) == (None, None) for t in self.trials)  # at each value
        self.passed = collections.Counter(point_of(t) for t in self.trials if t["outcome"] == "goal")
        self.crashed = collections.Counter(point_of(t) for t in self.trials if t["outcome"] == "crash")
        self.base = self.passed[None, None] / self.n
        self.parts = {f"{e}, tex {tex:g}": [t for t in self.trials if t["scenario"] == e and float(t["loop.tex"]) == tex]
                      for e in STARTS for tex in TEXES}  # fmt: skip

    def rate(self, key, value):
        return self.passed[key, value] / self.n


def fall(drives, q, values):
    """How far a quantity may go on one side before the pass rate has fallen so far."""
    if not values:
        return "–"
    rates = [(q.neutral, drives.base)] + [(v, drives.rate(q.key, v)) for v in values]
    at = limit(rates, drives.base)
    if at is None:
        return f"not to {values[-1]:g} (lowest rate {min(rate for _, rate in rates):.2f})"
    return f"{at:.2f}" if q.neutral else f"{at:.2g}"


def first_crash(drives, q, values):
    """The first value on one side at which a drive crashes, and the one before it."""
    if not values:
        return "–"
    counts = [(q.neutral, drives.crashed[None, None])] + [(v, drives.crashed[q.key, v]) for v in values]
    before = None
    for value, count in counts:
        if count:
            return f"{value:g} ({count} of {drives.n}; " + ("neutral)" if before is None else f"none at {before:g})")
        before = value
    return f"none to {values[-1]:g}"


def sides_table(every, cell):
    """Both sides of each quantity by each planner."""
    text = head(["quantity", "unit", "neutral", *(f"{d.planner} {side}" for d in every for side in ("below", "above")),
                 "tried"])
    for q in QUANTITIES:
        tried = ", ".join(f"{v:g}" for v in (*reversed(q.below), *q.above))
        text += row([f"`{q.key}`", q.unit, f"{q.neutral:g}",
                     *(cell(d, q, values) for d in every for values in (q.below, q.above)), tried])
    return text


def margins_table(every):
    """How near to an end the drives are that are all as believed."""
    text = head(["all as believed", "arrive", "least clearance [m]", "to", "least wheel load [N]"])
    for drives in every:
        for name, part in drives.parts.items():
            own = [t for t in part if point_of(t) == (None, None)]
            goal = [t for t in own if t["outcome"] == "goal"]
            cells = ["–"] * 3
            if goal:
                clear = sorted(float(t["least_clearance_m"]) for t in goal)
                cells = [f"{clear[0]:.2f}–{clear[-1]:.2f}", ", ".join(sorted({t["least_clearance_obstacle"] for t in goal})),
                         f"{min(float(t['least_wheel_load_N']) for t in goal):.0f}"]
            text += row([f"{drives.planner}, {name}", f"{len(goal)}/{len(own)}", *cells])
    return text


def rates_table(drives):
    text = head(["quantity", "value", "arrive", "share", "95 %", "crash", *drives.parts, "most of the others end"])
    for key, value in points():
        ends = collections.Counter(end_of(t) for t in drives.trials
                                   if point_of(t) == (key, value) and t["outcome"] != "goal")
        parts = []
        for part in drives.parts.values():
            mine = [t for t in part if point_of(t) == (key, value)]
            parts.append(f"{sum(t['outcome'] == 'goal' for t in mine)}/{len(mine)}")
        worst = "{} ({})".format(*ends.most_common(1)[0]) if ends else "–"
        name = [f"`{key}`", f"{value:g}"] if key else ["all neutral", ""]
        text += row([*name, share(drives.passed[key, value], drives.n), drives.crashed[key, value], *parts, worst])
    return text


HEAD = """# Sensitivity to what is not as believed

{stamp}
A planner believes the scenario's vehicle, what it is told of its state, and what it is told of
its obstacles. The plant and the sensors differ from that here, one quantity at a time
([formulation.md](../formulation.md), section 4, "What is believed, and what is"; keys in
[scenario-reference.md](../scenario-reference.md)). Two errors at once are not tried.

Drives are of E_B and E_C, tex {texes} s, each start with a seed of its own for noise. A drive passes where it
arrives. All that is not said here is by default.

"""

FALL = """
## How far each may go before arrivals fall

The value at which the pass rate has fallen by {drop:.0f} points, linear between the values tried; where it
falls more than once, the first. The 95 % interval of a share is up to {widths}, and
a limit is no more precise than the distance between the values tried.

"""

FIRST = """
## How far each may go before the first crash

The first value tried at which a drive crashes, going out from the neutral one.

"""

MARGINS = """
## What the drives have to spare

Clearance is to obstacles grown by 2 m, below which it is a crash; a wheel lifts below 100 N.

"""


def driven(drives):
    """What was driven by a planner, and how much of it passes when all is as believed."""
    moves = [", ".join(f"{v:g}" for v in values) for values in MOVES[drives.planner]]
    settings = ", ".join(f"`{key}: {value}`" for key, value in settings_of(drives.planner).items())
    base = drives.passed[None, None]
    return (f"- {drives.planner}: {drives.n} drives at each value, starts moved by {moves[0]} m in x and {moves[1]} m in y"
            + (f", with {settings}" if settings else "")
            + f". Of the {drives.n}, {base} pass when all is as believed ("
            + "{:.2f}, 95 % {:.2f}–{:.2f}).\n".format(drives.base, *interval(base, drives.n)))


def columns(trials):
    """The drives of one environment, tex and value, which differ in their start alone."""
    found = collections.defaultdict(list)
    for t in trials:
        found[t["scenario"], t["loop.tex"], point_of(t)].append(t)
    return found.values()


def findings(drives):
    """What the tables show, in numbers alone."""
    def of(own):
        return f"{sum(t['outcome'] == 'goal' for t in own)} of {len(own)}"

    def sides(wanted):
        """Sides of quantities, `wanted` of the first rate away from neutral and of the least one."""
        found = []
        for q in QUANTITIES:
            for name, values in (("below", q.below), ("above", q.above)):
                rates = [drives.rate(q.key, v) for v in values]
                if rates and wanted(rates[0], min(rates)):
                    found.append(f"`{q.key}` {name}")
        return ", ".join(found) or "none"

    def off(part):
        return [t for t in part if point_of(t) != (None, None)]
    level = drives.base - DROP
    every = columns(drives.trials)
    alike = [column for column in every if len({t["outcome"] == "goal" for t in column}) == 1]
    unsolved = "; ".join(f"{name}: {sum(t['outcome'] == 'not_optimal' for t in part)}" for name, part in drives.parts.items())
    return f"""
### {drives.planner}

- With one quantity off, drives arrive in: {"; ".join(f"{name}: {of(off(part))}" for name, part in drives.parts.items())}.
- With one quantity off, {sum(t["outcome"] == "crash" for t in off(drives.trials))} of {len(off(drives.trials))} drives crash.
- The rate falls by {100 * DROP:.0f} points at the nearest value tried already: {sides(lambda first, _: first < level)}.
- It falls so far at no value tried: {sides(lambda _, least: least >= level)}.
- Intervals take drives for independent. The starts of one environment, tex and value all end alike, arriving or
  not, in {len(alike)} of {len(every)} such sets.
- A cycle without a plan ends a drive (`loop.on_failure: stop`). Drives that end so: {unsolved}.
"""


def width(drives):
    low, high = interval(drives.n // 2, drives.n)
    return f"±{(high - low) / 2:.2f} wide with {drives.n} drives"


def page(trials, stamped):
    every = [Drives(planner, trials) for planner in PLANNERS]
    text = HEAD.format(texes=", ".join(f"{tex:g}" for tex in TEXES), stamp=stamped) + "".join(map(driven, every))
    text += FALL.format(drop=100 * DROP, widths=" and ".join(map(width, every))) + sides_table(every, fall)
    text += FIRST + sides_table(every, first_crash) + MARGINS + margins_table(every)
    text += "\n## What they show\n" + "".join(map(findings, every)) + "\n## Every value\n"
    return text + "".join(f"\n### By {d.planner}\n\n" + rates_table(d) for d in every)


def main():
    parser = page_parser("sensitivity", __doc__)
    parser.add_argument("--jobs", type=int, default=2, help="worker processes")
    options = parser.parse_args()
    trials = [trial for planner in PLANNERS for environment in STARTS for trial in sweep(options, environment, planner)]
    write(options.out, page(trials, stamp(command_of(parser, options, "sensitivity", "jobs"), options.program)))


if __name__ == "__main__":
    main()
