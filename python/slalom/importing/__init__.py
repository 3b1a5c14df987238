"""Scenarios of other formats as scenario files: `commonroad` and `track` make a scene, its `write` the file.

For example, `importing.track("Monza.csv").write("Monza.yaml")`.
"""

from __future__ import annotations

import os

from ._files import BadFile
from ._scene import Scene
from ._track import track
from ._xml import MISSING, ExtraMissing

__all__ = ["BadFile", "ExtraMissing", "Scene", "commonroad", "track"]


def commonroad(
    file: str | os.PathLike[str], *, vehicle: str = "bmw_320i", problem: int | None = None, oncoming: str = "needed"
) -> Scene:
    """A CommonRoad scenario (XML 2018b or 2020a) as one of Slalom, for one of its planning problems.

    `problem` is its id, by default the first. `oncoming` says whether lanes of the other way beside the way
    count as road: "never", "always", or "needed" where something stands that leaves no room beside it.
    Raises BadFile with what is wrong, ExtraMissing without the package's extra `commonroad`, and InvalidValue
    for a vehicle that is none.
    """
    try:
        from ._commonroad import scene_of
    except ImportError:
        raise ExtraMissing(MISSING) from None
    return scene_of(file, vehicle, problem, oncoming)
