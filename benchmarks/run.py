#!/usr/bin/env python3
"""Times the library beside CasADi on the planner's OCP in E_C and writes docs/benchmarks.md.

Sets up everything it needs: CasADi in benchmarks/.venv, our program in build/bench, CasADi's C in
build/bench/casadi. Then runs the contestants in turn, several rounds, on one core; pools the rounds
and writes the tables (standard output, docs/benchmarks.md) and every sample
(build/bench/benchmarks.json). Use a quiet machine.
"""

import argparse
import json
import os
import platform
import re
import statistics
import subprocess
import sys
from pathlib import Path

from tables import PARTS, POINTS, QUANTITIES, markdown

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
VENV = HERE / ".venv"
BUILD = Path(os.environ.get("SLALOM_BENCH_BUILD", ROOT / "build" / "bench"))
CASADI = BUILD / "casadi"
CYCLES = HERE / "cycles_E_C.json"
PEER = HERE / "time_casadi.py"
COMPILER = "gcc -O3 -march=native"
# What Ipopt calls for each quantity; CasADi's grad_f gives f too, its jac_g gives g.
CALLS = {
    "all_first": ["nlp_grad_f", "nlp_jac_g"],
    "all_second": ["nlp_grad_f", "nlp_jac_g", "nlp_hess_l"],
    "hessian": ["nlp_hess_l"],
}


def say(text):
    print(text, file=sys.stderr, flush=True)


def output_of(*command, default="unknown", **more):
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=True, **more)
        return done.stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return default


# --- set-up -----------------------------------------------------------------------------------


def python():
    return str(VENV / "bin" / "python")


def set_up_venv():
    wanted = (HERE / "requirements.txt").read_text()
    stamp = VENV / "installed.txt"
    if stamp.exists() and stamp.read_text() == wanted:
        return
    say("installing CasADi into benchmarks/.venv")
    subprocess.run([sys.executable, "-m", "venv", str(VENV)], check=True)
    subprocess.run([python(), "-m", "pip", "install", "--quiet", "--disable-pip-version-check",
                    "-r", str(HERE / "requirements.txt")], check=True)  # fmt: skip
    stamp.write_text(wanted)


def build_ours(jobs):
    say("building bench_planner in build/bench")
    quiet = {"check": True, "stdout": subprocess.DEVNULL}
    subprocess.run(["cmake", "-S", str(ROOT), "-B", str(BUILD), "-DCMAKE_BUILD_TYPE=Release",
                    "-DSLALOM_BENCHMARKS=ON", "-DSLALOM_TESTS=OFF"], **quiet)  # fmt: skip
    subprocess.run(["cmake", "--build", str(BUILD), "--parallel", str(jobs), "--target",
                    "bench_planner", "bench_generated"], **quiet)  # fmt: skip


def build_peer():
    """Checks CasADi's problem, generates its C and compiles what changed."""
    say("checking CasADi's problem and compiling its C (minutes, the first time)")
    CASADI.mkdir(parents=True, exist_ok=True)
    subprocess.run([python(), str(PEER), "check"], check=True, stdout=sys.stderr)
    subprocess.run([python(), str(PEER), "prepare", "--dir", str(CASADI), "--compiler", COMPILER],
                   check=True)  # fmt: skip


def program(name):
    found = [p for p in BUILD.rglob(name) if p.is_file()]
    if not found:
        sys.exit(f"{name} is not in build/bench after the build")
    return str(found[0])


# --- rounds -----------------------------------------------------------------------------------


def run_json(command, limit=600):
    """The command's JSON, or {"error": what it said}."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return {"error": f"no answer within {limit} s"}
    if done.returncode != 0:
        return {"error": (done.stderr.strip().splitlines() or ["failed"])[-1]}
    return json.loads(done.stdout)


def contestants(args):
    """Name -> commands of one round, their outputs merged."""
    repeats = ["--repeats", str(args.repeats)]
    ours = [program("bench_planner"), "--cycles", str(CYCLES)]
    result = {}
    for i, backend in enumerate(args.backends):
        functions = repeats if i == 0 else ["--repeats", "0"]
        result[f"slalom, {backend}"] = [[*ours, "--backend", backend, *functions]]
    peer = [python(), str(PEER), "run", "--dir", str(CASADI), *repeats]
    generated = program("bench_generated")
    calls = [[generated, str(CASADI / "all_sx.so"), str(CASADI / f"point_{at}.txt"),
              str(args.repeats), *QUANTITIES] for at in POINTS]  # fmt: skip
    separate = [[generated, str(CASADI / "nlp_sx.so"), str(CASADI / f"point_{at}.txt"),
                 str(args.repeats), *CALLS["all_second"]] for at in POINTS]  # fmt: skip
    result["CasADi C"] = [[*peer, "--mode", "c"], *calls, *separate]
    result["CasADi VM"] = [[*peer, "--mode", "vm"]]
    return result


def merge(name, outputs):
    if name != "CasADi C" or any("error" in o for o in outputs):
        return next((o for o in outputs if "error" in o), outputs[0])
    solves, n = outputs[0], len(POINTS)
    solves["functions_us"] = {
        at: outputs[1 + i] | outputs[1 + n + i] for i, at in enumerate(POINTS)}  # fmt: skip
    return solves


def run_rounds(args):
    commands = contestants(args)
    rounds = {name: [] for name in commands}
    names = list(commands)
    for r in range(args.rounds):
        order = names[r % len(names) :] + names[: r % len(names)]
        for name in order:
            say(f"round {r + 1} of {args.rounds}: {name}")
            rounds[name].append(merge(name, [run_json(c) for c in commands[name]]))
    return rounds


# --- summary ----------------------------------------------------------------------------------


def quantile(values, q):
    values = sorted(values)
    at = q * (len(values) - 1)
    low = int(at)
    high = min(low + 1, len(values) - 1)
    return values[low] + (at - low) * (values[high] - values[low])


def spread(values):
    return {"median": statistics.median(values), "p95": quantile(values, 0.95), "n": len(values)}


def pooled(rounds, path):
    """All rounds' samples at a path of keys, one list."""
    values = []
    for result in rounds:
        for key in path:
            result = result[key]
        values += result
    return values


def function_times(rounds, backends):
    """[point][quantity][contestant] -> spread in microseconds."""
    ours, c, vm = (rounds[n] for n in (f"slalom, {backends[0]}", "CasADi C", "CasADi VM"))
    kernels = [k for k in ("avx2", "baseline") if k in ours[0]["functions_us"]["guess"]]
    table = {}
    for at in POINTS:
        table[at] = {}
        for quantity in QUANTITIES:
            row = {f"slalom {k}": spread(pooled(ours, ["functions_us", at, k, quantity]))
                   for k in kernels}  # fmt: skip
            row["CasADi C, one function"] = spread(pooled(c, ["functions_us", at, quantity]))
            parts = [pooled(c, ["functions_us", at, name]) for name in CALLS[quantity]]
            row["CasADi C, as Ipopt calls"] = spread([sum(times) for times in zip(*parts)])
            row["CasADi VM"] = spread(pooled(vm, ["functions_us", at, quantity]))
            table[at][quantity] = row
    return table


def solve_times(rounds):
    """[contestant] -> cold, first re-solve and all re-solves: milliseconds, iterations, shares."""
    table = {}
    for name, results in rounds.items():
        results = [r for r in results if "error" not in r]
        if not results:
            table[name] = {"error": rounds[name][0]["error"]}
            continue
        entry = {}
        for part, pick in PARTS.items():
            solves = [s for r in results for s in r["solves"][pick]]
            entry[part] = {
                "ms": spread([1e3 * s["wall_s"] for s in solves]),
                "functions_ms": spread([1e3 * s["functions_s"] for s in solves]),
                "iterations": spread([s["iterations"] for s in solves]),
                "ms_per_iteration": spread([1e3 * s["wall_s"] / max(s["iterations"], 1)
                                            for s in solves]),  # fmt: skip
                "solved": sum(s["solved"] for s in solves),
                "of": len(solves),
            }
        table[name] = entry
    return table


def compare_answers(rounds):
    """Each contestant's answers of the first round against CasADi C's, cycle by cycle."""
    reference = rounds["CasADi C"][0]["solves"]
    table = {}
    for name, results in rounds.items():
        if name == "CasADi C" or "error" in results[0]:
            continue
        solves = results[0]["solves"]
        pairs = [(a, b) for a, b in zip(solves, reference) if a["solved"] and b["solved"]]
        table[name] = {
            "cycles": len(pairs),
            "phi": max((abs(a["phi"] - b["phi"]) for a, b in pairs), default=float("nan")),
            "phi_relative": max((abs(a["phi"] - b["phi"]) / max(1, abs(b["phi"]))
                                 for a, b in pairs), default=float("nan")),  # fmt: skip
            "path_m": max((abs(p[i] - q[i]) for a, b in pairs
                           for p, q in zip(a["nodes"], b["nodes"]) for i in (0, 1)),
                          default=float("nan")),  # fmt: skip
            "tf_s": max((abs(a["tf"] - b["tf"]) for a, b in pairs), default=float("nan")),
            "start": max((start_difference(a["start"], b["start"])
                          for a, b in zip(solves, reference)), default=float("nan")),  # fmt: skip
            "confirmed": sum(a.get("confirmed", False) for a in solves),
            "of": len(solves),
        }
    return table


def start_difference(ours, theirs):
    if isinstance(ours, dict):
        flat = [*ours["slacks"], *(v for node in ours["nodes"] for v in node), ours["tf"]]
    else:
        flat = ours
    return max(abs(a - b) for a, b in zip(flat, theirs))


# --- the machine ------------------------------------------------------------------------------


def cpu_model():
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.processor() or "unknown"


def wheel_version(library):
    """Version in the name of a library the CasADi wheel carries."""
    for path in VENV.glob(f"lib/python*/site-packages/casadi/{library}.so.*.*"):
        return path.name.split(".so.")[1]
    return "unknown"


def debian_version(package):
    found = output_of("dpkg-query", "-W", "-f", "${Version}", package)
    return re.sub(r"^\d+:", "", found)


def versions():
    numpy = output_of(python(), "-c", "import numpy; print(numpy.__version__)")
    casadi = output_of(python(), "-c", "import casadi; print(casadi.__version__)")
    return {
        "CPU": f"{cpu_model()}, {os.cpu_count()} cores",
        "system": output_of("sh", "-c", ". /etc/os-release && echo $PRETTY_NAME")
        + f", Linux {platform.release().split('-')[0]}",
        "load before the run": f"{os.getloadavg()[0]:.2f}",
        "slalom": output_of("git", "-C", str(ROOT), "describe", "--always", "--dirty"),
        "compiler": output_of("g++", "--version").splitlines()[0],
        "SLEEF": output_of("pkg-config", "--modversion", "sleef"),
        "our Ipopt": f"{output_of('pkg-config', '--modversion', 'ipopt')} (Debian), MUMPS "
        f"{debian_version('libmumps-seq-dev')}, BLAS {os.path.basename(blas())}",
        "CasADi": f"{casadi} (wheel), numpy {numpy}; C by `{COMPILER}`",
        "CasADi's Ipopt": f"{wheel_version('libipopt')}, MUMPS interface "
        f"{wheel_version('libcoinmumps')}, OpenBLAS, one thread",
    }


def blas():
    return os.path.realpath(output_of("sh", "-c", "ldconfig -p | sed -n 's/.*libblas.so.3 .*=> //p'"
                                      " | head -n 1"))  # fmt: skip


# --- main -------------------------------------------------------------------------------------


def summarise(rounds, args, about):
    first = rounds[f"slalom, {args.backends[0]}"]
    for name, results in rounds.items():
        for result in results:
            if "error" in result and (name.startswith("CasADi") or results is first):
                sys.exit(f"{name}: {result['error']}")
    shape = {k: first[0][k] for k in ("variables", "rows", "jacobian_entries", "hessian_entries")}
    return {
        "rounds": args.rounds, "problem": shape, "versions": about,
        "setup_s": spread([r["setup_s"] for r in first]),
        "generated_mb": (CASADI / "nlp_sx.c").stat().st_size / 1e6,
        "functions_us": function_times(rounds, args.backends),
        "solves": solve_times(rounds), "answers": compare_answers(rounds),
    }  # fmt: skip


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--repeats", type=int, default=300, help="calls of a function a round")
    parser.add_argument("--core", type=int, default=os.cpu_count() - 1, help="to run on")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="of the build")
    parser.add_argument("--backends", default="ipopt", help="ours, separated by commas")
    parser.add_argument("--no-docs", action="store_true", help="leave docs/benchmarks.md alone")
    args = parser.parse_args()
    args.backends = args.backends.split(",")

    set_up_venv()
    build_ours(args.jobs)
    build_peer()
    about = versions()
    os.sched_setaffinity(0, {args.core})
    os.environ |= {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    rounds = run_rounds(args)
    summary = summarise(rounds, args, about)
    text = markdown(summary)
    (BUILD / "benchmarks.json").write_text(json.dumps({"summary": summary, "rounds": rounds}))
    if not args.no_docs:
        (ROOT / "docs").mkdir(exist_ok=True)
        (ROOT / "docs" / "benchmarks.md").write_text(text)
    print(text)


if __name__ == "__main__":
    main()
