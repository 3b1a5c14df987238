#!/usr/bin/env python3
"""Solves thousands of perturbed cycles, by ours and by Ipopt, and writes docs/measured/perturbed.md.

    benchmarks/perturb.py [--count 10000] [--jobs N]

Verdicts and iterations, not speed: it may run on a busy machine. Width and seed were fixed on other
draws (seed 77, 200 cycles), so that a tenth is infeasible and a fifth costs Ipopt more than 30 iterations.
"""

import json
import os
import subprocess
from collections import Counter
from concurrent.futures import ThreadPoolExecutor

from contestants import build_ours, program, record_cycles
from measured import page_parser, stamp, write
from sweeps import quantile

ENVIRONMENT, SEED, WIDTH, DEADLINE = "E_C", 1, 7, 0.002
CHUNK = 250


def record(folder):
    cycles = folder / f"{ENVIRONMENT}.cycles"
    if not cycles.exists():
        record_cycles(ENVIRONMENT, cycles, 1000, 0, SEED)
    return cycles


def solve(folder, cycles, first, count):
    out = folder / f"{first}.jsonl"
    if out.exists():
        return
    with open(out.with_suffix(".part"), "w") as file:
        subprocess.run([program("bench_perturb"), "--environment", ENVIRONMENT, "--cycles",
                        str(cycles), "--seed", str(SEED), "--width", str(WIDTH), "--deadline",
                        str(DEADLINE), "--first", str(first), "--count", str(count)],
                       check=True, stdout=file)  # fmt: skip
    out.with_suffix(".part").rename(out)


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
    text = ["# Perturbed cycles", "", stamped,
            f"Planning cycles of {ENVIRONMENT} with P_D, recorded in closed loop, each with another predicted",
            f"state: up to {WIDTH} × (0.3 m, 0.3 m, 0.1 m/s, 0.02 rad/s,",
            "0.02 rad, 0.01 rad, 0.5 m/s, 0.2 m/s²) away in (x, y, v, r, ψ, δ, u, a). Seed and width were fixed",
            "beforehand. Both solvers start from the shifted plan, at a floor of 0.9; `nlp::check` judges both.",
            "", "| | |", "|---|---|"]
    text += [f"| {name} | {value} |" for name, value in rows]
    text += ["", "Statuses, ours down, Ipopt across:", "",
             "| | " + " | ".join(statuses) + " |", "|---" * (len(statuses) + 1) + "|"]
    pairs = Counter((x["ours"]["status"], x["ipopt"]["status"]) for x in lines)
    text += [f"| {a} | " + " | ".join(str(pairs[a, b]) for b in statuses) + " |" for a in statuses]
    text += ["", "\"Infeasible\" means a point from where the violation cannot be lessened nearby; another start",
             "may still find a way."]
    if refuted:
        text[-1] += " Ipopt did in the cycles " + ", ".join(map(str, refuted[:40])) + (
            f" and {len(refuted) - 40} more." if len(refuted) > 40 else ".")
    return "\n".join(text) + "\n"


def main():
    parser = page_parser("perturbed", __doc__)
    parser.add_argument("--count", type=int, default=10000)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    args = parser.parse_args()
    build_ours("record", "perturb")
    args.work.mkdir(parents=True, exist_ok=True)
    cycles = record(args.work)
    with ThreadPoolExecutor(args.jobs) as pool:
        chunks = [pool.submit(solve, args.work, cycles, first, min(CHUNK, args.count - first))
                  for first in range(0, args.count, CHUNK)]  # fmt: skip
        for chunk in chunks:
            chunk.result()
    lines = [json.loads(line) for path in args.work.glob("*.jsonl")
             for line in path.read_text().splitlines()]  # fmt: skip
    lines = sorted((x for x in lines if x["cycle"] < args.count), key=lambda x: x["cycle"])
    write(args.out, markdown(lines, stamp("make perturbed", program("bench_perturb"))))


if __name__ == "__main__":
    main()
