#!/usr/bin/env python3
"""Drives E_B and E_C with a plant or sensors other than the planner believes, one quantity at a time,
and writes docs/measured/sensitivity.md. Standard library only.

    tools/sensitivity.py [--program build/slalom] [--jobs 2]
"""

import collections
import itertools
import json
from typing import NamedTuple

from measured import page_parser, stamp, write
from sweeps import interval, swept

STARTS = {"E_B": (200, 0), "E_C": (6, 0)}  # [m]
MOVES_X = (-0.3, -0.1, 0, 0.1, 0.3)  # [m]
MOVES_Y = (-0.3, 0, 0.3)
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


def study(environment):
    """The sweep of one environment; each start has a seed of its own."""
    x, y = STARTS[environment]
    starts = [[round(x + dx, 6), round(y + dy, 6), seed]
              for seed, (dx, dy) in enumerate(itertools.product(MOVES_X, MOVES_Y))]
    values = [[value if q.key == key else q.neutral for q in QUANTITIES] for key, value in points()]
    axes = [{"keys": [q.key for q in QUANTITIES], "values": values},
            {"key": "loop.tex", "values": list(TEXES)},
            {"keys": ["start.x", "start.y", "sensing.noise_seed"], "values": starts}]
    return json.dumps({"title": f"sensitivity of P_D in {environment}", "scenario": environment,
                       "planners": ["P_D"], "axes": axes}, indent=1)  # JSON is YAML


def sweep(options, environment):
    options.work.mkdir(parents=True, exist_ok=True)
    file, folder = options.work / f"{environment}.yaml", options.work / environment
    file.write_text(study(environment))
    return swept(options.program, file, folder, "--jobs", str(options.jobs))


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


def side(q, values, counts, n):
    """The cell of one side of a quantity in the first table."""
    if not values:
        return "–"
    base = counts[None, None] / n
    rates = [(q.neutral, base)] + [(v, counts[q.key, v] / n) for v in values]
    at = limit(rates, base)
    lowest = min(rate for _, rate in rates)
    if at is None:
        return f"not to {values[-1]:g} (lowest rate {lowest:.2f})"
    return f"{at:.2f}" if q.neutral else f"{at:.2g}"


def limits_table(counts, n):
    text = ("| quantity | unit | neutral | below | above | tried |\n"
            "|---|---|---|---|---|---|\n")
    for q in QUANTITIES:
        tried = ", ".join(f"{v:g}" for v in (*reversed(q.below), *q.above))
        text += (f"| `{q.key}` | {q.unit} | {q.neutral:g} | {side(q, q.below, counts, n)} | "
                 f"{side(q, q.above, counts, n)} | {tried} |\n")
    return text


def margins_table(trials, by_part):
    """How near to an end the drives are that are all as believed."""
    text = ("| all as believed | arrive | least clearance [m] | to | least wheel load [N] |\n"
            "|---|---|---|---|---|\n")
    for name, part in by_part.items():
        own = [t for t in trials if point_of(t) == (None, None) and part(t)]
        goal = [t for t in own if t["outcome"] == "goal"]
        clear = sorted(float(t["least_clearance_m"]) for t in goal)
        nearest = ", ".join(sorted({t["least_clearance_obstacle"] for t in goal}))
        load = min(float(t["least_wheel_load_N"]) for t in goal)
        text += (f"| {name} | {len(goal)}/{len(own)} | {clear[0]:.2f}–{clear[-1]:.2f} | {nearest} | "
                 f"{load:.0f} |\n")
    return text


def rates_table(trials, counts, n, by_part):
    text = ("| quantity | value | arrive | share | 95 % | " + " | ".join(by_part) +
            " | most of the others end |\n|---|---|---|---|---|" + "---|" * len(by_part) + "---|\n")
    for key, value in points():
        own = [t for t in trials if point_of(t) == (key, value)]
        ends = collections.Counter(end_of(t) for t in own if t["outcome"] != "goal")
        parts = []
        for part in by_part.values():
            mine = [t for t in own if part(t)]
            parts.append(f"{sum(t['outcome'] == 'goal' for t in mine)}/{len(mine)}")
        worst = "{} ({})".format(*ends.most_common(1)[0]) if ends else "–"
        name = f"`{key}` | {value:g}" if key else "all neutral | "
        text += f"| {name} | {share(counts[key, value], n)} | {' | '.join(parts)} | {worst} |\n"
    return text


HEAD = """# Sensitivity to what is not as believed

{stamp}
The planner P_D believes the scenario's vehicle, what it is told of its state, and what it is told of
its obstacles. The plant and the sensors differ from that here, one quantity at a time
([formulation.md](../formulation.md), section 4, "What is believed, and what is"; keys in
[scenario-reference.md](../scenario-reference.md)).

{n} drives at each value: E_B and E_C, tex {texes} s, starts moved by {dx} m
in x and {dy} m in y, each start with a seed of its own for noise. All else is by default. A drive
passes where it arrives. Of the {n}, {base} pass when all is as believed ({share}). Two errors at
once are not tried.

## How far each may go

The value at which the pass rate has fallen by {drop:.0f} points, linear between the values tried; where it
falls more than once, the first. With {n} drives the 95 % interval of a share is up to ±{width:.2f}
wide, and a limit is no more precise than the distance between the values tried.

"""


MARGINS = """
## What the drives have to spare

Clearance is to obstacles grown by 2 m, below which it is a crash; a wheel lifts below 100 N.

"""


def columns(trials):
    """The drives of one environment, tex and value, which differ in their start alone."""
    found = collections.defaultdict(list)
    for t in trials:
        found[t["scenario"], t["loop.tex"], point_of(t)].append(t)
    return found.values()


def findings(trials, counts, n, by_part):
    """What the tables show, in numbers alone."""
    def of(own):
        return f"{sum(t['outcome'] == 'goal' for t in own)} of {len(own)}"

    def sides(wanted):
        """Sides of quantities, `wanted` of the first rate away from neutral and of the least one."""
        found = []
        for q in QUANTITIES:
            for name, values in (("below", q.below), ("above", q.above)):
                rates = [counts[q.key, v] / n for v in values]
                if rates and wanted(rates[0], min(rates)):
                    found.append(f"`{q.key}` {name}")
        return ", ".join(found) or "none"
    level = counts[None, None] / n - DROP
    off = [t for t in trials if point_of(t) != (None, None)]
    alike = [column for column in columns(trials) if len({t["outcome"] == "goal" for t in column}) == 1]
    unsolved = {name: sum(t["outcome"] == "not_optimal" for t in trials if part(t)) for name, part in by_part.items()}
    parts = "; ".join(f"{name}: {of([t for t in off if part(t)])}" for name, part in by_part.items())
    return f"""
## What they show

- With one quantity off, drives arrive in: {parts}.
- The rate falls by {100 * DROP:.0f} points at the nearest value tried already: {sides(lambda first, _: first < level)}.
- It falls so far at no value tried: {sides(lambda _, least: least >= level)}.
- Intervals take drives for independent. The starts of one environment, tex and value all end alike, arriving or
  not, in {len(alike)} of {len(columns(trials))} such sets.
- One unsolved problem ends a drive (`loop.on_failure: stop`). Drives that end so: {
    "; ".join(f"{name}: {count}" for name, count in unsolved.items())}.
"""


def page(trials, stamped):
    n = sum(point_of(t) == (None, None) for t in trials)
    counts = collections.Counter(point_of(t) for t in trials if t["outcome"] == "goal")
    base = counts[None, None]
    low, high = interval(n // 2, n)
    by_part = {f"{e}, tex {tex:g}": lambda t, e=e, tex=tex: t["scenario"] == e and float(t["loop.tex"]) == tex
               for e in STARTS for tex in TEXES}
    listed = lambda values: ", ".join(f"{v:g}" for v in values)  # noqa: E731
    text = HEAD.format(n=n, base=base, drop=100 * DROP, width=(high - low) / 2, texes=listed(TEXES),
                       dx=listed(MOVES_X), dy=listed(MOVES_Y), stamp=stamped,
                       share="{:.2f}, 95 % {:.2f}–{:.2f}".format(base / n, *interval(base, n)))
    text += limits_table(counts, n) + MARGINS + margins_table(trials, by_part)
    text += findings(trials, counts, n, by_part) + "\n## Every value\n\n"
    return text + rates_table(trials, counts, n, by_part)


def main():
    parser = page_parser("sensitivity", __doc__)
    parser.add_argument("--jobs", type=int, default=2, help="worker processes")
    options = parser.parse_args()
    trials = [trial for environment in STARTS for trial in sweep(options, environment)]
    write(options.out, page(trials, stamp("make sensitivity", options.program)))


if __name__ == "__main__":
    main()
