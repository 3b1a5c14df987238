#!/usr/bin/env python3
"""Runs the study `latency` and writes its table, docs/latency.md. Standard library only.

    tools/latency.py --program build/slalom [--work run/latency]

The sweep goes on where it stopped, in --work.
"""

import argparse
import pathlib
import re

from sweeps import head, row, swept

ROOT = pathlib.Path(__file__).resolve().parents[1]

HEAD = """<!-- Written by tools/latency.py (`make latency`). -->
# When plans take effect

What the rules of `loop.latency` ([studies.md](studies.md#latency-rules)) do to the pass rate: P_D in the
paper's E_C, O2 at {speeds} speeds from 0 to -20 m/s, by `slalom sweep latency`. `recorded` charges {recorded} s to
every solve, `model` draws from a lognormal distribution with that median and a spread of {spread}; where a
solve yields no plan, the last one runs on.

At the goal, of {speeds} speeds:

"""

NOTES = """
`instant`, what most simulation studies do, leaves out the time that planning takes and with it the
prediction; as long as plans are ready in time it passes about what `paper` passes. `measured` charges this machine's own solve times, which are
milliseconds, so that no plan is late and `paper`'s drives come out. Charged {recorded} s, plans are late at
every horizon shorter than that: a short tex then buys nothing, and what looked safe is not. The rule is
part of a claim about safety.
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default="build/slalom")
    parser.add_argument("--work", type=pathlib.Path, default=ROOT / "run/latency")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "docs/latency.md")
    options = parser.parse_args()
    trials = swept(options.program, "latency", options.work)
    study = (ROOT / "config/studies/latency.yaml").read_text()
    settings = dict(re.findall(r"loop\.(solve_times|latency_spread): \[?([\d.]+)", study))
    rules = list(dict.fromkeys(t["loop.latency"] for t in trials))
    texs = list(dict.fromkeys(t["loop.tex"] for t in trials))
    speeds = len({t["obstacles.O2.vy"] for t in trials})
    text = head(["rule", *(f"tex {tex} s" for tex in texs), "all"])
    for rule in rules:
        own = [t for t in trials if t["loop.latency"] == rule]
        passed = [sum(t["outcome"] == "goal" for t in own if t["loop.tex"] == tex) for tex in texs]
        text += row([f"`{rule}`", *passed, f"{sum(passed)} of {len(own)}"])
    numbers = {"speeds": speeds, "recorded": settings["solve_times"], "spread": settings["latency_spread"]}
    options.out.write_text(HEAD.format(**numbers) + text + NOTES.format(**numbers))


if __name__ == "__main__":
    main()
