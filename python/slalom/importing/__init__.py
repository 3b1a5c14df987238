"""Scenarios of other formats as scenario files: `commonroad` and `track` make a scene, its `write` the file.

    import slalom.importing
    slalom.importing.track("Monza.csv").write("Monza.yaml")
"""

from ._commonroad import commonroad
from ._files import BadFile
from ._scene import Scene
from ._track import track
from ._xml import ExtraMissing

__all__ = ["BadFile", "ExtraMissing", "Scene", "commonroad", "track"]
