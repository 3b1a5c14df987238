"""A drive as a recording of Rerun."""

from __future__ import annotations

import pathlib
from typing import Any

import numpy as np

from ..importing._xml import ExtraMissing
from ._drive import Drive
from ._mcap import FRAME_STEP, GHOSTS, SIGNALS
from ._shapes import believed, goal_outline, moves, outline, placed, vehicle_box

TIME = "drive_time"


def write_rerun(drive: Drive, file: pathlib.Path) -> None:
    """Writes the drive. Raises ExtraMissing without the package `rerun-sdk`."""
    try:
        import rerun
    except ImportError:
        raise ExtraMissing("the package rerun-sdk is missing: python3 -m pip install 'slalom[rerun]'") from None
    recording = rerun.RecordingStream(
        "slalom", recording_id=f"{drive.summary.get('scenario')} {drive.summary.get('planner')}"
    )
    recording.save(file)
    _still(rerun, recording, drive)
    _signals(rerun, recording, drive)
    _moving(rerun, recording, drive)
    _plans(rerun, recording, drive)
    recording.flush()
    recording.disconnect()


def _closed(corners: Any) -> Any:
    return np.vstack([corners, corners[:1]])


def _still(rerun: Any, recording: Any, drive: Drive) -> None:
    goal = goal_outline(drive.scenario)
    if goal is not None:
        recording.log("map/goal", rerun.LineStrips2D([_closed(goal)], colors=[38, 153, 77]), static=True)
    road = drive.scenario.road
    if road is not None:
        recording.log(
            "map/road",
            rerun.LineStrips2D([road.edge(left=False), road.edge(left=True)], colors=[115, 115, 115]),
            static=True,
        )
        if len(road.lanes):
            recording.log(
                "map/lanes",
                rerun.LineStrips2D([lane for lane in road.lanes], colors=[180, 180, 180]),
                static=True,
            )
    standing = [o for o in drive.scenario.obstacles if not moves(o, drive.t)]
    if standing:
        rings = [_closed(placed(outline(o), o.pose_at(0.0))) for o in standing]
        recording.log(
            "map/obstacles",
            rerun.LineStrips2D(rings, colors=[204, 51, 38], labels=[o.name for o in standing]),
            static=True,
        )


def _signals(rerun: Any, recording: Any, drive: Drive) -> None:
    columns = [rerun.TimeColumn(TIME, duration=drive.t)]
    for topic, names in SIGNALS.items():
        for name in names:
            if name in drive.plant:
                recording.send_columns(
                    f"signals{topic}/{name}", columns, rerun.Scalars.columns(scalars=drive.plant[name])
                )
    numbers = [name for name, value in (drive.cycles[0] if drive.cycles else {}).items() if isinstance(value, float)]
    for name in numbers:
        rows = [row for row in drive.cycles if isinstance(row[name], float)]
        recording.send_columns(
            f"cycle/{name}",
            [rerun.TimeColumn(TIME, duration=[row["t0"] for row in rows])],
            rerun.Scalars.columns(scalars=[row[name] for row in rows]),
        )


def _moving(rerun: Any, recording: Any, drive: Drive) -> None:
    length, width, ahead = vehicle_box(drive.scenario)
    body = np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]]) * np.array([length, width]) / 2 + [ahead, 0.0]
    moving = [o for o in drive.scenario.obstacles if moves(o, drive.t)]
    times = np.append(np.arange(drive.t[0], drive.t[-1], FRAME_STEP), drive.t[-1])
    states = drive.at(times)
    for k, t in enumerate(times.tolist()):
        recording.set_time(TIME, duration=t)
        pose = [float(states[name][k]) for name in ("x", "y", "psi")]
        recording.log("scene/vehicle", rerun.LineStrips2D([_closed(placed(body, pose))], colors=[41, 112, 217]))
        there = [o for o in moving if o.present(t)]
        rings = [_closed(placed(outline(o), o.pose_at(t))) for o in there]
        recording.log(
            "scene/obstacles", rerun.LineStrips2D(rings, colors=[204, 51, 38], labels=[o.name for o in there])
        )


def _plans(rerun: Any, recording: Any, drive: Drive) -> None:
    moving = [o for o in drive.scenario.obstacles if moves(o, drive.t)]
    for t, row, plan in drive.driven():
        recording.set_time(TIME, duration=min(t, float(drive.t[-1])))
        recording.log(
            "scene/plan", rerun.LineStrips2D([np.column_stack([plan["x"], plan["y"]])], colors=[41, 112, 217])
        )
        times = np.linspace(plan["t"][0], plan["t"][-1], GHOSTS)
        rings = [
            _closed(placed(outline(o), pose))
            for o in moving
            for pose in believed(drive, o, float(row["t0"]), times)
            if pose
        ]
        recording.log("scene/expected", rerun.LineStrips2D(rings, colors=[237, 140, 26]))
