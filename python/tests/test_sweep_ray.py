"""The sweep on a real Ray cluster of this machine gives the table of one process, whatever is killed."""

import csv
import os
import pathlib
import random
import signal
import subprocess
import sys
import threading

import pytest

from slalom import _sweep_ray
from sweeps import STUDY, study, sweep

ray = pytest.importorskip("ray")

MEASURED = {"max_solve_time_s", "median_solve_time_s", "max_cpu_time_s", "p99_cpu_time_s",
            "median_cpu_time_s"}
MARK = "SLALOM_TEST_RAY"


@pytest.fixture(scope="module", autouse=True)
def cluster():
    """Two processors; its processes are known by a mark in their environment."""
    os.environ[MARK] = f"{os.getpid()}"
    os.environ["RAY_USAGE_STATS_ENABLED"] = "0"
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
    yield
    ray.shutdown()


def table(folder):
    with open(folder / "trials.csv", newline="") as file:
        return [{k: v for k, v in row.items() if k not in MEASURED} for row in csv.DictReader(file)]


def processes(word):
    """Of this cluster, those at work on trials: Ray's workers, and the processes below them."""
    found = []
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            line = (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode()
            environment = (folder / "environ").read_bytes().split(b"\0")
        except OSError:
            continue
        if word in line and f"{MARK}={os.getpid()}".encode() in environment:
            found.append(int(folder.name))
    return found


def strike(kills, word, ended):
    dice = random.Random(3)
    struck = 0
    while struck < kills and not ended.wait(dice.uniform(0.3, 0.9)):
        if at_work := processes(word):
            try:
                os.kill(dice.choice(at_work), signal.SIGKILL)
                struck += 1
            except ProcessLookupError:
                pass
    return struck


def test_workers_killed_at_random_leave_the_same_table(tmp_path, capsys):
    file = study(tmp_path, STUDY.replace("0.5, 9]", "0.5, 9, 0.3, 0.35, 0.4, 0.45]") +
                 "repeats: 4\nretries: 10\n")
    sweep(file, tmp_path / "calm")
    ended, struck = threading.Event(), []
    killers = [threading.Thread(target=lambda word=word: struck.append(strike(5, word, ended)))
               for word in ("ray::run_chunk", "serve_trials()")]
    for killer in killers:
        killer.start()
    code = _sweep_ray.main([str(file), "--out", str(tmp_path / "out"), "--chunk-seconds", "0.5"])
    ended.set()
    for killer in killers:
        killer.join()
    assert code == 0
    assert min(struck) >= 1, struck
    assert table(tmp_path / "out") == table(tmp_path / "calm")
    assert "112 trials: 112 run now, 16 failed" in capsys.readouterr().out  # the invalid ones


def test_it_goes_on_where_another_sweep_stopped(tmp_path, capsys):
    file = study(tmp_path)
    sweep(file, tmp_path / "out", limit=3)
    arguments = [str(file), "--out", str(tmp_path / "out")]
    assert _sweep_ray.main([*arguments, "--limit", "4", "--resume"]) == 0
    assert "12 trials: 4 run now, 3 found done" in capsys.readouterr().out
    assert _sweep_ray.main([*arguments, "--quiet"]) == 0
    sweep(file, tmp_path / "calm")
    assert table(tmp_path / "out") == table(tmp_path / "calm")
    assert _sweep_ray.main([*arguments, "--set", "loop.timeout=0.25"]) == 3
    assert "before it changed" in capsys.readouterr().err


def test_a_trial_that_hangs_is_recorded_as_failed(tmp_path, capsys):
    # E_C at this setting takes minutes.
    file = study(tmp_path, "scenario: E_C\nset: {planner.N: 120}\ntime_limit: 4\nretries: 1\n"
                           "axes:\n  - {keys: [loop.tex, loop.timeout], values: [[0.001, 60], [0.5, 0.5]]}\n")
    assert _sweep_ray.main([str(file), "--out", str(tmp_path / "out")]) == 0
    hung, other = table(tmp_path / "out")
    assert hung["outcome"] == "failed" and hung["message"] == "2 attempts; the last: no answer within 4 s"
    assert other["outcome"] == "timeout"


def test_bad_input_is_refused(tmp_path, capsys):
    for arguments, code, part in (
            (["papre", "--out", str(tmp_path / "o")], 2, "did you mean 'paper'"),
            (["paper", "--out", str(tmp_path / "o"), "--set", "loop.tx=1"], 2, "did you mean 'tex'"),
            (["paper", "--out", str(tmp_path / "o"), "--resume"], 3, "nothing to resume")):
        assert _sweep_ray.main(arguments) == code
        error = capsys.readouterr().err
        assert error.startswith("slalom-sweep-ray: ") and error.count("\n") == 1 and part in error
    for arguments in (["paper"], ["paper", "--out", "o", "--chunk-seconds", "0"],
                      ["paper", "--out", "o", "--limit", "-1"],
                      ["paper", "--out", "o", "--force", "--resume"]):
        with pytest.raises(SystemExit) as left:
            _sweep_ray.main(arguments)
        assert left.value.code == 2
    assert list(tmp_path.iterdir()) == []


def test_a_cluster_that_is_not_there_is_said_at_once(tmp_path):
    file = study(tmp_path)
    for address, part in (("127.0.0.1:9", "--address 127.0.0.1:9: "), ("head", "--address head: ")):
        done = subprocess.run(
            [sys.executable, "-m", "slalom._sweep_ray", str(file), "--out", str(tmp_path / "out"),
             "--address", address], capture_output=True, text=True, timeout=60)
        assert (done.returncode, done.stdout) == (2, "") and part in done.stderr
        assert "Traceback" not in done.stderr


def test_a_worker_of_another_kind_is_refused():
    with pytest.raises(Exception, match="a worker has slalom .*, the sweep 0.0.0"):
        _sweep_ray.run_chunk([], "baseline", "0.0.0", 0, 1, 1)
    with pytest.raises(Exception, match="instruction set 'avx10'"):
        _sweep_ray.run_chunk([], "avx10", _sweep_ray._core.__version__, 0, 1, 1)
