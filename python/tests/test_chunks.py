"""Chunks of trials on a cluster that loses workers: what is lost, halved, tried again and given up."""

import itertools
import math

import pytest

import slalom
from slalom._chunks import MOST_LOSSES, ChunkedSweep, Lost


class Sweep:
    """A thousand trials, or some, recorded as they come."""

    retries = 2

    def __init__(self, size=1000):
        self.waiting, self.size, self.results = iter(range(1, size + 1)), size, {}

    @property
    def pending(self):
        return self.size - len(self.results)

    def next(self):
        trial = next(self.waiting, None)
        return None if trial is None else (trial, f"order {trial}")

    def record(self, trial, answer):
        assert trial not in self.results
        self.results[trial] = answer

    def record_failed(self, trial, reason):
        self.record(trial, f"failed: {reason}")


class Cluster:
    """Two slots; a chunk with a culprit is lost, one that takes too long is left unfinished."""

    def __init__(self, culprits=(), trial_seconds=0.01, lose=lambda orders: False):
        self.culprits, self.trial_seconds, self.lose = set(culprits), trial_seconds, lose
        self.count, self.running, self.sizes = itertools.count(), {}, []

    def slots(self):
        return 2

    def submit(self, orders, seconds):
        handle = next(self.count)
        self.sizes.append(len(orders))
        self.running[handle] = orders[:max(1, math.ceil(seconds / self.trial_seconds))], orders
        assert len(self.running) <= 2
        return handle

    def wait(self, handles):
        assert set(handles) == set(self.running)
        return handles[-1:]  # any order

    def result(self, handle):
        run, orders = self.running.pop(handle)
        if self.lose(orders) or self.culprits & {trial for trial, _ in orders}:
            raise Lost("died of it")
        return len(run) * self.trial_seconds, [(trial, order.replace("order", "answer"), "")
                                               for trial, order in run]


def run(sweep, cluster, seconds=1.0):
    chunked = ChunkedSweep(sweep, cluster, seconds)
    chunked.run()
    cluster.left = chunked.left
    return cluster


def test_chunks_take_the_time_they_should_and_shrink_towards_the_end():
    sweep = Sweep()
    cluster = run(sweep, Cluster())
    assert sweep.results == {n: f"answer {n}" for n in range(1, 1001)}
    assert cluster.sizes[:2] == [1, 1] and max(cluster.sizes) == 100  # of 10 ms in 1 s
    assert sorted(cluster.sizes[-4:])[0] < 20


def test_one_culprit_costs_itself_alone():
    sweep = Sweep()
    cluster = run(sweep, Cluster(culprits=[500]))
    assert 500 not in sweep.results and cluster.left == 1
    assert sweep.results == {n: f"answer {n}" for n in range(1, 1001) if n != 500}
    calm = len(run(Sweep(), Cluster()).sizes)
    assert len(cluster.sizes) <= calm + 2 * math.ceil(math.log2(100)) + 2


def test_a_worker_lost_by_chance_costs_time_alone():
    lost = itertools.cycle([False, True, False])
    sweep = Sweep()
    run(sweep, Cluster(lose=lambda orders: next(lost) and len(orders) > 1))
    assert sweep.results == {n: f"answer {n}" for n in range(1, 1001)}


def test_many_culprits_beside_each_other():
    sweep = Sweep(40)
    assert run(sweep, Cluster(culprits=range(5, 12))).left == 7
    assert sorted(sweep.results) == [n for n in range(1, 41) if n not in range(5, 12)]


def test_a_trial_whose_processes_are_killed_is_left():
    class Killing(Cluster):
        def result(self, handle):
            seconds, results = super().result(handle)
            return seconds, [result for result in results if result[0] != 7]

    sweep = Sweep(20)
    assert run(sweep, Killing()).left == 1
    assert sorted(sweep.results) == [n for n in range(1, 21) if n != 7]


def test_trials_slower_than_measured_go_elsewhere():
    sweep, cluster = Sweep(100), Cluster(trial_seconds=0.001)
    cluster.wait = lambda handles: (setattr(cluster, "trial_seconds", 0.5), handles[:1])[1]
    run(sweep, cluster)
    assert sweep.results == {n: f"answer {n}" for n in range(1, 101)}


def test_a_cluster_that_loses_everything_is_given_up():
    sweep = Sweep()
    with pytest.raises(slalom.Error, match=f"{MOST_LOSSES} workers lost one after the other.*died of it"):
        run(sweep, Cluster(lose=lambda orders: True))
    assert not sweep.results
