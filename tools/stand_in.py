#!/usr/bin/env python3
"""Stands in for the program in tests of tools that write pages: it makes empty scenarios, and every drive arrives but
those that are said to crash. It reads studies as the tools write them, and no others. Where the environment has
STAND_IN_LOG, each command goes there as a line; a trial whose values, joined by spaces, match STAND_IN_CRASHES (a
regular expression) crashes into O2, and one that matches STAND_IN_FAILURES fails and leaves no files; `reproduce` evaluates to what is in STAND_IN_EVALUATION."""

import csv
import itertools
import json
import os
import pathlib
import re
import sys

MEASURES = {"outcome": "goal", "hit": "", "message": "reached the goal", "time_s": 12, "goal_time_s": 12, "cycles": 20,
            "failed_cycles": 0, "new_plans": 20, "rests": 0, "least_bads": 0, "marks": "", "least_clearance_m": 0.5,
            "least_clearance_obstacle": "O2", "least_wheel_load_N": 1500, "median_cpu_time_s": 0.001,
            "p99_cpu_time_s": 0.002, "max_cpu_time_s": 0.003, "max_solve_time_s": 0.004}  # fmt: skip
BUILT_IN = "scenario: E_C\nplanners: [P_C, P_D]\n"  # a study that is named and no file
CYCLES = "cycle,status,planning_cpu_s,solve_time_s\n1,solved,0.001,0.002\n2,solved,0.003,0.004\n"
CRASH = {"outcome": "crash", "hit": "O2", "message": "hit O2 at 3 s at (6, 200), 20 m/s", "goal_time_s": ""}
FAILURE = dict.fromkeys(MEASURES, "") | {"outcome": "failed", "message": "out of memory", "cycles": 0, "failed_cycles": 0,
                                         "new_plans": 0, "rests": 0, "least_bads": 0}


def list_of(text):
    return [item.strip() for item in text.strip("[] ").split(",")]


def axes(study):
    """Key and values of each axis."""
    for key, kind, rest in re.findall(r"- key: (\S+)\n +(range|values): (.*)", study):
        if kind == "values":
            yield key, list_of(rest)
            continue
        first, last, count = map(float, re.search(r"from: (\S+), to: (\S+), count: (\d+)", rest).groups())
        yield key, [f"{first + (last - first) * k / max(count - 1, 1):g}" for k in range(int(count))]


def scenarios(study):
    named = re.search(r"(?m)^scenarios:(.*)\n((?:  - .*\n)*)", study)
    if not named:
        return [re.search(r"(?m)^scenario: (.*)$", study)[1]]
    paths = list_of(named[1]) if named[1].strip() else re.findall(r"  - (.*)\n", named[2])
    files = [file for path in map(pathlib.Path, paths)
             for file in (sorted(path.parent.glob(path.name)) if "*" in path.name else [path])]  # fmt: skip
    return [file.stem for file in files]


def ended(cells):
    """How a trial with these values ends."""
    found = MEASURES
    for name, other in (("STAND_IN_CRASHES", CRASH), ("STAND_IN_FAILURES", FAILURE)):
        pattern = os.environ.get(name)
        if pattern and re.search(pattern, " ".join(cells)):
            found = found | other
    return found


def sweep(study, out):
    text = pathlib.Path(study).read_text() if pathlib.Path(study).is_file() else BUILT_IN
    keys, values = zip(*axes(text)) if "axes:" in text else ((), ())
    planners = list_of(re.search(r"(?m)^planners: (.*)$", text)[1])
    out.mkdir(parents=True, exist_ok=True)
    with open(out / "trials.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, ["trial", "scenario", "planner", *keys, *MEASURES])
        writer.writeheader()
        for number, cells in enumerate(itertools.product(scenarios(text), planners, *values), 1):
            names = ("scenario", "planner", *keys)
            result = ended(cells)
            writer.writerow({"trial": number, **dict(zip(names, cells)), **result})
            if "keep: drives" in text and result["outcome"] != "failed":
                simulate(cells, out / "drives" / f"{number:06}")


def simulate(arguments, out):
    out.mkdir(parents=True, exist_ok=True)
    (out / "summary.json").write_text(json.dumps(ended(arguments)))
    (out / "cycles.csv").write_text(CYCLES)
    (out / "plant.csv").write_text("t,x,y\n")


def reproduce(out):
    """The evaluation that is given, and the figures of which it speaks."""
    (out / "figures").mkdir(parents=True)
    (out / "E_C/P_D/figures").mkdir(parents=True)
    (out / "E_C/P_D/figures/path.svg").touch()
    text = os.environ["STAND_IN_EVALUATION"]
    (out / "evaluation.json").write_text(text)
    for figure in json.loads(text)["figures"]:
        (out / "figures" / figure["file"]).write_text(figure["caption"])


def make_scenarios(family, out, count):
    out.mkdir(parents=True, exist_ok=True)
    for index in range(1, count + 1):
        (out / f"{family}-{index:04}.yaml").write_text(f'name: "{family}"\n')


def main(command, *arguments):
    if "STAND_IN_LOG" in os.environ:
        with open(os.environ["STAND_IN_LOG"], "a") as file:
            print(command, *arguments, file=file)
    option = dict(itertools.pairwise(arguments))
    out = pathlib.Path(option["--out"])
    if command == "sweep":
        sweep(arguments[0], out)
    elif command == "simulate":
        simulate(arguments, out)
    elif command == "reproduce":
        reproduce(out)
    elif command == "make-scenarios":
        make_scenarios(arguments[0], out, int(option["--count"]))
    else:
        raise SystemExit(f"{command}: the stand-in does not know this")


def run(tool, *arguments, **environment):
    """Runs the main function of a tool, which has this for a program."""
    import unittest.mock  # here, for the stand-in itself starts often

    command = [tool.__module__ + ".py", *arguments, "--program", __file__]
    with (unittest.mock.patch.object(sys, "argv", list(map(str, command))),
          unittest.mock.patch.dict(os.environ, environment)):
        tool()


def page_of(tool, folder, *arguments, **environment):
    """The page that a tool writes, with `folder`/work for what it measures."""
    run(tool, "--work", folder / "work", "--out", folder / "page.md", *arguments, **environment)
    return (folder / "page.md").read_text()


if __name__ == "__main__":
    main(*sys.argv[1:])
