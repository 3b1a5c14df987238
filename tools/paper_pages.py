#!/usr/bin/env python3
"""Writes pages of docs/measured/ from what `slalom reproduce` evaluates: results, paper-index, verdicts and
paper-sweep. Every number and verdict on them is the program's. Standard library only.

    tools/paper_pages.py PAGE... [--program build/slalom] [--work FOLDER] [--repeats 9]

Sweeps stand in --work and go on where they stopped: verdicts and paper-index need the paper's on both grids,
paper-sweep also those with one thing changed.
"""

import fnmatch
import json
import pathlib
import shutil
import subprocess
import tempfile

from measured import FOLDER, ROOT, command_of, page_parser, stamp, write
from sweeps import ended, setting, swept
from sweeps import table as plain_table

GRIDS = {"paper": "study", "paper-printed": "printed"}  # study, its folder
# One thing changed at a time, on the first grid: name, settings, words.
VARIANTS = (
    ("floor-0.8", {"planner.floor": 0.8}, "barrier floor .8"),
    ("floor-1", {"planner.floor": 1}, "barrier floor 1.0"),
    ("margin-1.5", {"loop.sm_crash": 1.5}, "crash margin 1.5 m instead of 2"),
    ("margin-1", {"loop.sm_crash": 1}, "crash margin 1 m"),
    ("nodes-30", {"planner.N": 30}, "N 30 instead of 15"),
    ("range-130", {"planner.L_range": 130, "planner.N": 22}, "L_range 130 m instead of 90, N 22"),
)
# Of the reproduction's figures, those that are kept, as far as they are there: of a crash, if there is one.
KEPT = ("E_A-figure.svg", "E_B.svg", "E_C.svg", "E_C_crash*.svg", "E_C_dynamics.svg", "E_C-range-50_crash*.svg",
        "E_C-no-cones_path.svg", "cases.svg")
# And of single drives: the file in the reproduction's folder, its name in figures/, what it shows.
OF_DRIVES = (("E_C/P_D/figures/path.svg", "E_C-P_D.svg", "E_C with P_D"),)
TERMS = ("steering_angle", "steering_rate", "jerk", "total")


def table(columns, rows):
    return plain_table(columns, ([str(cell).replace("|", "\\|") for cell in cells] for cells in rows))


def digits(value, form):
    return "–" if value is None else f"{value:{form}}"


# --- results ------------------------------------------------------------------------------------


def drive_rows(drives):
    for one in drives:
        end, printed = one["end"], one["printed"]
        yield (one["folder"], ended(one), f"{one['time_s']:.3f}", digits(one["goal_time_s"], ".3f"),
               f"({end['x_m']:.2f}, {end['y_m']:.2f})", f"{end['ux_mps']:.2f}",
               f"{abs(round(one['least_clearance_m'], 3)):.3f}",
               f"{ended(printed)}, {printed['time_s']:.1f}" if printed else "in its text alone",
               "–" if not printed else "as the paper's" if printed["as_paper"] else "differs")


def snapshot_rows(drives):
    for one in drives:
        for shot in one["printed"]["snapshots"] if one["printed"] else ():
            ours = shot["ours"]
            judged = ("ours has ended" if ours is None else "no: the paper's series lags" if not shot["comparable"]
                      else f"{'within' if ours['within'] else 'beyond'} {shot['tolerance_m']:g} m")
            yield (one["folder"], f"{shot['t_s']:g}", f"({ours['x_m']:.2f}, {ours['y_m']:.2f})" if ours else "–",
                   f"({shot['x_m']:.2f}, {shot['y_m']:.2f})", digits(ours and ours["distance_m"], ".2f"), judged)


def change(pair, term):
    """From P_B to P_C in per cent; what rounds to nothing has no sign."""
    percent = round(100 * (pair["P_C"][term] / pair["P_B"][term] - 1), 1)
    return f"{percent:+.1f} %" if percent else "0.0 %"


def effort_table(*pairs):
    """A pair has the terms of P_B and P_C; the second is the paper's."""
    columns = ["term", "P_B", "P_C", "change"] + (["paper: P_B", "P_C", "change"] if len(pairs) > 1 else [])
    return table(columns, [[term.replace("_", " "), *(cell for pair in pairs for cell in (
        f"{pair['P_B'][term]:.3g}", f"{pair['P_C'][term]:.3g}", change(pair, term)))] for term in TERMS])


def efforts(entries):
    text = ""
    for one in entries:
        text += f"\n{one['environment']}, by the paper's table, 0.1 ∫(·)² along the drive for all three terms:\n\n"
        text += effort_table(one, *([one["printed"]] if one["printed"] else []))
        weights = ", ".join(f"{w:g}" for w in one["weights"])
        text += f"\n{one['environment']}, by the weights of the cost ({weights}):\n\n" + effort_table(one["weighted"])
    return text


def pictures(evaluation):
    """The file in the reproduction's folder, its name in figures/ and what it shows, of each that is kept."""
    captions = {one["file"]: one["caption"] for one in evaluation["figures"]}
    named = [name for pattern in KEPT for name in sorted(fnmatch.filter(captions, pattern))]
    return [(f"figures/{name}", name, captions[name]) for name in named] + list(OF_DRIVES)


def results(evaluation, mark):
    cases = [(c["case"], c["specifications"], c["planner_words"], c["scenario"],
              c["says"] + (f" (than {c['faster_than']})" if c["faster_than"] else ""), c["ended"],
              "yes" if c["holds"] else "no") for c in evaluation["cases"]]
    shown = "".join(f"\n![{words}](figures/{name})\n\n*{words}*\n" for _, name, words in pictures(evaluation))
    return f"""# Results

{mark}
The drives of the paper's figures and text, all by the same default settings. What they say of the paper's claims stands
in [verdicts.md](verdicts.md).

## Drives

{table(["drive", "outcome", "time [s]", "goal entered [s]", "end (x, y) [m]", "ux at end [m/s]", "least clearance [m]",
        "paper: outcome, time [s]", "ends"], drive_rows(evaluation["drives"]))}
The paper reports ends of execution horizons, so its times carry up to 0.5 s; a drive of ours ends at the check after an
execution horizon too, and the moment at which it entered the goal's square stands beside. A crash is timed where the
front axle's centre touches the obstacle grown by the crash margin.

## Positions

{table(["drive", "t [s]", "ours (x, y) [m]", "paper's (x, y) [m]", "apart [m]", "compared"],
       snapshot_rows(evaluation["drives"]))}
The figures mark thirds of a drive; their printed times are rounded. Why two series are not compared is in section 5 of
[formulation.md](../formulation.md).

## Control effort
{efforts(evaluation["effort"])}
Which of the two measures the paper's is, and how its two drives differ, is in section 5 of
[formulation.md](../formulation.md).

## What planners lack

The six cases of the paper's conceptual figure, driven by the 3DoF vehicle past one obstacle that stands (A to D) or
crosses from the right (E, F). By the specifications of the paper's table: S1 static obstacles, S2 minimum time, S3
dynamic vehicle model, S4 minimum control effort, S5 speed and steering together, S6 moving obstacles.

{table(["case", "has", "planner", "way", "the paper's text", "ours", "holds"], cases)}
## Pictures
{shown}
## Solve times

Solve times depend on the machine; `cycles.csv` and the report of each drive have them beside tex,
[realtime.md](realtime.md) a measurement.
"""


# --- index and verdicts -------------------------------------------------------------------------


def index(evaluation, mark):
    rows = [[one[key] for key in ("of", "command", "where", "ours", "printed")] for one in evaluation["index"]]
    return f"""# The paper's tables and figures

{mark}
By the names of the paper's sources. `make reproduce` leaves its figures in run/reproduce/figures/, some of them also
here. The printed numbers are kept in `config/paper/`.

{table(["of the paper", "command", "where", "ours", "the paper's"], rows)}"""


def claim_table(claims):
    return table(["claim", "paper", "ours", "verdict"],
                 [(c["says"], f"{c['at']}: {c['printed']}", c["ours"], f"**{c['verdict']}**") for c in claims])


def tally(claims):
    words = {"holds": "hold", "holds in part": "hold in part", "does not hold": "do not hold"}
    return ", ".join(f"{sum(c['verdict'] == one for c in claims)} {many}" for one, many in words.items())


def verdicts(evaluation, mark):
    by_sweep = "".join(f"\n## From {sweep['title']}\n\n{sweep['trials']} trials of {sweep['size']}: {tally(sweep['claims'])}.\n\n"
                       + claim_table(sweep["claims"]) for sweep in evaluation["sweeps"][:len(GRIDS)])
    judged = evaluation["claims"] + evaluation["sweeps"][0]["claims"]
    return f"""# The paper's claims

{mark}
Each claim of the paper, its figures, ours, and what they say of it: of {len(judged)} claims, by drives and by the first
sweep, {tally(judged)}. A verdict is a rule on numbers that the program measures (`config/paper/claims.yaml`). Intervals
in brackets are of 95 %: of medians (also of ratios cycle by cycle) from order statistics, none (–) of fewer than six
values; of ratios of two medians by bootstrap over the cycles. Solve times are CPU time, of each cycle the median over
{evaluation["repeats"]} drives; the first cycle, which the warm-up solves, is left out.

## From the drives

By `slalom reproduce`, default settings ([results.md](results.md)): {tally(evaluation["claims"])}.

{claim_table(evaluation["claims"])}{by_sweep}
## Not judged

- That MATLAB was far from real time: [long-solves.md](long-solves.md) sets the paper's times beside ours.
- KNITRO's own solve times: it is not here.
"""


# --- the sweep ----------------------------------------------------------------------------------


def counts_table(evaluation):
    named = [(s["title"], s["counts"]) for s in evaluation["sweeps"][:len(GRIDS)]]
    rows = []
    for name, counts in [*named, ("the paper's, from its counts", evaluation["printed_counts"])]:
        passed = [f"{c['passed']} of {c['trials']}" for c in counts["planners"]]
        rows.append((name, *passed, f"× {digits(counts['ratio'], '.2f')}", digits(counts["fisher_p"], ".1e")))
    return table(["sweep", "P_C at the goal", "P_D at the goal", "ratio", "Fisher's p"], rows)


def horizon_table(sweep):
    by_tex = {}
    for one in sweep["horizons"]:
        by_tex.setdefault(one["tex_s"], {})[one["planner"]] = one
    rows = []
    for tex, planners in by_tex.items():
        figures = [digits(planners[p][key], form) for p in ("P_C", "P_D")
                   for key, form in (("pos", ".2f"), ("rtf_cpu", ".3g"), ("rtf_wall", ".3g"))]
        printed = planners["P_D"]["printed"]
        rows.append((f"{tex:.3f}", *figures, f"POS {printed['pos']:.2f}" if printed else ""))
    greatest = max(one["rtf_cpu"] for one in sweep["horizons"])
    return (f"\nO2 at up to {sweep['greatest_speed_mps']:g} m/s; the greatest real-time factor by CPU time is {greatest:.2g}:\n\n"
            + table(["tex [s]", "P_C: POS", "RTF, CPU", "RTF, wall", "P_D: POS", "RTF, CPU", "RTF, wall", "paper: P_D"], rows))


def slower_table(sweep):
    rows = [(f"{one['speed_mps']:g} m/s", f"{one['tex_s']:.3f}", f"{one['passed']} of {one['trials']}",
             digits(one["rtf_cpu"], ".3g"), f"{one['printed']['pos']:g}, {one['printed']['rtf']:g}")
            for one in sweep["slower"]]
    return "\nWith slower O2 alone:\n\n" + table(
        ["O2 at up to", "tex [s]", "P_D at the goal", "RTF, CPU", "paper: POS, RTF"], rows)


def ends_table(sweep):
    return "\n## How they end\n\n" + table(
        ["", "at the goal", "crash into O2", "into O1 or a cone", "no plan", "else"],
        [(f"{e['planner']}, tex {e['tex']} {e['tex_s']:g} s", f"{e['passed']} of {e['trials']}", e["crash_O2"],
          e["crash_other"], e["no_plan"], e["else"]) for e in sweep["ends"]])


def variant_row(words, sweep):
    c, d = ([e for e in sweep["ends"] if e["planner"] == p] for p in ("P_C", "P_D"))

    def share(ends):
        return f"{sum(e['passed'] for e in ends)} of {sum(e['trials'] for e in ends)}"

    fastest = [e["fastest_passed_mps"] for e in d if e["fastest_passed_mps"] is not None]
    return words, share(c), share(d), share(d[:1]), share(d[1:]), digits(max(fastest, default=None), ".1f")


def variants_table(sweeps):
    named = [("as it is", sweeps[0]), *zip((words for *_, words in VARIANTS), sweeps[len(GRIDS):])]
    return "\n## With one thing changed\n\n" + table(
        ["", "P_C at the goal", "P_D at the goal", "tex up to .5 s", "above", "fastest O2 that P_D passes [m/s]"],
        [variant_row(*one) for one in named])


def paper_sweep(evaluation, mark):
    sweeps = evaluation["sweeps"]
    return f"""# The paper's sweep

{mark}
E_C over execution horizons from .01 to 1 s and speeds of O2, by P_C and P_D. `make study` runs it into run/study/ with its
page, on which a click opens each drive. The speeds go to -40 m/s, which the paper's figures show, or to -20 m/s, as its
text says. Failing solves count, the warm-up does not, and no deadline ends a solve. Why ours differ from the paper's is
in section 5 of [formulation.md](../formulation.md).

{counts_table(evaluation)}
## Real-time factor and probability of safety
{"".join(map(horizon_table, sweeps[:len(GRIDS)]))}{slower_table(sweeps[0])}{ends_table(sweeps[0])}{variants_table(sweeps)}"""


# --- what the pages are made of -----------------------------------------------------------------

PAGES = {"results": results, "paper-index": index, "verdicts": verdicts, "paper-sweep": paper_sweep}
TARGETS = {"paper-index": "verdicts"}  # where make's target has another name


def variant(program, work, name, settings):
    """The folder of the sweep with these settings, run or gone on with."""
    study = work / f"{name}.yaml"
    text = (ROOT / "config/studies/paper.yaml").read_text()
    study.write_text(f"set: {setting(settings)}\n" + text)
    swept(program, study, work / name)
    return work / name


def sweeps_for(pages, program, work):
    """The folders of the sweeps that these pages need, the grids first."""
    if set(pages) == {"results"}:
        return []
    folders = []
    for study, folder in GRIDS.items():
        swept(program, study, work / folder)
        folders.append(work / folder)
    if "paper-sweep" in pages:
        (work / "variants").mkdir(parents=True, exist_ok=True)
        folders += [variant(program, work / "variants", name, settings) for name, settings, _ in VARIANTS]
    return folders


def reproduce(program, pages, out, sweeps, repeats):
    """Drives what these pages need; the evaluation."""
    more = ["--besides", "--repeats", str(repeats)] if "verdicts" in pages else []
    for folder in sweeps:
        more += ["--sweep", folder]
    subprocess.run([program, "reproduce", "--out", out, "--quiet", *more], check=True)
    return json.loads((out / "evaluation.json").read_text())


def main():
    parser = page_parser("paper", __doc__)
    parser.add_argument("pages", nargs="+", choices=PAGES)
    parser.add_argument("--repeats", type=int, default=9)
    parser.set_defaults(out=FOLDER)  # a folder, for there are several pages
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch) / "paper"
        evaluation = reproduce(args.program, args.pages, folder, sweeps_for(args.pages, args.program, args.work), args.repeats)
        if "results" in args.pages:
            (args.out / "figures").mkdir(parents=True, exist_ok=True)
            for source, name, _ in pictures(evaluation):
                shutil.copyfile(folder / source, args.out / "figures" / name)
        for page in args.pages:
            names = ["repeats"] if page == "verdicts" else []
            command = command_of(parser, args, TARGETS.get(page, page), *names, given=page)
            write(args.out / f"{page}.md", PAGES[page](evaluation, stamp(command, args.program)))


if __name__ == "__main__":
    main()
