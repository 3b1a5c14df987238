"""Lines of points in the plane, (n, 2) arrays [m]."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[Any]
PIECE = 64
"""Segments of a line that are looked at together."""


def lengths(points: Array) -> Array:
    """Arc length at each point, from 0."""
    return np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))))


def without_doubles(points: Array, least: float = 1e-3) -> Array:
    """The points but those that come within `least` of the one before."""
    kept = [0]
    for k in range(1, len(points)):
        if np.hypot(*(points[k] - points[kept[-1]])) > least:
            kept.append(k)
    return points[kept]


def at(points: Array, s: Array) -> Array:
    """The points at arc lengths `s`."""
    along = lengths(points)
    return np.column_stack([np.interp(s, along, points[:, 0]), np.interp(s, along, points[:, 1])])


def resampled(points: Array, step: float) -> Array:
    """Points about `step` apart along the same line, its ends among them."""
    total = lengths(points)[-1]
    return at(points, np.linspace(0, total, max(int(round(total / step)), 3) + 1))


def smoothed(points: Array, wavelength: float) -> Array:
    """A line through evenly spaced points without bends shorter than about `wavelength`, its ends kept.

    The least of the squared distances and of the weighed squared third differences (Whittaker's smoother).
    """
    count = len(points)
    if count < 5:
        return points
    step = lengths(points)[-1] / (count - 1)
    weight = (wavelength / (2 * np.pi * step)) ** 6
    at_ends = np.ones(count)
    at_ends[[0, -1]] = 1e6
    # The banded matrix of the least squares, upper diagonals by rows: bands[d, k] is entry (k, k + d).
    third = np.array([-1.0, 3.0, -3.0, 1.0])
    bands = np.zeros((4, count))
    for d in range(4):
        for i in range(4 - d):
            bands[d, i : count - 3 + i] += weight * third[i] * third[i + d]
    bands[0] += at_ends
    return _solved(bands, at_ends[:, None] * points)


def _solved(bands: Array, right: Array) -> Array:
    """x of A x = right, A symmetric and positive definite with `bands[d, k]` its entry (k, k + d): by L D L^T."""
    bands, x = bands.copy(), right.astype(float)
    count, width = len(x), len(bands) - 1
    for k in range(count):
        for d in range(1, min(width, count - 1 - k) + 1):
            factor = bands[d, k] / bands[0, k]
            for e in range(d, min(width, count - 1 - k) + 1):
                bands[e - d, k + d] -= factor * bands[e, k]
            x[k + d] -= factor * x[k]
    for k in range(count - 1, -1, -1):
        for d in range(1, min(width, count - 1 - k) + 1):
            x[k] -= bands[d, k] * x[k + d]
        x[k] /= bands[0, k]
    return x


def headings(points: Array) -> Array:
    """Direction of the line at each point [rad], without jumps."""
    slope = np.gradient(points, lengths(points), axis=0)
    return np.unwrap(np.arctan2(slope[:, 1], slope[:, 0]))


def curvature(points: Array) -> Array:
    """Curvature at each point [1/m], left positive."""
    return np.asarray(np.gradient(headings(points), lengths(points)))


def project(points: Array, place: Array) -> tuple[float, float, float]:
    """Of the line's point nearest to `place`: arc length, how far the place lies to its left, direction."""
    a, b = points[:-1], points[1:]
    along = b - a
    length = np.hypot(*along.T)
    t = np.clip(np.sum((place - a) * along, axis=1) / length**2, 0, 1)
    k = int(np.argmin(np.hypot(*(a + t[:, None] * along - place).T)))
    direction = along[k] / length[k]
    off = place - a[k]
    left = direction[0] * off[1] - direction[1] * off[0]
    s = float(lengths(points)[k] + t[k] * length[k])
    return s, float(left), float(np.arctan2(direction[1], direction[0]))


def crossings(first: Array, second: Array) -> Array:
    """Index pairs (k, m) of segments of two lines that cross each other, in order, segments of one point left out."""
    found = [np.empty((0, 2), dtype=int)]
    for k, m in _near_each_other(first, second):
        found.append(_crossings(first[k : k + PIECE + 1], second[m : m + PIECE + 1]) + [k, m])
    pairs = np.concatenate(found)
    return pairs[np.lexsort(pairs.T[::-1])]


def _near_each_other(first: Array, second: Array) -> Array:
    """Where pieces of PIECE segments begin whose bounding boxes touch: all pairs of segments of a long line would
    take gigabytes."""

    def boxes(line: Array) -> tuple[Array, Array, Array]:
        begins = np.arange(0, len(line) - 1, PIECE)
        pieces = [line[k : k + PIECE + 1] for k in begins]
        return begins, np.array([p.min(axis=0) for p in pieces]), np.array([p.max(axis=0) for p in pieces])

    (a, least_a, most_a), (b, least_b, most_b) = boxes(first), boxes(second)
    touch = np.argwhere(np.all((least_a[:, None] <= most_b[None]) & (least_b[None] <= most_a[:, None]), axis=2))
    return np.column_stack([a[touch[:, 0]], b[touch[:, 1]]])


def _crossings(first: Array, second: Array) -> Array:
    p, q = first[:-1], second[:-1]
    u, v = np.diff(first, axis=0), np.diff(second, axis=0)
    gap = q[None, :, :] - p[:, None, :]

    def cross(a: Array, b: Array) -> Array:
        return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]

    with np.errstate(divide="ignore", invalid="ignore"):
        det = cross(u[:, None, :], v[None, :, :])
        t, w = cross(gap, v[None, :, :]) / det, cross(gap, u[:, None, :]) / det
        return np.argwhere((t > 0) & (t < 1) & (w > 0) & (w < 1))


def ray_lengths(origins: Array, directions: Array, edges: Array) -> Array:
    """From each origin along its unit direction, the distance to the first of the (m, 2, 2) edges; inf without."""
    few = max(1_000_000 // max(len(edges), 1), 1)
    parts = [slice(k, k + few) for k in range(0, len(origins), few)]
    return np.concatenate([_ray_lengths(origins[part], directions[part], edges) for part in parts])


def _ray_lengths(origins: Array, directions: Array, edges: Array) -> Array:
    a, along = edges[:, 0], edges[:, 1] - edges[:, 0]
    gap = a[None] - origins[:, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        det = directions[:, None, 0] * along[None, :, 1] - directions[:, None, 1] * along[None, :, 0]
        t = (gap[..., 0] * along[None, :, 1] - gap[..., 1] * along[None, :, 0]) / det
        w = (gap[..., 0] * directions[:, None, 1] - gap[..., 1] * directions[:, None, 0]) / det
        hit = (w >= -1e-9) & (w <= 1 + 1e-9) & (t >= 0)
    return np.min(np.where(hit, t, np.inf), axis=1, initial=np.inf)
