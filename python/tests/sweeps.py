"""A small study for tests, and a sweep of it on a worker of this interpreter."""

from __future__ import annotations

import pathlib
import sys

from slalom import _core

# Twelve trials of about a tenth of a second each, four of them invalid.
STUDY = """
title: small
scenarios: [E_B, E_A]
planners: [P_C, P_D]
set: {loop.timeout: 0.5, planner.tf_max: 8}
axes:
  - {key: loop.tex, values: [0.25, 0.5, 9]}
"""
WORKER = [sys.executable, "-c", "from slalom._core import serve_trials; serve_trials()"]


def study(folder: pathlib.Path, text: str = STUDY) -> pathlib.Path:
    file = folder / "small.yaml"
    file.write_text(text)
    return file


def sweep(file: pathlib.Path, out: pathlib.Path, **options: object) -> _core.OpenSweep:
    """Runs all that waits, as `slalom sweep` does."""
    work = _core.OpenSweep(str(file), out, **options)
    orders = list(iter(work.next, None))
    for trial, answer, reason in _core.run_trials(orders, WORKER, work.retries, work.time_limit, 1e9):
        if answer is None:
            work.record_failed(trial, reason)
        else:
            work.record(trial, answer)
    work.finish()
    return work
