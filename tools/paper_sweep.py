#!/usr/bin/env python3
"""Writes docs/paper-sweep.md: the paper's sweep on both grids, and with one thing changed at a time,
beside what the paper got. Standard library only.

    tools/paper_sweep.py --program build/slalom [--work run]

Sweeps go on where they stopped, in --work.
"""

import argparse
import math
import pathlib

from sweeps import fisher, head, row, setting, swept
from verdict_data import ROOT, Sweep, of, paper_counts, paper_points, passes

GRIDS = {"paper": ("study", -40), "paper-printed": ("printed", -20)}
# One thing changed at a time, on the grid to -40 m/s: name, settings, what it asks.
VARIANTS = (
    ("floor-0.8", {"planner.floor": 0.8}, "barrier floor .8"),
    ("floor-1", {"planner.floor": 1}, "barrier floor 1.0"),
    ("margin-1.5", {"loop.sm_crash": 1.5}, "crash margin 1.5 m instead of 2"),
    ("margin-1", {"loop.sm_crash": 1}, "crash margin 1 m"),
    ("nodes-30", {"planner.N": 30}, "N 30 instead of 15"),
    ("range-130", {"planner.L_range": 130, "planner.N": 22}, "L_range 130 m instead of 90, N 22"),
)

HEAD = """<!-- Written by tools/paper_sweep.py (`make paper-sweep`). -->
# The paper's sweep

E_C, 20 execution horizons from .01 to 1 s, 20 speeds of O2, P_C and P_D: 800 drives. `make study` runs it
into run/study/ with its page, on which a click opens each drive. The speeds go to -40 m/s, which the
paper's figures show, or to -20 m/s, as its text says ([formulation.md](formulation.md), section 5). Solve
times are CPU time; failing solves count, the warm-up does not, and no deadline ends a solve.

"""


def p_value(counts):
    (a, m), (b, n) = counts
    return f"{fisher(a, m - a, b, n - b):.1e}"


def counts_table(grids):
    text = head(["grid", "P_C at the goal", "P_D at the goal", "ratio", "Fisher's p"])
    printed = paper_counts()
    pairs = [(f"to {least} m/s", [(passes(s.of(p)), len(s.of(p))) for p in ("P_C", "P_D")])
             for s, least in grids]
    pairs.append(("the paper's, from its counts", [printed["P_C"], printed["P_D"]]))
    for name, counts in pairs:
        (a, m), (b, n) = counts
        text += row([name, f"{a} of {m}", f"{b} of {n}", f"× {b / n / (a / m):.2f}", p_value(counts)])
    return text


def horizon_table(sweep, least):
    text = f"\nO2 at up to {-least} m/s:\n\n" + head(
        ["tex [s]", "P_C: POS", "RTF, CPU", "RTF, wall", "P_D: POS", "RTF, CPU", "RTF, wall", "paper: P_D"])
    points = [p for p in paper_points() if p["speed"] == -least]
    for tex in sweep.texs:
        cells = [f"{tex:.3f}"]
        for planner in ("P_C", "P_D"):
            (rtf, pos), (wall, _) = sweep.rtf(planner, tex), sweep.rtf(planner, tex, measure="max_wall")
            cells += [f"{pos:.2f}", f"{rtf:.3g}", f"{wall:.3g}"]
        near = [p for p in points if abs(p["tex"] - tex) < 0.003]
        cells.append(f"POS {near[0]['pos']:.2f}, RTF below 1" if near else "")
        text += row(cells)
    greatest = max(sweep.rtf(p, tex)[0] for p in ("P_C", "P_D") for tex in sweep.texs)
    return text + f"\nThe greatest real-time factor by CPU time is {greatest:.2g}.\n"


def slower_table(sweep):
    text = "\nWith slower O2 alone, at tex .687 s:\n\n" + head(
        ["O2 at up to", "P_D at the goal", "RTF, CPU", "paper: POS, RTF"])
    tex = sweep.nearest_tex(0.687)
    for point in paper_points():
        if "rtf" not in point:
            continue
        own = [t for t in sweep.of("P_D") if t["tex"] == tex and t["speed"] <= point["speed"] + 0.06]
        text += row([f"{point['speed']:g} m/s", of(own), f"{sweep.rtf('P_D', tex, point['speed'] + 0.06)[0]:.3g}",
                     f"{point['pos']:g}, {point['rtf']:g}"])
    return text


def causes(sweep):
    text = "\n## How they end\n\n" + head(["", "at the goal", "crash into O2", "into O1 or a cone", "no plan", "else"])
    for planner in ("P_C", "P_D"):
        for name, tex in (("tex up to .5 s", (0, 0.5)), ("above", (0.5, math.inf))):
            own = sweep.of(planner, tex)
            crash = [t for t in own if t["outcome"] == "crash"]
            o2 = sum(t["hit"] == "O2" for t in crash)
            none = sum(t["outcome"] == "not_optimal" for t in own)
            text += row([f"{planner}, {name}", of(own), o2, len(crash) - o2, none,
                         len(own) - passes(own) - len(crash) - none])
    return text


def variants_table(base, variants):
    text = head(["P_D on the grid to -40 m/s", "at the goal", "tex up to .5 s", "above", "fastest O2 passed [m/s]"])
    for name, sweep in [("as it is", base), *variants]:
        own = sweep.of("P_D")
        fastest = max((t["speed"] for t in own if t["passed"]), default=math.nan)
        text += row([name, of(own), of(sweep.of("P_D", (0, 0.5))), of(sweep.of("P_D", (0.5, math.inf))),
                     f"{fastest:.1f}"])
    return text


def reasons(base, variants):
    by_name = dict(variants)
    margin, tight = by_name["crash margin 1.5 m instead of 2"], by_name["crash margin 1 m"]
    printed = paper_counts()
    floors = [by_name["barrier floor .8"], base, by_name["barrier floor 1.0"]]
    longer, nodes = by_name["L_range 130 m instead of 90, N 22"], by_name["N 30 instead of 15"]

    def fast(sweep):
        return sweep.of("P_D", speed=(24, 39))

    def most(sweep):
        return max((t["speed"] for t in sweep.of("P_D") if t["passed"]), default=math.nan)
    return ("\n## Why ours differ from the paper's\n\n" + variants_table(base, variants) + f"""
- **P_C** arrives in {of(base.of('P_C'))}, the paper's in {printed['P_C'][0]}: it avoids O2 where it stands at
  planning, so that it arrives only where O2 is slow or plans are renewed often. Every drive of both that
  arrives stands with its least clearance on the page of the sweep.
- **P_D at short horizons** (up to .5 s) arrives in {of(base.of('P_D', (0, 0.5)))}. Up to tex .32 s it
  passes O2 at up to {most(base):.0f} m/s; the paper's text says 21.1 m/s. Beyond, no plan is found once O2 comes into
  reach: within L_range (90 m) there are about 90 / (25 + {most(base):.0f}) = {90 / (25 + most(base)):.1f} s to move 8 m aside. More nodes or a longer
  range do not change that for O2 at 25 to 38 m/s ({of(fast(nodes))} and {of(fast(longer))} arrive). At 40 m/s O2 has passed before the
  vehicle needs its lane, where that is seen in time: {of(nodes.of('P_D', speed=(39, 41)))} arrive with N 30, {of(longer.of('P_D', speed=(39, 41)))} with L_range 130 m,
  which costs more elsewhere than it brings. A cold start from the straight-on guess at the cycle that finds no plan
  was tried, too: at 35 to 40 m/s it plans for two or three seconds more, and no drive arrives.
- **P_D at long horizons** (above .5 s) is where the counts part: {of(base.of('P_D', (0.5, math.inf)))}; the paper prints 9 of 20 at
  .687 s and 5 of 20 at .792 s. Many of these drives graze O2: constraints hold at nodes, at 26 m/s 6 m apart on
  a circle of 8.5 m, between which a straight path comes 6²/(8·8.5) = .5 m nearer, all that a plan's first
  nodes have beyond the crash check's 2 m. With 1.5 m there {of(margin.of('P_D', (0.5, math.inf)))} arrive, with 1 m
  {of(tight.of('P_D', (0.5, math.inf)))}; over all horizons 1.5 m gives {of(margin.of('P_D'))}. How the paper's check was made is not said.
- **The barrier floor** moves the counts: {', '.join(f"{passes(s.of('P_C'))} and {passes(s.of('P_D'))}" for s in floors)} at floors .8, .9 and 1.0. The
  independent reference of the formulation, at floor .8 on 12 of the 20 tex, passes 9 and 61 of 240: shares of
  {9 / 240:.3f} and {61 / 240:.3f}, ours at that floor {passes(floors[0].of('P_C')) / len(floors[0].of('P_C')):.3f} and {passes(floors[0].of('P_D')) / len(floors[0].of('P_D')):.3f}.
- **The real-time factor** is another machine's and another solver's: the paper's P_D is below 1 at two tex alone.
""")


def sweep(program, study, out):
    swept(program, study, out)
    return Sweep(out)


def variant(program, work, name, settings):
    study = work / f"{name}.yaml"
    text = (ROOT / "config/studies/paper.yaml").read_text()
    study.write_text(text.replace("title:", f"set: {setting(settings)}\ntitle:", 1))
    return sweep(program, study, work / name)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default="build/slalom")
    parser.add_argument("--work", type=pathlib.Path, default=ROOT / "run")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "docs/paper-sweep.md")
    options = parser.parse_args()
    work = options.work / "variants"
    work.mkdir(parents=True, exist_ok=True)
    grids = [(sweep(options.program, study, options.work / folder), least)
             for study, (folder, least) in GRIDS.items()]
    base = grids[0][0]
    variants = [(words, variant(options.program, work, name, settings)) for name, settings, words in VARIANTS]
    options.out.write_text(HEAD + counts_table(grids) + "\n## Real-time factor and probability of safety\n"
                           + "".join(horizon_table(*grid) for grid in grids) + slower_table(base)
                           + causes(base) + reasons(base, variants))


if __name__ == "__main__":
    main()
