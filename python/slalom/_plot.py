"""Solution.plot, behind the extra `plot`."""

from __future__ import annotations

from typing import Any

from ._core import Solution


def plot(solution: Solution, **options: Any) -> Any:
    """One axes a state and control over time; keywords go to matplotlib.pyplot.subplots."""
    try:
        from matplotlib import pyplot
    except ImportError as error:
        raise ImportError("plot needs Matplotlib: pip install 'slalom[plot]'") from error
    curves = {**solution.states, **solution.controls}
    options = {"sharex": True, "squeeze": False, **options}
    figure, axes = pyplot.subplots(len(curves), 1, **options)
    for axis, (name, values) in zip(axes[:, 0], curves.items()):
        axis.plot(solution.t, values)
        axis.set_ylabel(name)
    axes[-1, 0].set_xlabel("t")
    return figure
