"""A road of a scenario file from the lanes of a way: one line with widths inside them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import shapely

from ._lanes import Lane, Lanes, neighbours
from ._line import Array, at, curvature, headings, lengths, project, ray_lengths, resampled, smoothed, without_doubles

POINT_STEP = 2.0
"""Between the points of the reference line [m]."""
FINE_STEP = 0.5
"""Between the places where the widths are measured [m]."""
STEEPEST = 0.5
"""By how much a width changes at the most for each metre along the line."""
CURVE_SHARE = 0.8
"""How much of the radius of a bend its inner side may be wide."""
NEAR_RADIUS = 0.95
"""The same where the road must hold the vehicle's body."""
LEAD = 8.0
"""How long a change of lanes is, in its widths."""
RETURNING = 0.05
"""By how much that changes for each metre beyond the body."""
BESIDE = 0.1
"""How much of the road is kept beside a body that it must hold [m]."""
FARTHEST = 60.0
WAVELENGTH = 12.0
"""Shortest bends that are kept of the lanes' middle lines [m]."""


@dataclass
class Road:
    """A reference line, its widths to the right and to the left, and lines between lanes; `area` is what it covers."""

    line: Array
    right: Array
    left: Array
    area: Any
    rows: list[list[Lane]]

    @property
    def length(self) -> float:
        return float(lengths(self.line)[-1])

    def between(self, first: float, last: float) -> Road:
        """The part from arc length `first` to `last`, its points evenly spaced."""
        along = lengths(self.line)
        first, last = max(first, 0.0), min(last, self.length)
        s = np.linspace(first, last, max(int(round((last - first) / POINT_STEP)), 4) + 1)
        return Road(
            at(self.line, s), np.interp(s, along, self.right), np.interp(s, along, self.left), self.area, self.rows
        )

    def near(self, area: Any) -> Road:
        """The part beside an area, its points close together where that is short."""
        box = shapely.box(*area.bounds) if not area.is_empty else area
        held = np.flatnonzero(shapely.distance(shapely.points(self.line), box) < FARTHEST / 2)
        if len(held) < 2:
            return self
        along = lengths(self.line)[held[[0, -1]]]
        s = np.linspace(along[0], along[1], int(min(max((along[1] - along[0]) / 0.25, 4), 4000)) + 1)
        whole = lengths(self.line)
        return replace(
            self, line=at(self.line, s), right=np.interp(s, whole, self.right), left=np.interp(s, whole, self.left)
        )

    def edges(self) -> tuple[Array, Array]:
        """The right and the left edge."""
        psi = headings(self.line)
        normal = np.column_stack([-np.sin(psi), np.cos(psi)])
        return self.line - self.right[:, None] * normal, self.line + self.left[:, None] * normal

    def wider_than(self, other: Road) -> float:
        """By how much [m] at the most, to one side, of another along the same line."""
        return float(np.max([self.right - other.right, self.left - other.left]))

    def polygon(self) -> Any:
        right, left = self.edges()
        return shapely.make_valid(shapely.Polygon(np.vstack([right, left[::-1]])))

    def points(self) -> list[list[float]]:
        return [[float(number) for number in row] for row in np.column_stack([self.line, self.right, self.left])]

    def lane_lines(self) -> list[list[list[float]]]:
        """The lines between lanes beside each other, as far as they lie on the road."""
        lines = []
        for row in self.rows:
            for left, lane in zip(row, row[1:]):
                nearest = min(
                    (lane.left, lane.right), key=lambda bound: left.polygon.distance(shapely.MultiPoint(bound))
                )
                bound = shapely.LineString(without_doubles(nearest)).simplify(0.03)
                on_road = [p for p in np.asarray(bound.segmentize(10.0).coords) if self._holds(p)]
                if len(on_road) >= 2:
                    lines.append([[float(x), float(y)] for x, y in shapely.LineString(on_road).simplify(0.03).coords])
        return lines

    def _holds(self, place: Array) -> bool:
        s, left, _ = project(self.line, place)
        along = lengths(self.line)
        return bool(0 < s < self.length and -np.interp(s, along, self.right) < left < np.interp(s, along, self.left))


def road_along(lanes: Lanes, way: list[Lane], line: Array, oncoming: bool) -> Road:
    """The road along `line`, which lies on lanes that follow each other, as wide as the lanes beside them that
    go the same way.

    Its edges are within those lanes: widths are measured across the line, narrowed to what is there all
    around, and change no faster than STEEPEST.
    """
    rows = [neighbours(lanes, lane, oncoming) for lane in way]
    parts = [lane.polygon for row in rows for lane in row]
    parts += [joint for row, following in zip(rows, rows[1:]) for joint in _joints(row, following)]
    area = shapely.union_all([part.buffer(0.05, join_style="mitre") for part in parts])
    area = area.buffer(-0.05, join_style="mitre")
    line = _line_inside(line, area)
    s = np.linspace(0, lengths(line)[-1], int(np.ceil(lengths(line)[-1] / FINE_STEP)) + 1)
    fine = at(line, s)
    right, left = _widths(fine, area)
    return Road(fine, right, left, area, rows)


def _joints(row: list[Lane], following: list[Lane]) -> list[Any]:
    """What lies between the ends of lanes and the beginnings of their successors, which some maps leave open."""
    pairs = [(a, b) for a in row for b in following if b.id in a.successors]
    pairs += [(b, a) for a in row for b in following if a.id in b.successors]
    ends = [[a.left[-1], a.right[-1], b.left[0], b.right[0]] for a, b in pairs]
    return [hull for four in ends if (hull := shapely.MultiPoint(four).convex_hull).area > 1e-3]


def holding(road: Road, bodies: list[Any], area: Any = None, beside: float = BESIDE) -> Road:
    """The road, as much wider as it must be to hold bodies that are partly beside it; where an area is given, no
    wider than that. `beside` is how much of the road is kept beside them [m].

    Widths change by RETURNING from there on, for the vehicle to come back, and stay within a bend's radius. What a
    side has no room for is added to the other.
    """
    corners = np.vstack([body.exterior.segmentize(FINE_STEP).coords for body in bodies])
    places = np.array([project(road.line, corner)[:2] for corner in corners])
    along = lengths(road.line)
    away = np.abs(along[:, None] - places[None, :, 0])
    slope = RETURNING * np.maximum(away - POINT_STEP, 0)
    psi, bend = headings(road.line), curvature(road.line)
    normal = np.column_stack([-np.sin(psi), np.cos(psi)])
    sides = ((-1, -bend), (1, bend))
    needed = [np.max(side * places[None, :, 1] + beside - slope, axis=1) for side, _ in sides]
    room = [_room(road.line, side * normal, inwards, area) for side, inwards in sides]
    # Where one side has no room for what sticks out there, the body keeps to the other.
    slope = RETURNING * np.maximum(np.abs(along[:, None] - along[None, :]) - POINT_STEP, 0)
    lacking = [np.max(np.maximum(n - r, 0)[None, :] - slope, axis=1) for n, r in zip(needed, room)]
    widths = [road.right, road.left]
    wider = [
        np.maximum(width, np.minimum(n + np.maximum(lack, 0), r))
        for width, n, lack, r in zip(widths, needed, reversed(lacking), room)
    ]
    return replace(road, right=wider[0], left=wider[1])


def _room(line: Array, normals: Array, inwards: Array, area: Any) -> Array:
    """How wide a road along a line may be to a side: within an area, if there is one, and within the radius of a bend
    towards there."""
    room = np.full(len(line), np.inf) if area is None else ray_lengths(line, normals, _edges(area))
    with np.errstate(divide="ignore"):
        return np.where(inwards > 1e-6, np.minimum(room, NEAR_RADIUS / inwards), room)


def _line_inside(line: Array, area: Any) -> Array:
    """The line, smoothed as far as it stays inside."""
    raw = resampled(line, 1.0)
    for wavelength in (WAVELENGTH, WAVELENGTH / 2, WAVELENGTH / 4):
        line = smoothed(raw, wavelength)
        if area.buffer(0.01).covers(shapely.LineString(line)):
            return line
    return raw


def joined(lanes: Lanes, way: list[Lane]) -> Array:
    """Middle lines one after the other; where one does not begin at the last one's end, led over slowly, as far
    as there are lanes beside each other before and after it."""
    points = way[0].middle
    k = 1
    while k < len(way):
        middle = way[k].middle
        gap = float(np.hypot(*(middle[0] - points[-1])))
        if gap > 0.5:
            before, after = _room_to_change(lanes, way, k)
            wanted = LEAD * gap
            back = min(before, max(wanted / 2, wanted - after), lengths(points)[-1] / 2)
            while k + 1 < len(way) and lengths(middle)[-1] < 2 * after and _follows(way[k], way[k + 1]):
                k += 1
                middle = np.vstack([middle, way[k].middle])
            middle = without_doubles(middle)
            ahead = min(after, max(wanted / 2, wanted - back), lengths(middle)[-1] / 2)
            points = _up_to(points, lengths(points)[-1] - back)
            middle = _up_to(middle[::-1], lengths(middle)[-1] - ahead)[::-1]
        points = np.vstack([points, middle])
        k += 1
    return without_doubles(points)


def _follows(lane: Lane, other: Lane) -> bool:
    return float(np.hypot(*(other.middle[0] - lane.middle[-1]))) <= 0.5


def _up_to(points: Array, s: float) -> Array:
    """The points to arc length `s`, there one more."""
    along = lengths(points)
    return np.vstack([points[along < s - 0.1], at(points, np.array([s]))])


def _room_to_change(lanes: Lanes, way: list[Lane], k: int) -> tuple[float, float]:
    """How far [m] before and after the beginning of the way's k-th lane both it and that which goes on from the
    lane before lie beside each other. A lane that begins apart without being beside has half of both."""
    old, new = way[k - 1], way[k]
    if new.id in old.successors:
        return old.length / 2, new.length / 2
    before = after = 0.0
    targets = {new.id}
    for lane in reversed(way[:k]):
        row = {each.id for each in neighbours(lanes, lane, False)}
        targets = {p for each in targets for p in lanes[each].predecessors} & row
        if not targets:
            break
        before += lane.length
    targets = {old.id}
    for lane in way[k:]:
        row = {each.id for each in neighbours(lanes, lane, False)}
        targets = {following for each in targets for following in lanes[each].successors} & row
        if not targets:
            break
        after += lane.length
    return before, after


def _widths(line: Array, area: Any) -> tuple[Array, Array]:
    psi, bend = headings(line), curvature(line)
    normal = np.column_stack([-np.sin(psi), np.cos(psi)])
    edges = _edges(area)
    inside = shapely.contains_xy(area.buffer(-0.05), line)
    inner = np.flatnonzero(inside)
    widths = []
    for normals, inwards in ((-normal, -bend), (normal, bend)):
        width = np.where(inside, np.minimum(ray_lengths(line, normals, edges), FARTHEST), 0.0)
        # Across the very end of a lane the edge is its end; what is led on beyond it is as wide as it.
        if len(inner):
            width[: inner[0]], width[inner[-1] + 1 :] = width[inner[0]], width[inner[-1]]
        with np.errstate(divide="ignore"):
            width = np.where(inwards > 1e-6, np.minimum(width, CURVE_SHARE / inwards), width)
        widths.append(_narrowed(width, lengths(line)))
    return widths[0], widths[1]


def _edges(area: Any) -> Array:
    return np.concatenate([np.stack([ring[:-1], ring[1:]], axis=1) for ring in _rings(area)])


def _rings(area: Any) -> list[Array]:
    polygons = area.geoms if hasattr(area, "geoms") else [area]
    return [
        np.asarray(ring.coords)
        for polygon in polygons
        if polygon.geom_type == "Polygon"
        for ring in (polygon.exterior, *polygon.interiors)
    ]


def _narrowed(width: Array, s: Array) -> Array:
    """The least within a step of the final points, and no steeper than STEEPEST; `s` is evenly spaced."""
    step = s[1] - s[0]
    reach = int(POINT_STEP / 2 / step + 1e-9)
    padded = np.pad(width, reach, constant_values=np.inf)
    least = np.lib.stride_tricks.sliding_window_view(padded, 2 * reach + 1).min(axis=1)
    # By slopes: the least of what came before, seen along a line that rises, and the same from the other end.
    rising = np.minimum.accumulate(least - STEEPEST * s) + STEEPEST * s
    falling = np.minimum.accumulate((least + STEEPEST * s)[::-1])[::-1] - STEEPEST * s
    narrowed: Array = np.minimum(rising, falling)
    return narrowed
