#!/usr/bin/env python3
"""Where the microseconds of a solve go: samples bench_solve by perf and writes
docs/measured/solver-profile.md.

    benchmarks/profile.py [--cycles 500]

Needs perf (Debian: linux-perf).
"""

import json
import re
import statistics
import subprocess
import tempfile

from contestants import ENVIRONMENTS, program, record_cycles
from levels import LEVELS
from measured import page_parser, stamp, write
from run import build_ours

SEED, FLOOR = 1, LEVELS["floor"].floor
SHORT = 8  # iterations of a solve that counts for the median
FRONTS = (18, 28, 38)  # rows; an inner stage's of E_B and E_C has about as many as the second

# What a sampled function belongs to; the first pattern that fits.
PARTS = (
    ("functions and their derivatives", r"slalom::expr|slalom::ocp|^Sleef"),
    ("search for pivots", r"kkt::Front"),
    ("solves with the factors", r"kkt::.*(forward|backward|four|scale)\b|Multifrontal::solve"),
    ("factorisation", r"kkt::.*(Loops<.*>::(factor|update|subtract|pivot|catch_up)|Multifrontal)"),
    ("condensation of the inequalities", r"kkt::.*(condense|symmetric)|CondensedHessian"),
    ("products with Jacobian and Hessian", r"kkt::.*RowLoops|RowBlocks|SymmetricRuns"),
    ("loops over bounds and rows", r"ipm::.*VectorLoops"),
    ("rest of the interior-point method", r"slalom::nlp::(ipm|\(anonymous)"),
    ("the independent check", r"slalom::nlp::check|nlp::.*Residual"),
    ("planner: request, shift, guess", r"slalom::(planner|bench|vehicle)"),
    ("memory (moves, zeros)", r"mem(set|move|cpy)"),
)


def run(command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def samples(command):
    """Share of the samples by function."""
    with tempfile.NamedTemporaryFile() as data:
        run(["perf", "record", "-q", "-F", "20000", "-o", data.name, *command])
        text = run(["perf", "report", "-i", data.name, "--stdio", "-q", "--no-children",
                    "--percent-limit", "0", "-F", "overhead,symbol"])  # fmt: skip
    for line in text.splitlines():
        found = re.match(r"\s*([\d.]+)%\s+\[.\]\s+(.*\S)", line)
        if found:
            yield float(found[1]), found[2]


def shares(command):
    """Of the time in the library, by part: reading the cycles and writing JSON are left out."""
    sums = dict.fromkeys([name for name, _ in PARTS], 0.0)
    for percent, symbol in samples(command):
        for name, pattern in PARTS:
            if re.search(pattern, symbol):
                sums[name] += percent
                break
    total = sum(sums.values())
    return {name: value / total for name, value in sums.items()}


def measure(environment, cycles):
    """Median time of the shorter solves [µs], their median iterations, and the shares of the parts."""
    command = [program("bench_solve"), "--environment", environment, "--cycles", str(cycles), "--backend",
               "interior_point", "--floor", str(FLOOR)]  # fmt: skip
    solved = [c for c in json.loads(run(command))["cycles"] if c["status"] == "solved"]
    short = [c for c in solved if c["iterations"] <= SHORT]
    return (1e6 * statistics.median(c["cpu_s"] for c in short),
            statistics.median(c["iterations"] for c in short), shares(command))  # fmt: skip


def interleaved():
    """Rows of a front -> how many times as fast fronts are factorised where each vector holds one number of as many."""
    found = json.loads(run([program("bench_interleaved"), "--size", ",".join(map(str, FRONTS))]))
    return {e["size"]: e["lanes"] * e["one_ns"] / e["together_ns"] for e in found}


def together(columns, ratios):
    """What solving several problems together could win."""
    lines = ["", "## Several problems together", "",
             "Fronts of several problems can be factorised together, each lane of a vector for one of them",
             "(`benchmarks/interleaved.cpp`, AVX2). One after the other, a front's columns fill the vectors.", "",
             "| rows of a front | " + " | ".join(map(str, ratios)) + " |", "|---" * (1 + len(ratios)) + "|",
             "| four interleaved, times as fast | " + " | ".join(f"{r:.2f}" for r in ratios.values()) + " |", ""]  # fmt: skip
    ratio = ratios[FRONTS[1]]
    lines += [f"{ratio:.2f} times as fast in all that is done with fronts, and no other gain, for functions, products and loops",
              "over bounds run over whole vectors already, makes a solve:", ""]  # fmt: skip
    for environment, (_, _, share) in columns.items():
        fronts = share["factorisation"] + share["search for pivots"] + share["solves with the factors"]
        lines.append(f"- in {environment}, {100 * fronts:.0f} % of it spent on fronts, {1 / (1 - fronts + fronts / ratio):.2f} times as fast.")
    return lines


def page(columns, ratios, stamped):
    text = ["# Profile of one solve", "", stamped,
            f"Recorded planning cycles at a floor of {FLOOR:g}, warm, each from request to checked answer, sampled by",
            f"perf; microseconds are the share of the median cycle of up to {SHORT} iterations.", "",
            "| | " + " | ".join(f"{e} [µs] | {e}" for e in columns) + " |",
            "|---" * (1 + 2 * len(columns)) + "|"]  # fmt: skip
    for name, _ in PARTS:
        text.append(f"| {name} | " + " | ".join(
            f"{time * share[name]:.0f} | {100 * share[name]:.0f} %"
            for time, _, share in columns.values()) + " |")  # fmt: skip
    text.append("| all | " + " | ".join(f"{time:.0f} | {iterations:g} iterations"
                                        for time, iterations, _ in columns.values()) + " |")  # fmt: skip
    return "\n".join([*text, *together(columns, ratios)]) + "\n"


def main():
    parser = page_parser("solver-profile", __doc__)
    parser.add_argument("--cycles", type=int, default=500, help="recorded in each environment")
    args = parser.parse_args()
    build_ours()
    args.work.mkdir(parents=True, exist_ok=True)
    columns = {}
    for environment in ENVIRONMENTS:
        cycles = args.work / f"{environment}.cycles"
        record_cycles(environment, cycles, args.cycles, 0, SEED)
        columns[environment] = measure(environment, cycles)
    write(args.out, page(columns, interleaved(), stamp("make solver-profile", program("bench_solve"))))


if __name__ == "__main__":
    main()
