#!/usr/bin/env python3
"""Solves thousands of perturbed cycles, by ours and by Ipopt, and writes docs/measured/perturbed.md.

    benchmarks/perturb.py [--count 10000] [--jobs N]

Verdicts and iterations, not speed: it may run on a busy machine. Width and seed were fixed on other
draws (seed 77, 200 cycles), so that a tenth is infeasible and a fifth costs Ipopt more than 30 iterations.
"""

import hashlib
import json
import os
import pathlib
import subprocess
from collections import Counter
from concurrent.futures import ThreadPoolExecutor

from contestants import build_ours, program, record_cycles
from measured import command_of, page_parser, stamp, write
from sweeps import head, quantile, row

ENVIRONMENT, SEED, WIDTH, DEADLINE = "E_C", 1, 7, 0.002
CHUNK = 250


def folder_of(work):
    """Of what this bench_perturb has solved: at a commit with changes there may be several."""
    folder = work / hashlib.sha256(pathlib.Path(program("bench_perturb")).read_bytes()).hexdigest()[:8]
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def record(folder):
    cycles = folder / f"{ENVIRONMENT}.cycles"
    if not cycles.exists():
        record_cycles(ENVIRONMENT, cycles.with_suffix(".part"), 1000, 0, SEED)
        cycles.with_suffix(".part").rename(cycles)
    return cycles


def solve(folder, cycles, first, count):
    """So many cycles from the first on; a chunk that is there is solved again where it has fewer, of an earlier run of
    fewer cycles."""
    out = folder / f"{first}.jsonl"
    if out.exists() and len(lines := out.read_text().splitlines()) >= count:
        return [json.loads(line) for line in lines[:count]]
    with open(out.with_suffix(".part"), "w") as file:
        subprocess.run([program("bench_perturb"), "--environment", ENVIRONMENT, "--cycles",
                        str(cycles), "--seed", str(SEED), "--width", str(WIDTH), "--deadline",
                        str(DEADLINE), "--first", str(first), "--count", str(count)],
                       check=True, stdout=file)  # fmt: skip
    out.with_suffix(".part").rename(out)
    return [json.loads(line) for line in out.read_text().splitlines()]


def solve_all(work, count, jobs):
    """The lines of bench_perturb, in order of the cycles."""
    folder = folder_of(work)
    cycles = record(folder)
    with ThreadPoolExecutor(jobs) as pool:
        chunks = [pool.submit(solve, folder, cycles, first, min(CHUNK, count - first)) for first in range(0, count, CHUNK)]
        return [line for chunk in chunks for line in chunk.result()]


def share(part, whole):
    return f"{part} of {whole} ({100 * part / whole:.2f} %)"


def markdown(lines, stamped):
    total = len(lines)
    ours = Counter(x["ours"]["status"] for x in lines)
    ipopt = Counter(x["ipopt"]["status"] for x in lines)
    wrong = [x["cycle"] for x in lines
             if x["ours"]["status"] == "solved" and not x["ours"]["confirmed"]]
    infeasible = [x for x in lines if x["ours"]["status"] == "infeasible"]
    tries = ("ipopt", "ipopt_cold", "ipopt_from_ours")
    refuted = [x["cycle"] for x in infeasible if any(x[t]["status"] == "solved" for t in tries)]
    agreed = [x for x in infeasible if all(x[t]["status"] != "solved" for t in tries)
              and any(x[t]["status"] == "infeasible" for t in tries)]  # fmt: skip
    hard = sum(x["ipopt"]["iterations"] > 30 for x in lines)
    overrun = [x["deadline"]["cpu_s"] - DEADLINE for x in lines
               if x["deadline"]["cpu_s"] > DEADLINE + x["deadline"]["longest_step_s"]]
    struck = [x["deadline"]["cpu_s"] - DEADLINE for x in lines
              if x["deadline"]["status"] == "time_limit"]  # fmt: skip
    statuses = sorted(set(ours) | set(ipopt))
    both = [x for x in lines if x["ours"]["status"] == x["ipopt"]["status"] == "solved"]
    same = [x for x in both if abs(x["ours"]["phi"] - x["ipopt"]["phi"])
            <= 1e-4 * max(1, abs(x["ipopt"]["phi"]))]  # fmt: skip
    better = sum(x["ours"]["phi"] < x["ipopt"]["phi"] for x in both if x not in same)
    rows = [
        ("cycles", str(total)),
        ("Ipopt needs more than 30 iterations", share(hard, total)),
        ("ours solved", share(ours["solved"], total)),
        ("Ipopt solved", share(ipopt["solved"], total)),
        ("ours solved, refused by the checker", str(len(wrong))),
        ("ours infeasible", share(len(infeasible), total)),
        ("of these, Ipopt infeasible and never solved, from three starts",
         share(len(agreed), max(1, len(infeasible)))),
        ("of these, Ipopt solved from some start", str(len(refuted))),
        ("both solved, same φ to 1e-4", share(len(same), max(1, len(both)))),
        ("both solved, other local optima: ours lower", f"{better} of {len(both) - len(same)}"),
        ("allocations in all solves by ours", str(sum(x["allocations"] for x in lines))),
        (f"deadline {1e3 * DEADLINE:g} ms struck", share(len(struck), total)),
        ("overrun by more than the longest step", str(len(overrun))),
        ("overshoot where it struck [µs]: median, p99, max",
         ", ".join(f"{1e6 * quantile(struck, q):.0f}" for q in (0.5, 0.99, 1)) if struck else "–"),
        ("iterations of ours: median, p95, max",
         ", ".join(f"{quantile([x['ours']['iterations'] for x in lines], q):g}" for q in (0.5, 0.95, 1))),
        ("iterations of Ipopt: median, p95, max",
         ", ".join(f"{quantile([x['ipopt']['iterations'] for x in lines], q):g}" for q in (0.5, 0.95, 1))),
    ]  # fmt: skip
    text = "\n".join([
        "# Perturbed cycles", "", stamped,
        f"Planning cycles of {ENVIRONMENT} with P_D, recorded in closed loop, each with another predicted",
        f"state: up to {WIDTH} × (0.3 m, 0.3 m, 0.1 m/s, 0.02 rad/s,",
        "0.02 rad, 0.01 rad, 0.5 m/s, 0.2 m/s²) away in (x, y, v, r, ψ, δ, u, a). Seed and width were fixed",
        "beforehand. Both solvers start from the shifted plan, at a floor of 0.9; `nlp::check` judges both.", "", ""])  # fmt: skip
    text += head(["", ""]) + "".join(map(row, rows))
    text += "\nStatuses, ours down, Ipopt across:\n\n" + head(["", *statuses])
    pairs = Counter((x["ours"]["status"], x["ipopt"]["status"]) for x in lines)
    text += "".join(row([a, *(pairs[a, b] for b in statuses)]) for a in statuses)
    text += ("\n\"Infeasible\" means a point from where the violation cannot be lessened nearby; another start\n"
             "may still find a way.")
    if refuted:
        text += " Ipopt did in the cycles " + ", ".join(map(str, refuted[:40])) + (
            f" and {len(refuted) - 40} more." if len(refuted) > 40 else ".")
    return text + "\n"


def main():
    parser = page_parser("perturbed", __doc__)
    parser.add_argument("--count", type=int, default=10000)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    args = parser.parse_args()
    build_ours("record", "perturb")
    lines = solve_all(args.work, args.count, args.jobs)
    write(args.out, markdown(lines, stamp(command_of(parser, args, "perturbed", "count"), program("bench_perturb"))))


if __name__ == "__main__":
    main()
