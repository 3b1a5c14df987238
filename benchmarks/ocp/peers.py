#!/usr/bin/env python3
"""Times tools for optimal control on the same problems to the same accuracy, into
docs/measured/peers.md.

    benchmarks/ocp/peers.py [--work DIR] [--contestants a,b] [--problems a,b] [--fresh]

Each contestant solves each statement (statements.py) on uniform meshes of 10, 20, 40, ... 320
intervals by each of its schemes; the first mesh of a scheme whose answer judge.py finds good is that
scheme's. There, set-up (from the statement to a solver that may start) and solve are timed, median of
seven, in a process of its own (attempt.py); the contestant's best scheme, by both together, counts. One
thread.

Packages (requirements.txt) and the wheel of the Python package come into build/peers/venv. What was
measured stays in --work and is not measured again without --fresh; what failed is tried again.
"""

import json
import math
import signal
import statistics
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(ROOT / "tools"))
from environments import environment, one_thread, requirements  # noqa: E402
from measured import command_of, page_parser, stamp, write  # noqa: E402
from sweeps import head, row  # noqa: E402

BUILD = ROOT / "build/peers"
CONTESTANTS = ["slalom", "asset", "casadi", "maptor"]
NAMES = {"slalom": "Slalom", "asset": "ASSET", "casadi": "CasADi + Ipopt", "maptor": "MAPTOR"}
LIMIT = 1200  # s for a contestant on a problem


# --- what is measured -----------------------------------------------------------------------------


def set_up():
    """The interpreter of an environment with all contestants."""
    wheels = BUILD / "wheel"
    subprocess.run([str(ROOT / "tools/python.sh"), "wheel", str(wheels)], check=True)
    return environment(BUILD / "venv", [*requirements(HERE / "requirements.txt"), *wheels.glob("slalom-*.whl")])


def ending(done):
    """Why a process did not end as it should, or nothing."""
    if done.returncode == 0:
        return ""
    if done.returncode < 0:
        return f"killed by {signal.Signals(-done.returncode).name}"
    return (done.stderr.strip().splitlines() or [f"ended with {done.returncode}"])[-1]


def attempt(python, answers, *arguments):
    """Runs attempt.py: what it found, and why it found no more, if it did not end as it should."""
    answers.write_text("")
    try:
        why = ending(subprocess.run([python, str(HERE / "attempt.py"), str(answers), *arguments], capture_output=True,
                                    text=True, timeout=LIMIT, env=one_thread()))  # fmt: skip
    except subprocess.TimeoutExpired:
        why = f"no more within {LIMIT} s"
    whole, _, _ = answers.read_text().rpartition("\n")
    return [json.loads(line) for line in whole.splitlines()], why


def keep(file, results):
    """All but what failed, which the next run tries again."""
    good = {"references": {p: r for p, r in results["references"].items() if not r["failed"]}}
    for problem, of_problem in results.items():
        if problem != "references":
            good[problem] = {c: r for c, r in of_problem.items() if not r["failed"]}
    write(file, json.dumps(good, indent=1))


def measure(python, work, problems, contestants, fresh):
    """{"references": {problem: {"values", "failed"}}, problem: {contestant: {"found", "failed"}}}; "failed": why, or
    nothing."""
    kept, answers = work / "results.json", work / "answers.jsonl"
    results = json.loads(kept.read_text()) if kept.exists() and not fresh else {}
    references = results.setdefault("references", {})
    for problem in problems:
        of_problem = results.setdefault(problem, {})
        if problem not in references:
            found, why = attempt(python, answers, "reference", problem)
            references[problem] = {"values": found[0]["values"] if found else [], "failed": why}
        for contestant in contestants:
            if contestant in of_problem:
                continue
            if not references[problem]["values"]:
                of_problem[contestant] = {"found": [], "failed": "there is no converged objective to compare with"}
                continue
            found, why = attempt(python, answers, contestant, problem, repr(references[problem]["values"][0]))
            of_problem[contestant] = {"found": found, "failed": why}
            print(problem, contestant, best(of_problem[contestant]), why, flush=True)
            keep(kept, results)
    return results


# --- the page -------------------------------------------------------------------------------------


def best(result):
    """The configuration with the least time in all; None without any."""
    found = result["found"] if result else []
    return min(found, key=lambda f: f["setup_s"] + f["solve_s"]) if found else None


def geometric_mean(values):
    return f"{math.exp(statistics.mean(math.log(v) for v in values)):.1f}" if values else "–"


def in_cell(reason):
    return f"failed: {' '.join(reason.split()).replace('|', '/')[:100]}"


def cell(result):
    if result is None:
        return "not run"
    f = best(result)
    if f is None:
        return in_cell(result["failed"]) if result["failed"] else "–"
    return f"{1e3 * f['setup_s']:.1f} + {1e3 * f['solve_s']:.1f} ({f['scheme']}, {f['intervals']})"


def table(results, titles):
    """Markdown: a row a problem; beneath it, what was cut short."""
    text = head(["problem", *(NAMES[c] for c in CONTESTANTS)])
    for problem, title in titles.items():
        text += row([title, *(cell(results[problem].get(c)) for c in CONTESTANTS)])
    text += "\n–: no answer as accurate with up to 320 equal intervals by any of its schemes.\n"
    cut = [f"- {NAMES[c]}, {title}: {in_cell(r['failed'])}" for problem, title in titles.items()
           for c, r in results[problem].items() if r["failed"] and r["found"]]  # fmt: skip
    return text + ("\nNot all schemes were tried:\n\n" + "\n".join(cut) + "\n" if cut else "")


def ratios(results, problems):
    """Of each peer: geometric means over the problems that both solved, and where it was ahead."""
    text = head(["peer", "problems", "set-up", "solve", "both", "peer ahead in solve"])
    for c in CONTESTANTS[1:]:
        pairs = [(p, best(results[p].get("slalom")), best(results[p].get(c))) for p in problems]
        pairs = [(p, a, b) for p, a, b in pairs if a and b]

        def mean(f, pairs=pairs):
            return geometric_mean([f(b) / f(a) for _, a, b in pairs])

        ahead = [p for p, a, b in pairs if b["solve_s"] < a["solve_s"]]
        text += row([NAMES[c], len(pairs), mean(lambda f: f["setup_s"]), mean(lambda f: f["solve_s"]),
                     mean(lambda f: f["setup_s"] + f["solve_s"]), ", ".join(ahead) or "none"])  # fmt: skip
    return text


def converged(references, titles):
    text = head(["problem", "by LGR, hp", "by Hermite–Simpson, h"])
    for problem, title in titles.items():
        values = references[problem]["values"]
        text += row([title, *(f"{value:.8g}" for value in values)] if values
                    else [title, in_cell(references[problem]["failed"]), "–"])  # fmt: skip
    return text


def page(results, titles, stamped):
    """The text of docs/measured/peers.md."""
    return "\n".join([
        "# Tools for optimal control, on the same problems to the same accuracy", "", stamped,
        "How: `benchmarks/ocp/peers.py`; problems in `statements.py`, accuracy in `judge.py`: every interval,",
        "integrated anew by SciPy's DOP853 with the answer's own controls, ends within 1e-6 (relative) of the",
        "answer's next node, the nodes keep to the ends, the states' bounds and the path constraints as closely, and",
        "the objective is within 1e-4 of the converged one. Bounds of controls are not looked at, nor those of states",
        "between nodes. One thread each.", "",
        "## Times: set-up + solve [ms] (scheme, intervals)", "",
        table(results, titles),
        "## Ratios: the peer's time over Slalom's, geometric means", "", ratios(results, list(titles)),
        "## Converged objectives", "", converged(results["references"], titles)])  # fmt: skip


def main():
    parser = page_parser("peers", __doc__)
    parser.prog = "ocp/peers.py"
    parser.add_argument("--contestants", default=",".join(CONTESTANTS))
    parser.add_argument("--problems")
    parser.add_argument("--fresh", action="store_true", help="measure anew what was measured")
    parser.add_argument("--no-set-up", action="store_true", help="the environment is there")
    arguments = parser.parse_args()
    arguments.work.mkdir(parents=True, exist_ok=True)
    python = str(BUILD / "venv/bin/python") if arguments.no_set_up else set_up()
    sys.path.insert(0, str(HERE))
    import statements  # noqa: PLC0415

    titles = {make.__name__: make().name for make in statements.STATEMENTS}
    wanted = arguments.problems.split(",") if arguments.problems else list(titles)
    results = measure(python, arguments.work, wanted, arguments.contestants.split(","), arguments.fresh)
    extension = next(BUILD.glob("venv/lib/python*/site-packages/slalom/*.so"), "")
    made_by = command_of(parser, arguments, "peers", "contestants", "problems")
    known = {problem: title for problem, title in titles.items() if problem in results["references"]}
    write(arguments.out, page(results, known, stamp(made_by, extension)))


if __name__ == "__main__":
    main()
