"""What of a drive is drawn: outlines in their own frames and poses, in metres and radians."""

from __future__ import annotations

from typing import Any

import numpy as np

import slalom

from ._drive import Array, Drive

# Corners of an ellipse's outline.
AROUND = 32


def vehicle_box(scenario: slalom.Scenario) -> tuple[float, float, float]:
    """Length and width of the body, and how far its centre lies ahead of the front axle's (below zero)."""
    length, width = float(scenario["vehicle.length"]), float(scenario["vehicle.width"])
    return length, width, float(scenario["vehicle.front_overhang"]) - length / 2


def outline(obstacle: slalom.Obstacle) -> Array:
    """Corners of an obstacle in its own frame, (n, 2)."""
    if obstacle.outline is not None:
        return np.array(obstacle.outline)
    angle = np.linspace(0, 2 * np.pi, AROUND, endpoint=False)
    return np.column_stack([obstacle.a * np.cos(angle), obstacle.b * np.sin(angle)])


def placed(corners: Array, pose: tuple[float, ...] | list[float]) -> Array:
    """Corners of a body's own frame in the world's."""
    c, s = np.cos(pose[2]), np.sin(pose[2])
    return np.asarray(corners @ np.array([[c, s], [-s, c]]) + np.asarray(pose[:2]))


def moves(obstacle: slalom.Obstacle, times: Array) -> bool:
    """Whether it is elsewhere, or not there, at some of two hundred of these times."""
    looked_at = times[np.linspace(0, len(times) - 1, min(200, len(times))).astype(int)].tolist()
    first = obstacle.pose_at(looked_at[0])[:3]
    return any(obstacle.pose_at(t)[:3] != first or not obstacle.present(t) for t in looked_at)


def believed(
    drive: Drive, obstacle: slalom.Obstacle, t0: float, times: Array
) -> list[tuple[float, float, float] | None]:
    """Where a plan made at `t0` expects an obstacle at `times`; None where it is not expected."""
    scenario = drive.scenario
    rule = scenario["planner.prediction"] if "planner.prediction" in scenario.keys() else "known"
    # Held, of whatever shape and by whatever rule; a planner that verifies its plans moves them all the same.
    if scenario["planner.method"] == "receding_horizon" and not scenario["planner.moving_avoidance"]:
        times = np.full(len(times), t0)
    if not obstacle.present(t0) and rule != "known":
        return [None] * len(times)
    if rule == "known":
        return [
            (p[0], p[1], p[2]) if obstacle.present(float(t)) else None
            for t, p in ((t, obstacle.pose_at(float(t))) for t in times)
        ]
    x, y, psi, vx, vy, omega = obstacle.pose_at(t0)
    omega = omega if rule == "constant_turn" else 0.0
    return [_turned((x, y, psi, vx, vy, omega), float(t) - t0) for t in times]


def _turned(pose: tuple[float, float, float, float, float, float], ahead: float) -> tuple[float, float, float]:
    """A pose some time ahead at its velocity, which turns by omega."""
    x, y, psi, vx, vy, omega = pose
    angle = omega * ahead
    along, across = (ahead, 0.0) if abs(angle) < 1e-9 else (np.sin(angle) / omega, (1 - np.cos(angle)) / omega)
    return float(x + vx * along - vy * across), float(y + vy * along + vx * across), float(psi + angle)


def goal_outline(scenario: slalom.Scenario) -> Array | None:
    """Corners of the goal's area, or the ends of its line across the road; None of a time and of laps."""
    values: dict[str, Any] = {key: scenario[key] for key in scenario.keys() if key.startswith("goal.")}
    if any(np.isfinite(values.get("goal." + key, np.inf)) for key in ("time", "laps")):
        return None
    if scenario.road is not None and np.isfinite(values.get("goal.s", np.inf)):
        x, y, psi, right, left = scenario.road.at(values["goal.s"])
        return np.array([[x + n * np.cos(psi + np.pi / 2), y + n * np.sin(psi + np.pi / 2)] for n in (-right, left)])
    if np.isfinite(values.get("goal.length", np.inf)):
        half = np.array([values["goal.length"], values["goal.width"]]) / 2
        return placed(
            half * np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]]),
            (values["goal.x"], values["goal.y"], values["goal.psi"]),
        )
    return placed(
        values["goal.sigma"] * np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]]), (values["goal.x"], values["goal.y"], 0.0)
    )
