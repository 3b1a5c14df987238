#!/usr/bin/env python3
"""Discs, superellipses, a separating line and the dual of the distance on the same problems, into
docs/measured/shape-forms.md.

    benchmarks/shape_forms.py [--seeds 6] [--runs 5] [--intervals 40]

Builds bench_shape_forms in build/bench, or $SLALOM_BENCH_BUILD, which solves them (shape_forms.cpp). Standard library only.
"""

import json
import statistics
import subprocess

from contestants import build_ours, program
from measured import command_of, page_parser, stamp, write
from sweeps import head, row

FLOOR = 0.001  # in the objective's unit
CLOSE = 0.08  # beyond the gap asked for, by the median: these forms are compared at an equal gap [m]

SIZES = ("seeds", "runs", "intervals")

TOP = """# Forms of the rows that keep a rectangle off rectangles

{stamp}
The same problems with each form of row, solved by the native solver: a vehicle of {length} m by {width} m (kinematic
single-track model, least time with little of steering rate and acceleration) keeps {asked} m from rectangles at the points of
{intervals} intervals of Hermite-Simpson, {seeds} draws of each scene (`benchmarks/shape_scenes.hpp`):

- **parked row**: four cars at a slant, on one side.
- **gap**: between two lorries at a slant, .7 m to 1.4 m wider than the vehicle, with no way around.
- **oncoming**: a lorry that comes at us and turns.
- **street**: eight cars on each side, of which two stand far out.

Forms (`benchmarks/shape_rows.cpp`):

- **discs-E**: circles that cover each rectangle and stick out by E at the most, as many as that takes, and a smooth
  distance of the vehicle's rectangle (`benchmarks/smooth_box.hpp`).
- **superellipse-P**: the corners of each of two rectangles stay out of a superellipse of exponent P about the other.
- **axes**: how far they are apart along the axes of both, in one smooth number: what the planner has
  ([keeping-off.md](../keeping-off.md)).
- **line**: a line between vehicle and rectangle at each point; its angle and its offset are variables, and the corners of
  both are on their sides of it.
- **dual**: the distance by its dual, as in Zhang, Liniger and Borrelli's OBCA: eight variables for each rectangle.

*Solved* counts answers from a way that passes on the right side, and from a straight line. The *gap* is the exact one
between the rectangles, along the answer and between its points: least of all draws, and median. *Cost* is the median of how
much the answer costs above the least that any form has for the same draw. Times are processor time, medians of up to
{runs} runs, fewer where they take longer than .5 s together, and of the draws that were solved, transcription left out: *first*
from the way, *again* from that answer with its multipliers, begun .1 m to the left and .1 m/s slower. *At a floor* of {floor}
the solve ends at that central point, as the planner's do.

"""


def middle(values, factor=1.0):
    return factor * statistics.median(values) if values else None


def number(value, digits):
    return "" if value is None else f"{value:.{digits}f}"


class Results:
    """Of one floor, by scene, form and start."""

    def __init__(self, lines):
        self.all = [json.loads(line) for line in lines]
        self.least = {}
        for r in self.of(solved=True):
            key = r["scene"], r["seed"]
            self.least[key] = min(self.least.get(key, r["cost"]), r["cost"])

    def of(self, **wanted):
        return [r for r in self.all if all(r[name] == value for name, value in wanted.items())]

    def names(self, field):
        return list(dict.fromkeys(r[field] for r in self.all))

    def above(self, results):
        """By what share answers cost more than the least known."""
        return [r["cost"] / self.least[r["scene"], r["seed"]] - 1 for r in results]


def table(exact, floored, scene):
    text = f"## {scene[0].upper()}{scene[1:]}\n\n" + head([
        "form", "rows, variables at a point", "solved: way, straight", "gap: least, median [m]", "cost",
        "first: iterations, ms", "again: iterations, ms", "at a floor: gap [m]", "first, again [ms]"])  # fmt: skip
    for form in exact.names("form"):
        every = exact.of(scene=scene, form=form, start="way")
        straight = exact.of(scene=scene, form=form, start="straight")
        good = [r for r in every if r["solved"]]
        warm = [r for r in good if r["warm_solved"]]
        ends = [r for r in floored.of(scene=scene, form=form, start="way") if r["solved"]]
        ends_warm = [r for r in ends if r["warm_solved"]]
        of = lambda field, results, factor=1.0: middle([r[field] for r in results], factor)  # noqa: E731
        text += row([
            f"`{form}`", f"{every[0]['rows']}, {every[0]['variables']}",
            f"{len(good)}, {sum(r['solved'] for r in straight)} of {len(every)}",
            f"{min(r['gap'] for r in good):.3f}, {of('gap', good):.3f}" if good else "",
            f"+{100 * middle(exact.above(good)):.1f}%" if good else "",
            f"{of('iterations', good):.0f}, {of('solve_s', good, 1e3):.1f}" if good else "",
            f"{of('warm_iterations', warm):.0f}, {of('warm_s', warm, 1e3):.1f}" if warm else "",
            number(of("gap", ends), 3),
            f"{of('solve_s', ends, 1e3):.1f}, {number(of('warm_s', ends_warm, 1e3), 1)}" if ends else ""])  # fmt: skip
    return text + "\n"


def ratio(results, form, other, start, field, solved):
    """Median of how many times as long `form` takes as `other`, over what both have solved."""
    theirs = {(r["scene"], r["seed"]): r for r in results.of(form=other, start=start) if r[solved]}
    found = [r[field] / theirs[r["scene"], r["seed"]][field]
             for r in results.of(form=form, start=start) if r[solved] and (r["scene"], r["seed"]) in theirs]  # fmt: skip
    return f"× {statistics.median(found):.2f} ({len(found)})" if found else ""


def equal_gap(exact, floored, yardstick):
    """The forms whose answers keep no more than CLOSE beyond what is asked, and what they keep it at."""
    text = (f"## At an equal gap\n\nForms whose gap is by the median at most {CLOSE} m beyond what is asked in each scene\n"
            f"that they solve. Times are medians of the ratio to `{yardstick}`'s on the same draw, with the number of draws "
            "that both have solved.\n\n") + head([
                "form", "solved: way, straight", "first, from a way", "first, straight", "again", "at a floor: first",
                "again, at a floor"])  # fmt: skip
    for form in exact.names("form"):
        gaps = [[r["gap"] - r["asked"] for r in exact.of(scene=scene, form=form, solved=True)]
                for scene in exact.names("scene")]  # fmt: skip
        if not any(gaps) or any(statistics.median(g) > CLOSE for g in gaps if g):
            continue
        way, straight = (exact.of(form=form, start=start) for start in ("way", "straight"))
        times = [(exact, "way", "solve_s", "solved"), (exact, "straight", "solve_s", "solved"),
                 (exact, "way", "warm_s", "warm_solved"), (floored, "way", "solve_s", "solved"),
                 (floored, "way", "warm_s", "warm_solved")]  # fmt: skip
        text += row([f"`{form}`", f"{sum(r['solved'] for r in way)}, {sum(r['solved'] for r in straight)} of {len(way)}",
                     *(ratio(results, form, yardstick, *what) for results, *what in times)])  # fmt: skip
    return text


def page(exact, floored, head_line, options):
    one = {name: exact.all[0][name] for name in ("asked", "length", "width")}
    given = {name: getattr(options, name) for name in SIZES}
    text = TOP.format(stamp=head_line, floor=FLOOR, **one, **given)
    for scene in exact.names("scene"):
        text += table(exact, floored, scene)
    return text + equal_gap(exact, floored, "line")


def main():
    parser = page_parser("shape-forms", __doc__, keeps=False)
    parser.add_argument("--seeds", type=int, default=6)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--intervals", type=int, default=40)
    options = parser.parse_args()
    build_ours("shape_forms")
    given = [f"--{name}={getattr(options, name)}" for name in SIZES]
    bench = program("bench_shape_forms")
    found = [Results(subprocess.run([bench, f"--floor={floor}", *given], check=True, capture_output=True,
                                    text=True).stdout.splitlines())
             for floor in (0, FLOOR)]  # fmt: skip
    write(options.out, page(*found, stamp(command_of(parser, options, "shape-forms", *SIZES), bench), options))


if __name__ == "__main__":
    main()
