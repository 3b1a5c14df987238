"""A drive as MCAP, which Foxglove opens: the scene, and every signal for plots."""

from __future__ import annotations

import json
import math
from typing import Any, BinaryIO, Iterator

import numpy as np

from .. import __version__
from ..importing._xml import ExtraMissing
from . import _foxglove as fox
from ._drive import STATES, Drive
from ._shapes import believed, goal_outline, moves, outline, placed, vehicle_box

FRAME_STEP = 0.05
"""Between scenes [s]."""
BLUE, GREY, RED, GREEN, ORANGE = (
    fox.colour(*rgb)
    for rgb in ((0.16, 0.44, 0.85), (0.45, 0.45, 0.45), (0.80, 0.20, 0.15), (0.15, 0.60, 0.30), (0.93, 0.55, 0.10))
)
GHOSTS = 5
"""How many of a plan's times show where it expects the obstacles."""

Entry = tuple[str, str, float, fox.Message]
"""Topic, schema, time [s] and message."""
SIGNALS = {
    "/state": STATES,
    "/control": ("sr", "jx"),
    "/wheel_loads": ("Fz_rl", "Fz_rr", "Fz_fl", "Fz_fr"),
    "/clearance": ("clearance",),
}


def write_mcap(drive: Drive, stream: BinaryIO) -> None:
    """Writes the drive. Raises ExtraMissing without the package `mcap`."""
    try:
        from mcap.writer import Writer
    except ImportError:
        raise ExtraMissing("the package mcap is missing: python3 -m pip install 'slalom[mcap]'") from None
    writer = Writer(stream)
    writer.start(profile="", library=f"slalom {__version__}")
    writer.add_metadata(
        "slalom", {key: str(drive.summary.get(key)) for key in ("scenario", "planner", "vehicle", "outcome", "message")}
    )
    channels: dict[str, int] = {}
    schemas = dict(fox.SCHEMAS)
    for number, (topic, schema, t, message) in enumerate(sorted(_entries(drive), key=lambda entry: entry[2])):
        if topic not in channels:
            body = schemas.get(schema) or fox.numbers_schema(schema, message)
            data = json.dumps(body).encode()
            channels[topic] = writer.register_channel(topic, "json", writer.register_schema(schema, "jsonschema", data))
        stamp = round(t * 1e9)
        writer.add_message(channels[topic], stamp, json.dumps(message, allow_nan=False).encode(), stamp, number)
    writer.finish()


def _entries(drive: Drive) -> Iterator[Entry]:
    yield from _signals(drive)
    yield from _cycles(drive)
    yield "/map", "foxglove.SceneUpdate", float(drive.t[0]), _map(drive)
    yield from _scenes(drive)
    yield from _plans(drive)


def _plain(value: Any) -> Any:
    """A number that JSON has, else None; text as it is."""
    if isinstance(value, str):
        return value
    return float(value) if math.isfinite(value) else None


def _signals(drive: Drive) -> Iterator[Entry]:
    for topic, names in SIGNALS.items():
        there = [name for name in names if name in drive.plant]
        for k, t in enumerate(drive.t):
            yield topic, "slalom" + topic.replace("/", "."), float(t), {
                name: _plain(drive.plant[name][k]) for name in there
            }


def _cycles(drive: Drive) -> Iterator[Entry]:
    for row in drive.cycles:
        yield "/cycle", "slalom.cycle", row["t0"], {name: _plain(value) for name, value in row.items() if value != ""}


def _map(drive: Drive) -> fox.Message:
    """What stays as it is: road, goal, obstacles that stand."""
    t0 = float(drive.t[0])
    entities = []
    road = drive.scenario.road
    if road is not None:
        lines = [fox.line(edge, fox.STRIP, 0.15, GREY) for edge in (road.edge(left=False), road.edge(left=True))]
        lines += [fox.line(lane, fox.STRIP, 0.08, fox.colour(0.7, 0.7, 0.7)) for lane in road.lanes]
        entities.append(fox.entity("road", t0, lines=lines))
    goal = goal_outline(drive.scenario)
    if goal is not None:
        entities.append(fox.entity("goal", t0, lines=[fox.line(goal, fox.LOOP, 0.2, GREEN)]))
    for obstacle in drive.scenario.obstacles:
        if not moves(obstacle, drive.t):
            entities.append(_body(obstacle, t0, obstacle.pose_at(t0), RED))
    return fox.scene_update(entities)


def _body(obstacle: Any, t: float, pose: Any, tint: fox.Message) -> fox.Message:
    corners = placed(outline(obstacle), pose)
    return fox.entity(
        f"obstacle {obstacle.name}",
        t,
        triangles=[fox.prism(corners, 1.5, tint)],
        texts=[fox.text(obstacle.name, pose[0], pose[1], 2.0, 0.6, GREY)],
    )


def _scenes(drive: Drive) -> Iterator[Entry]:
    """The vehicle, where the axes of its frame are, and what moves."""
    length, width, ahead = vehicle_box(drive.scenario)
    moving = [o for o in drive.scenario.obstacles if moves(o, drive.t)]
    times = np.append(np.arange(drive.t[0], drive.t[-1], FRAME_STEP), drive.t[-1])
    states = drive.at(times)
    gone: set[str] = set()
    for k, t in enumerate(times.tolist()):
        x, y, psi = (float(states[name][k]) for name in ("x", "y", "psi"))
        yield "/tf", "foxglove.FrameTransform", t, fox.frame_transform("vehicle", t, x, y, psi)
        yield "/pose", "foxglove.PoseInFrame", t, fox.pose_in_frame(t, x, y, psi)
        centre = fox.pose_of(x + ahead * np.cos(psi), y + ahead * np.sin(psi), psi, 0.75)
        entities = [fox.entity("vehicle", t, cubes=[fox.box(length, width, 1.5, centre, BLUE)])]
        there = [o for o in moving if o.present(t)]
        entities += [_body(o, t, o.pose_at(t), RED) for o in there]
        absent = {f"obstacle {o.name}" for o in moving} - {f"obstacle {o.name}" for o in there}
        yield "/scene", "foxglove.SceneUpdate", t, fox.scene_update(
            entities, ((name, t) for name in sorted(absent - gone))
        )
        gone = absent


def _plans(drive: Drive) -> Iterator[Entry]:
    """Each plan that was driven, from when it was, and where it expects what moves."""
    moving = [o for o in drive.scenario.obstacles if moves(o, drive.t)]
    for t, row, plan in drive.driven():
        nodes = np.column_stack([plan["x"], plan["y"]])
        entities = [
            fox.entity(
                "plan",
                t,
                lines=[fox.line(nodes, fox.STRIP, 0.25, BLUE, 0.05)],
                metadata=[("cycle", f"{row['cycle']:g}"), ("status", str(row["status"]))],
            )
        ]
        times = np.linspace(plan["t"][0], plan["t"][-1], GHOSTS)
        for obstacle in moving:
            poses = believed(drive, obstacle, float(row["t0"]), times)
            rings = [fox.line(placed(outline(obstacle), pose), fox.LOOP, 0.06, ORANGE) for pose in poses if pose]
            entities.append(fox.entity(f"expected {obstacle.name}", t, lines=rings))
        yield "/plan", "foxglove.SceneUpdate", min(t, float(drive.t[-1])), fox.scene_update(entities)
