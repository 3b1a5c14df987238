"""A road of a scenario file from the lanes of a way: one line with widths inside them."""

from __future__ import annotations

from dataclasses import dataclass
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

    def edges(self) -> tuple[Array, Array]:
        """The right and the left edge."""
        psi = headings(self.line)
        normal = np.column_stack([-np.sin(psi), np.cos(psi)])
        return self.line - self.right[:, None] * normal, self.line + self.left[:, None] * normal

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
    area = shapely.union_all([lane.polygon.buffer(0.05, join_style="mitre") for row in rows for lane in row])
    area = area.buffer(-0.05, join_style="mitre")
    line = _line_inside(line, area)
    s = np.linspace(0, lengths(line)[-1], int(np.ceil(lengths(line)[-1] / FINE_STEP)) + 1)
    fine = at(line, s)
    right, left = _widths(fine, area)
    return Road(fine, right, left, area, rows)


def _line_inside(line: Array, area: Any) -> Array:
    """The line, smoothed as far as it stays inside."""
    raw = resampled(line, 1.0)
    for wavelength in (WAVELENGTH, WAVELENGTH / 2, WAVELENGTH / 4):
        line = smoothed(raw, wavelength)
        if area.buffer(0.01).covers(shapely.LineString(line)):
            return line
    return raw


def joined(way: list[Lane]) -> Array:
    """Middle lines one after the other; where one does not begin at the last one's end, led over slowly."""
    points = way[0].middle
    for lane in way[1:]:
        middle = lane.middle
        gap = float(np.hypot(*(middle[0] - points[-1])))
        if gap > 0.5:
            room = min(4 * gap, lengths(points)[-1] / 2, lane.length / 2)
            points = resampled(points, 1.0)
            points = points[lengths(points) <= lengths(points)[-1] - room]
            middle = resampled(middle, 1.0)
            middle = middle[lengths(middle) >= room]
        points = np.vstack([points, middle])
    return without_doubles(points)


def _widths(line: Array, area: Any) -> tuple[Array, Array]:
    psi, bend = headings(line), curvature(line)
    normal = np.column_stack([-np.sin(psi), np.cos(psi)])
    edges = np.concatenate([np.stack([ring[:-1], ring[1:]], axis=1) for ring in _rings(area)])
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


def _rings(area: Any) -> list[Array]:
    polygons = area.geoms if hasattr(area, "geoms") else [area]
    return [
        np.asarray(ring.coords)
        for polygon in polygons
        if polygon.geom_type == "Polygon"
        for ring in (polygon.exterior, *polygon.interiors)
    ]


def _narrowed(width: Array, s: Array) -> Array:
    """The least within a step of the final points, and no steeper than STEEPEST."""
    gap = np.abs(s[:, None] - s[None, :])
    least = np.min(np.where(gap <= POINT_STEP / 2, width[None, :], np.inf), axis=1)
    narrowed: Array = np.min(least[None, :] + STEEPEST * gap, axis=1)
    return narrowed
