#!/usr/bin/env python3
"""Where the microseconds of a solve go: samples bench_solve by perf and writes
docs/measured/solver-profile.md.

    benchmarks/profile.py [--cycles 500]

Needs perf (Debian: linux-perf).
"""

import json
import pathlib
import platform
import re
import statistics
import subprocess
import sys
import tempfile

from contestants import ENVIRONMENTS, build_ours, program, record_cycles
from levels import LEVELS
from measured import command_of, page_parser, stamp, write
from sweeps import head, row

SEED, CYCLES, FLOOR = 1, 500, LEVELS["floor"].floor
INTERLEAVED = platform.machine() in ("x86_64", "AMD64")  # bench_interleaved is of AVX2
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
    ("other functions of the library", r"slalom::"),
)


def run(command):
    """What it prints. What perf says where it may not sample has the reason."""
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        hint = ("\nperf may sample where /proc/sys/kernel/perf_event_paranoid is 2 or less (sysctl "
                "kernel.perf_event_paranoid=2)" if command[0] == "perf" else "")  # fmt: skip
        sys.exit(f"{' '.join(map(str, command))}: ended with {done.returncode}\n{done.stderr.strip()}{hint}")
    return done.stdout


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


def shares(sampled):
    """Of the time in the library, by part: reading the cycles and writing JSON are left out."""
    sums = dict.fromkeys([name for name, _ in PARTS], 0.0)
    for percent, symbol in sampled:
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
            statistics.median(c["iterations"] for c in short), shares(samples(command)))  # fmt: skip


def interleaved():
    """Rows of a front -> how many times as fast fronts are factorised where each vector holds one number of as many."""
    found = json.loads(run([program("bench_interleaved"), "--size", ",".join(map(str, FRONTS))]))
    return {e["size"]: e["lanes"] * e["one_ns"] / e["together_ns"] for e in found}


def together(columns, ratios):
    """What solving several problems together could win."""
    text = ("\n## Several problems together\n\n"
            "Fronts of several problems can be factorised together, each lane of a vector for one of them\n"
            "(`benchmarks/interleaved.cpp`, AVX2). One after the other, a front's columns fill the vectors.\n\n"
            + head(["rows of a front", *ratios])
            + row(["four interleaved, times as fast", *(f"{r:.2f}" for r in ratios.values())]))  # fmt: skip
    ratio = ratios[FRONTS[1]]
    text += (f"\nIf all that is done with fronts were {ratio:.2f} times as fast, and all else as fast as it is, a solve would "
             "be:\n\n")  # fmt: skip
    for environment, (_, _, share) in columns.items():
        fronts = share["factorisation"] + share["search for pivots"] + share["solves with the factors"]
        text += (f"- in {environment}, {100 * fronts:.0f} % of it spent on fronts, "
                 f"{1 / (1 - fronts + fronts / ratio):.2f} times as fast.\n")  # fmt: skip
    return text


def page(columns, ratios, stamped):
    """`ratios`: none where fronts of several problems were not timed."""
    text = "\n".join([
        "# Profile of one solve", "", stamped,
        f"Recorded planning cycles at a floor of {FLOOR:g}, warm, each from request to checked answer, sampled by",
        f"perf; microseconds are the share of the median cycle of up to {SHORT} iterations.", "", ""])  # fmt: skip
    text += head(["", *(cell for e in columns for cell in (f"{e} [µs]", e))])
    for name, _ in PARTS:
        text += row([name, *(cell for time, _, share in columns.values()
                             for cell in (f"{time * share[name]:.0f}", f"{100 * share[name]:.0f} %"))])  # fmt: skip
    text += row(["all", *(cell for time, iterations, _ in columns.values()
                          for cell in (f"{time:.0f}", f"{iterations:g} iterations"))])  # fmt: skip
    return text + (together(columns, ratios) if ratios else "")


def main():
    parser = page_parser("solver-profile", __doc__, keeps=False)
    parser.add_argument("--cycles", type=int, default=CYCLES, help="recorded in each environment")
    args = parser.parse_args()
    build_ours("record", "solve", *["interleaved"] * INTERLEAVED)
    columns = {}
    with tempfile.TemporaryDirectory() as folder:
        for environment in ENVIRONMENTS:
            cycles = pathlib.Path(folder) / f"{environment}.cycles"
            record_cycles(environment, cycles, args.cycles, 0, SEED)
            columns[environment] = measure(environment, cycles)
    ratios = interleaved() if INTERLEAVED else {}
    write(args.out, page(columns, ratios, stamp(command_of(parser, args, "solver-profile", "cycles"), program("bench_solve"))))


if __name__ == "__main__":
    main()
