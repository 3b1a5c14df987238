"""CommonRoad XML, 2018b and 2020a: looked at for what would go wrong, then read by commonroad-io."""

from __future__ import annotations

import contextlib
import logging
import math
import os
import warnings
from typing import Any, Iterator

from ._files import BadFile, read

VERSIONS = ("2018b", "2020a")
EXPECTED = f"a CommonRoad scenario, XML of version {' or '.join(VERSIONS)}"
NUMBERS = frozenset(("x", "y", "exact", "intervalStart", "intervalEnd", "length", "width", "radius", "orientation"))
SIZES = frozenset(("length", "width", "radius"))
REFERENCES = frozenset(("successor", "predecessor", "adjacentLeft", "adjacentRight", "lanelet"))
SIGNS = {
    "trafficSign": "traffic sign",
    "trafficLight": "traffic light",
    "intersection": "right of way of intersection",
    "trafficSignRef": "",
    "trafficLightRef": "",
}
"""What the vehicle is not told of, and its name."""
NEEDED = {
    "point": ("x", "y"),
    "center": ("x", "y"),
    "rectangle": ("length", "width"),
    "circle": ("radius",),
    "initialState": ("position", "time"),
    "state": ("time",),
    "goalState": ("time",),
    "occupancy": ("shape", "time"),
    "staticObstacle": ("type", "shape", "initialState"),
    "dynamicObstacle": ("type", "shape", "initialState"),
    "obstacle": ("role", "type", "shape", "initialState"),
    "trafficSignElement": ("trafficSignID",),
}
"""What elements must hold."""
OBSTACLES = ("obstacle", "staticObstacle", "dynamicObstacle")
CORNERS = 16
"""Of a polygon about a circle: at most 2 % wider."""
MISSING = "CommonRoad's reader is missing: python3 -m pip install 'slalom[commonroad]'"


class ExtraMissing(ImportError):
    """A package that an importer or exporter needs is not installed; the message says what to install."""


def open_file(file: str | os.PathLike[str]) -> tuple[Any, Any, list[str]]:
    """Scenario and planning problems as commonroad-io has them, and what it could not read, by name.

    Raises BadFile, and ExtraMissing without it.
    """
    try:
        from commonroad.common.file_reader import CommonRoadFileReader
    except ImportError:
        raise ExtraMissing(MISSING) from None
    root = check(file, read(file, EXPECTED))
    changed = _flattened(root) + _placed(file, root)
    unread: list[str] = []
    with quiet():
        try:
            scenario, problems = _reread(root) if changed else CommonRoadFileReader(os.fspath(file)).open()
        except Exception as error:  # its messages are of all kinds
            try:
                scenario, problems = _bare(root)
                unread = [f"{SIGNS[each.tag]} {each.get('id')}: left out" for each in root if SIGNS.get(each.tag)]
            except Exception:
                found = f"what commonroad-io cannot read ({type(error).__name__}: {error})"
                raise BadFile(file, found, EXPECTED) from None
    _complete(root, problems.planning_problem_dict)
    return scenario, problems, unread


def _bare(root: Any) -> tuple[Any, Any]:
    """The same of what a vehicle drives on and among alone: many a file has signs, lights and intersections that
    commonroad-io refuses, such as incomings of several intersections with one id, or no location and tags."""
    import copy

    from lxml import etree

    plain = copy.deepcopy(root)
    for element in [each for each in plain.iter() if each.tag in SIGNS or each.tag in ("location", "scenarioTags")]:
        element.getparent().remove(element)
    plain.insert(0, etree.Element("scenarioTags"))
    for name in ("author", "affiliation", "source", "tags", "date"):
        plain.set(name, plain.get(name) or "")
    return _reread(plain)


def _reread(root: Any) -> tuple[Any, Any]:
    """Scenario and planning problems of an element, by way of a file: commonroad-io reads nothing else."""
    import tempfile

    from commonroad.common.file_reader import CommonRoadFileReader
    from lxml import etree

    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "plain.xml")
        etree.ElementTree(root).write(file)
        return CommonRoadFileReader(file).open()  # type: ignore[no-any-return]


def _flattened(root: Any) -> int:
    """Takes the heights off all points, for a road lies in the plane. Returns how many."""
    heights = [each for tag in ("point", "center") for each in root.iterfind(f".//{tag}/z")]
    for height in heights:
        height.getparent().remove(height)
    return len(heights)


def _placed(file: str | os.PathLike[str], root: Any) -> int:
    """Makes polygons of obstacles' shapes that have a center or an orientation of their own, which commonroad-io
    passes over. Returns how many. Raises BadFile for such of other shapes."""
    shapes = [each for kind in OBSTACLES for each in root.iterfind(f"{kind}/shape/*")]
    count = 0
    for shape in shapes:
        given = [shape.find(name) for name in ("center/x", "center/y", "orientation")]
        x, y, psi = (0.0 if each is None else _number(each.text) for each in given)
        if x is None or y is None or psi is None:
            raise BadFile(file, f"a <{shape.tag}> whose place is no number", "x, y and orientation", shape.sourceline)
        if not (x or y or psi):
            continue
        shifted = _number(shape.findtext("originXShift") or "0") != 0
        if shape.tag not in ("rectangle", "circle") or shifted:
            found = f"a <{shape.tag}> with center or orientation" + (" and originXShift" if shifted else "")
            raise BadFile(file, found, "those of a rectangle or a circle, without a shift", shape.sourceline)
        shape.getparent().replace(shape, _polygon(shape, x, y, psi))
        count += 1
    return count


def _polygon(shape: Any, x: float, y: float, psi: float) -> Any:
    """The corners of a rectangle or about a circle, turned by `psi` and moved to (x, y), as an element."""
    from lxml import etree

    if shape.tag == "circle":
        angles = [2 * math.pi * k / CORNERS for k in range(CORNERS)]
        outside = float(shape.findtext("radius")) / math.cos(math.pi / CORNERS)
        corners = [(outside * math.cos(angle), outside * math.sin(angle)) for angle in angles]
    else:
        half = [float(shape.findtext(name)) / 2 for name in ("length", "width")]
        corners = [(a * half[0], b * half[1]) for a, b in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
    c, s = math.cos(psi), math.sin(psi)
    polygon = etree.Element("polygon")
    for a, b in corners:
        point = etree.SubElement(polygon, "point")
        etree.SubElement(point, "x").text = repr(x + c * a - s * b)
        etree.SubElement(point, "y").text = repr(y + s * a + c * b)
    return polygon


def _complete(root: Any, problems: dict[int, Any]) -> None:
    """commonroad-io reads an initial state's values up to the first that the file leaves out, and takes the others for 0."""
    for element in root.iterchildren("planningProblem"):
        state = problems[int(element.get("id"))].initial_state
        for tag, name in (
            ("velocity", "velocity"),
            ("acceleration", "acceleration"),
            ("yawRate", "yaw_rate"),
            ("slipAngle", "slip_angle"),
        ):
            exact = element.findtext(f"initialState/{tag}/exact")
            if exact is not None:
                setattr(state, name, float(exact))


def check(file: str | os.PathLike[str], content: bytes) -> Any:
    """The root element. Raises BadFile with the line where the file is not XML, of another version, or says what cannot be."""
    from lxml import etree

    parser = etree.XMLParser(resolve_entities=False, no_network=True)
    try:
        root = etree.fromstring(content, parser)
    except etree.XMLSyntaxError as error:
        found = f"XML that is cut short or damaged ({(error.msg or 'nothing').split(', line')[0]})"
        raise BadFile(file, found, EXPECTED, error.lineno) from None
    if root.tag != "commonRoad":
        raise BadFile(file, f"the element <{root.tag}>", EXPECTED, root.sourceline)
    version = root.get("commonRoadVersion")
    if version not in VERSIONS:
        raise BadFile(file, f"version {version!r}", " or ".join(VERSIONS), root.sourceline)
    step = _number(root.get("timeStepSize"))
    if step is None or step <= 0:
        raise BadFile(file, f"timeStepSize {root.get('timeStepSize')!r}", "seconds above zero", root.sourceline)
    _check_elements(file, root)
    _check_numbers(file, root)
    _check_lanelets(file, root)
    if root.find("planningProblem") is None:
        raise BadFile(file, "no planningProblem", "at least one: a start and a goal")
    for problem in root.iter("planningProblem"):
        if problem.find("initialState/position") is None:
            raise BadFile(file, "a planningProblem without initialState and position", "a start", problem.sourceline)
        if problem.find("initialState/time/exact") is None:
            raise BadFile(file, "a planningProblem that begins at no exact time", "a time step", problem.sourceline)
    return root


def _check_elements(file: str | os.PathLike[str], root: Any) -> None:
    for element in root.iter():
        for name in NEEDED.get(element.tag, ()):
            if element.find(name) is None:
                raise BadFile(
                    file,
                    f"<{element.tag}> without <{name}>",
                    f"one with {', '.join(NEEDED[element.tag])}",
                    element.sourceline,
                )
        if element.tag in ("shape", "position") and not len(element):
            raise BadFile(file, f"an empty <{element.tag}>", "a place or a shape", element.sourceline)
        number = element.get("id") if isinstance(element.tag, str) else None
        if number is not None and not number.lstrip("-").isdigit():
            raise BadFile(file, f"the id {number!r} of <{element.tag}>", "a whole number", element.sourceline)


def _check_numbers(file: str | os.PathLike[str], root: Any) -> None:
    for element in root.iter():
        if element.tag not in NUMBERS or len(element):
            continue
        value = _number(element.text)
        if value is None or abs(value) > 1e9:
            raise BadFile(file, f"<{element.tag}> {(element.text or '')[:40]!r}", "a finite number", element.sourceline)
        if element.tag in SIZES and value <= 0:
            raise BadFile(file, f"<{element.tag}> {value:g}", "metres above zero", element.sourceline)


def _check_lanelets(file: str | os.PathLike[str], root: Any) -> None:
    lanelets = [element for element in root.iterchildren("lanelet")]
    known = [element.get("id") for element in lanelets]
    for lanelet in lanelets:
        counts = [len(lanelet.findall(f"{bound}/point")) for bound in ("leftBound", "rightBound")]
        if counts[0] != counts[1] or counts[0] < 2:
            raise BadFile(
                file,
                f"lanelet {lanelet.get('id')} with {counts[0]} points to its left and {counts[1]} to its right",
                "as many on both sides, at least 2",
                lanelet.sourceline,
            )
        for element in lanelet.iterchildren():
            if element.tag in REFERENCES and element.get("ref") not in known:
                raise BadFile(
                    file,
                    f"{element.tag} {element.get('ref')!r} of lanelet {lanelet.get('id')}",
                    "the id of a lanelet of this file",
                    element.sourceline,
                )
    if len(set(known)) < len(known):
        double = next(i for i in known if known.count(i) > 1)
        raise BadFile(file, f"two lanelets {double}", "ids that differ")


def _number(text: str | None) -> float | None:
    try:
        value = float(text or "")
    except ValueError:
        return None
    return value if math.isfinite(value) else None


@contextlib.contextmanager
def quiet() -> Iterator[None]:
    """Without the reader's own lines, which say nothing of this file alone."""
    before = logging.root.manager.disable
    logging.disable(logging.CRITICAL)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    finally:
        logging.disable(before)
