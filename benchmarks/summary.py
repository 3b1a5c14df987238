"""From a run's results to the numbers of the tables."""

from collections import defaultdict

from contestants import CHUNK, CONTESTANTS, ENVIRONMENTS
from levels import LEVELS
from sweeps import quantile

LIMIT_MS = 500.0  # the planner's default execution horizon: what an unsolved cycle counts as, or its time if longer
REFERENCE = "casadi-c"  # whose answers ours are compared with
PHI, PATH_M = 1e-4, 0.01  # the same answer: relative difference of phi, largest of paths


def solved(entry, level):
    return bool(entry["claimed"] and LEVELS[level].confirms(entry))


class Measured:
    """The cycles of all results: [environment, level, start][contestant][cycle] -> entry. `total` cycles were recorded
    in each environment."""

    def __init__(self, results, total):
        self.table, self.setup, self.errors = defaultdict(lambda: defaultdict(dict)), {}, defaultdict(list)
        for result in results.values():
            if "contestant" not in result:
                continue
            of = result["contestant"], result["environment"]
            if "error" in result:
                self.errors[of].append(result)
                continue
            self.setup.setdefault(of, result["setup_s"])
            for entry in result["cycles"]:
                entry["solved"] = solved(entry, result["level"])
                self.table[of[1], result["level"], result["start"]][of[0]][entry["cycle"]] = entry
        for of, failed in self.errors.items():
            if of in self.setup:
                self.count_unsolved(of[0], failed, total)

    def count_unsolved(self, name, failed, total):
        """The cycles of chunks in which a contestant broke down: without them its figures would be of fewer cycles, and
        of easier ones. One that never ran in an environment has no figures there."""
        for result in failed:
            cycles = self.table[result["environment"], result["level"], result["start"]][name]
            for cycle in range(result["first"], min(result["first"] + CHUNK, total)):
                cycles[cycle] = {"cycle": cycle, "claimed": False, "solved": False, "cpu_s": 0.0, "wall_s": 0.0}

    def failures(self):
        """A sentence for each contestant and environment where something failed."""
        for (name, environment), failed in sorted(self.errors.items()):
            what = (f"failed in {len(failed)} of its chunks of {CHUNK} cycles in {environment}, which count as not solved"
                    if (name, environment) in self.setup else f"did not run in {environment}")  # fmt: skip
            yield f"{CONTESTANTS[name].title} {what}: {failed[-1]['error']}"

    def feasible(self, environment, same_problem):
        """Cycles that a contestant with this problem solved, at any level from any start."""
        found = set()
        for key, by_name in self.table.items():
            for name, cycles in by_name.items():
                if key[0] == environment and CONTESTANTS[name].same_problem == same_problem:
                    found |= {c for c, entry in cycles.items() if entry["solved"]}
        return found


def times(cycles, feasible, setup_s):
    """Of one contestant: milliseconds and iterations over the feasible cycles."""
    entries = [e for c, e in cycles.items() if c in feasible]
    good = [e for e in entries if e["solved"]]
    if not entries:
        return None
    counts = lambda e, s: 1e3 * s if e["solved"] else max(LIMIT_MS, 1e3 * s)
    ms = [counts(e, e["cpu_s"]) for e in entries]
    wall = [counts(e, e["wall_s"]) for e in entries]
    row = {"cpu_ms": spread(ms), "wall_ms": spread(wall), "of": len(entries), "solved": len(good),
           "denied": sum(e["claimed"] and not e["solved"] for e in entries), "all": len(cycles),
           "setup_ms": 1e3 * setup_s}  # fmt: skip
    if good:
        row["iterations"] = spread([e["iterations"] for e in good])
        row["us_per_iteration"] = per_iteration(good)
        row["max_solved_ms"] = max(1e3 * e["cpu_s"] for e in good)
    return row


def per_iteration(entries):
    """Median microseconds an iteration, inside the solver."""
    return quantile([1e6 * e.get("solver_cpu_s", e["cpu_s"]) / max(1, e["iterations"])
                     for e in entries], 0.5)  # fmt: skip


def spread(values):
    return {"median": quantile(values, 0.5), "p95": quantile(values, 0.95),
            "p99": quantile(values, 0.99), "max": max(values)}  # fmt: skip


def compare(ours, theirs, at_floor):
    """Answers of both, cycle by cycle: the same, or other local optima."""
    merit = "phi" if at_floor else "f"
    result = {"both": 0, "same": 0, "phi": 0.0, "path_m": 0.0, "others": []}
    for c, a in ours.items():
        b = theirs.get(c)
        if b is None or not (a["solved"] and b["solved"]):
            continue
        result["both"] += 1
        phi = abs(a[merit] - b[merit]) / max(1, abs(b[merit]))
        path = max(abs(p - q) for p, q in zip(a["path"], b["path"]))
        if phi <= PHI and path <= PATH_M:
            result["same"] += 1
            result["phi"], result["path_m"] = max(result["phi"], phi), max(result["path_m"], path)
        else:
            result["others"].append({"cycle": c, "ours": a[merit], "theirs": b[merit],
                                     "path_m": path})  # fmt: skip
    return result


def functions(results):
    """[place][quantity][contestant] -> microseconds, all samples' median and 95th percentile."""
    ours, theirs = results.get("functions_slalom", {}), results.get("functions_casadi", {})
    if not ours or "error" in ours or "error" in theirs or not theirs:
        return {}
    table = {}
    for place in ("guess", "plan"):
        table[place] = {}
        for quantity in ("all_first", "all_second", "hessian"):
            row = {f"slalom {k}": v[quantity] for k, v in ours[place]["functions_us"].items()}
            row |= {name: v[quantity] for name, v in theirs[place].items()}
            table[place][quantity] = {
                name: {"median": quantile(v, 0.5), "p95": quantile(v, 0.95)}
                for name, v in row.items()}  # fmt: skip
    return table


def summarise(about, results):
    measured = Measured(results, about["recorded"] + about["perturbed"])
    summary = {"about": about, "errors": list(measured.failures()), "limit_ms": LIMIT_MS,
               "versions": sorted({r["version"] for r in results.values()}),
               "load": max((r["load"] for r in results.values()), default=0),
               "environments": {}, "functions": functions(results)}  # fmt: skip
    kernels = {r["kernels"] for r in results.values() if "kernels" in r}
    summary["kernels"] = ", ".join(sorted(kernels))
    for environment in ENVIRONMENTS:
        feasible = {same: measured.feasible(environment, same) for same in (True, False)}
        part = {"feasible": {str(k): len(v) for k, v in feasible.items()}, "groups": []}
        for key, by_name in measured.table.items():
            if key[0] != environment:
                continue
            group = {"level": key[1], "start": key[2], "times": {}, "answers": None}
            for name in CONTESTANTS:
                if name in by_name:
                    row = times(by_name[name], feasible[CONTESTANTS[name].same_problem],
                                measured.setup[name, environment])  # fmt: skip
                    group["times"] |= {name: row} if row else {}
            # At 1e-2 two answers to the same optimum may lie further apart than this judges.
            if "slalom" in by_name and REFERENCE in by_name and key[1] != "1e-2":
                group["answers"] = compare(by_name["slalom"], by_name[REFERENCE], key[1] == "floor")
            part["groups"].append(group)
        order = list(LEVELS)
        part["groups"].sort(key=lambda g: (g["start"] == "cold", order.index(g["level"])))
        summary["environments"][environment] = part
    return summary
