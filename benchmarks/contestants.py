"""Who takes part, with the commands that prepare and run each, and where everything lies."""

import json
import os
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

from levels import LEVELS

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
sys.path.insert(0, str(ROOT / "tools"))  # for measured.py, environments.py and sweeps.py
BUILD = Path(os.environ.get("SLALOM_BENCH_BUILD", ROOT / "build" / "bench"))
PEERS = BUILD / "peers"  # a virtual environment with CasADi, and the unpacked acados wheel
WHEEL = PEERS / "acados"
GENERATED = BUILD / "generated"
ENVIRONMENTS = ("E_B", "E_C")
CHUNK = 250  # cycles that a contestant is given at a time


def python():
    return str(PEERS / "bin" / "python")


def build_ours(*names):
    """Builds bench_NAME for each of these names: what a page does not need may not compile on every processor."""
    print(f"building our programs in {BUILD}", file=sys.stderr, flush=True)
    quiet = {"check": True, "stdout": subprocess.DEVNULL}
    subprocess.run(["cmake", "-S", str(ROOT), "-B", str(BUILD), "-DCMAKE_BUILD_TYPE=Release",
                    "-DSLALOM_BENCHMARKS=ON", "-DSLALOM_TESTS=OFF"], **quiet)  # fmt: skip
    subprocess.run(["cmake", "--build", str(BUILD), "--parallel", str(os.cpu_count()), "--target",
                    *(f"bench_{name}" for name in names)], **quiet)  # fmt: skip


def program(name):
    found = BUILD / "benchmarks" / name
    if not found.is_file():
        sys.exit(f"{name} is not in {BUILD} (run.py setup builds it)")
    return str(found)


@dataclass(frozen=True)
class Job:
    """Some cycles of one environment, at one level, from one kind of start."""

    environment: str
    level: str
    start: str
    first: int
    count: int

    @property
    def name(self):
        return f"{self.environment}_{self.level}_{self.start}_{self.first}"


@dataclass(frozen=True)
class Contestant:
    name: str
    title: str
    run: callable  # (job, cycles file) -> {"setup_s", "cycles": [...]}
    prepare: list = field(default_factory=list)  # commands an environment, {} its name
    levels: tuple = ("floor", "1e-2", "1e-6")
    same_problem: bool = True  # as ours: comparable answers; else multiple shooting


def run_command(command, limit=1200):
    """Standard output; raises RuntimeError with the command's last words."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        raise RuntimeError(f"no answer within {limit} s") from None
    if done.returncode != 0:
        raise RuntimeError((done.stderr.strip().splitlines() or ["failed"])[-1])
    return done.stdout


def record_cycles(environment, out, cycles, perturbed, seed):
    """The cycles of closed-loop drives from seeded starts, into the file `out`."""
    run_command([program("bench_record"), "--environment", environment, "--cycles", str(cycles),
                 "--perturbed", str(perturbed), "--seed", str(seed), "--out", str(out)])  # fmt: skip


def job_arguments(job, cycles):
    return ["--environment", job.environment, "--cycles", str(cycles), "--start", job.start,
            "--first", str(job.first), "--count", str(job.count)]  # fmt: skip


def run_ours(backend, kernels=None):
    def run(job, cycles):
        level = LEVELS[job.level]
        command = [program("bench_solve"), *job_arguments(job, cycles), "--backend", backend,
                   "--floor", str(level.floor), "--tol", str(level.tol), "--dual-tol",
                   str(level.dual_tol), "--constraint-tol", str(level.violation)]  # fmt: skip
        return json.loads(run_command(command + (["--kernels", kernels] if kernels else [])))

    return run


def run_peer(script, *more):
    def run(job, cycles):
        with tempfile.TemporaryDirectory() as folder:
            out = os.path.join(folder, "out.json")
            run_command([python(), str(HERE / script), "run", *job_arguments(job, cycles),
                         "--level", job.level, "--dir", str(GENERATED), "--out", out, *more])  # fmt: skip
            with open(out) as file:
                return json.load(file)

    return run


def run_ipopt(mode):
    """CasADi's Ipopt; its answers are judged as ours are, by bench_judge."""

    def run(job, cycles):
        with tempfile.TemporaryDirectory() as folder:
            answers = os.path.join(folder, "answers")
            result = run_peer("peer_ipopt.py", "--mode", mode, "--answers", answers)(job, cycles)
            judged = json.loads(run_command(
                [program("bench_judge"), "--environment", job.environment, "--cycles", str(cycles),
                 "--answers", answers, "--floor", str(LEVELS[job.level].floor)]))  # fmt: skip
        result["cycles"] = [a | b for a, b in zip(result["cycles"], judged, strict=True)]
        return result

    return run


def preparation(script, *more):
    return [python(), str(HERE / script), "prepare", "--environment", "{}", "--dir",
            str(GENERATED), *more]  # fmt: skip


TIGHT = ("1e-2", "1e-6")
WITH_WHEEL = ("--wheel", str(WHEEL))
CONTESTANTS = {c.name: c for c in [
    Contestant("slalom", "slalom", run_ours("interior_point")),
    Contestant("casadi-c", "CasADi C + Ipopt", run_ipopt("c"), [preparation("peer_ipopt.py")]),
    Contestant("casadi-vm", "CasADi VM + Ipopt", run_ipopt("vm")),
    Contestant("fatrop", "CasADi C + fatrop", run_peer("peer_fatrop.py"),
               [preparation("peer_fatrop.py")], TIGHT, False),
    Contestant("acados", "acados SQP", run_peer("peer_acados.py", *WITH_WHEEL),
               [preparation("peer_acados.py", *WITH_WHEEL)], TIGHT, False),
    # On demand: no baseline of a ratio, and the other instruction set.
    Contestant("ipopt-debian", "our functions + Debian's Ipopt", run_ours("ipopt")),
    Contestant("slalom-baseline", "slalom, baseline kernels",
               run_ours("interior_point", "baseline")),
]}  # fmt: skip
DEFAULT = ["slalom", "casadi-c", "casadi-vm", "fatrop", "acados"]
