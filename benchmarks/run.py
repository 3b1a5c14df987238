#!/usr/bin/env python3
"""Times the planner's solver beside its peers on recorded cycles; writes docs/measured/benchmarks.md.

Steps, all of them by default, each of which may be run by itself:
  setup      install the peers, generate and compile their C
  record     begin a run: drive, and write its cycles
  measure    each contestant on each environment, level and start, chunk by chunk, in turn
  functions  one evaluation of the functions beside CasADi's
  report     tables of the run, on standard output and in docs/measured/benchmarks.md

A run is a folder build/bench/runs/ID with its cycles and one JSON file a contestant and chunk:
`measure` leaves alone what is there, so a stopped run goes on where it was (--minutes stops it in
time), and `--again` measures anew what --contestants names. Our programs are built before all but a report. Use a
quiet machine.
"""

import argparse
import json
import os
import subprocess
import sys
import time

import machine
from contestants import (
    BUILD, CHUNK, CONTESTANTS, DEFAULT, ENVIRONMENTS, GENERATED, HERE, PEERS, WHEEL, Job, build_ours, program,
    python, record_cycles, run_command)  # fmt: skip
import environments  # on the path that contestants.py sets
from levels import LEVELS
from measured import FOLDER, commit_at_start, write
from summary import summarise
from tables import markdown

STEPS = ("setup", "record", "measure", "functions", "report")
RUNS = BUILD / "runs"
STARTS = ("warm", "cold")
PROGRAMS = ("record", "solve", "judge", "functions", "generated")


def say(text):
    print(text, file=sys.stderr, flush=True)


# --- set-up -----------------------------------------------------------------------------------


def install_peers():
    wanted = environments.requirements(HERE / "requirements.txt")
    # The acados wheel carries a slim CasADi for another Python: unpacked beside, not installed.
    beside = [line for line in wanted if "acados" in line]
    environments.environment(PEERS, [line for line in wanted if line not in beside], {WHEEL.name: beside})


def setup(args):
    install_peers()
    say("checking CasADi's problem, generating and compiling the peers' C (many minutes, once)")
    subprocess.run([python(), str(HERE / "peer_ipopt.py"), "check"], check=True, stdout=sys.stderr)
    for name in args.contestants:
        for command in CONTESTANTS[name].prepare:
            for environment in ENVIRONMENTS:
                say(f"preparing {name}, {environment}")
                run_command([part.replace("{}", environment) for part in command], limit=3600)


# --- a run ------------------------------------------------------------------------------------


def load(path):
    return json.loads(path.read_text())


def current_run(args):
    name = args.run or ((RUNS / "latest").read_text() if (RUNS / "latest").exists() else "")
    if not name or not (RUNS / name / "about.json").exists():
        sys.exit("no run to go on with: run.py record begins one")
    return RUNS / name


def record(args):
    name = time.strftime("%Y%m%d-%H%M%S")
    folder = RUNS / name
    (folder / "results").mkdir(parents=True)
    cycles, perturbed = (48, 12) if args.quick else (1000, 250)
    for environment in ENVIRONMENTS:
        say(f"recording {cycles} + {perturbed} cycles in {environment}")
        record_cycles(environment, folder / f"{environment}.cycles", cycles, perturbed, args.seed)
    about = {"run": name, "commit": commit_at_start(), "quick": args.quick, "seed": args.seed, "recorded": cycles,
             "perturbed": perturbed, "machine": machine.describe()}  # fmt: skip
    (folder / "about.json").write_text(json.dumps(about, indent=1))
    (RUNS / "latest").write_text(name)


def write_result(folder, name, key, call):
    """Runs `call` and keeps what it gave, with the run's name and our version."""
    began = time.time()
    try:
        result = call()
    except (RuntimeError, OSError, ValueError) as error:
        result = {"error": str(error)}
        say(f"  {name}: {error}")
    result |= key | {"run": folder.name, "version": commit_at_start(),
                     "took_s": time.time() - began, "load": os.getloadavg()[0]}  # fmt: skip
    (folder / "results" / f"{name}.json").write_text(json.dumps(result))


def jobs(about):
    total = about["recorded"] + about["perturbed"]
    for environment in ENVIRONMENTS:
        for start in STARTS:
            for level in LEVELS:
                for first in range(0, total, CHUNK):
                    yield Job(environment, level, start, first, min(CHUNK, total - first))


def measure(args):
    folder = current_run(args)
    deadline = time.time() + 60 * args.minutes
    wanted = [(c, job) for job in jobs(load(folder / "about.json")) for c in args.contestants
              if job.level in CONTESTANTS[c].levels]  # fmt: skip
    todo = [(c, job) for c, job in wanted if args.again
            or not (folder / "results" / f"{c}_{job.name}.json").exists()]  # fmt: skip
    for i, (name, job) in enumerate(todo):
        if time.time() > deadline:
            say(f"stopped with {len(todo) - i} of {len(wanted)} left; run.py measure goes on")
            sys.exit(3)
        say(f"{i + 1} of {len(todo)}: {name}, {job.name}")
        cycles = folder / f"{job.environment}.cycles"
        key = {"contestant": name, "environment": job.environment, "level": job.level,
               "start": job.start, "first": job.first}  # fmt: skip
        write_result(folder, f"{name}_{job.name}", key,
                     lambda: CONTESTANTS[name].run(job, cycles))  # fmt: skip


def functions(args):
    """One evaluation of all functions in E_C: ours, and CasADi's C and VM."""
    folder = current_run(args)
    cycles, more = ["--cycles", str(folder / "E_C.cycles")], ["--repeats", str(args.repeats)]
    peer = [python(), str(HERE / "time_casadi.py")]
    say("functions")
    write_result(folder, "functions_slalom", {}, lambda: json.loads(
        run_command([program("bench_functions"), *cycles, *more])))  # fmt: skip
    write_result(folder, "functions_casadi", {}, lambda: json.loads(
        run_command([*peer, *cycles, *more, "--dir", str(GENERATED), "--generated",
                     program("bench_generated")])))  # fmt: skip


def report(args):
    folder = current_run(args)
    results = {p.stem: load(p) for p in sorted((folder / "results").glob("*.json"))}
    foreign = [name for name, r in results.items() if r["run"] != folder.name]
    if foreign:
        sys.exit(f"results of another run in {folder}: {', '.join(foreign)}")
    summary = summarise(load(folder / "about.json"), results)
    (folder / "summary.json").write_text(json.dumps(summary, indent=1))
    text = markdown(summary, program("bench_solve"))
    print(text)
    if args.docs:
        write(FOLDER / "benchmarks.md", text)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)  # fmt: skip
    parser.add_argument("steps", nargs="*", metavar="STEP", help=f"of {', '.join(STEPS)}; all")
    parser.add_argument("--quick", action="store_true", help="some dozens of cycles; no docs")
    parser.add_argument("--contestants", default=",".join(DEFAULT),
                        help=f"of {', '.join(CONTESTANTS)}, separated by commas")  # fmt: skip
    parser.add_argument("--run", help="go on with this run rather than the latest")
    parser.add_argument("--again", action="store_true", help="measure anew what is there")
    parser.add_argument("--minutes", type=float, default=1e9, help="of measure; exit 3 after it")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--repeats", type=int, default=300, help="calls of a function")
    parser.add_argument("--core", type=int, default=os.cpu_count() - 1, help="to measure on")
    parser.add_argument("--no-docs", dest="docs", action="store_false",
                        help="leave docs/measured/benchmarks.md alone")  # fmt: skip
    args = parser.parse_args()
    args.steps = args.steps or list(STEPS)
    args.contestants = args.contestants.split(",")
    for given, known in ((args.steps, STEPS), (args.contestants, CONTESTANTS)):
        for name in set(given) - set(known):
            sys.exit(f"run.py: '{name}', expected one of {', '.join(known)}")
    args.docs &= not args.quick
    os.environ |= environments.ONE_THREAD
    everywhere = os.sched_getaffinity(0)
    commit_at_start()
    if args.steps != ["report"]:  # else what is timed may be an older program than the commit says
        build_ours(*PROGRAMS)
    for step in args.steps:
        alone = step in ("measure", "functions")
        os.sched_setaffinity(0, {args.core} if alone else everywhere)
        globals()[step](args)


if __name__ == "__main__":
    main()
