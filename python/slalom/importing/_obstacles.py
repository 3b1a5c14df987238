"""Obstacles of CommonRoad as those of a scenario file."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Iterator

import numpy as np
import shapely

from ._line import Array

FULLER = 1.25
"""Sets of places of one obstacle, step by step, are put together while their hull has at most this many times
the area of the largest of them."""


SAME_PLACE, SAME_HEADING = 0.5, 0.2
"""Within which [m, rad] an obstacle begins as the vehicle does."""


@dataclass(frozen=True)
class Clock:
    """Time steps of a file [s]: `first` is the one at which the drive begins."""

    step: float
    first: int

    def __call__(self, time_step: float) -> float:
        return (time_step - self.first) * self.step


def obstacles_of(scenario: Any, clock: Clock, place: Array, psi: float, notes: list[str]) -> list[dict[str, Any]]:
    """All obstacles of a scenario of commonroad-io but the vehicle itself, which starts at `place` in the
    direction `psi`; what is not carried over is added to `notes`."""
    made = []
    for obstacle in scenario.static_obstacles:
        made += _standing(obstacle, notes)
    for obstacle in scenario.dynamic_obstacles:
        if _is_the_vehicle(obstacle, clock, place, psi):
            notes.append(f"{_name(obstacle)}: left out, it begins as the vehicle does, and is a drive of it")
        else:
            made += _moving(obstacle, clock, notes)
    for obstacle in scenario.phantom_obstacle:
        name = f"phantom{obstacle.obstacle_id}"
        if obstacle.prediction is None:
            notes.append(f"{name}: says nothing of where it may be; left out")
        else:
            made += list(_swept(name, dict(obstacle.prediction.occupancies), clock, notes))
    for obstacle in scenario.environment_obstacle:
        notes.append(f"{obstacle.obstacle_type.value} {obstacle.obstacle_id}: beside the road, left out")
    return made


def _name(obstacle: Any) -> str:
    return f"{obstacle.obstacle_type.value}{obstacle.obstacle_id}"


def _is_the_vehicle(obstacle: Any, clock: Clock, place: Array, psi: float) -> bool:
    """Whether an obstacle begins where and when the vehicle does: scenarios keep a recorded drive of it so.

    Its place may be told of another point of the body: one whose shape holds the middle of the vehicle is it, too.
    """
    state = obstacle.initial_state
    if _uncertain(state) or state.time_step != clock.first:
        return False
    turned = abs(float(np.angle(np.exp(1j * ((getattr(state, "orientation", None) or 0.0) - psi)))))
    near = np.hypot(*(np.asarray(state.position) - place)) < SAME_PLACE
    return bool(turned < SAME_HEADING and (near or _body(obstacle).covers(shapely.Point(place))))


def _body(obstacle: Any) -> Any:
    return area_of(obstacle.occupancy_at_time(obstacle.initial_state.time_step))


def area_of(occupancy: Any) -> Any:
    """What an occupancy or a goal's place covers. Of a circle, commonroad-io 2026.1 gives one of half the radius."""
    parts = getattr(occupancy, "occupancies", None)
    if parts is not None:
        return shapely.union_all([area_of(part) for part in parts])
    radius = getattr(occupancy, "radius", None)
    return occupancy.shapely_object if radius is None else occupancy.circle_center.buffer(radius)


def _standing(obstacle: Any, notes: list[str]) -> list[dict[str, Any]]:
    name, state = _name(obstacle), obstacle.initial_state
    parts = None if _uncertain(state) else _outlines(obstacle.obstacle_shape, name, notes)
    if parts is None:
        return [{"name": name, **_hull_at_first(obstacle, name, notes)}]
    psi = float(getattr(state, "orientation", None) or 0.0)
    made = []
    for part, (outline, centre) in _named(name, parts):
        x, y = np.asarray(state.position) + _turned(centre, psi)
        made.append(
            {"name": part, "x": float(x), "y": float(y), **outline, **({"psi": psi} if "r" not in outline else {})}
        )
    return made


def _moving(obstacle: Any, clock: Clock, notes: list[str]) -> list[dict[str, Any]]:
    from commonroad.prediction.prediction import TrajectoryPrediction

    name, prediction = _name(obstacle), obstacle.prediction
    if getattr(obstacle, "signal_series", None) or getattr(obstacle, "initial_signal_state", None):
        notes.append(f"{name}: its indicators and lights")
    states = [obstacle.initial_state]
    if prediction is None:
        notes.append(f"{name}: says nothing of where it goes; it goes on as it begins")
        return _unpredicted(obstacle, name, clock, notes)
    parts = None
    if isinstance(prediction, TrajectoryPrediction):
        states += [s for s in prediction.trajectory.state_list if s.time_step > states[0].time_step]
        if not any(map(_uncertain, states)):
            parts = _outlines(prediction.shape, name, notes)
        if parts is None:
            prediction.shape = _about_its_place(prediction.shape)
    if parts is None:
        occupancies = {states[0].time_step: _at_first(obstacle), **prediction.occupancies}
        return list(_swept(name, occupancies, clock, notes))
    states = [s for s in states if s.time_step >= clock.first - 1]
    if not states:
        notes.append(f"{name}: gone before the drive begins")
        return []
    rows = _going_on(states[-1], clock) if len(states) == 1 else _rows(states, clock)
    return _with_table(name, parts, rows, "absent")


def _unpredicted(obstacle: Any, name: str, clock: Clock, notes: list[str]) -> list[dict[str, Any]]:
    """Of an obstacle that says nothing of where it goes."""
    state = obstacle.initial_state
    parts = None if _uncertain(state) else _outlines(obstacle.obstacle_shape, name, notes)
    if parts is not None:
        return _with_table(name, parts, _going_on(state, clock), "goes_on")
    hull = _hull_at_first(obstacle, name, notes)
    row = np.array([clock(state.time_step), hull.pop("x"), hull.pop("y"), 0.0])
    table = np.array([row, row + _step_ahead(state, clock)]).tolist()
    return [{"name": name, **hull, "before": "absent", "after": "goes_on", "table": table}]


def _rows(states: list[Any], clock: Clock) -> Array:
    """t, x, y, psi of each state."""
    psi = np.unwrap([float(getattr(s, "orientation", None) or 0.0) for s in states])
    return np.array([[clock(s.time_step), *s.position, angle] for s, angle in zip(states, psi)], dtype=float)


def _going_on(state: Any, clock: Clock) -> Array:
    """Two rows: where a state is, and one step on by its velocity."""
    row = _rows([state], clock)[0]
    return np.array([row, row + _step_ahead(state, clock)])


def _step_ahead(state: Any, clock: Clock) -> Array:
    """By how much t, x, y, psi change until the next step, by a state's velocity."""
    speed, psi = (_middle(getattr(state, name, None)) for name in ("velocity", "orientation"))
    return clock.step * np.array([1, speed * np.cos(psi), speed * np.sin(psi), 0])


def _middle(value: Any) -> float:
    """A number, or the middle of an interval."""
    return float(value.start + value.end) / 2 if hasattr(value, "start") else float(value or 0.0)


def _with_table(name: str, parts: list[tuple[dict[str, Any], Array]], rows: Array, after: str) -> list[dict[str, Any]]:
    made = []
    for part, (outline, centre) in _named(name, parts):
        moved = rows.copy()
        moved[:, 1:3] += np.array([_turned(centre, psi) for psi in rows[:, 3]])
        made.append({"name": part, **outline, "before": "absent", "after": after, "table": moved.tolist()})
    return made


def _named(name: str, parts: list[Any]) -> Iterator[tuple[str, Any]]:
    for k, part in enumerate(parts, 1):
        yield (name if len(parts) == 1 else f"{name}_{k}"), part


def _outlines(shape: Any, name: str, notes: list[str]) -> list[tuple[dict[str, Any], Array]] | None:
    """Of a rigid shape, the keys of a scenario's obstacle and where their centre is in the shape's own frame;
    None for one that bends, such as a truck with a trailer."""
    from commonroad.geometry.obstacle_shapes.circle_obstacle_shape import CircleObstacleShape
    from commonroad.geometry.obstacle_shapes.polygon_obstacle_shape import PolygonObstacleShape
    from commonroad.geometry.obstacle_shapes.rect_obstacle_shape import RectObstacleShape
    from commonroad.geometry.obstacle_shapes.truck_shape import TruckShape

    if isinstance(shape, RectObstacleShape):
        return [({"length": shape.length, "width": shape.width}, np.array([-shape.origin_x_shift, 0.0]))]
    if isinstance(shape, TruckShape):
        size = {"length": shape.truck_dims.length, "width": shape.truck_dims.width}
        return [(size, np.array([-shape.origin_x_shift, 0.0]))]
    if isinstance(shape, CircleObstacleShape):
        return [({"r": shape.radius}, np.zeros(2))]
    if isinstance(shape, PolygonObstacleShape):
        polygon = shapely.Polygon(shape.vertices)
        if polygon.convex_hull.area > 1.001 * polygon.area:
            notes.append(f"{name}: its outline is not convex; its hull stands for it")
        outline = _polygon(polygon.convex_hull)
        return [({"polygon": outline["polygon"]}, np.array([outline["x"], outline["y"]]))]
    return None


def _about_its_place(shape: Any) -> Any:
    """The shape for places that are not certain. About these, commonroad-io puts a polygon as if it had its middle
    there: in its stead goes the rectangle about the place that holds it."""
    from commonroad.geometry.obstacle_shapes.polygon_obstacle_shape import PolygonObstacleShape
    from commonroad.geometry.obstacle_shapes.rect_obstacle_shape import RectObstacleShape

    if not isinstance(shape, PolygonObstacleShape):
        return shape
    length, width = (2 * np.abs(np.asarray(shape.vertices)).max(axis=0)).tolist()
    return RectObstacleShape(length=length, width=width)


def _at_first(obstacle: Any) -> Any:
    """What an obstacle covers, or may cover, in its initial state."""
    state, shape = obstacle.initial_state, obstacle.obstacle_shape
    return (_about_its_place(shape) if _uncertain(state) else shape).compute_occupancy(state)


def _hull_at_first(obstacle: Any, name: str, notes: list[str]) -> dict[str, Any]:
    why = "its place is not certain; the hull of where it may be"
    notes.append(f"{name}: {why if _uncertain(obstacle.initial_state) else 'its hull'} stands for it")
    return _polygon(_hull(_at_first(obstacle)))


def _swept(name: str, occupancies: dict[Any, Any], clock: Clock, notes: list[str]) -> Iterator[dict[str, Any]]:
    """Of where an obstacle may be at each step, hulls that are there one after the other."""
    steps = sorted(
        (_ends(time_step), _hull(occupancy))
        for time_step, occupancy in occupancies.items()
        if _ends(time_step)[1] >= clock.first
    )
    groups: list[tuple[list[float], Any, float]] = []
    for (first, last), hull in steps:
        if groups:
            times, before, largest = groups[-1]
            together, largest = before.union(hull).convex_hull, max(largest, hull.area)
            # Where it is when the drive begins stays by itself: the vehicle may stand where it comes later.
            if together.area <= FULLER * largest and times[1] > clock.first:
                groups[-1] = ([times[0], max(times[1], last)], together, largest)
                continue
        groups.append(([first, last], hull, hull.area))
    notes.append(f"{name}: where it may be at {len(steps)} steps; {len(groups)} hulls of it, one after the other")
    for k, (times, hull, _) in enumerate(groups, 1):
        outline = _polygon(hull)
        place = [outline.pop("x"), outline.pop("y"), 0.0]
        # Until half-way to the next one's, which begins there.
        rows = [[clock(times[0] - 0.5), *place], [clock(times[1] + 0.5), *place]]
        yield {"name": f"{name}_{k}", **outline, "before": "absent", "after": "absent", "table": rows}


def _ends(time_step: Any) -> tuple[float, float]:
    return (time_step.start, time_step.end) if hasattr(time_step, "start") else (time_step, time_step)


def _hull(occupancy: Any) -> Any:
    return area_of(occupancy).convex_hull.simplify(0.02)


def _polygon(hull: Any) -> dict[str, Any]:
    """Centre, and corners about it, counter-clockwise."""
    corners = np.asarray(shapely.geometry.polygon.orient(hull).exterior.coords)[:-1]
    x, y = hull.centroid.x, hull.centroid.y
    return {"x": x, "y": y, "polygon": (corners - [x, y]).tolist()}


def _uncertain(state: Any) -> bool:
    return bool(state.is_uncertain_position or getattr(state, "is_uncertain_orientation", False))


def _turned(place: Array, psi: float) -> Array:
    return np.array([np.cos(psi) * place[0] - np.sin(psi) * place[1], np.sin(psi) * place[0] + np.cos(psi) * place[1]])
