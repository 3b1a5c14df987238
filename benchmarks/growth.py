#!/usr/bin/env python3
"""How the time of an iteration grows with intervals, obstacles, phases and collocation points, into
docs/measured/growth.md and growth.svg.

    benchmarks/growth.py
"""

import json
import math

from contestants import build_ours, program, record_cycles, run_command
from levels import LEVELS
from measured import page_parser, stamp, write

SEED, CYCLES, REPEATS = 1, 60, 3
INTERVALS, OBSTACLES = (15, 30, 60, 120, 240, 480), (38, 100, 200, 400, 1000)
PHASES, POINTS = (1, 2, 4, 8), (3, 5, 8, 12, 20, 30)


class Curve:
    """Microseconds an iteration by size; `base`: what the sizes count, for the axis and the table."""

    def __init__(self, base, note, points):
        self.base, self.note, self.points = base, note, sorted(points.items())

    def exponent(self, first=0):
        """Slope of the logarithms, by least squares, of the points from `first` on."""
        logs = [(math.log(size), math.log(time)) for size, time in self.points[first:]]
        x, y = (sum(each) / len(logs) for each in zip(*logs))
        return sum((a - x) * (b - y) for a, b in logs) / sum((a - x) ** 2 for a, _ in logs)


# --- what is measured -----------------------------------------------------------------------------


def of_cycles(cycles, option, sizes):
    """Least over a few runs of the mean microseconds an iteration of solved cycles, by size."""
    least = {}
    command = [program("bench_solve"), "--environment", "E_C", "--cycles", str(cycles), "--backend",
               "interior_point", "--floor", str(LEVELS["floor"].floor), "--growth", f"--{option}",
               ",".join(map(str, sizes))]  # fmt: skip
    for _ in range(REPEATS):
        for entry in json.loads(run_command(command))["growth"]:
            good = [c for c in entry["cycles"] if c["status"] == "solved"]
            if good:
                time = 1e6 * sum(c["cpu_s"] for c in good) / sum(c["iterations"] for c in good)
                size = entry[option]
                least[size] = min(time, least.get(size, math.inf))
    return {size: time for size, time in least.items() if size in sizes}


def of_oscillators():
    """Entries of bench_growth."""
    command = [program("bench_growth"), "--N", "20", "--phases", ",".join(map(str, PHASES)),
               "--points", ",".join(map(str, POINTS))]  # fmt: skip
    return json.loads(run_command(command))


def curves(work):
    cycles = work / "E_C.cycles"
    record_cycles("E_C", cycles, CYCLES, 0, SEED)
    entries = of_oscillators()
    return [
        Curve("intervals", "E_C at the floor, 38 obstacles", of_cycles(cycles, "N", INTERVALS)),
        Curve("obstacles", "E_C at the floor, 15 intervals", of_cycles(cycles, "obstacles", OBSTACLES)),
        Curve("phases", "oscillators, 20 intervals of Hermite-Simpson in each",
              {e["phases"]: 1e6 * e["iteration_s"] for e in entries if e["scheme"] != "lgr" and e["N"] == 20}),
        Curve("LGR points", "oscillators, one phase of 4 intervals",
              {e["points"]: 1e6 * e["iteration_s"] for e in entries if e["scheme"] == "lgr"}),
    ]  # fmt: skip


# --- the figure -----------------------------------------------------------------------------------

WIDTH, HEIGHT, LEFT, TOP, GAP = 230, 190, 52, 34, 74  # of a panel [px]


def text_at(x, y, words, anchor="middle", size=11):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size}">{words}</text>'


def panel(curve, x0, y0):
    """Both axes logarithmic; the dashed line grows as the size does."""
    sizes, times = zip(*curve.points)
    low, high = math.log(sizes[0]), math.log(sizes[-1])
    bottom, top = math.log(min(times) / 1.3), math.log(max(times[-1], times[0] * sizes[-1] / sizes[0]) * 1.3)

    def place(size, time):
        return (x0 + WIDTH * (math.log(size) - low) / (high - low),
                y0 + HEIGHT * (1 - (math.log(time) - bottom) / (top - bottom)))  # fmt: skip

    parts = [f'<rect x="{x0}" y="{y0}" width="{WIDTH}" height="{HEIGHT}" fill="none" stroke="#888"/>',
             text_at(x0 + WIDTH / 2, y0 - 8, f"{curve.base}: exponent {curve.exponent():.2f}", size=12)]  # fmt: skip
    for size in sizes:
        parts.append(text_at(place(size, times[0])[0], y0 + HEIGHT + 15, f"{size:g}"))
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
    width, height = LEFT + 2 * WIDTH + GAP + 16, TOP + 2 * HEIGHT + GAP + 30
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
             f'height="{height}" font-family="Helvetica, Arial, sans-serif">',
             f'<rect width="{width}" height="{height}" fill="#fff"/>']  # fmt: skip
    for k, curve in enumerate(list_of_curves):
        parts += panel(curve, LEFT + k % 2 * (WIDTH + GAP), TOP + k // 2 * (HEIGHT + GAP - 14))
    return "\n".join([*parts, "</svg>"]) + "\n"


# --- the page -------------------------------------------------------------------------------------


def page(list_of_curves, stamped):
    text = ["# Growth", "", stamped,
            "Processor time of an iteration of the interior-point method, all of a solve counted, from the least of",
            f"{REPEATS} runs. In E_C, recorded cycles of P_D at the floor, each from the last one's plan, on other meshes or",
            "with further obstacles beside the road; the oscillators (`benchmarks/growth.cpp`) have free times,",
            "15 static parameters linked through all phases, an integral constraint and a periodic link.", "",
            "![Time of an iteration against size, both axes logarithmic; dashed: in proportion](growth.svg)", "",
            "| of | what | exponent over all | between the two largest | sizes: µs an iteration |",
            "|---|---|---|---|---|"]  # fmt: skip
    for curve in list_of_curves:
        sizes = ", ".join(f"{size}: {time:.0f}" for size, time in curve.points)
        text.append(f"| {curve.base} | {curve.note} | {curve.exponent():.2f} | {curve.exponent(-2):.2f} | {sizes} |")
    by_base = {curve.base: dict(curve.points) for curve in list_of_curves}
    n, o = by_base["intervals"], by_base["obstacles"]
    if 15 in n and 240 in n:
        text += ["", f"240 intervals take {n[240] / n[15]:.1f} times as long as 15."]
    if 38 in o and 1000 in o:
        each = 1e3 * (o[1000] - o[38]) / ((1000 - 38) * 16)
        text += [f"From 38 to 1000 obstacles a row, of one obstacle at one of the 16 nodes, takes {each:.0f} ns an iteration."]
    return "\n".join(text) + "\n"


def main():
    args = page_parser("growth", __doc__).parse_args()
    build_ours("record", "solve", "growth")
    args.work.mkdir(parents=True, exist_ok=True)
    found = curves(args.work)
    write(args.out.with_suffix(".svg"), figure(found))
    write(args.out, page(found, stamp("make growth", program("bench_solve"))))


if __name__ == "__main__":
    main()
