"""CommonRoad scenarios as those of Slalom."""

from __future__ import annotations

import os
import pathlib
from typing import Any

import numpy as np
import shapely

import slalom

from . import _goal
from ._body import in_bends, turning_in
from ._files import BadFile
from ._lanes import Lane, Lanes, at_place, near_place, extended, lanes_of, shortest, without_changes
from ._line import Array, at, lengths, project, without_doubles
from ._obstacles import Clock, obstacles_of
from ._road import BESIDE, Road, holding, joined, road_along
from ._scene import Scene, Vehicle
from ._start import exact, place_of, start_of
from ._xml import EXPECTED, open_file, quiet

ACCELERATION = 4.0
"""By which the road's length for a goal of time alone is reckoned [m/s^2]."""
BEHIND, BEYOND = 15.0, 60.0
"""How much road is kept behind the vehicle and beyond the goal [m]."""
TEX = 0.1
"""Execution horizon [s]: a scene may leave a second to act, and tells the traffic in such steps."""
AT_THE_END = 2.0
"""How far the body stays from the end of the lanes [m]."""
TURNED_AWAY = 10.0
"""What it costs to start in a lane of another direction [m/rad]."""
BESIDE_IT = 10.0
"""What it costs to start in a lane that is beside the vehicle's middle, for each metre."""
BENDS = 0.3
"""How much of the road is kept beside the body in bends [m]: a driven way is off its line."""
NARROWER = 0.15
"""By how much a road may be narrower than its lanes anyway [m], since it is as wide as they are all around."""
TURNS = 2.0
"""The same of a lane's turn ahead, where several lie under a vehicle without a goal of place."""


def scene_of(file: str | os.PathLike[str], vehicle: str, problem: int | None, oncoming: str) -> Scene:
    """See `slalom.importing.commonroad`."""
    try:
        return _scene_of(file, vehicle, problem, oncoming)
    except (BadFile, ImportError, OSError, slalom.Error):
        raise
    except Exception as error:  # what the reader took may still be refused where it is used
        raise BadFile(file, f"what cannot be imported ({type(error).__name__}: {error})", EXPECTED) from error


def _scene_of(file: str | os.PathLike[str], vehicle: str, problem: int | None, oncoming: str) -> Scene:
    car = Vehicle.load(vehicle)
    scenario, problems, unread = open_file(file)
    chosen = chosen_problem(file, problems.planning_problem_dict, problem)
    initial = chosen.initial_state
    clock = Clock(scenario.dt, initial.time_step)
    notes = _left_out(scenario, problems.planning_problem_dict, chosen.planning_problem_id) + unread
    start = start_of(file, initial, car, notes)
    place, psi = place_of(initial), exact("its heading", getattr(initial, "orientation", 0.0), [])
    with quiet():
        obstacles = obstacles_of(scenario, clock, place, psi, notes)
    lanes = lanes_of(scenario.lanelet_network)
    way = _Way(file, lanes, car, initial, oncoming == "always")
    goal, road = _goal_and_road(way, chosen, clock, obstacles)
    blocked = _in_the_way(road, obstacles, car)
    if blocked and oncoming == "needed":
        way = _Way(file, lanes, car, initial, True)
        goal, road = _goal_and_road(way, chosen, clock, obstacles)
        notes.append(f"road: lanes of the other way beside it are added, since {blocked[0]}")
        blocked = _in_the_way(road, obstacles, car)
    if road:
        road, added = _holding_the_start(road, lanes, turning_in(start, car, road.line))
        if added:
            way.notes.append(
                f"road: {added:.2f} m wider about the start, where the vehicle is partly beside its lanes"
            )
    limits = _within_the_map(road, goal, start, car, way) if road else {}
    notes += way.notes + [f"road: {each}" for each in blocked]
    t_max = goal.get("time", goal.get("t_max"))
    return Scene(
        name=pathlib.Path(file).stem,
        file=pathlib.Path(file),
        vehicle=car,
        start=start,
        goal=goal,
        source=[
            f"Imported from {pathlib.Path(file).name}, CommonRoad {scenario.scenario_id.scenario_version}",
            f"Benchmark {scenario.scenario_id}, planning problem {chosen.planning_problem_id}, dt {scenario.dt:g} s",
        ],
        timeout=float(np.ceil(t_max + 1)) if t_max else 60.0,
        points=road.points() if road else [],
        lanes=road.lane_lines() if road else [],
        obstacles=obstacles,
        planner={"base": "P_E_road", "prediction": "known"},
        loop={"tex": TEX},
        limits=limits,
        notes=notes,
    )


def chosen_problem(file: str | os.PathLike[str], problems: dict[int, Any], wanted: int | None) -> Any:
    """The planning problem of that id, or the first."""
    if wanted is not None and wanted not in problems:
        raise BadFile(file, f"no planning problem {wanted}", "one of " + ", ".join(map(str, problems)))
    return problems[wanted if wanted is not None else next(iter(problems))]


def _left_out(scenario: Any, problems: dict[int, Any], chosen: int) -> list[str]:
    """What no scenario file has: each by name."""
    network = scenario.lanelet_network
    notes = [f"planning problem {other}: left out" for other in problems if other != chosen]
    for sign in network.traffic_signs:
        elements = [
            f"{e.traffic_sign_element_id.name} {' '.join(map(str, e.additional_values))}".strip()
            for e in sign.traffic_sign_elements
        ]
        notes.append(f"traffic sign {sign.traffic_sign_id} ({', '.join(elements)}): left out")
    notes += [f"traffic light {light.traffic_light_id}: left out" for light in network.traffic_lights]
    notes += [f"intersection {each.intersection_id}: its right of way is left out" for each in network.intersections]
    lines = [str(lanelet.lanelet_id) for lanelet in network.lanelets if lanelet.stop_line]
    if lines:
        notes.append(f"stop lines of lanelets {', '.join(lines)}: left out")
    return notes


def _holding_the_start(road: Road, lanes: Lanes, bodies: list[Any]) -> tuple[Road, float]:
    """The road so wide that it holds the vehicle's body at the start, and on lanelets those with which it turns in."""
    held = holding(road, bodies[:1])
    added = max(held.wider_than(road) - BESIDE, 0.0)
    near = [lane.polygon.buffer(0.05) for lane in lanes.values() if any(map(lane.polygon.intersects, bodies))]
    area = shapely.union_all(near).buffer(-0.05)
    turning = [body for body in bodies[1:] if area.buffer(0.1).covers(body)]
    if not turning:
        return held, added
    wider = holding(held, turning, area)
    return wider, max(added, wider.wider_than(held) - BESIDE)


class _Way:
    """Ways through a network from where the vehicle starts."""

    def __init__(self, file: str | os.PathLike[str], lanes: Lanes, car: Vehicle, state: Any, oncoming: bool) -> None:
        self.file, self.lanes, self.car, self.oncoming = file, lanes, car, oncoming
        self.notes: list[str] = []
        self.place = place_of(state)
        self.psi = exact("its heading", getattr(state, "orientation", 0.0), [])
        self.speed = exact("its speed", getattr(state, "velocity", 0.0), [])
        self.starts = self._starts()

    def _starts(self) -> dict[int, float]:
        """Lanes that the vehicle may be on, with what it costs to begin there [m]: those under its middle, or
        under its body where they agree more with its direction."""
        near = near_place(self.lanes, self.place, self.psi, self.car.width)
        return {
            lane: TURNED_AWAY * off + BESIDE_IT * away
            for lane, (off, away) in near.items()
            if off < np.pi / 2 and (away < 0.01 or self.lanes[lane].for_cars())
        }

    def goals(self, wanted: _goal.Wanted) -> dict[int, float]:
        """Lanes on which a goal lies, with how far they are from its middle [m]."""
        if wanted.lanes:
            return {lane: 0.0 for lane in wanted.lanes}
        middle = wanted.area.representative_point()
        touched = [lane for lane in self.lanes.values() if lane.polygon.intersection(wanted.area).area > 0.1]
        return {lane.id: 2 * lane.polygon.distance(middle) for lane in touched}

    def road(self, way: list[Lane], ahead: float, target: Array | None) -> Road:
        """Along a way: from behind the vehicle to `ahead` [m] beyond the target, or beyond the start."""
        way = extended(self.lanes, without_changes(self.lanes, way), self.car.length + BEHIND, ahead)
        line = self._beyond(self._from_behind(joined(self.lanes, way)), target)
        s = project(line, self.place)[0]
        end = project(line, target)[0] if target is not None else s
        total = lengths(line)[-1]
        first, last = max(s - self.car.length / 2 - BEHIND - 15, 0.0), min(end + ahead + 15, total)
        inner = [first, *(k for k in lengths(line) if first < k < last), last]
        road = road_along(self.lanes, way, without_doubles(at(line, np.array(inner))), self.oncoming)
        s = project(road.line, self.place)[0]
        end = project(road.line, target)[0] if target is not None else s
        road = self._holding_bends(road.between(s - self.car.length / 2 - BEHIND, end + ahead))
        return self._wide_enough(road, target)

    def _holding_bends(self, road: Road) -> Road:
        """The road so wide that it holds the vehicle's body in bends, as far as there are lanes for cars beside it."""
        bodies = in_bends(road.line, self.car)
        if not bodies:
            return road
        lanes = [lane.polygon.buffer(0.05) for lane in self.lanes.values() if lane.for_cars()]
        held = holding(road, bodies, shapely.union_all([*lanes, road.area]).buffer(-0.05), BENDS)
        added = held.wider_than(road)
        if added > NARROWER:
            self.notes.append(f"road: up to {added:.2f} m wider in bends, over other lanes, for the vehicle's body")
        return held

    def _from_behind(self, line: Array) -> Array:
        """A line that begins ahead of the vehicle's rear is led on straight to behind it."""
        s, _, psi = project(line, self.place)
        short = self.car.length / 2 + 2.0 - s
        if short <= 0:
            return line
        self.notes.append(f"road: begins {s:.1f} m behind the vehicle's middle; {short:.1f} m are added behind it")
        return np.vstack([line[0] - short * np.array([np.cos(psi), np.sin(psi)]), line])

    def _beyond(self, line: Array, target: Array | None) -> Array:
        """A line that ends before the vehicle's front at the goal is led on straight to beyond it."""
        if target is None:
            return line
        s, _, psi = project(line, target)
        short = self.car.length / 2 + 2.0 - (lengths(line)[-1] - s)
        if short <= 0:
            return line
        self.notes.append(f"road: ends before the vehicle's front at the goal; {short:.1f} m are added beyond it")
        return np.vstack([line, line[-1] + short * np.array([np.cos(psi), np.sin(psi)])])

    def _wide_enough(self, road: Road, target: Array | None) -> Road:
        """The part about start and target that is wider than the vehicle."""
        narrow = np.flatnonzero(road.left + road.right < self.car.width + 0.1)
        along = lengths(road.line)
        s = project(road.line, self.place)[0]
        end = project(road.line, target)[0] if target is not None else s
        between = [k for k in narrow if s <= along[k] <= end]
        if between:
            k = between[0]
            raise BadFile(
                self.file,
                f"a road {road.left[k] + road.right[k]:.2f} m wide at ({road.line[k, 0]:.1f}, "
                f"{road.line[k, 1]:.1f})",
                f"more than the {self.car.width:g} m of the vehicle",
            )
        first = max((along[k + 1] for k in narrow if along[k] < s), default=0.0)
        last = min((along[k - 1] for k in narrow if along[k] > end), default=road.length)
        return road.between(first, last)


def _goal_and_road(
    way: _Way, problem: Any, clock: Clock, obstacles: list[dict[str, Any]]
) -> tuple[dict[str, float], Road | None]:
    goals = _goal.wanted(problem)
    placed = [goal for goal in goals if goal.area is not None]
    if not placed:
        return _as_far_as_possible(way, goals, clock, obstacles)
    reached = [way.goals(goal) for goal in placed]
    if not way.starts and not any(reached):
        way.notes.append("road: neither start nor goal lies on a lanelet; there is none")
        return _goal_keys(placed, 0, None, way.psi, way, clock), None
    _must_start_on_a_lane(way)
    found = [(answer, k) for k, lanes in enumerate(reached) if (answer := shortest(way.lanes, way.starts, lanes))]
    if not found:
        to = sorted({lane for lanes in reached for lane in lanes})
        if not to:
            middle = placed[0].area.representative_point()
            raise _off_the_road(way, "goal", middle.x, middle.y)
        raise BadFile(
            way.file,
            f"no way from lanelet {_some(way.starts)} to the goal on lanelet {_some(to)}",
            "one over successors and lanes beside each other",
        )
    (_, lanes), k = min(found, key=lambda each: each[0][0])
    middle = placed[k].area.intersection(lanes[-1].polygon).representative_point()
    road = way.road(lanes, _reach(placed[k].area) + BEYOND, np.array([middle.x, middle.y]))
    psi = project(road.line, np.array([middle.x, middle.y]))[2]
    return _goal_keys(placed, k, road, psi, way, clock), road


def _reach(area: Any) -> float:
    """How far an area's farthest point may be from one in it [m]."""
    box = area.bounds
    return float(np.hypot(box[2] - box[0], box[3] - box[1]))


def _goal_keys(
    goals: list[_goal.Wanted], k: int, road: Road | None, psi: float, way: _Way, clock: Clock
) -> dict[str, float]:
    """Of the goal that is taken, for the front axle's centre."""
    way.notes += [
        f"goal {n} of {len(goals)}: left out, a nearer one is taken" for n in range(1, len(goals) + 1) if n != k + 1
    ]
    goal = goals[k]
    box, less = _goal.rectangle(goal, road, psi)
    if min(box["length"], box["width"]) < _goal.SHORTEST:
        raise BadFile(way.file, "a goal off the road", "one that lies on it")
    if less:
        way.notes.append(f"goal: a rectangle of {box['length']:.1f} m by {box['width']:.1f} m in it, on the road")
    keys = {**_goal.kept_on(road, _goal.ahead(box, way.car.centre)), **_goal.heading(goal, box, way.notes)}
    return {**keys, **_goal.conditions(goal, clock)}


def _as_far_as_possible(
    way: _Way, goals: list[_goal.Wanted], clock: Clock, obstacles: list[dict[str, Any]]
) -> tuple[dict[str, float], Road | None]:
    """A goal without a place is one of time; without a time, until the traffic's last row."""
    time = _goal.conditions(goals[0], clock).get("t_max") if goals else None
    if goals and (getattr(goals[0].state, "velocity", None) or getattr(goals[0].state, "orientation", None)):
        way.notes.append("goal: its speed and heading, which it wants without a place")
    if time is None:
        time = max((row[0] for each in obstacles for row in each.get("table", ())), default=0.0) or 10.0
        way.notes.append(f"goal: there is none; as far as possible in {time:g} s, when the traffic ends")
    if not way.starts and not at_place(way.lanes, way.place, way.psi):
        way.notes.append("road: the start lies on no lanelet; there is none")
        return {"time": time}, None
    _must_start_on_a_lane(way)
    first = min(way.starts, key=lambda lane: way.starts[lane] + TURNS * _turn_ahead(way.lanes[lane], way.place))
    ahead = _reached(way.speed, time) + BEYOND
    return {"time": time}, way.road([way.lanes[first]], ahead, None)


def _turn_ahead(lane: Lane, place: Array) -> float:
    """By how much a lane turns beyond a place on it [rad]."""
    psi, last = (project(lane.middle, each)[2] for each in (place, lane.middle[-1]))
    return abs(float(np.angle(np.exp(1j * (last - psi)))))


def _reached(speed: float, time: float) -> float:
    """How far a vehicle may come [m]."""
    return speed * time + ACCELERATION / 2 * time**2


def _must_start_on_a_lane(way: _Way) -> None:
    if way.starts:
        return
    x, y = way.place
    here = at_place(way.lanes, way.place, way.psi)
    if here:
        raise BadFile(way.file, f"a start at ({x:g}, {y:g}) that faces against lanelet {_some(here)}", "one along it")
    raise _off_the_road(way, "start", x, y)


def _off_the_road(way: _Way, what: str, x: float, y: float) -> BadFile:
    point = shapely.Point(x, y)
    near = min(way.lanes.values(), key=lambda lane: lane.polygon.distance(point))
    return BadFile(
        way.file,
        f"a {what} at ({x:g}, {y:g}), off the road: {near.polygon.distance(point):.1f} m from lanelet {near.id}",
        "one on a lanelet",
    )


def _some(ids: Any) -> str:
    ids = [str(i) for i in ids]
    return ", ".join(ids[:4]) + (f" and {len(ids) - 4} others" if len(ids) > 4 else "")


def _within_the_map(
    road: Road, goal: dict[str, float], start: dict[str, float], car: Vehicle, way: _Way
) -> dict[str, float]:
    """A greatest speed by which a goal of time does not lead beyond the end of the lanes."""
    if "time" not in goal:
        return {}
    s = project(road.line, np.array([start["x"], start["y"]]))[0]
    time, room = goal["time"], road.length - s - car.front_overhang - AT_THE_END
    speed = room / time
    if room > _reached(start["ux"], time) or speed >= car.ux_max or speed <= start["ux"]:
        return {}
    way.notes.append(f"vehicle: at most {speed:.1f} m/s, for the lanes end {road.length - s:.0f} m ahead")
    return {"ux_max": speed}


def _in_the_way(road: Road | None, obstacles: list[dict[str, Any]], car: Vehicle) -> list[str]:
    """Obstacles that stand and leave the vehicle no room on the road, a clause each."""
    found = []
    for obstacle in obstacles if road else ():
        if "table" in obstacle:
            continue
        assert road
        s, left, psi = project(road.line, np.array([obstacle["x"], obstacle["y"]]))
        size, along = _half_width(obstacle, psi), lengths(road.line)
        room = max(np.interp(s, along, road.left) - left - size, np.interp(s, along, road.right) + left - size)
        if 0 < s < road.length and room < car.width:
            found.append(f"{obstacle['name']} leaves {max(room, 0):.1f} m to the vehicle of {car.width:g} m")
    return found


def _half_width(obstacle: dict[str, Any], psi: float) -> float:
    """How far an obstacle reaches to a side of a line of direction `psi`."""
    if "r" in obstacle:
        return float(obstacle["r"])
    turned = obstacle.get("psi", 0.0) - psi
    half = np.array([obstacle.get("length", 0.0), obstacle.get("width", 0.0)]) / 2
    corners = np.array(obstacle["polygon"]) if "polygon" in obstacle else np.array([half, half * [1, -1]])
    return float(np.max(np.abs(corners @ [np.sin(turned), np.cos(turned)])))
