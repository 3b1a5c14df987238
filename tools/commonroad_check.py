#!/usr/bin/env python3
"""Judges drives, exported as CommonRoad solutions, by the CommonRoad scenarios alone: nothing of Slalom is used.

For each scenario NAME.xml of one folder and drive NAME/solution.xml of another, a row of a Markdown table says
whether the vehicle's rectangle touches an obstacle or leaves the lanelets at any time step, how near it comes to
an obstacle, and when the goal is reached. Obstacles that begin where the vehicle does, or whose shape then holds its
middle, are recorded drives of it: they are left out, and named under "without". Collision and road are judged by shapely, and again by
commonroad-drivability-checker where it is installed; a row says so where the two differ, be it in a time step. A drive
whose vehicle starts with its middle off the lanelets neither stays on the road nor leaves it, and is counted apart. The
checker needs the commonroad-io before 2026:

    python3 -m venv judge; judge/bin/pip install commonroad-drivability-checker 'commonroad-io<2026'

usage: commonroad_check.py SCENARIOS DRIVES      two folders, or NAME.xml and solution.xml
Exits with 1 if there is a drive that collides or leaves the road, with 2 for files that cannot be judged.
"""

import argparse
import json
import logging
import math
import pathlib
import sys
import warnings
from xml.etree import ElementTree

# What gaps between neighbouring lanelets may have [m]: their edges are rounded in the files.
SEAM = 0.01
HEAD = (
    "| scenario | drive ended as | at [s] | collision | off the road | least distance [m] | goal reached | without | judges |\n"
    "|---|---|---|---|---|---|---|---|---|"
)


def shape_of(occupancy):
    """The shapely geometry of an occupancy, of commonroad-io before and from 2026 on. Both have circles of half the
    radius in shapely."""
    from shapely.geometry import Point
    from shapely.ops import unary_union

    shape = getattr(occupancy, "shape", occupancy)
    parts = getattr(shape, "shapes", None) or getattr(shape, "occupancies", None)
    if parts:
        return unary_union([shape_of(part) for part in parts])
    if getattr(shape, "radius", None):
        return Point(getattr(shape, "circle_center", None) or shape.center).buffer(shape.radius)
    return shape.shapely_object


def rectangle(state, length, width):
    import shapely
    from shapely import affinity

    box = shapely.box(-length / 2, -width / 2, length / 2, width / 2)
    turned = affinity.rotate(box, state.orientation, origin=(0, 0), use_radians=True)
    return affinity.translate(turned, *state.position)


def by_shapely(scenario, states, length, width):
    """The first time steps of a collision and off the road, None without, and the least distance [m]."""
    import shapely

    road = shapely.union_all([shape_of(lanelet.polygon).buffer(SEAM) for lanelet in scenario.lanelet_network.lanelets])
    collision, off, least = None, None, float("inf")
    for state in states:
        body = rectangle(state, length, width)
        if off is None and not road.covers(body):
            off = state.time_step
        for obstacle in scenario.obstacles:
            occupancy = obstacle.occupancy_at_time(state.time_step)
            if occupancy is None:
                continue
            distance = body.distance(shape_of(occupancy))
            least = min(least, distance)
            if collision is None and distance == 0:
                collision = state.time_step
    return collision, off, least


def upright(scenario):
    """The scenario's lanelets, their left bounds to the left: some files have one the other way round, whose
    area the checker then takes for off the road."""
    import numpy as np
    from commonroad.scenario.lanelet import Lanelet, LaneletNetwork
    from commonroad.scenario.scenario import Scenario

    lanelets = []
    for lanelet in scenario.lanelet_network.lanelets:
        left, right = lanelet.left_vertices, lanelet.right_vertices
        along, across = np.diff(lanelet.center_vertices[:2], axis=0)[0], left[0] - right[0]
        if along[0] * across[1] - along[1] * across[0] < 0:
            left, right = right, left
        lanelets.append(Lanelet(left, lanelet.center_vertices, right, lanelet.lanelet_id))
    made = Scenario(scenario.dt)
    made.add_objects(LaneletNetwork.create_from_lanelet_list(lanelets))
    return made


def by_checker(scenario, states, length, width):
    """The same first time steps by commonroad-drivability-checker; None where it is not installed."""
    try:
        from commonroad_dc import pycrcc
        from commonroad_dc.boundary import boundary
        from commonroad_dc.collision.collision_detection.pycrcc_collision_dispatch import create_collision_checker
        from commonroad_dc.collision.trajectory_queries import trajectory_queries
    except ImportError:
        return None
    body = pycrcc.TimeVariantCollisionObject(states[0].time_step)
    for state in states:
        body.append_obstacle(pycrcc.RectOBB(length / 2, width / 2, state.orientation, *map(float, state.position)))
    checker = create_collision_checker(scenario)
    collision = next(
        (s.time_step for s in states if checker.time_slice(s.time_step).collide(body.obstacle_at_time(s.time_step))),
        None,
    )
    road = boundary.create_road_polygons(upright(scenario), method="whole_polygon", triangulate=True)
    off = trajectory_queries.trajectories_enclosure_polygons_static([body], road)[0]
    return collision, (None if off < 0 else off)


def without_the_vehicle(scenario, initial):
    """Leaves out obstacles that begin where the vehicle does: recorded drives of it. Returns their ids."""
    import shapely

    same = []
    for obstacle in list(scenario.dynamic_obstacles):
        state = obstacle.initial_state
        if state.time_step == initial.time_step and not getattr(state, "is_uncertain_position", False):
            gap = ((state.position[:2] - initial.position[:2]) ** 2).sum() ** 0.5
            held = shape_of(obstacle.occupancy_at_time(state.time_step)).covers(shapely.Point(initial.position))
            turned = abs(math.remainder(state.orientation - initial.orientation, 2 * math.pi))
            if (gap < 0.5 or held) and turned < 0.2:
                scenario.remove_obstacle(obstacle)
                same.append(obstacle.obstacle_id)
    return same


def refuse_misplaced(xml, scenario):
    """commonroad-io from 2026 on passes over where a shape lies in its obstacle's own frame."""
    for element in ElementTree.parse(xml).getroot():
        for shape in element.iterfind("shape/*"):
            place = [float(shape.findtext(name) or 0) for name in ("center/x", "center/y", "orientation")]
            obstacle = scenario.obstacle_by_id(int(element.get("id"))) if any(place) else None
            known = getattr(obstacle, "obstacle_shape", None)
            if known is not None and not hasattr(known, "center"):
                raise ValueError(f"obstacle {element.get('id')} has a shape with a place that this commonroad-io does not read")


def together(ours, checkers):
    """The first time steps of a collision and off the road by both judges, the earlier one where they differ, and what
    is said of them; `checkers` is None where there is one judge."""
    if checkers is None:
        return *ours, "shapely"
    if ours == checkers:
        return *ours, "both"
    earliest = [min((step for step in steps if step is not None), default=None) for steps in zip(ours, checkers)]
    named = ["none" if step is None else f"step {step}" for step in (*ours, *checkers)]
    return *earliest, "differ: collision {} and {}, off the road {} and {}".format(*named[::2], *named[1::2])


def judged(xml, solution_file):
    """What a row says of one drive."""
    from commonroad.common.file_reader import CommonRoadFileReader
    from commonroad.common.solution import CommonRoadSolutionReader, vehicle_parameters

    scenario, problems = CommonRoadFileReader(str(xml)).open()
    refuse_misplaced(xml, scenario)
    part = CommonRoadSolutionReader.open(str(solution_file)).planning_problem_solutions[0]
    problem = problems.planning_problem_dict[part.planning_problem_id]
    car = vehicle_parameters[part.vehicle_type]
    states = part.trajectory.state_list
    without = without_the_vehicle(scenario, problem.initial_state)
    collision, off, least = by_shapely(scenario, states, car.l, car.w)
    again = by_checker(scenario, states, car.l, car.w)
    collision, off, judges = together((collision, off), again)
    starts_off = by_shapely(scenario, states[:1], 0.01, 0.01)[1] is not None
    if starts_off:
        off = None
    reached = "none asked" if not problem.goal.state_list else "no"
    if problem.goal.state_list:
        step = next((s.time_step for s in states if problem.goal.is_reached(s)), None)
        reached = "no" if step is None else f"{step * scenario.dt:.2f} s"
    return {
        "end": states[-1].time_step * scenario.dt,
        "collision": collision,
        "off": off,
        "least": least,
        "reached": reached,
        "without": ", ".join(map(str, without)),
        "starts_off": starts_off,
        "judges": judges,
        "dt": scenario.dt,
    }


def pairs(scenarios, drives):
    """Name, scenario, solution and summary of each drive."""
    if scenarios.is_file():
        yield scenarios.stem, scenarios, drives, drives.parent / "summary.json"
        return
    for xml in sorted(scenarios.glob("*.xml")):
        if (drives / xml.stem / "solution.xml").exists():
            yield xml.stem, xml, drives / xml.stem / "solution.xml", drives / xml.stem / "summary.json"


def row(name, summary, verdict):
    ended = json.loads(summary.read_text())["outcome"] if summary.exists() else ""
    when = [
        ("no" if verdict[key] is None else f"from {verdict[key] * verdict['dt']:.2f} s") for key in ("collision", "off")
    ]
    when[1] = "starts off it" if verdict["starts_off"] else when[1]
    cells = [
        name,
        ended,
        f"{verdict['end']:.2f}",
        *when,
        f"{verdict['least']:.2f}",
        verdict["reached"],
        verdict["without"],
    ]
    return f"| {' | '.join(cells)} | {verdict['judges']} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scenarios", type=pathlib.Path)
    parser.add_argument("drives", type=pathlib.Path)
    arguments = parser.parse_args()
    logging.disable(logging.CRITICAL)
    warnings.simplefilter("ignore")
    found = list(pairs(arguments.scenarios, arguments.drives))
    if not found:
        print(f"{arguments.drives}: found no NAME/solution.xml of a scenario of {arguments.scenarios}", file=sys.stderr)
        return 2
    print(HEAD)
    good = apart = 0
    for name, xml, solution, summary in found:
        try:
            verdict = judged(xml, solution)
        except Exception as error:  # the packages' messages are of all kinds
            print(f"{solution}: cannot be judged: {type(error).__name__}: {error}", file=sys.stderr)
            return 2
        clean = verdict["collision"] is None and verdict["off"] is None
        good += clean and not verdict["starts_off"]
        apart += clean and verdict["starts_off"]
        print(row(name, summary, verdict))
    print(f"\n{good} of {len(found)} drives touch nothing and stay on the road; {apart} touch nothing and start off it.")
    return 0 if good + apart == len(found) else 1


if __name__ == "__main__":
    sys.exit(main())
