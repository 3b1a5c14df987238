"""Goals of CommonRoad: rectangles with windows for the front axle's centre, or a time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely

from ._line import Array, lengths, project
from ._obstacles import Clock, area_of
from ._road import Road

PLACES_ALONG = 16
"""Of how many places along the road a rectangle may begin or end."""
SHORTEST = 0.2
"""Least side of a rectangle [m]."""
FROM_EDGE = 0.05
"""How far from the road's edges a rectangle's centre is kept [m]."""
WELL_WITHIN = 0.1
"""How far from the ends of a goal's heading a direction is to be [rad]."""
HEADING = 0.2
"""[rad]"""
FARTHEST_ACROSS = 10.0
"""How far to a side a rectangle may reach [m]."""


@dataclass(frozen=True)
class Wanted:
    """One goal of a planning problem: where the vehicle's centre is to be (None: anywhere) and its lanelets."""

    state: Any
    area: Any
    lanes: tuple[int, ...]


def wanted(problem: Any) -> list[Wanted]:
    """The goals of a planning problem of commonroad-io, of which one is to be reached."""
    goals = []
    lanelets = problem.goal.lanelets_of_goal_position or {}
    for k, state in enumerate(problem.goal.state_list):
        position = getattr(state, "position", None)
        area = None if position is None else shapely.make_valid(area_of(position))
        goals.append(Wanted(state, area, tuple(lanelets.get(k, ()))))
    return goals


def conditions(goal: Wanted, clock: Clock) -> dict[str, float]:
    """Windows of time and speed, as a scenario's goal has them."""
    keys = {}
    time, speed = _interval(getattr(goal.state, "time_step", None)), _interval(getattr(goal.state, "velocity", None))
    if speed and speed[0] > 0:
        keys["ux_min"] = speed[0]
    if speed:
        keys["ux_max"] = speed[1]
    if time:
        first, last = clock(time[0]), clock(time[1])
        if first == last:  # arriving within the step that ends there
            first -= 0.99 * clock.step
        if first > 0:
            keys["t_min"] = first
        keys["t_max"] = last
    return keys


def rectangle(goal: Wanted, road: Road | None, psi: float) -> tuple[dict[str, float], bool]:
    """x, y, psi, length and width of a rectangle in the goal's area, and whether that is less than the area.

    `psi` is the direction of the way there. A rectangle that lies on the road stays as it is.
    """
    position = goal.state.position
    on_road = road is None or road.polygon().buffer(0.05).covers(goal.area)
    if hasattr(position, "rect_center") and on_road:
        return _named(position, _direction(goal, psi)), False
    if road is None:
        return _box(goal.area, psi), True
    area = goal.area.intersection(road.polygon())
    own = [_direction(goal, psi)]
    if hasattr(position, "rect_center"):
        own.append(_named(position, own[0])["psi"])
    chords = _chords(area, road) + [chord for each in own for chord in _chords_in(area, each)]
    agreeing = [chord for chord in chords if abs(_direction(goal, _psi(chord)) - _psi(chord)) % (2 * np.pi) < 1e-6]
    box = _inscribed(area, agreeing)
    return (box if box["length"] and len(agreeing) < len(chords) else _inscribed(area, chords)), True


def heading(goal: Wanted, box: dict[str, float], notes: list[str]) -> dict[str, float]:
    """The heading's tolerance about the rectangle's direction: within the interval that the goal has."""
    interval = _interval(getattr(goal.state, "orientation", None))
    if interval is None:
        return {}
    middle, half = (interval[0] + interval[1]) / 2, (interval[1] - interval[0]) / 2
    off = float(np.angle(np.exp(1j * (box["psi"] - middle))))
    if abs(off) >= half:
        notes.append(f"goal: its heading, {middle:.3f} rad within {half:.3f} rad, is not that of its place")
        return {}
    if abs(off) > 1e-3:
        notes.append(
            f"goal: its heading is within {half - abs(off):.3f} rad of {box['psi']:.3f} rad: "
            f"part of the {half:.3f} rad about {middle:.3f} rad"
        )
    return {"psi_tolerance": half - abs(off)}


def ahead(box: dict[str, float], distance: float) -> dict[str, float]:
    """The rectangle for what lies `distance` ahead of the vehicle's centre: so much narrower that the centre is
    in the goal's, too, while the vehicle is turned against it by at most HEADING, or a quarter of the width."""
    return {
        **box,
        "width": box["width"] - min(2 * distance * float(np.sin(HEADING)), box["width"] / 4),
        "x": box["x"] + distance * float(np.cos(box["psi"])),
        "y": box["y"] + distance * float(np.sin(box["psi"])),
    }


def kept_on(road: Road | None, box: dict[str, float]) -> dict[str, float]:
    """The rectangle with its centre on the road, as much narrower as it is moved: in a bend, what lies ahead of a
    place near the edge is beside it."""
    if road is None:
        return box
    s, left, psi = project(road.line, np.array([box["x"], box["y"]]))
    along = lengths(road.line)
    most, least = np.interp(s, along, road.left) - FROM_EDGE, FROM_EDGE - np.interp(s, along, road.right)
    aside = float(np.clip(left, least, most)) - left
    if not aside or not 0 < s < along[-1]:
        return box
    return {
        **box,
        "x": box["x"] - aside * float(np.sin(psi)),
        "y": box["y"] + aside * float(np.cos(psi)),
        "width": max(box["width"] - 2 * abs(aside), SHORTEST / 2),
    }


def _direction(goal: Wanted, psi: float) -> float:
    """`psi`, or what is nearest to it well within the heading that the goal has."""
    interval = _interval(getattr(goal.state, "orientation", None))
    if interval is None:
        return psi
    middle, half = (interval[0] + interval[1]) / 2, (interval[1] - interval[0]) / 2
    off = float(np.angle(np.exp(1j * (psi - middle))))
    within = half - min(half / 2, WELL_WITHIN)
    return psi + float(np.clip(off, -within, within)) - off


def _named(position: Any, psi: float) -> dict[str, float]:
    """A rectangle of the file, by the one of its four directions that is nearest to `psi`."""
    quarters = int(np.round(float(np.angle(np.exp(1j * (psi - position.orientation)))) / (np.pi / 2)))
    turned = position.orientation + quarters * np.pi / 2
    length, width = (position.length, position.width) if quarters % 2 == 0 else (position.width, position.length)
    return {
        "x": position.rect_center.x,
        "y": position.rect_center.y,
        "psi": float(np.angle(np.exp(1j * turned))),
        "length": length,
        "width": width,
    }


def _corners(x: float, y: float, psi: float, length: float, width: float) -> Any:
    along, across = np.array([np.cos(psi), np.sin(psi)]) * length / 2, np.array([-np.sin(psi), np.cos(psi)]) * width / 2
    centre = np.array([x, y])
    return shapely.Polygon(
        [centre - along - across, centre + along - across, centre + along + across, centre - along + across]
    )


def _box(area: Any, psi: float) -> dict[str, float]:
    """The largest rectangle in that direction about a point in the area."""
    point = area.representative_point()
    length = width = 0.0
    for size in np.geomspace(0.1, 100, 60):
        if area.buffer(0.01).covers(_corners(point.x, point.y, psi, size, size)):
            length = width = float(size)
    return {"x": point.x, "y": point.y, "psi": psi, "length": length, "width": width}


def _psi(chord: tuple[Array, Array]) -> float:
    return float(np.arctan2(*(chord[1] - chord[0])[::-1]))


def _inscribed(area: Any, chords: list[tuple[Array, Array]]) -> dict[str, float]:
    """The largest rectangle along one of the chords that the area holds."""
    best = {"x": 0.0, "y": 0.0, "psi": 0.0, "length": 0.0, "width": 0.0}
    inside = area.buffer(0.02)
    shapely.prepare(inside)
    for a, b in chords:
        length = float(np.hypot(*(b - a)))
        psi, (x, y) = _psi((a, b)), (a + b) / 2
        least, most = best["length"] * best["width"] / length, 2 * FARTHEST_ACROSS
        if not inside.covers(_corners(x, y, psi, length, least + 0.01)):
            continue
        for _ in range(8):
            middle = (least + most) / 2
            least, most = (middle, most) if inside.covers(_corners(x, y, psi, length, middle)) else (least, middle)
        if least * length > best["length"] * best["width"]:
            best = {"x": float(x), "y": float(y), "psi": psi, "length": length, "width": least}
    return best


def _chords(area: Any, road: Road) -> list[tuple[Array, Array]]:
    """Pairs of places along the road, both as far beside its line, between which the area lies."""
    road = road.near(area)
    psi = np.unwrap(np.arctan2(*np.gradient(road.line, axis=0).T[::-1]))
    normal = np.column_stack([-np.sin(psi), np.cos(psi)])
    s = lengths(road.line)
    chords = []
    for share in np.linspace(0.1, 0.9, 9):
        beside = road.line + ((road.left + road.right) * share - road.right)[:, None] * normal
        held = np.flatnonzero(shapely.contains_xy(area, beside))
        if len(held) < 2:
            continue
        grid = np.unique(held[np.linspace(0, len(held) - 1, PLACES_ALONG).round().astype(int)])
        chords += [(beside[i], beside[j]) for k, i in enumerate(grid) for j in grid[k + 1 :] if s[j] - s[i] > SHORTEST]
    return chords


def _chords_in(area: Any, psi: float) -> list[tuple[Array, Array]]:
    """Pairs of places in one direction between which the area lies: the longest on each of some parallel lines."""
    if area.is_empty:
        return []
    along, across = np.array([np.cos(psi), np.sin(psi)]), np.array([-np.sin(psi), np.cos(psi)])
    middle = np.array([area.centroid.x, area.centroid.y])
    size = float(np.hypot(*np.subtract(area.bounds[2:], area.bounds[:2])))
    chords = []
    for beside in np.linspace(-size / 2, size / 2, 2 * PLACES_ALONG + 1):
        line = shapely.LineString([middle + beside * across - size * along, middle + beside * across + size * along])
        parts = line.intersection(area)
        for part in getattr(parts, "geoms", [parts]):
            if part.geom_type == "LineString" and part.length > SHORTEST:
                a, b = np.asarray(part.coords)[[0, -1]]
                half = along * part.length / 2
                # The whole of one that ends at slanting sides is in no rectangle.
                chords += [((a + b) / 2 - share * half, (a + b) / 2 + share * half) for share in (1, 0.75, 0.5, 0.25)]
    return chords


def _interval(value: Any) -> tuple[float, float] | None:
    if value is None:
        return None
    if hasattr(value, "start"):
        return float(value.start), float(value.end)
    return float(value), float(value)
