"""The vehicle's body on its way: rectangles that a road has to hold."""

from __future__ import annotations

from typing import Any

import numpy as np
import shapely

from ._line import Array, curvature, headings, lengths, project, resampled
from ._scene import Vehicle

LATERAL, TIGHTEST = 4.0, 1 / 6
"""With which lateral acceleration [m/s^2], and in how tight a bend [1/m], a vehicle turns into its lane."""
ALONG, STEP, TURNS_IN_WITHIN = 0.1, 0.5, 20.0
"""Within which direction [rad] it is in it; how far apart the places on the way are, and how long that is [m]."""
BEND = 1 / 50
"""In less of a bend [1/m] a body stays as wide as it is, nearly."""


def body_at(place: Array, psi: float, car: Vehicle) -> Any:
    """The vehicle's rectangle with its front axle at a place."""
    along = np.array([np.cos(psi), np.sin(psi)])
    across = np.array([-along[1], along[0]]) * car.width / 2
    front = place + car.front_overhang * along
    rear = front - car.length * along
    return shapely.Polygon([front - across, front + across, rear + across, rear - across])


def turning_in(start: dict[str, float], car: Vehicle, line: Array) -> list[Any]:
    """The vehicle's rectangle at the start, and while it turns into the direction of a road's line, half a metre
    after the other: at the start's speed, with a lateral acceleration of LATERAL at the most."""
    place, psi = np.array([start["x"], start["y"]]), start["psi"]
    bodies = [body_at(place, psi, car)]
    tightest = min(LATERAL / max(start["ux"], 1e-3) ** 2, TIGHTEST)
    for _ in range(int(TURNS_IN_WITHIN / STEP)):
        off = float(np.angle(np.exp(1j * (project(line, place)[2] - psi))))
        if abs(off) < ALONG:
            break
        psi += float(np.clip(off, -STEP * tightest, STEP * tightest))
        place = place + STEP * np.array([np.cos(psi), np.sin(psi)])
        bodies.append(body_at(place, psi, car))
    return bodies


def in_bends(line: Array, car: Vehicle) -> list[Any]:
    """The vehicle's rectangles where the line bends, half a metre after the other: the front axle follows the line,
    and the rear axle follows the front one (kinematic single-track model without slip)."""
    line = resampled(line, STEP)
    theta, bends = headings(line), np.abs(curvature(line)) > BEND
    step = lengths(line)[-1] / (len(line) - 1)
    psi, bodies = theta[0], []
    for place, direction, bend in zip(line, theta, bends):
        steering = float(np.clip(direction - psi, -1, 1))
        if bend or abs(steering) > BEND * car.wheelbase:
            bodies.append(body_at(place, psi, car))
        psi += step / car.wheelbase * np.sin(steering)
    return bodies
