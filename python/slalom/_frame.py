"""to_frame of solutions and drives, behind the extra `frame`."""

from __future__ import annotations

from typing import Any

from ._core import Drive, PhasedSolution, Solution, control_names, state_names

WHEELS = ("Fz_rl", "Fz_rr", "Fz_fl", "Fz_fr")


def columns(answer: Solution | Drive) -> dict[str, Any]:
    """Numbers over `t` by name; of a drive as in plant.csv."""
    if isinstance(answer, Solution):
        return {**answer.states, **answer.controls}
    names = (*state_names, *control_names, *WHEELS, "clearance")
    rows = (*answer.states.T, *answer.controls.T, *answer.wheel_loads.T, answer.clearance)
    return dict(zip(names, rows))


def to_frame(answer: Solution | PhasedSolution | Drive, **options: Any) -> Any:
    """By name over the index `t`, of several phases over `phase` and `t`; keywords go to
    pandas.DataFrame."""
    try:
        import pandas
    except ImportError as error:
        raise ImportError("to_frame needs pandas: pip install 'slalom[frame]'") from error
    if isinstance(answer, PhasedSolution):
        frames = {phase.name: to_frame(phase, **options) for phase in answer.phases}
        return pandas.concat(frames, names=["phase"])
    return pandas.DataFrame(columns(answer), index=pandas.Index(answer.t, name="t"), **options)
