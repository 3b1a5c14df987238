"""Solution.plot and PhasedSolution.plot, behind the extra `plot`."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._core import PhasedSolution, Solution

# Points of each interval's curve: enough for a polynomial of degree 12 to look like one.
SAMPLES = 12


def times(solution: Solution) -> Any:
    """From node to node, each interval's both ends included."""
    shares = np.linspace(0, 1, SAMPLES)
    begins, ends = solution.nodes[:-1, None], solution.nodes[1:, None]
    return np.append(begins + shares[:-1] * (ends - begins), solution.tf)


def plot(solution: Solution | PhasedSolution, **options: Any) -> Any:
    """One axes a state and control over time, the points on the scheme's polynomials; keywords go
    to matplotlib.pyplot.subplots."""
    try:
        from matplotlib import pyplot
    except ImportError as error:
        raise ImportError("plot needs Matplotlib: pip install 'slalom[plot]'") from error
    phases = [solution] if isinstance(solution, Solution) else solution.phases
    names = list(dict.fromkeys(name for p in phases for name in [*p.states, *p.controls]))
    options = {"sharex": True, "squeeze": False, **options}
    figure, axes = pyplot.subplots(len(names), 1, **options)
    for number, phase in enumerate(phases):
        t = times(phase)
        curves, points = phase(t), {**phase.states, **phase.controls}
        for axis, name in zip(axes[:, 0], names):
            if name in curves:
                color = f"C{number % 10}"
                axis.plot(t, curves[name], color=color, label=phase.name)
                axis.plot(phase.t, points[name], ".", color=color)
    for axis, name in zip(axes[:, 0], names):
        axis.set_ylabel(name)
    if len(phases) > 1:
        axes[0, 0].legend()
    axes[-1, 0].set_xlabel("t")
    return figure
