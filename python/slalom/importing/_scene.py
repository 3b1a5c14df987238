"""A scenario as the importers make it, and its file: YAML that a person can read and change."""

from __future__ import annotations

import json
import math
import os
import pathlib
from dataclasses import dataclass, field
from typing import Any, Iterable

import slalom

from ._files import BadFile, write_whole

DIGITS = 5
"""Behind the point of each number in the file, in m and rad: more than any map is worth."""
NO_TEXT = frozenset(("null", "true", "false", "yes", "no", "on", "off", "y", "n"))
"""Words that a reader of YAML takes for something else, in small or capital letters."""


@dataclass(frozen=True)
class Vehicle:
    """What an importer must know of the vehicle that is to drive [m, m/s]."""

    name: str
    length: float
    width: float
    la: float
    """From the front axle back to the centre of gravity."""
    lb: float
    """From there back to the rear axle."""
    front_overhang: float
    """From the front axle on to the front of the body."""
    ux_min: float
    ux_max: float

    @property
    def wheelbase(self) -> float:
        return self.la + self.lb

    @property
    def centre(self) -> float:
        """How far the body's centre is behind the front axle."""
        return self.length / 2 - self.front_overhang

    @classmethod
    def load(cls, name: str) -> Vehicle:
        """A built-in vehicle or one of a file. Raises InvalidValue for what is none."""
        plain = {"vehicle": name, "start": {"x": 0, "y": 0}, "goal": {"x": 0, "y": 100}}
        scenario = slalom.load_scenario(plain)
        keys = ("length", "width", "la", "lb", "front_overhang", "ux_min", "ux_max")
        return cls(name, *(float(scenario["vehicle." + key]) for key in keys))


@dataclass
class Scene:
    """A scenario on its way to its file. Frame and units are those of a scenario file."""

    name: str
    file: pathlib.Path
    source: list[str]
    """What it was made from, a line each."""
    vehicle: Vehicle
    start: dict[str, float]
    goal: dict[str, float]
    timeout: float
    points: list[list[float]] = field(default_factory=list)
    """Of the road's reference line: x, y, width to the right and to the left; none without a road."""
    closed: bool = False
    lanes: list[list[list[float]]] = field(default_factory=list)
    obstacles: list[dict[str, Any]] = field(default_factory=list)
    planner: dict[str, Any] = field(default_factory=dict)
    loop: dict[str, Any] = field(default_factory=dict)
    limits: dict[str, float] = field(default_factory=dict)
    """Keys of the vehicle that are not its own."""
    notes: list[str] = field(default_factory=list)
    """What could not be carried over, by name, and what was decided, a sentence each."""

    def __post_init__(self) -> None:
        self.notes = [_one_line(note) for note in self.notes]

    def yaml(self) -> str:
        """The scenario file's text."""
        lines = [f"# {_one_line(line)}" for line in self.source]
        if self.notes:
            lines += ["# Not as in the source:", *(f"# - {_one_line(note)}" for note in self.notes)]
        lines += [
            f"name: {_text(self.name)}",
            f"vehicle: {_flow({'base': self.vehicle.name, 'footprint': 'rectangle', **self.limits})}",
            f"planner: {_flow(self.planner)}",
            f"start: {_flow(self.start)}",
            f"goal: {_flow(self.goal)}",
            f"loop: {_flow({'sm_crash': 0, 'timeout': self.timeout, **self.loop})}",
        ]
        if self.points:
            lines += [
                "road:",
                f"  closed: {'true' if self.closed else 'false'}",
                "  points:  # x, y, width to the right, width to the left",
                *(f"    - {_flow(point)}" for point in self.points),
            ]
            if self.lanes:
                lines += ["  lanes:", *(f"    - {_flow(lane)}" for lane in self.lanes)]
        if self.obstacles:
            lines += ["obstacles:"]
            for obstacle in self.obstacles:
                lines += _obstacle(obstacle)
        return "\n".join(lines) + "\n"

    def write(self, file: str | os.PathLike[str], force: bool = False) -> None:
        """Writes the file, whole or not at all. Raises BadFile where Slalom refuses the scenario, and OSError."""
        path = pathlib.Path(file)

        def check(part: pathlib.Path) -> None:
            try:
                slalom.load_scenario(part)
            except slalom.Error as error:
                raise BadFile(
                    self.file,
                    f"a scenario that is refused ({str(error).replace(str(part), str(path))})",
                    "one that can be driven",
                ) from None

        write_whole(path, self.yaml(), force, check)


def as_written(value: float) -> float:
    """A number as its file will have it."""
    return float(_number(value))


def no_more(value: float) -> float:
    """The nearest number to a value, not farther from zero, that its file will have as it is."""
    size = as_written(abs(value))
    if size > abs(value):
        size = as_written(size - 10**-DIGITS)
    return math.copysign(size, value)


def no_less(value: float) -> float:
    """The same of a value above zero, not below it."""
    size = as_written(value)
    return size if size >= value else as_written(size + 10**-DIGITS)


def _number(value: float) -> str:
    if not math.isfinite(value):
        raise ValueError(f"a number that is not finite: {value}")
    text = f"{value:.{DIGITS}f}".rstrip("0").rstrip(".")
    return "0" if text in ("", "-0") else text


def _one_line(text: str) -> str:
    """What the source says may have line breaks, after which a comment would be no comment."""
    return "".join(c if c.isprintable() else "?" for c in " ".join(text.split()))


def _text(value: str) -> str:
    plain = value and all(c.isalnum() or c in "_-/." for c in value) and value[0].isalpha()
    if plain and value.lower() not in NO_TEXT:
        return value
    # Not escaped, for YAML has no pairs of surrogates; a file's name may have single ones, which are no text.
    return json.dumps(value.encode("utf-8", "replace").decode(), ensure_ascii=False)


def _flow(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {_flow(entry)}" for key, entry in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_flow, value)) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return _text(value)
    return _number(float(value))


def _obstacle(obstacle: dict[str, Any]) -> Iterable[str]:
    """On one line, or with its table a row a line."""
    if "table" not in obstacle:
        return [f"  - {_flow(obstacle)}"]
    plain = [(key, value) for key, value in obstacle.items() if key != "table"]
    return [
        *(f"  {'-' if k == 0 else ' '} {key}: {_flow(value)}" for k, (key, value) in enumerate(plain)),
        "    table:  # t, x, y, psi",
        *(f"      - {_flow(row)}" for row in obstacle["table"]),
    ]
