"""Foxglove's messages as JSON, as far as a drive needs them, and their JSON schemas."""

from __future__ import annotations

from typing import Any, Iterable

import numpy as np

from ._drive import Array

Message = dict[str, Any]
WORLD = "world"
ZERO = {"sec": 0, "nsec": 0}
NO_POSE = {"position": {"x": 0.0, "y": 0.0, "z": 0.0}, "orientation": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}}
STRIP, LOOP, LIST = 0, 1, 2
"""Kinds of a foxglove.LinePrimitive."""


def time_of(t: float) -> Message:
    """Seconds since the drive's start, as seconds and nanoseconds."""
    nanoseconds = round(t * 1e9)
    return {"sec": nanoseconds // 10**9, "nsec": nanoseconds % 10**9}


def pose_of(x: float, y: float, psi: float, z: float = 0.0) -> Message:
    return {
        "position": {"x": float(x), "y": float(y), "z": float(z)},
        "orientation": {"x": 0.0, "y": 0.0, "z": float(np.sin(psi / 2)), "w": float(np.cos(psi / 2))},
    }


def colour(red: float, green: float, blue: float, alpha: float = 1.0) -> Message:
    return {"r": red, "g": green, "b": blue, "a": alpha}


def line(points: Array, kind: int, thickness: float, tint: Message, z: float = 0.02) -> Message:
    """A line [m] through points (n, 2)."""
    return {
        "type": kind,
        "pose": NO_POSE,
        "thickness": thickness,
        "scale_invariant": False,
        "color": tint,
        "colors": [],
        "indices": [],
        "points": [{"x": float(x), "y": float(y), "z": z} for x, y in points],
    }


def box(length: float, width: float, height: float, pose: Message, tint: Message) -> Message:
    return {"pose": pose, "size": {"x": length, "y": width, "z": height}, "color": tint}


def prism(corners: Array, height: float, tint: Message) -> Message:
    """Triangles of the top and the sides of a convex outline (n, 2)."""
    n = len(corners)
    points = [{"x": float(x), "y": float(y), "z": z} for z in (0.0, height) for x, y in corners]
    top = [k for i in range(1, n - 1) for k in (n, n + i, n + i + 1)]
    sides = [k for i in range(n) for k in (i, (i + 1) % n, n + i, (i + 1) % n, n + (i + 1) % n, n + i)]
    return {"pose": NO_POSE, "points": points, "color": tint, "colors": [], "indices": top + sides}


def text(words: str, x: float, y: float, z: float, size: float, tint: Message) -> Message:
    return {
        "pose": pose_of(x, y, 0.0, z),
        "billboard": True,
        "font_size": size,
        "scale_invariant": False,
        "color": tint,
        "text": words,
    }


def entity(
    name: str,
    t: float,
    *,
    lines: Iterable[Message] = (),
    cubes: Iterable[Message] = (),
    triangles: Iterable[Message] = (),
    texts: Iterable[Message] = (),
    metadata: Iterable[tuple[str, str]] = (),
) -> Message:
    """A foxglove.SceneEntity that stays until one of its name replaces it."""
    return {
        "timestamp": time_of(t),
        "frame_id": WORLD,
        "id": name,
        "lifetime": ZERO,
        "frame_locked": False,
        "metadata": [{"key": key, "value": value} for key, value in metadata],
        "arrows": [],
        "cubes": list(cubes),
        "spheres": [],
        "cylinders": [],
        "lines": list(lines),
        "triangles": list(triangles),
        "texts": list(texts),
        "models": [],
    }


def scene_update(entities: Iterable[Message], deleted: Iterable[tuple[str, float]] = ()) -> Message:
    return {
        "deletions": [{"timestamp": time_of(t), "type": 0, "id": name} for name, t in deleted],
        "entities": list(entities),
    }


def frame_transform(child: str, t: float, x: float, y: float, psi: float) -> Message:
    pose = pose_of(x, y, psi)
    return {
        "timestamp": time_of(t),
        "parent_frame_id": WORLD,
        "child_frame_id": child,
        "translation": pose["position"],
        "rotation": pose["orientation"],
    }


def pose_in_frame(t: float, x: float, y: float, psi: float) -> Message:
    return {"timestamp": time_of(t), "frame_id": WORLD, "pose": pose_of(x, y, psi)}


# Schemas of the messages above: types and required fields as foxglove's own (schemas/jsonschema of its SDK).
def _object(**properties: Any) -> Message:
    return {"type": "object", "properties": properties, "required": list(properties)}


def _list(items: Message) -> Message:
    return {"type": "array", "items": items}


NUMBER, TEXT, BOOLEAN = {"type": "number"}, {"type": "string"}, {"type": "boolean"}
_INTEGER = {"type": "integer"}
_TIME = {
    **_object(sec={"type": "integer", "minimum": 0}, nsec={"type": "integer", "minimum": 0, "maximum": 999999999}),
    "title": "time",
}
_DURATION = {**_object(sec=_INTEGER, nsec={"type": "integer", "minimum": 0, "maximum": 999999999}), "title": "duration"}
_VECTOR = _object(x=NUMBER, y=NUMBER, z=NUMBER)
_QUATERNION = _object(x=NUMBER, y=NUMBER, z=NUMBER, w=NUMBER)
_POSE = _object(position=_VECTOR, orientation=_QUATERNION)
_COLOUR = _object(r=NUMBER, g=NUMBER, b=NUMBER, a=NUMBER)
_MESH = dict(pose=_POSE, points=_list(_VECTOR), color=_COLOUR, colors=_list(_COLOUR), indices=_list(_INTEGER))
_ENTITY = _object(
    timestamp=_TIME,
    frame_id=TEXT,
    id=TEXT,
    lifetime=_DURATION,
    frame_locked=BOOLEAN,
    metadata=_list(_object(key=TEXT, value=TEXT)),
    arrows=_list({"type": "object"}),
    cubes=_list(_object(pose=_POSE, size=_VECTOR, color=_COLOUR)),
    spheres=_list({"type": "object"}),
    cylinders=_list({"type": "object"}),
    lines=_list(
        _object(
            type={
                "type": "integer",
                "oneOf": [
                    {"title": name, "const": k} for k, name in enumerate(("LINE_STRIP", "LINE_LOOP", "LINE_LIST"))
                ],
            },
            thickness=NUMBER,
            scale_invariant=BOOLEAN,
            **_MESH,
        )
    ),
    triangles=_list(_object(**_MESH)),
    texts=_list(
        _object(pose=_POSE, billboard=BOOLEAN, font_size=NUMBER, scale_invariant=BOOLEAN, color=_COLOUR, text=TEXT)
    ),
    models=_list({"type": "object"}),
)
_DELETION = _object(
    timestamp=_TIME,
    type={"type": "integer", "oneOf": [{"title": "MATCHING_ID", "const": 0}, {"title": "ALL", "const": 1}]},
    id=TEXT,
)

SCHEMAS: dict[str, Message] = {
    "foxglove.SceneUpdate": _object(deletions=_list(_DELETION), entities=_list(_ENTITY)),
    "foxglove.FrameTransform": _object(
        timestamp=_TIME, parent_frame_id=TEXT, child_frame_id=TEXT, translation=_VECTOR, rotation=_QUATERNION
    ),
    "foxglove.PoseInFrame": _object(timestamp=_TIME, frame_id=TEXT, pose=_POSE),
}
for _name, _schema in SCHEMAS.items():
    _schema["title"] = _name


def numbers_schema(title: str, names: Iterable[str]) -> Message:
    """Of a message of signals: a number, or null where there is none, for each name."""
    return {
        "title": title,
        "type": "object",
        "properties": {name: {"type": ["number", "string", "null"]} for name in names},
    }
