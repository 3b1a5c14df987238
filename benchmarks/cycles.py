"""Recorded cycles, the command line of peers, and answers on their way to bench_judge."""

import argparse
import json
import os
from dataclasses import dataclass

import numpy as np

from levels import LEVELS


@dataclass
class Cycle:
    index: int
    meta: dict  # t0, tex, in_range, solved, drive, perturbed, has_last, ... (cycle_file.cpp)
    X0p: np.ndarray
    y: np.ndarray  # multipliers of the last plan, as they were; empty without one
    zl: np.ndarray
    zu: np.ndarray
    warm_x: np.ndarray
    cold_x: np.ndarray

    @property
    def form(self):
        return "in_range" if self.meta["in_range"] else "out_of_range"

    @property
    def has_duals(self):
        return bool(self.meta["has_last"]) and self.meta["in_range"] == self.meta["last_in_range"]


class CycleFile:
    """A file of bench_record: names of variables and rows by form, and the cycles."""

    def __init__(self, path):
        with open(path, "rb") as file:
            header = json.loads(file.readline())
            data = np.frombuffer(file.read())
        self.environment, self.forms = header["environment"], header["forms"]
        self.cycles, at = [], 0
        for index in range(header["cycles"]):
            arrays = {}
            for field in header["fields"]:
                size = int(data[at])
                arrays[field] = data[at + 1 : at + 1 + size]
                at += 1 + size
            meta = dict(zip(header["meta"], arrays["meta"]))
            keep = {k: arrays[k] for k in ("X0p", "y", "zl", "zu", "warm_x", "cold_x")}
            self.cycles.append(Cycle(index, meta, **keep))


class Names:
    """Our order of names beside a peer's; what the peer lacks (lifted copies) is NaN on our side."""

    def __init__(self, ours, theirs):
        place = {name: i for i, name in enumerate(ours)}
        self.size = len(ours)
        self.ours = np.array([place[name] for name in theirs])

    def to_peer(self, values):
        return values[self.ours]

    def to_ours(self, values):
        result = np.full(self.size, np.nan)
        result[self.ours] = values
        return result


def split_multipliers(x, lower, upper, lam, floor):
    """zl, zu of bounds of which a peer gives lam = zu - zl alone. At a floor both sides of a
    variable have one: they share the deviation from the central point mu / slack alike."""
    zl, zu = np.maximum(-lam, 0), np.maximum(lam, 0)
    both = np.isfinite(lower) & np.isfinite(upper)
    if floor > 0:
        low, up = floor / (x - lower)[both], floor / (upper - x)[both]
        off = (lam[both] - (up - low)) / (up + low)
        zl[both], zu[both] = low * (1 - off), up * (1 + off)
    return zl, zu


def within(z, slack, most):
    """Multipliers z >= 0 no larger than most / slack: what a loose answer's exceeds of it counts as
    stationarity, as the solver itself counted it, not as complementarity."""
    return np.minimum(np.maximum(z, 0), most / np.maximum(slack, 1e-300))


def write_answer(file, cycle, *arrays):
    """Appends one answer in the form bench_judge reads."""
    for values in (np.array([float(cycle)]), *arrays):
        np.array([float(len(values))]).tofile(file)
        np.ascontiguousarray(values, dtype=float).tofile(file)


FORMS = {"out_of_range": False, "in_range": True}  # goal in range


def peer_arguments(doc, commands, levels=tuple(LEVELS)):
    """The command line that all peers have."""
    parser = argparse.ArgumentParser(description=doc.split("\n")[0])
    parser.add_argument("command", choices=commands)
    parser.add_argument("--environment", default="E_C")
    parser.add_argument("--dir", default=".", type=os.path.abspath, help="of generated C")
    parser.add_argument("--mode", choices=["vm", "c"], default="c")
    parser.add_argument("--cycles", type=os.path.abspath, help="file of bench_record")
    parser.add_argument("--level", choices=levels, default=levels[-1])
    parser.add_argument("--start", choices=["warm", "cold"], default="warm")
    parser.add_argument("--first", type=int, default=0, help="cycle to begin with")
    parser.add_argument("--count", type=int, default=1 << 30, help="cycles to solve")
    parser.add_argument("--options", default="{}", type=json.loads, help="more of the solver's, JSON")
    parser.add_argument("--out", type=os.path.abspath, help="file for the results, JSON")
    return parser


def write_results(args, setup_s, solves):
    with open(args.out, "w") as file:
        json.dump({"setup_s": setup_s, "cycles": solves}, file)
