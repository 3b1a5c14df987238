#!/usr/bin/env python3
"""Every table and figure of the paper, the command that makes ours, and what came out, into
docs/paper-index.md. Standard library only.

    tools/paper_index.py [--program build/slalom] [--drives FOLDER] [--sweep run/study]

--drives takes the folder of a finished `slalom reproduce` instead of driving again. Without the sweep's
folder its rows have no figures.
"""

import argparse
import pathlib
import re
import subprocess
import tempfile

import results
from sweeps import fisher
from verdict_data import ROOT, Sweep, paper_counts, passes

ENVIRONMENTS = {"veh": ("E_A", "P_A"), "parama": ("E_A", "P_A"), "enva": ("E_A", "P_A"),
                "envc": ("E_C", "P_D")}


# --- tables of parameters -----------------------------------------------------------------------


def printed(table):
    """(key, [values as text]) of one of the paper's tables; config/paper/tables.yaml."""
    text = (ROOT / "config/paper/tables.yaml").read_text()
    block = re.search(rf"^{table}:.*\n((?:  - .*\n)+)", text, re.M).group(1)
    return [(key, expanded(value)) for key, value in re.findall(r"key: (\S+), value: (.*)\}", block)]


def expanded(text):
    """The values of "5", "[1, 2]", "[6, 36 x 0.4]" or "[1, 0:5:175]", each as text."""
    values = []
    for part in text.strip("[]").split(", "):
        times, span = re.match(r"(\d+) x (\S+)$", part), re.match(r"(\d+):(\d+):(\d+)$", part)
        if times:
            values += [times.group(2)] * int(times.group(1))
        elif span:
            first, step, last = map(int, span.groups())
            values += [str(v) for v in range(first, last + 1, step)]
        else:
            values.append(part)
    return values


def resolved(program, scenario, planner):
    """What `slalom check` prints, as {"planner.w_t": ["0"], "obstacles.x": [...], ...}."""
    text = subprocess.run([program, "check", scenario, "--planner", planner], check=True,
                          capture_output=True, text=True).stdout
    found, section = {}, ""
    for line in text.splitlines():
        head = re.match(r"(\w+):(.*)", line)
        if head:
            section = head.group(1)
        if re.match(r"(\w+: \{|  - \{)", line):
            for key, value in re.findall(r"(\w+): ([-\d.e+]+)", line):
                found.setdefault(f"{section}.{key}", []).append(value)
        pair = re.match(r"  (\w+): (.+)", line)
        if pair:
            found[f"{section}.{pair.group(1)}"] = pair.group(2).strip("[]").split(", ")
    return found


def agrees(text, ours):
    """Whether ours, rounded as printed, is what is printed."""
    decimals = len(text.partition(".")[2])
    return round(float(ours), decimals) == float(text)


def parameters(program, table):
    own = resolved(program, *ENVIRONMENTS[table])
    count, other = 0, []
    for key, values in printed(table):
        mine = own.get(key, [])
        if len(mine) != len(values):
            other.append(f"{key}: {len(values)} printed, ours {len(mine)}")
            continue
        count += len(values)
        for k, (text, value) in enumerate(zip(values, mine)):
            if not agrees(text, value):
                place = f"{key}[{k + 1}]" if len(values) > 1 else key
                other.append(f"{place} {text}, ours {value}")
    differ = f"; differ: {', '.join(other)}" if other else ""
    return f"{count - len(other)} of {count} values as printed" + differ


# --- figures ------------------------------------------------------------------------------------


def ended(drives, *keys):
    words = []
    for key in keys:
        s = drives[key].summary
        words.append(f"{key[1]} {s['outcome']}{' ' + s['hit'] if s['hit'] else ''} {s['time_s']:.1f} s")
    return ", ".join(words)


def papers(drives, *keys):
    found = results.paper_drives()
    return ", ".join(f"{k[1]} {found[k]['outcome']}{' ' + found[k]['hit'] if 'hit' in found[k] else ''} "
                     f"{float(found[k]['time']):.1f} s" for k in keys)


def crash(drives):
    end = drives["E_C", "P_C"].rows[-1]
    shot = results.paper_drives()["E_C", "P_C"]["snapshots"][-1]
    return (f"({end['x']:.1f}, {end['y']:.1f}) m at {end['t']:.1f} s",
            f"({float(shot['x']):.1f}, {float(shot['y']):.1f}) m at {float(shot['t']):.1f} s")


def sweep_figures(folder):
    """Ours of the two figures and the table of the sweep."""
    if not (pathlib.Path(folder) / "trials.csv").is_file():
        return {"texv": "–", "rtf": "–", "fishera": "–"}
    s = Sweep(folder)
    c, d = ([t for t in s.trials if t["planner"] == p] for p in ("P_C", "P_D"))
    below = [tex for tex in s.texs if s.rtf("P_D", tex)[0] < 1]
    p = fisher(passes(c), len(c) - passes(c), passes(d), len(d) - passes(d))
    return {"texv": f"P_C {passes(c)}, P_D {passes(d)} of {len(d)} arrive",
            "rtf": f"P_D below 1 at {len(below)} of {len(s.texs)} tex",
            "fishera": f"{passes(c)} and {passes(d)} pass: × {passes(d) / max(passes(c), 1):.2f}, p = {p:.1e}"}


def effort(drives):
    def total(planner):
        drive = drives["E_A-figure", planner]
        return sum(0.1 * drive.square(column) for _, column, _, _ in results.TERMS)
    printed_effort = results.paper_effort()
    b, c = total("P_B"), total("P_C")
    pb, pc = (printed_effort[p]["total"] for p in ("P_B", "P_C"))
    return (f"total {b:.4f} to {c:.4f}, {results.change(b, c)}",
            f"{pb:g} to {pc:g}, {results.change(pb, pc)}")


def rows(program, drives, sweep_folder):
    """(what of the paper, command, where, ours, paper's)."""
    figure = [("E_A-figure", p) for p in ("P_A", "P_B", "P_C")]
    moving, structured = ([(e, p) for p in ("P_C", "P_D")] for e in ("E_B", "E_C"))
    sweep, counts = sweep_figures(sweep_folder), paper_counts()
    reproduce, study = "`make reproduce`", "`make study`"
    cases = ", ".join(f"{c} {drives['cases', c].summary['outcome']} {drives['cases', c].summary['time_s']:.1f} s"
                      for c in results.CASES)
    return [
        ("Table 1, specifications S1 to S7", "`slalom list`", "[formulation.md](formulation.md), section 3",
         "options of the planner and loop.tex", "–"),
        ("Fig. terms, conceptual", reproduce, "[cases.svg](figures/cases.svg), [results.md](results.md)", cases,
         "drawn by hand: A, E collide; F safe"),
        ("Fig. mpc, the loop", "`slalom simulate`", "[formulation.md](formulation.md), section 4",
         "predict, plan, drive, swap", "the same"),
        ("Fig. model, 3DoF vehicle", "–", "[formulation.md](formulation.md), section 2", "the same equations", "–"),
        ("Table planners, P_A to P_D", "`slalom list`", "config/planners/", "w_t, w_ce, moving avoidance", "the same"),
        ("Table veh", "`slalom check E_A --planner P_A`", "config/vehicles/hmmwv.yaml", parameters(program, "veh"), "–"),
        ("Table parama", "`slalom check E_A --planner P_A`", "config/planners/P_A.yaml",
         parameters(program, "parama"), "–"),
        ("Table enva", "`slalom check E_A`", "config/scenarios/E_A.yaml", parameters(program, "enva"), "–"),
        ("Table envc", "`slalom check E_C`", "config/scenarios/E_C.yaml", parameters(program, "envc"), "–"),
        ("Fig. mt, E_A", reproduce, "[E_A-figure.svg](figures/E_A-figure.svg)", ended(drives, *figure),
         papers(drives, *figure)),
        ("Table cer, control effort", reproduce, "[results.md](results.md#control-effort)", *effort(drives)),
        ("Fig. mo, E_B", reproduce, "[E_B.svg](figures/E_B.svg)", ended(drives, *moving),
         papers(drives, *moving)),
        ("Fig. moa, E_C", reproduce, "[E_C.svg](figures/E_C.svg)", ended(drives, *structured), papers(drives, *structured)),
        ("Fig. mob, the crash", reproduce, "[E_C_crash.svg](figures/E_C_crash.svg)", *crash(drives)),
        ("Fig. moc, traces of E_C", reproduce, "[E_C.svg](figures/E_C.svg), [E_C_dynamics.svg](figures/E_C_dynamics.svg)", ended(drives, *structured),
         papers(drives, *structured)),
        ("Fig. texv, tex and speed of O2", study, "run/study/figures/map_P_C, map_P_D", sweep["texv"],
         f"P_C {counts['P_C'][0]}, P_D {counts['P_D'][0]} of {counts['P_D'][1]}"),
        ("Fig. rtf, real-time factor", study, "run/study/figures/real_time", sweep["rtf"], "at 2 of 20"),
        ("Table fishera", study, "run/study/index.html", sweep["fishera"],
         f"{counts['P_C'][0]} and {counts['P_D'][0]}: × {counts['P_D'][0] / counts['P_C'][0]:.2f}, p = 2.2e-16"),
        ("Table solve, long solves", "`make long-solves`", "[long-solves.md](long-solves.md)", "there", "there"),
        ("What the text claims of all these", "`make verdicts`", "[verdicts.md](verdicts.md)", "there", "there"),
    ]


def page(lines):
    head = ["of the paper", "command", "where", "ours", "the paper's"]
    return "\n".join([
        "<!-- Written by tools/paper_index.py (`make results`). -->",
        "# The paper's tables and figures", "",
        "By the names of the paper's sources. `make reproduce` leaves its figures in run/reproduce/figures/, some of them",
        "also here. All numbers are of the run that wrote this page, and the printed ones from",
        "`config/paper/`.", "",
        "| " + " | ".join(head) + " |", "|---" * len(head) + "|",
        *("| " + " | ".join(line) + " |" for line in lines), ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", default=str(ROOT / "build/slalom"))
    parser.add_argument("--drives")
    parser.add_argument("--sweep", default=str(ROOT / "run/study"))
    parser.add_argument("--out", default=str(ROOT / "docs/paper-index.md"))
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(args.drives or pathlib.Path(scratch) / "paper")
        if not args.drives:
            subprocess.run([args.program, "reproduce", "--out", folder, "--quiet"], check=True)
        drives = results.read(folder)
    pathlib.Path(args.out).write_text(page(rows(args.program, drives, args.sweep)))


if __name__ == "__main__":
    main()
