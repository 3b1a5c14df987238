"""Obstacles of CommonRoad whose shapes are not about their origin, bend, or say little of where they are."""

import numpy as np
import pytest

import scenes
import slalom
from slalom import importing

pytest.importorskip("commonroad", reason="needs the extra slalom[commonroad]")
shapely = pytest.importorskip("shapely")

SEMI = ("<semiTrailerTruckShape><truckShape><truckDims><length>5</length><width>2.5</width><wheelbase>3.6</wheelbase>"
        "<distFromRearToRearAxle>0.5</distFromRearToRearAxle><cabinLength>2.5</cabinLength>"
        "<distFromRearAxleToHitch>0.5</distFromRearAxleToHitch></truckDims><originXShift>0</originXShift></truckShape>"
        "<trailerDims><length>12</length><width>2.5</width><wheelbase>7.8</wheelbase>"
        "<distFromFrontToHitch>1</distFromFrontToHitch></trailerDims></semiTrailerTruckShape>")
TRUCK = SEMI.split("<trailerDims>")[0].removeprefix("<semiTrailerTruckShape>").replace("Shift>0<", "Shift>-1.5<")
PLACE = "<center><x>1</x><y>0.5</y></center>"
SURE = "<position><point><x>60</x><y>5</y></point></position>"
ABOUT = "<position><circle><radius>1</radius><center><x>60</x><y>5</y></center></circle></position>"


def scene_of(folder, more, **others):
    """The scene of a small file with one more obstacle, which Slalom takes as a scenario."""
    file = folder / "map.xml"
    file.write_text(scenes.commonroad(parked=(60, -30), more=more, **others))
    scene = importing.commonroad(file)
    scene.write(folder / "map.yaml", force=True)
    return scene


def obstacle(folder, shape, kind="static", state="", position=SURE):
    """How such an obstacle, number 15, or the last part of it, is told of, and as Slalom has it."""
    first = scenes.state("initialState", 0, 60, 5, 0.1, scenes.exact("velocity", 8)).replace(SURE, position)
    scene = scene_of(folder, scenes.obstacle("2020a", 15, kind, "truck", shape, first, state))
    told = [o for o in scene.obstacles if o["name"].startswith("truck15")][-1]
    return told, next(o for o in slalom.load_scenario(folder / "map.yaml").obstacles if o.name == told["name"]), scene.notes


def turned(points, psi, x, y):
    c, s = np.cos(psi), np.sin(psi)
    return np.asarray(points) @ np.array([[c, s], [-s, c]]) + [x, y]


def apart(corners, expected):
    """How far two outlines are apart at the most [m]."""
    return shapely.Polygon(corners).hausdorff_distance(shapely.Polygon(expected))


def rectangle(length, width):
    return np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]]) * [length / 2, width / 2]


def test_a_rectangle_with_a_place_of_its_own(tmp_path):
    shape = scenes.box(4, 2).replace("</rectangle>", "<orientation>0.3</orientation>" + PLACE + "</rectangle>")
    own = turned(rectangle(4, 2), 0.3, 1, 0.5)
    _, standing, _ = obstacle(tmp_path, shape)
    assert apart(standing.corners_at(0.0), turned(own, 0.1, 60, 5)) < 1e-3
    _, moving, _ = obstacle(tmp_path, shape, "dynamic", scenes.state("state", 10, 70, 6, 0.6))
    assert apart(moving.corners_at(1.0), turned(own, 0.6, 70, 6)) < 1e-3
    told, _, _ = obstacle(tmp_path, scenes.box(4, 2).replace("</rectangle>", "<orientation>0.0</orientation></rectangle>"))
    assert (told["length"], told["width"]) == (4, 2)


def test_a_circle_with_a_place_of_its_own(tmp_path):
    _, found, _ = obstacle(tmp_path, f"<circle><radius>0.8</radius>{PLACE}</circle>")
    x, y = turned([[1, 0.5]], 0.1, 60, 5)[0]
    outline = shapely.Polygon(found.corners_at(0.0))
    circle = shapely.Point(x, y).buffer(0.8, 64)
    assert outline.buffer(1e-3).covers(circle) and circle.buffer(0.03).covers(outline)


@pytest.mark.parametrize("shape, message", [
    (scenes.box(4, 2).replace("</rectangle>", PLACE + "<originXShift>-1</originXShift></rectangle>"), "and originXShift"),
    ("<polygon>" + scenes.xml_points(rectangle(4, 2)) + PLACE + "</polygon>", "a <polygon> with center"),
    (scenes.box(4, 2).replace("</rectangle>", "<orientation><exact>1</exact></orientation></rectangle>"), "no number"),
])
def test_places_that_cannot_be_used(tmp_path, shape, message):
    with pytest.raises(importing.BadFile, match=message) as error:
        obstacle(tmp_path, shape)
    assert "map.xml:" in str(error.value)


@pytest.mark.parametrize("kind, state", [("static", ""), ("dynamic", ""), ("dynamic", scenes.state("state", 1, 60, 5, 0.1))])
def test_an_uncertain_place_of_a_shape_beside_its_origin(tmp_path, kind, state):
    """Wherever it may be, the obstacle has it."""
    shape = "<polygon>" + scenes.xml_points(rectangle(4, 2) + [3, 0]) + "</polygon>"
    _, found, _ = obstacle(tmp_path, shape, kind, state and state.replace(SURE, ABOUT), ABOUT)
    outline = shapely.Polygon(found.corners_at(0.0)).buffer(0.03)
    for angle in np.linspace(0, 2 * np.pi, 8):
        assert outline.covers(shapely.Polygon(turned(rectangle(4, 2) + [3, 0], 0.1, 60 + np.cos(angle), 5 + np.sin(angle))))


def test_an_obstacle_of_uncertain_place_goes_on(tmp_path):
    told, found, notes = obstacle(tmp_path, scenes.box(4, 2), "dynamic", position=ABOUT)
    assert told["after"] == "goes_on" and told["before"] == "absent"
    assert any(note.startswith("truck15: its place is not certain") for note in notes)
    for t in (0.0, 2.0):
        held = shapely.Polygon(turned(rectangle(4, 2), 0.1, 60 + 8 * t * np.cos(0.1) + 0.9, 5 + 8 * t * np.sin(0.1)))
        assert shapely.Polygon(found.corners_at(t)).buffer(0.05).covers(held)


def test_trucks_with_and_without_a_trailer_go_on(tmp_path):
    told, found, notes = obstacle(tmp_path, SEMI, "dynamic")
    assert any("truck15: its hull stands for it" in note for note in notes)
    # The truck's middle is the origin; its hitch is 1.5 m behind, and the trailer from 1 m before that on.
    own = np.array([[2.5, 1.25], [2.5, -1.25], [-1.5 + 1 - 12, -1.25], [-1.5 + 1 - 12, 1.25]])
    for t in (0.0, 2.0):
        assert apart(found.corners_at(t), turned(own, 0.1, 60 + 8 * t * np.cos(0.1), 5 + 8 * t * np.sin(0.1))) < 0.05
    told, found, _ = obstacle(tmp_path, TRUCK, "dynamic")
    assert (told["length"], told["width"]) == (5, 2.5)
    assert apart(found.corners_at(0.0), turned(rectangle(5, 2.5) + [1.5, 0], 0.1, 60, 5)) < 1e-3
    assert obstacle(tmp_path, SEMI)[0]["polygon"]


def test_a_phantom_that_says_nothing(tmp_path):
    scene = scene_of(tmp_path, '<phantomObstacle id="16"></phantomObstacle>')
    assert len(scene.obstacles) == 3 and "phantom16: says nothing of where it may be; left out" in scene.notes


def test_values_of_signs_stay_in_their_comment(tmp_path):
    sign = ('<trafficSign id="81"><trafficSignElement><trafficSignID>274</trafficSignID>'
            "<additionalValue>13&#10;name: other</additionalValue></trafficSignElement></trafficSign>")
    lanes = scenes.LANES.replace('<successor ref="2"/>', '<successor ref="2"/><trafficSignRef ref="81"/>', 1)
    scene = scene_of(tmp_path, sign, lanes=lanes)
    assert any("13 name: other" in note for note in scene.notes) and slalom.load_scenario(tmp_path / "map.yaml").name == "map"
