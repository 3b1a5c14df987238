"""The trials of a sweep in chunks of some seconds, for clusters whose workers may be lost."""

from __future__ import annotations

import collections
import dataclasses
import math
from collections.abc import Callable, Hashable, Sequence
from typing import Protocol

from ._core import Error, OpenSweep

Order = tuple[int, str]
"""A trial and the line a worker is told."""
Result = tuple[int, "str | None", str]
"""A trial, its answer (None: it failed), and why it failed."""

MOST_TRIALS = 1000
"""In one chunk."""
MOST_LOSSES = 50
"""In a row without a result, before giving up: it is not the trials then."""


class Lost(Exception):
    """A chunk whose worker is gone; says how."""


class Cluster(Protocol):
    """What runs chunks."""

    def slots(self) -> int:
        """How many chunks it can take at once."""

    def submit(self, orders: Sequence[Order], seconds: float) -> Hashable:
        """Begins a chunk; trials that have not begun after so many seconds are left out."""

    def wait(self, chunks: Sequence[Hashable]) -> Sequence[Hashable]:
        """Those of the chunks that have ended; waits a moment for one."""

    def result(self, chunk: Hashable) -> tuple[float, Sequence[Result]]:
        """The seconds it took and what came of its trials. Raises Lost."""


@dataclasses.dataclass
class Chunk:
    orders: list[Order]
    losses: int = 0


class ChunkedSweep:
    """Runs what waits of a sweep on a cluster. A lost chunk is halved, down to the trial that loses its
    workers: after `retries` more attempts this one is left to the next sweep, for others took the
    workers away (memory, a batch system, a broken node)."""

    def __init__(self, sweep: OpenSweep, cluster: Cluster, chunk_seconds: float) -> None:
        self._sweep, self._cluster, self._seconds = sweep, cluster, chunk_seconds
        self._again: collections.deque[Chunk] = collections.deque()
        self._running: dict[Hashable, Chunk] = {}
        self._mean: float | None = None  # [s] of one trial, as measured
        self._losses = 0  # in a row
        self.left = 0
        """Trials that lost every worker they had."""

    def run(self, tick: Callable[[], None] = lambda: None) -> None:
        """Returns when no trial waits; calls `tick` now and then. Raises Error when nothing but losses
        comes from the cluster."""
        while self._fill():
            for handle in self._cluster.wait(list(self._running)):
                self._take(handle)
            tick()

    def _fill(self) -> bool:
        while len(self._running) < self._cluster.slots():
            chunk = self._again.popleft() if self._again else self._next()
            if chunk is None:
                break
            # Twice the time, for trials differ; what is left then goes elsewhere.
            self._running[self._cluster.submit(chunk.orders, 2 * self._seconds)] = chunk
        return bool(self._running)

    def _size(self) -> int:
        """Trials of the next chunk: a few seconds' worth, and towards the end a share for each slot."""
        if self._mean is None:
            return 1
        running = sum(len(chunk.orders) for chunk in self._running.values())
        share = math.ceil((self._sweep.pending - running) / self._cluster.slots())
        return max(1, min(int(self._seconds / max(self._mean, 1e-9)), share, MOST_TRIALS))

    def _next(self) -> Chunk | None:
        orders: list[Order] = []
        for _ in range(self._size()):
            order = self._sweep.next()
            if order is None:
                break
            orders.append(order)
        return Chunk(orders) if orders else None

    def _take(self, handle: Hashable) -> None:
        chunk = self._running.pop(handle)
        try:
            seconds, results = self._cluster.result(handle)
        except Lost as lost:
            self._lose(chunk, str(lost))
            return
        if not results:
            self._lose(chunk, "the processes of its trials were killed")
            return
        self._losses = 0
        for trial, answer, reason in results:
            if answer is None:
                self._sweep.record_failed(trial, reason)
            else:
                self._sweep.record(trial, answer)
        done = {trial for trial, _, _ in results}
        if rest := [order for order in chunk.orders if order[0] not in done]:
            self._again.appendleft(Chunk(rest))
        if done:
            mean = seconds / len(done)
            self._mean = mean if self._mean is None else 0.7 * self._mean + 0.3 * mean

    def _lose(self, chunk: Chunk, reason: str) -> None:
        self._losses += 1
        if self._losses >= MOST_LOSSES:
            raise Error(f"{self._losses} workers lost one after the other; the last: {reason}")
        if len(chunk.orders) > 1:
            half = len(chunk.orders) // 2
            self._again.extendleft((Chunk(chunk.orders[half:]), Chunk(chunk.orders[:half])))
            return
        chunk.losses += 1
        if chunk.losses <= self._sweep.retries:
            self._again.appendleft(chunk)
            return
        self.left += 1
