"""Solution.to_frame, behind the extra `frame`."""

from __future__ import annotations

from typing import Any

from ._core import Solution


def to_frame(solution: Solution, **options: Any) -> Any:
    """States and controls by name over the index `t`; keywords go to pandas.DataFrame."""
    try:
        import pandas
    except ImportError as error:
        raise ImportError("to_frame needs pandas: pip install 'slalom[frame]'") from error
    index = pandas.Index(solution.t, name="t")
    return pandas.DataFrame({**solution.states, **solution.controls}, index=index, **options)
