"""Lanelets as lanes with neighbours, and ways through them."""

from __future__ import annotations

import heapq
import itertools
from dataclasses import dataclass
from typing import Any, Mapping

import numpy as np
import shapely

from ._line import Array, lengths, project, without_doubles

# On these no car drives, unless it starts there or is to arrive there.
NOT_FOR_CARS = frozenset(("sidewalk", "crosswalk", "bicycleLane", "border", "restricted_area"))
# What a change of lanes costs [m]: a way through one lane is taken where it is hardly longer.
CHANGE = 5.0


@dataclass(frozen=True)
class Lane:
    """A lanelet: its bounds and middle, (n, 2) arrays, and its neighbours' ids."""

    id: int
    left: Array
    right: Array
    types: frozenset[str]
    successors: tuple[int, ...]
    predecessors: tuple[int, ...]
    beside: dict[str, tuple[int, bool]]
    """By side, "left" or "right": the lane there, and whether it goes the same way."""

    @property
    def middle(self) -> Array:
        return without_doubles((self.left + self.right) / 2)

    @property
    def length(self) -> float:
        return float(lengths(self.middle)[-1])

    @property
    def polygon(self) -> Any:
        return shapely.make_valid(shapely.Polygon(np.vstack([self.left, self.right[::-1]])))

    @property
    def turn(self) -> float:
        """By how much its direction changes from end to end [rad]."""
        step = np.diff(self.middle, axis=0)
        psi = np.unwrap(np.arctan2(step[:, 1], step[:, 0]))
        return float(abs(psi[-1] - psi[0]))

    def for_cars(self) -> bool:
        return not self.types & NOT_FOR_CARS


Lanes = Mapping[int, Lane]


def lanes_of(network: Any) -> dict[int, Lane]:
    """The lanelets of a network of commonroad-io, by id."""
    lanes = {}
    for lanelet in network.lanelets:
        beside = {}
        for side in ("left", "right"):
            other = getattr(lanelet, f"adj_{side}")
            if other is not None:
                beside[side] = (other, bool(getattr(lanelet, f"adj_{side}_same_direction")))
        lanes[lanelet.lanelet_id] = Lane(
            lanelet.lanelet_id,
            np.asarray(lanelet.left_vertices),
            np.asarray(lanelet.right_vertices),
            frozenset(str(kind.value) for kind in lanelet.lanelet_type or ()),
            tuple(lanelet.successor),
            tuple(lanelet.predecessor),
            beside,
        )
    return lanes


def neighbours(lanes: Lanes, lane: Lane, oncoming: bool) -> list[Lane]:
    """The lanes beside each other that go the way of `lane`, itself among them, from left to right; with
    `oncoming`, those of the other way beside them too."""
    row = [lane]
    for side, put in (("left", lambda new: row.insert(0, new)), ("right", row.append)):
        here, towards, same = lane, side, True
        while here.beside.get(towards):
            other, agrees = here.beside[towards]
            if not agrees:  # seen from there, the same side has the other name
                towards, same = ("right" if towards == "left" else "left"), not same
            here = lanes[other]
            if here in row or not here.for_cars() or not (same or oncoming):
                break
            put(here)
    return row


def at_place(lanes: Lanes, place: Array, psi: float) -> dict[int, float]:
    """Lanes on which a place lies, with how far each lane's direction there is from `psi` [rad]."""
    return {lane: off for lane, (off, away) in near_place(lanes, place, psi, 0.01).items()}


def near_place(lanes: Lanes, place: Array, psi: float, within: float) -> dict[int, tuple[float, float]]:
    """Lanes that are at most so far [m] from a place: how far each one's direction is from `psi` [rad], and how
    far it is away [m]."""
    point = shapely.Point(place)
    found = {}
    for lane in lanes.values():
        if (away := float(lane.polygon.distance(point))) <= within:
            off = float(np.angle(np.exp(1j * (project(lane.middle, place)[2] - psi))))
            found[lane.id] = (abs(off), away)
    return found


def shortest(lanes: Lanes, starts: Mapping[int, float], goals: Mapping[int, float]) -> tuple[float, list[Lane]] | None:
    """The cheapest way from one of `starts` to one of `goals`, over successors and changes of lanes.

    Both have what it costs to begin or end there [m]. A change is the cheaper the earlier it comes.
    """
    order = itertools.count()
    queue = [(cost, next(order), lane, [lane]) for lane, cost in starts.items()]
    heapq.heapify(queue)
    done, best = set(), None
    while queue:
        cost, _, here, way = heapq.heappop(queue)
        if best and cost >= best[0]:
            break
        if here in done:
            continue
        done.add(here)
        if here in goals and (best is None or cost + goals[here] < best[0]):
            best = (cost + goals[here], [lanes[i] for i in way])
        lane = lanes[here]
        steps = [(following, lane.length) for following in lane.successors]
        steps += [(other, CHANGE + 0.01 * cost) for other, same in lane.beside.values() if same]
        for following, more in steps:
            if following not in done and (lanes[following].for_cars() or following in goals):
                heapq.heappush(queue, (cost + more, next(order), following, [*way, following]))
    return best


def straightest(lanes: Lanes, ids: tuple[int, ...], seen: set[int]) -> Lane | None:
    """Of these lanes for cars, the one that turns least; the longer one where two are alike."""
    open_ones = [lanes[i] for i in ids if lanes[i].for_cars() and i not in seen]
    return min(open_ones, key=lambda lane: (round(lane.turn, 2), -lane.length), default=None)


def extended(lanes: Lanes, way: list[Lane], before: float, beyond: float) -> list[Lane]:
    """The way with the straightest lanes before its first and beyond its last, of these lengths [m] at least."""
    way = list(way)
    while before > 0 and (lane := straightest(lanes, way[0].predecessors, {each.id for each in way})):
        way.insert(0, lane)
        before -= lane.length
    while beyond > 0 and (lane := straightest(lanes, way[-1].successors, {each.id for each in way})):
        way.append(lane)
        beyond -= lane.length
    return way


def without_changes(lanes: Lanes, way: list[Lane]) -> list[Lane]:
    """The lanes that follow each other: of lanes beside each other on the way, the last."""
    kept: list[Lane] = []
    for k, lane in enumerate(way):
        following = way[k + 1] if k + 1 < len(way) else None
        if following is None or following.id in lane.successors:
            kept.append(lane)
    return kept
