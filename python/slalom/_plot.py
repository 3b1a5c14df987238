"""plot of solutions and drives, behind the extra `plot`."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._core import Drive, PhasedSolution, Solution, control_names, state_names

# Points of each interval's curve: enough for a polynomial of degree 12 to look like one.
SAMPLES = 12
# Of a drive: what is drawn over time beside the path.
OVER_TIME = ("ux", "ax", "sa", "sr")


def plot(answer: Solution | PhasedSolution | Drive, **options: Any) -> Any:
    """Keywords go to matplotlib.pyplot.subplots."""
    try:
        from matplotlib import pyplot
    except ImportError as error:
        raise ImportError("plot needs Matplotlib: pip install 'slalom[plot]'") from error
    if isinstance(answer, Drive):
        return plot_drive(answer, pyplot, options)
    return plot_phases([answer] if isinstance(answer, Solution) else answer.phases, pyplot, options)


def times(solution: Solution) -> Any:
    """From node to node, each interval's both ends included."""
    shares = np.linspace(0, 1, SAMPLES)
    begins, ends = solution.nodes[:-1, None], solution.nodes[1:, None]
    return np.append(begins + shares[:-1] * (ends - begins), solution.tf)


def plot_phases(phases: list[Solution], pyplot: Any, options: dict[str, Any]) -> Any:
    """One axes a state and control over time: the scheme's polynomials, and the points on them."""
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


def plot_drive(drive: Drive, pyplot: Any, options: dict[str, Any]) -> Any:
    """The path among the obstacles where these were when the drive ended, and over time what
    OVER_TIME names."""
    from matplotlib.patches import Ellipse, Polygon

    figure = pyplot.figure(**{"layout": "constrained", **options})
    grid = figure.add_gridspec(len(OVER_TIME), 2)
    path = figure.add_subplot(grid[:, 0])
    path.plot(drive.states[:, 0], drive.states[:, 1])
    for o in drive.scenario.obstacles:
        if not o.present(drive.time):
            continue
        x, y, psi = o.pose_at(drive.time)[:3]
        corners = o.corners_at(drive.time)
        if len(corners):
            path.add_patch(Polygon(corners, color="C1"))
        else:
            path.add_patch(Ellipse((x, y), 2 * o.a, 2 * o.b, angle=np.degrees(psi), color="C1"))
    path.plot(drive.scenario.goal.x, drive.scenario.goal.y, "C2*")
    path.set_aspect("equal", "datalim")
    path.set_xlabel("x [m]")
    path.set_ylabel("y [m]")
    numbers = np.hstack([drive.states, drive.controls])
    for row, name in enumerate(OVER_TIME):
        axis = figure.add_subplot(grid[row, 1])
        axis.plot(drive.t, numbers[:, (*state_names, *control_names).index(name)])
        axis.set_ylabel(name)
    axis.set_xlabel("t [s]")
    return figure
