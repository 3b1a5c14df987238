"""slalom-sweep-ray: `slalom sweep` on the processors of a Ray cluster."""

from __future__ import annotations

import argparse
import socket
import sys
import time
from collections.abc import Hashable, Sequence
from typing import Any

from . import _core
from ._chunks import ChunkedSweep, Lost, Order, Result

OK, BAD_INPUT, NOT_WRITTEN, INTERRUPTED = 0, 2, 3, 130
SERVE = "from slalom._core import serve_trials; serve_trials()"


def run_chunk(orders: Sequence[Order], kernels: str, version: str, retries: int, time_limit: float,
              seconds: float) -> tuple[float, list[Result]]:
    """On a worker of the cluster. The trials run in a process below it: one that crashes or hangs is
    found out and tried again there, as on one machine, and costs the worker nothing."""
    if version != _core.__version__:
        raise _core.Error(f"a worker has slalom {_core.__version__}, the sweep {version}")
    _core.require_kernels(kernels)
    begin = time.monotonic()
    results = _core.run_trials(list(orders), [sys.executable, "-c", SERVE], retries, time_limit, seconds)
    return time.monotonic() - begin, results


class RayCluster:
    """The processors of a Ray cluster."""

    def __init__(self, ray: Any, sweep: _core.OpenSweep) -> None:
        self._ray = ray
        self._task = ray.remote(num_cpus=1, max_retries=0)(run_chunk)
        self._settings = (sweep.kernels, _core.__version__, sweep.retries, sweep.time_limit)
        self._slots, self._asked = 0, -1e9
        errors = ray.exceptions
        self._losses = (errors.WorkerCrashedError, errors.NodeDiedError, errors.OutOfMemoryError,
                        errors.ObjectLostError)

    def slots(self) -> int:
        """Two a processor, so that none waits for the next; clusters grow and shrink."""
        if time.monotonic() - self._asked > 5:
            self._slots = 2 * max(1, int(self._ray.cluster_resources().get("CPU", 1)))
            self._asked = time.monotonic()
        return self._slots

    def submit(self, orders: Sequence[Order], seconds: float) -> Hashable:
        handle: Hashable = self._task.remote(orders, *self._settings, seconds)
        return handle

    def wait(self, chunks: Sequence[Hashable]) -> Sequence[Hashable]:
        ended: Sequence[Hashable] = self._ray.wait(list(chunks), timeout=0.5)[0]
        return ended

    def result(self, chunk: Hashable) -> tuple[float, Sequence[Result]]:
        try:
            answered: tuple[float, Sequence[Result]] = self._ray.get(chunk)
            return answered
        except self._losses as error:
            raise Lost(f"{type(error).__name__}: {_first_sentence(error)}") from error
        except self._ray.exceptions.RayTaskError as error:
            raise _core.Error(f"a worker of the cluster: {error.cause}") from error
        except self._ray.exceptions.RayError as error:
            raise _core.Error(f"the cluster: {_first_sentence(error)}") from error


def _first_sentence(error: Exception) -> str:
    return " ".join(str(error).split()).split(". ")[0]


class Progress:
    """One line on the terminal."""

    def __init__(self, sweep: _core.OpenSweep, quiet: bool) -> None:
        self._sweep = sweep
        self._shown = not quiet and sys.stderr.isatty()
        self._begin = time.monotonic()
        self._last = 0.0

    def tick(self) -> None:
        now = time.monotonic()
        if not self._shown or now - self._last < 0.5:
            return
        self._last = now
        s = self._sweep
        rate = s.done / max(now - self._begin, 1e-9)
        print(f"\r\x1b[K{s.name} {s.before + s.done}/{s.total}  {rate:.3g} a second", end="",
              file=sys.stderr, flush=True)

    def clear(self) -> None:
        if self._shown:
            print("\r\x1b[K", end="", file=sys.stderr, flush=True)


def _positive(text: str) -> float:
    value = float(text)
    if not 0 < value < float("inf"):
        raise ValueError
    return value


def _count(text: str) -> int:
    value = int(text)
    if value < 0:
        raise ValueError
    return value


_positive.__name__ = "positive number"  # argparse names it in its message
_count.__name__ = "count"


def _arguments(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="slalom-sweep-ray", description="Drive all trials of a study on a Ray cluster.",
        epilog="The folder is that of 'slalom sweep': each goes on where the other stopped.")
    parser.add_argument("study", metavar="STUDY", help="built-in study (paper, latency, ...) or a YAML file")
    parser.add_argument("--out", metavar="DIR", required=True, help="folder for the results; goes on where it holds some")
    parser.add_argument("--address", help="of the cluster, such as 'auto' or head:6379; without it the one "
                                          "that runs here or a new one on this machine")
    parser.add_argument("--set", metavar="KEY.PATH=VALUE", action="append", default=[], help="set any key for all trials")
    parser.add_argument("--chunk-seconds", metavar="S", type=_positive, default=5.0,
                        help="how long a worker is busy before it answers (default 5)")
    parser.add_argument("--limit", metavar="N", type=_count, help="run at most so many trials now")
    begin = parser.add_mutually_exclusive_group()
    begin.add_argument("--resume", action="store_true", help="refuse to begin anew: DIR must hold this study already")
    begin.add_argument("--force", action="store_true", help="replace what another sweep left in DIR")
    begin.add_argument("--again", choices=["failed"], help="run the trials again that DIR holds as failed")
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    return parser.parse_args(arguments)


def _end_text(sweep: _core.OpenSweep, out: str) -> str:
    text = f"{sweep.total} trials: {sweep.done} run now"
    for count, what in ((sweep.before, "found done"), (sweep.failed, "failed (see the column message)"),
                        (sweep.pending, "left")):
        if count > 0:
            text += f", {count} {what}"
    text += f"\nwritten to {out}/trials.csv"
    return text + ("\nrun the same command again to go on" if sweep.pending > 0 else "")


def _require_reachable(address: str | None) -> None:
    """Ray itself tries for more than a minute."""
    host, _, port = (address or "").rpartition(":")
    if host and port.isdigit() and "/" not in host:
        socket.create_connection((host, int(port)), timeout=10).close()


def _sweep(ray: Any, given: argparse.Namespace) -> int:
    sweep = _core.OpenSweep(given.study, given.out, set=given.set, limit=given.limit,
                            resume=given.resume, force=given.force,
                            again_failed=given.again == "failed")
    code = OK
    progress = Progress(sweep, given.quiet)
    begun_here = not ray.is_initialized()
    try:
        if begun_here:
            _require_reachable(given.address)
            ray.init(address=given.address, log_to_driver=False, logging_level="ERROR")
        chunks = ChunkedSweep(sweep, RayCluster(ray, sweep), given.chunk_seconds)
        chunks.run(progress.tick)
        if chunks.left > 0:
            code = INTERRUPTED
    except KeyboardInterrupt:
        code = INTERRUPTED
    finally:
        progress.clear()
        if begun_here:
            ray.shutdown()  # what still runs for this sweep ends with it
    sweep.finish()
    if not given.quiet:
        print(_end_text(sweep, given.out))
    return code


def main(arguments: Sequence[str] | None = None) -> int:
    given = _arguments(arguments)

    def refuse(code: int, message: object) -> int:
        print(f"slalom-sweep-ray: {message}", file=sys.stderr)
        return code

    try:
        import ray
    except ImportError:
        return refuse(BAD_INPUT, "needs ray: pip install 'slalom[sweep]'")
    try:
        return _sweep(ray, given)
    except _core.InvalidValue as error:
        return refuse(BAD_INPUT, error)
    except (OSError, ValueError) as error:  # of ray.init
        return refuse(BAD_INPUT, f"--address {given.address}: {_first_sentence(error)}")
    except _core.Error as error:
        return refuse(NOT_WRITTEN, error)
    except KeyboardInterrupt:
        return INTERRUPTED


if __name__ == "__main__":
    sys.exit(main())
