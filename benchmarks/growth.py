#!/usr/bin/env python3
"""How the time of an iteration grows with intervals, obstacles, phases, collocation points, controls and states, and
time and memory of whole solves with the latter two, into docs/measured/growth.md and growth.svg.

    benchmarks/growth.py
"""

import json
import math
import pathlib
import tempfile

from contestants import build_ours, program, record_cycles, run_command
from levels import LEVELS
from measured import page_parser, stamp, write
from robustness import text_at
from sweeps import head, row

SEED, CYCLES, REPEATS = 1, 60, 3
SOLVES, ITERATIONS = 5, 25  # of the oscillators, and of one solve at the most
INTERVALS, OBSTACLES = (15, 30, 60, 120, 240, 480), (38, 100, 200, 400, 1000)
PHASES, POINTS = (1, 2, 4, 8), (3, 5, 8, 12, 20, 30)
CONTROLS, STATES = (25, 50, 100, 200, 400), (25, 50, 100, 200)


class Curve:
    """Microseconds an iteration by size; `base`: what the sizes count, for the axis and the table; `rows`: of the problem
    of each size; `without`: a word on each size that has no time; `whole`: by size, what bench_growth says of a whole
    solve."""

    def __init__(self, base, note, points, rows=None, without=(), whole=None):
        self.base, self.note, self.points = base, note, sorted(points.items())
        self.rows, self.without, self.whole = rows or {}, without, whole or {}

    def exponent(self, first=0):
        """Slope of the logarithms, by least squares, of the points from `first` on."""
        logs = [(math.log(size), math.log(time)) for size, time in self.points[first:]]
        x, y = (sum(each) / len(logs) for each in zip(*logs))
        return sum((a - x) * (b - y) for a, b in logs) / sum((a - x) ** 2 for a, _ in logs)


# --- what is measured -----------------------------------------------------------------------------


def of_cycles(cycles, option, sizes):
    """Least over a few runs of the mean microseconds an iteration of solved cycles, and the rows, by size; and what is
    to be said of sizes at which none was solved."""
    least, rows = {}, {}
    command = [program("bench_solve"), "--environment", "E_C", "--cycles", str(cycles), "--backend",
               "interior_point", "--floor", str(LEVELS["floor"].floor), "--growth", f"--{option}",
               ",".join(map(str, sizes))]  # fmt: skip
    for _ in range(REPEATS):
        for entry in json.loads(run_command(command))["growth"]:
            good = [c for c in entry["cycles"] if c["status"] == "solved"]
            rows[entry[option]] = entry["rows"]
            if good:
                time = 1e6 * sum(c["cpu_s"] for c in good) / sum(c["iterations"] for c in good)
                size = entry[option]
                least[size] = min(time, least.get(size, math.inf))
    return least, rows, [f"{size} {option}: no cycle was solved" for size in sizes if size not in least]


def of_oscillators():
    """Entries of bench_growth."""
    command = [program("bench_growth"), "--N", "20", "--phases", ",".join(map(str, PHASES)),
               "--points", ",".join(map(str, POINTS)), "--solves", str(SOLVES),
               "--iterations", str(ITERATIONS)]  # fmt: skip
    return json.loads(run_command(command))


def timed(entries, field):
    """Microseconds an iteration by a field of the oscillators' entries, of solves that went as far as they might; and
    what is to be said of the others."""
    ended = {e[field]: e for e in entries if e["status"] in ("solved", "iteration_limit")}
    return ({size: 1e6 * e["iteration_s"] for size, e in ended.items()}, {},
            [f"{e[field]} {field}: {e['status']} after {e['iterations']} iterations" for e in entries
             if e[field] not in ended])  # fmt: skip


def of_whole_solves(option, sizes):
    """As timed(), with set-up and check in the time, and the entries by size: the fastest of a few processes of one solve
    each, whose peak of memory is that solve's."""
    runs = [[json.loads(run_command([program("bench_growth"), f"--{option}", str(size)]))[0] for _ in range(REPEATS)]
            for size in sizes]  # fmt: skip
    entries = [min(run, key=lambda entry: entry["whole_s"]) for run in runs]
    return *timed(entries, option), {entry[option]: entry for entry in entries}


def curves(work):
    cycles = work / "E_C.cycles"
    record_cycles("E_C", cycles, CYCLES, 0, SEED)
    entries = of_oscillators()
    return [
        Curve("intervals", "E_C at the floor, 38 obstacles", *of_cycles(cycles, "N", INTERVALS)),
        Curve("obstacles", "E_C at the floor, 15 intervals", *of_cycles(cycles, "obstacles", OBSTACLES)),
        Curve("phases", "oscillators, 20 intervals of Hermite-Simpson in each",
              *timed([e for e in entries if e["scheme"] != "lgr" and e["N"] == 20], "phases")),
        Curve("LGR points", "oscillators, one phase of 4 intervals",
              *timed([e for e in entries if e["scheme"] == "lgr"], "points")),
        Curve("controls", "a mass pushed by many forces, 40 intervals", *of_whole_solves("controls", CONTROLS)),
        Curve("states", "a rod of so many pieces, heated at one end, 40 intervals", *of_whole_solves("states", STATES)),
    ]  # fmt: skip


# --- the figure -----------------------------------------------------------------------------------

WIDTH, HEIGHT, LEFT, TOP, GAP = 230, 190, 52, 34, 74  # of a panel [px]


def panel(curve, x0, y0):
    """Both axes logarithmic; the dashed line grows as the size does."""
    sizes, times = zip(*curve.points)
    low, high = math.log(sizes[0]), math.log(sizes[-1])
    bottom, top = math.log(min(times) / 1.3), math.log(max(times[-1], times[0] * sizes[-1] / sizes[0]) * 1.3)

    def place(size, time):
        return (x0 + WIDTH * (math.log(size) - low) / (high - low),
                y0 + HEIGHT * (1 - (math.log(time) - bottom) / (top - bottom)))  # fmt: skip

    parts = [f'<rect x="{x0}" y="{y0}" width="{WIDTH}" height="{HEIGHT}" fill="none" stroke="#888"/>',
             text_at(x0 + WIDTH / 2, y0 - 8, f"{curve.base}: exponent {curve.exponent():.2f}")]  # fmt: skip
    for size in sizes:
        parts.append(text_at(place(size, times[0])[0], y0 + HEIGHT + 15, f"{size:g}", size=11))
    for power in range(-1, 6):
        for time in (10**power, 3 * 10**power):
            if bottom <= math.log(time) <= top:
                y = place(sizes[0], time)[1]
                parts.append(f'<line x1="{x0}" x2="{x0 + WIDTH}" y1="{y:.1f}" y2="{y:.1f}" stroke="#ddd"/>')
                parts.append(text_at(x0 - 5, y + 4, f"{time:g} µs", "end", 10))
    ends = [place(sizes[0], times[0]), place(sizes[-1], times[0] * sizes[-1] / sizes[0])]
    parts.append('<polyline fill="none" stroke="#999" stroke-dasharray="4 3" points="'
                 + " ".join(f"{x:.1f},{y:.1f}" for x, y in ends) + '"/>')  # fmt: skip
    line = [place(*each) for each in curve.points]
    parts.append('<polyline fill="none" stroke="#3b7dd8" stroke-width="2" points="'
                 + " ".join(f"{x:.1f},{y:.1f}" for x, y in line) + '"/>')  # fmt: skip
    parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="#3b7dd8"/>' for x, y in line]
    return parts


def figure(list_of_curves):
    lines = (len(list_of_curves) + 1) // 2
    width, height = LEFT + 2 * WIDTH + GAP + 16, TOP + lines * HEIGHT + (lines - 1) * (GAP - 14) + 44
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
             f'height="{height}" font-family="Helvetica, Arial, sans-serif">',
             f'<rect width="{width}" height="{height}" fill="#fff"/>']  # fmt: skip
    for k, curve in enumerate(list_of_curves):
        parts += panel(curve, LEFT + k % 2 * (WIDTH + GAP), TOP + k // 2 * (HEIGHT + GAP - 14))
    return "\n".join([*parts, "</svg>"]) + "\n"


# --- the page -------------------------------------------------------------------------------------


def whole_solves(list_of_curves):
    """A table of solves with all that belongs to them, or nothing."""
    if not list_of_curves:
        return ""
    text = "\nWhole solves by Hermite-Simpson: processor time, and the most memory of a process that does nothing else.\n\n"
    text += head(["of", "how many", "status", "iterations", "time", "memory"])
    for curve in list_of_curves:
        for size, entry in sorted(curve.whole.items()):
            text += row([curve.base, size, entry["status"], entry["iterations"], f"{entry['whole_s']:.2f} s",
                         f"{entry['peak_mib']:.0f} MiB"])  # fmt: skip
    return text


def page(list_of_curves, stamped):
    text = "\n".join([
        "# Growth", "", stamped,
        "Processor time of an iteration of the interior-point method. In E_C: recorded cycles of P_D at the floor, each",
        "from the last one's plan, on other meshes or with further obstacles beside the road; update, shift, solve and",
        f"check of the cycles that were solved, over their iterations, the least of {REPEATS} runs. The oscillators",
        "(`benchmarks/growth.cpp`) have free times, 15 static parameters linked through all phases, an integral",
        f"constraint and a periodic link; the solver alone, the least of {SOLVES} solves of up to {ITERATIONS} iterations. By",
        f"controls and states: whole solves with their set-up and check, over their iterations, the least of {REPEATS}.", "",
        "![Time of an iteration against size, both axes logarithmic; dashed: in proportion](growth.svg)", "", ""])  # fmt: skip
    text += head(["of", "what", "exponent over all", "between the two largest", "sizes: µs an iteration"])
    for curve in list_of_curves:
        sizes = ", ".join(f"{size}: {time:.0f}" for size, time in curve.points)
        text += row([curve.base, curve.note, f"{curve.exponent():.2f}", f"{curve.exponent(-2):.2f}", sizes])
    without = [word for curve in list_of_curves for word in curve.without]
    if without:
        text += f"\nWithout a time: {'; '.join(without)}.\n"
    text += whole_solves([curve for curve in list_of_curves if curve.whole])
    by_base = {curve.base: curve for curve in list_of_curves}
    n, o = dict(by_base["intervals"].points), dict(by_base["obstacles"].points)
    if 15 in n and 240 in n:
        text += f"\n240 intervals take {n[240] / n[15]:.1f} times as long as 15.\n"
    if 38 in o and 1000 in o:
        more = by_base["obstacles"].rows[1000] - by_base["obstacles"].rows[38]
        text += (f"From 38 to 1000 obstacles a row, of which each obstacle has {more / (1000 - 38):g}, takes "
                 f"{1e3 * (o[1000] - o[38]) / more:.0f} ns an iteration.\n")  # fmt: skip
    return text


def main():
    args = page_parser("growth", __doc__, keeps=False).parse_args()
    build_ours("record", "solve", "growth")
    with tempfile.TemporaryDirectory() as folder:
        found = curves(pathlib.Path(folder))
    write(args.out.with_suffix(".svg"), figure(found))
    write(args.out, page(found, stamp("make growth", program("bench_solve"))))


if __name__ == "__main__":
    main()
