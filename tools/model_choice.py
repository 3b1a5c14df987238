#!/usr/bin/env python3
"""Drives the paper's environments with each model a planner may use and writes the table of
docs/measured/model-choice.md. Standard library only.

    tools/model_choice.py [--program build/slalom]
"""

from measured import page_parser, stamp, write
from sweeps import driven, ended, head, row

MODELS = ("pacejka", "linear_tyre", "constant_speed", "kinematic")
ENVIRONMENTS = ("E_A", "E_B", "E_C")

HEAD = """# Which model a planner has in mind

{stamp}
Planner P_D with each `planner.model` ([planner-models.md](../planner-models.md)), by default settings. The 3DoF
vehicle drives.

"""


def main():
    options = page_parser("model-choice", __doc__, keeps=False).parse_args()
    text = HEAD.format(stamp=stamp("make model-choice", options.program)) + head(["model", *ENVIRONMENTS])
    for model in MODELS:
        drives = [driven(options.program, e, "P_D", {"planner.model": model})[0] for e in ENVIRONMENTS]
        text += row([f"`{model}`", *(f"{ended(s)}, {s['time_s']:.2f} s" for s in drives)])
    write(options.out, text)


if __name__ == "__main__":
    main()
