#!/usr/bin/env python3
"""Times tools for optimal control on the same problems to the same accuracy, into
docs/measured/peers.md.

Each contestant solves each statement (statements.py) on uniform meshes of 10, 20, 40, ... 320
intervals by each of its schemes; the first mesh of a scheme whose answer judge.py finds good is that
scheme's. There, set-up (from the statement to a solver that may start) and solve are timed, median of
seven, in a process of its own; the contestant's best scheme, by both together, counts. One thread.

usage: peers.py [--out DOC] [--folder DIR] [--contestants a,b] [--problems a,b] [--fresh]

Packages (requirements.txt) and the wheel of the Python package come into DIR/venv. What was measured
at a commit is kept in DIR and not measured again without --fresh.
"""

import argparse
import json
import math
import os
import statistics
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(ROOT / "tools"))
from measured import FOLDER, commit, stamp, write  # noqa: E402

CONTESTANTS = ["slalom", "asset", "casadi", "maptor"]
NAMES = {"slalom": "Slalom", "asset": "ASSET", "casadi": "CasADi + Ipopt", "maptor": "MAPTOR"}
INTERVALS = [10, 20, 40, 80, 160, 320]
RUNS = 7
PATIENCE = 20.0  # s: a scheme that takes longer on one mesh gets no finer one
LIMIT = 1200  # s for a contestant on a problem


def measure(contestant, problem, reference):
    """In a process of its own: what one contestant does on one problem."""
    sys.path.insert(0, str(HERE))
    import judge  # noqa: PLC0415  (needs the environment)
    import statements  # noqa: PLC0415

    tool = __import__("contestant_" + contestant)
    statement = statements.by_name(problem)
    found = []
    for scheme in tool.SCHEMES:
        for intervals in INTERVALS:
            begin = time.perf_counter()
            try:
                answer, _, _ = tool.solve(statement, scheme, intervals)
            except Exception as error:  # noqa: BLE001  (a peer's own failure is a result)
                print(f"{contestant} {problem} {scheme} {intervals}: {error}", file=sys.stderr)
                answer = None
            spent = time.perf_counter() - begin
            good = False
            if answer is not None:
                error, gap, good = judge.judge(statement, answer, reference)
            if good:
                times = [tool.solve(statement, scheme, intervals) for _ in range(RUNS)]
                found.append({
                    "scheme": scheme, "intervals": intervals, "error": error, "gap": gap,
                    "setup_s": statistics.median(t[1] for t in times),
                    "solve_s": statistics.median(t[2] for t in times)})
                break
            if spent > PATIENCE:
                break
    return found


def reference_of(problem):
    """The converged objective, by two schemes of Slalom's refinement that must agree."""
    sys.path.insert(0, str(HERE))
    import contestant_slalom as tool  # noqa: PLC0415
    import statements  # noqa: PLC0415

    statement = statements.by_name(problem)
    values = []
    for scheme, refinement in [("lgr", "hp"), ("hermite_simpson", "h")]:
        p, guess = tool.build(statement)
        refined = p.refine(mesh=40, scheme=scheme, refinement=refinement, tolerance=1e-8,
                           guess=guess)
        values.append(refined.solution.objective)
    return values


def in_environment(folder, *arguments):
    """Runs this script in the environment; its output, or None if it failed or took too long."""
    one_thread = {name: "1" for name in
                  ("OMP_NUM_THREADS", "MKL_NUM_THREADS", "OPENBLAS_NUM_THREADS")}
    try:
        done = subprocess.run([str(folder / "venv/bin/python"), __file__, *arguments],
                              capture_output=True, text=True, timeout=LIMIT,
                              env={**os.environ, **one_thread})
    except subprocess.TimeoutExpired:
        return None
    lines = done.stdout.strip().splitlines()
    return json.loads(lines[-1]) if done.returncode == 0 and lines else None


def set_up(folder):
    """The environment with all contestants."""
    python = folder / "venv/bin/python"
    if not python.exists():
        subprocess.run([sys.executable, "-m", "venv", str(folder / "venv")], check=True)
    subprocess.run([python, "-m", "pip", "install", "-q", "--disable-pip-version-check", "-r",
                    str(HERE / "requirements.txt")], check=True)
    wheels = folder / "wheel"
    subprocess.run([str(ROOT / "tools/python.sh"), "wheel", str(wheels)], check=True)
    subprocess.run([python, "-m", "pip", "install", "-q", "--disable-pip-version-check",
                    "--force-reinstall", "--no-deps", *map(str, wheels.glob("*.whl"))], check=True)


def best(found):
    """The configuration with the least time in all."""
    return min(found, key=lambda f: f["setup_s"] + f["solve_s"]) if found else None


def geometric_mean(values):
    return math.exp(statistics.mean(math.log(v) for v in values)) if values else math.nan


def table(results, problems, titles):
    """Markdown: a row a problem."""
    lines = ["| problem | " + " | ".join(NAMES[c] for c in CONTESTANTS) + " |",
             "|---|" + "---|" * len(CONTESTANTS)]
    for problem in problems:
        cells = []
        for c in CONTESTANTS:
            if c not in results[problem]:
                cells.append("not run")
                continue
            f = best(results[problem][c])
            if f is None:
                cells.append("–")
                continue
            cells.append(f"{1e3 * f['setup_s']:.1f} + {1e3 * f['solve_s']:.1f} "
                         f"({f['scheme']}, {f['intervals']})")
        lines.append(f"| {titles[problem]} | " + " | ".join(cells) + " |")
    return lines


def ratios(results, problems):
    """Of each peer: geometric means over the problems that both solved, and where it was ahead."""
    lines = ["| peer | problems | set-up | solve | both | peer ahead in solve |", "|---|---|---|---|---|---|"]
    for c in CONTESTANTS[1:]:
        pairs = [(p, best(results[p].get("slalom")), best(results[p].get(c))) for p in problems]
        pairs = [(p, a, b) for p, a, b in pairs if a and b]

        def mean(f, pairs=pairs):
            return geometric_mean([f(b) / f(a) for _, a, b in pairs])

        ahead = [p for p, a, b in pairs if b["solve_s"] < a["solve_s"]]
        lines.append(f"| {NAMES[c]} | {len(pairs)} | {mean(lambda f: f['setup_s']):.1f} | "
                     f"{mean(lambda f: f['solve_s']):.1f} | "
                     f"{mean(lambda f: f['setup_s'] + f['solve_s']):.1f} | "
                     f"{', '.join(ahead) or 'none'} |")
    return lines


def page(results, references, titles, stamped):
    """The text of docs/measured/peers.md."""
    problems = list(titles)
    return "\n".join([
        "# Tools for optimal control, on the same problems to the same accuracy", "", stamped,
        "How: `benchmarks/ocp/peers.py`; problems in `statements.py`, accuracy in `judge.py`: every interval,",
        "integrated anew by SciPy's DOP853 with the answer's own controls, ends within 1e-6 (relative) of the",
        "answer's next node, and the objective is within 1e-4 of the converged one. One thread each.", "",
        "## Times: set-up + solve [ms] (scheme, intervals)", "",
        *table(results, problems, titles), "",
        "–: no answer as accurate with up to 320 equal intervals by any of its schemes.", "",
        "## Ratios: the peer's time over Slalom's, geometric means", "", *ratios(results, problems),
        "", "## Converged objectives", "", "| problem | by LGR, hp | by Hermite–Simpson, h |",
        "|---|---|---|",
        *[f"| {titles[p]} | {references[p][0]:.8g} | {references[p][1]:.8g} |" for p in problems],
        ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=FOLDER / "peers.md")
    parser.add_argument("--folder", default=str(ROOT / "build/peers"))
    parser.add_argument("--contestants", default=",".join(CONTESTANTS))
    parser.add_argument("--problems")
    parser.add_argument("--fresh", action="store_true")
    parser.add_argument("--no-set-up", action="store_true", help="the environment is there")
    parser.add_argument("--one", nargs=3, help=argparse.SUPPRESS)
    parser.add_argument("--reference", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.one:
        contestant, problem, reference = arguments.one
        print(json.dumps(measure(contestant, problem, float(reference))))
        return
    if arguments.reference:
        print(json.dumps(reference_of(arguments.reference)))
        return
    folder = Path(arguments.folder).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    if not arguments.no_set_up:
        set_up(folder)
    sys.path.insert(0, str(HERE))
    import statements  # noqa: PLC0415

    titles = {make.__name__: make().name for make in statements.STATEMENTS}
    kept = folder / f"results-{commit()}.json"
    results = json.loads(kept.read_text()) if kept.exists() and not arguments.fresh else {}
    references = results.setdefault("references", {})
    wanted = arguments.problems.split(",") if arguments.problems else list(titles)
    for problem in wanted:
        if problem not in references:
            references[problem] = in_environment(folder, "--reference", problem)
        for contestant in arguments.contestants.split(","):
            of_problem = results.setdefault(problem, {})
            if contestant in of_problem:
                continue
            found = in_environment(folder, "--one", contestant, problem,
                                   repr(references[problem][0]))
            of_problem[contestant] = found
            print(problem, contestant, best(found), flush=True)
            kept.write_text(json.dumps(results, indent=1))
    done = {p: t for p, t in titles.items() if p in results}
    extension = next(folder.glob("venv/lib/python*/site-packages/slalom/*.so"), "")
    write(arguments.out, page(results, references, done, stamp("make peers", extension)))


if __name__ == "__main__":
    main()
