"""Solution.to_frame and PhasedSolution.to_frame, behind the extra `frame`."""

from __future__ import annotations

from typing import Any

from ._core import PhasedSolution, Solution


def to_frame(solution: Solution | PhasedSolution, **options: Any) -> Any:
    """States and controls by name over the index `t`, of several phases over `phase` and `t`;
    keywords go to pandas.DataFrame."""
    try:
        import pandas
    except ImportError as error:
        raise ImportError("to_frame needs pandas: pip install 'slalom[frame]'") from error
    if isinstance(solution, PhasedSolution):
        frames = {phase.name: to_frame(phase, **options) for phase in solution.phases}
        return pandas.concat(frames, names=["phase"])
    index = pandas.Index(solution.t, name="t")
    return pandas.DataFrame({**solution.states, **solution.controls}, index=index, **options)
