"""Where and how fast a vehicle begins, from the initial state of a CommonRoad planning problem."""

from __future__ import annotations

import os
from typing import Any

import numpy as np

import slalom

from ._files import BadFile
from ._line import Array
from ._scene import Vehicle, as_written, no_less, no_more

ROLLS_BACK = 0.5
"""Up to which speed backwards [m/s] a vehicle is taken to stand: what a recording takes for that of one that stands."""
SOURCES = {
    "ux": "speed",
    "ax": "acceleration",
    "sa": "steering",
    "r": "yaw rate",
    "v": "lateral speed",
}
"""What our keys are in words."""


def exact(name: str, value: Any, notes: list[str]) -> float:
    """A number, or the middle of an interval."""
    if hasattr(value, "start"):
        notes.append(f"start: {name} from {value.start:g} to {value.end:g}; its middle is taken")
        return float(value.start + value.end) / 2
    return float(value or 0.0)


def place_of(state: Any) -> Array:
    """The place of the body's centre, or the middle of where it may be."""
    if state.is_uncertain_position:
        centre = state.position.center
        return np.array([centre.x, centre.y])
    return np.asarray(state.position, dtype=float)


def start_of(file: str | os.PathLike[str], state: Any, car: Vehicle, notes: list[str]) -> dict[str, float]:
    """CommonRoad's state is that of the body's centre; ours has the front axle's place and the speeds of the
    centre of gravity."""
    if state.is_uncertain_position:
        notes.append("start: its place is not certain; the middle is taken")
    x, y = place_of(state).tolist()
    psi = exact("its heading", getattr(state, "orientation", 0.0), notes)
    speed, slip = (
        exact(f"its {n}", getattr(state, k, 0.0), notes) for k, n in (("velocity", "speed"), ("slip_angle", "slip"))
    )
    r = exact("its yaw rate", getattr(state, "yaw_rate", 0.0), notes)
    ux = speed * float(np.cos(slip))
    if ux < -ROLLS_BACK:
        raise BadFile(file, f"a start at {ux:g} m/s", "one that does not drive backwards")
    if as_written(ux) < car.ux_min:
        notes.append(f"start: {ux:g} m/s; begins at the {car.ux_min:g} m/s that are the least of the vehicle")
        ux, speed = no_less(car.ux_min), max(speed, 0.0)
    start = {
        "x": x + car.centre * float(np.cos(psi)),
        "y": y + car.centre * float(np.sin(psi)),
        "v": speed * float(np.sin(slip)) + r * (car.centre - car.la),
        "r": r,
        "psi": psi,
        "sa": exact("its steering", getattr(state, "steering_angle", 0.0), notes),
        "ux": ux,
        "ax": exact("its acceleration", getattr(state, "acceleration", 0.0), notes),
    }
    start = _as_the_vehicle_can(car, start, notes)
    return {key: float(value) for key, value in start.items() if value or key in ("x", "y", "psi", "ux")}


def _as_the_vehicle_can(car: Vehicle, start: dict[str, float], notes: list[str]) -> dict[str, float]:
    """The start with as much of each value as the vehicle's limits and wheel loads allow; recorded ones come from
    other vehicles, and from differences of noisy places."""
    kept = {"x": 0.0, "y": 0.0, "psi": 0.0, "ux": no_less(car.ux_min)}
    for key, name in SOURCES.items():
        kept[key] = _most_of(car, kept, key, start[key])
        if kept[key] != start[key]:
            notes.append(f"start: {name} {kept[key]:.3g} in place of {start[key]:.3g}, for more is beyond the vehicle")
    return {**start, **{key: kept[key] for key in SOURCES}}


def _most_of(car: Vehicle, others: dict[str, float], key: str, value: float) -> float:
    """As much of a value as a start may have beside others, all with the digits that the file will have: more of them
    would be rounded, and beyond the limit by that."""

    def accepted(tried: float) -> bool:
        start = {name: as_written(number) for name, number in {**others, key: tried}.items()}
        plain = {"vehicle": car.name, "start": start, "goal": {"x": 0, "y": 100}}
        try:
            slalom.load_scenario(plain)
        except slalom.Error:
            return False
        return True

    if not value or accepted(value):
        return value
    least, most = 0.0, 1.0
    for _ in range(20):
        middle = (least + most) / 2
        least, most = (middle, most) if accepted(no_more(middle * value)) else (least, middle)
    return no_more(least * value)
