"""What peers.py has done in the environment of the peers, in a process of its own; a line of JSON for each thing found,
as it is found, so that a process that breaks down or is stopped leaves what it found before.

usage: attempt.py ANSWERS reference PROBLEM | attempt.py ANSWERS CONTESTANT PROBLEM REFERENCE
"""

import json
import statistics
import sys
import time

import judge
import statements

INTERVALS = [10, 20, 40, 80, 160, 320]
RUNS = 7
PATIENCE = 20.0  # s: a scheme that takes longer on one mesh gets no finer one


def good_enough(tool, statement, scheme, intervals, reference):
    """What is found of a scheme on a mesh; None where the judge does not find it good."""
    answer, _, _ = tool.solve(statement, scheme, intervals)
    if answer is None:
        return None
    error, gap, good = judge.judge(statement, answer, reference)
    if not good:
        return None
    times = [tool.solve(statement, scheme, intervals) for _ in range(RUNS)]
    return {"scheme": scheme, "intervals": intervals, "error": error, "gap": gap,
            "setup_s": statistics.median(t[1] for t in times), "solve_s": statistics.median(t[2] for t in times)}


def measure(tool, statement, reference):
    """Of each scheme, the first mesh whose answer is good; and that every attempt raised an error, if each did."""
    attempts, errors = 0, []
    for scheme in tool.SCHEMES:
        for intervals in INTERVALS:
            begin = time.perf_counter()
            attempts += 1
            try:
                found = good_enough(tool, statement, scheme, intervals, reference)
            except Exception as error:  # noqa: BLE001  (a peer's own failure is a result)
                errors.append(f"{scheme}, {intervals}: {type(error).__name__}: {' '.join(str(error).split())}")
                found = None
            if found:
                yield found
                break
            if time.perf_counter() - begin > PATIENCE:
                break
    if attempts == len(errors):
        raise SystemExit(f"every attempt raised an error, the last: {errors[-1]}")


def references(problem):
    """The converged objective, by two schemes of Slalom's refinement; both stand on the page."""
    import contestant_slalom as tool  # noqa: PLC0415  (needs the package)

    values = []
    for scheme, refinement in [("lgr", "hp"), ("hermite_simpson", "h")]:
        p, guess = tool.build(statements.by_name(problem))
        refined = p.refine(mesh=40, scheme=scheme, refinement=refinement, tolerance=1e-8, guess=guess)
        values.append(refined.solution.objective)
    yield {"values": values}


def main(answers, what, problem, reference=None):
    if what == "reference":
        found = references(problem)
    else:
        found = measure(__import__("contestant_" + what), statements.by_name(problem), float(reference))
    with open(answers, "a") as file:
        for each in found:
            print(json.dumps(each), file=file, flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
