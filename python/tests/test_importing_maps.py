"""Maps and starts as recordings and converters leave them: with gaps, off their lanes, beyond what a vehicle can."""

import numpy as np
import pytest

import scenes
import slalom
from slalom import importing

pytest.importorskip("commonroad", reason="needs the extra slalom[commonroad]")


def scene_of(folder, **others):
    """The scene of a small file, which Slalom takes as a scenario."""
    file = folder / "map.xml"
    file.write_text(scenes.commonroad(**others))
    scene = importing.commonroad(file)
    scene.write(folder / "map.yaml", force=True)
    return scene


def start(x=20.0, y=0.0, psi=0.0, speed=12.0, more=""):
    return scenes.state("initialState", 0, x, y, psi, scenes.exact("velocity", speed) + more)


def edges(scene):
    """x, and y of the right and the left edge, of a road along x."""
    x, y, right, left = np.array(scene.points).T
    return x, y - right, y + left


def test_a_vehicle_that_begins_partly_beside_its_lanelets(tmp_path):
    scene = scene_of(tmp_path, start=start(y=-1.5))
    x, right, _ = edges(scene)
    car = scene.vehicle
    about = (x > 20 - car.length / 2) & (x < 20 + car.length / 2)
    assert np.all(right[about] < -1.5 - car.width / 2) and np.all(right[about] > -1.5 - car.width / 2 - 0.2)
    assert right[x > 60] == pytest.approx(-2, abs=0.01)
    assert any("wider about the start" in note for note in scene.notes)
    assert not any("wider" in note for note in scene_of(tmp_path, start=start()).notes)


def test_a_vehicle_that_turns_into_its_lane(tmp_path):
    """It begins across its lane, and comes beside it, on that of the other way, before it can be along it."""
    lanes = scenes.straight(1, 0, 200, 0, '<adjacentLeft ref="5" drivingDir="opposite"/>') + scenes.straight(
        5, 0, 200, 4, '<adjacentLeft ref="1" drivingDir="opposite"/>', backwards=True)
    across = {"start": start(y=0.5, psi=0.3, speed=8), "goal": scenes.GOAL.replace("<y>4</y>", "<y>0</y>"), "parked": (150, 20)}
    scene = scene_of(tmp_path, lanes=lanes, **across)
    x, right, left = edges(scene)
    assert 2.3 < left[(x > 22) & (x < 26)].max() < 4 and left[x > 80] == pytest.approx(2, abs=0.01) and right.min() > -2.01
    assert any("wider about the start" in note for note in scene.notes)
    alone = scene_of(tmp_path, lanes=lanes.split('<lanelet id="5"')[0].replace('<adjacentLeft ref="5" drivingDir="opposite"/>', ""), **across)
    assert edges(alone)[2].max() < 2.3  # no lanelet to turn on


def test_a_start_beyond_the_vehicle(tmp_path):
    scene = scene_of(tmp_path, start=start(more=scenes.exact("acceleration", 30)))
    assert 0 < scene.start["ax"] < 11.5
    assert any("acceleration" in note and "in place of 30" in note for note in scene.notes)
    with pytest.raises(slalom.InvalidValue):
        more = dict(scene.start, ax=scene.start["ax"] + 0.1)
        slalom.load_scenario({"vehicle": "bmw_320i", "start": more, "goal": {"x": 0, "y": 100}})


@pytest.mark.parametrize("name", ["acceleration", "slipAngle"])
def test_a_reduced_start_is_within_the_limits_as_it_is_written(tmp_path, name):
    """Rounded to the digits of the file, many a limit is passed; writing the scenario would say so."""
    beyond = {"acceleration": (12, -14, 30), "slipAngle": (0.4, -0.6, 0.9)}[name]
    for value in beyond:
        for speed in (11, 17.7, 31):
            (tmp_path / "map.xml").write_text(scenes.commonroad(start=start(speed=speed, more=scenes.exact(name, value))))
            scene = importing.commonroad(tmp_path / "map.xml", vehicle="vw_vanagon")
            assert any("in place of" in note for note in scene.notes)
            scene.write(tmp_path / "map.yaml", force=True)


def test_numbers_are_cut_to_the_digits_of_the_file():
    from slalom.importing._scene import no_less, no_more

    assert [no_more(x) for x in (1.234567, -1.234567, 1.1, -0.000001)] == [1.23456, -1.23456, 1.1, 0]
    assert [no_less(x) for x in (1.234561, 1.1, 0.29)] == [1.23457, 1.1, 0.29]


def test_a_vehicle_that_is_recorded_to_roll_back(tmp_path):
    scene = scene_of(tmp_path, start=start(speed=-0.1))
    assert scene.start["ux"] == scene.vehicle.ux_min and any("-0.1 m/s" in note for note in scene.notes)
    with pytest.raises(importing.BadFile, match="does not drive backwards"):
        scene_of(tmp_path, start=start(speed=-2))


def test_gaps_between_lanelets(tmp_path):
    gap = (scenes.straight(1, 0, 100, 0, '<successor ref="2"/><adjacentLeft ref="3" drivingDir="same"/>')
           + scenes.straight(2, 100.4, 200, 0, '<predecessor ref="1"/><adjacentLeft ref="4" drivingDir="same"/>')
           + scenes.straight(3, 0, 100, 4, '<successor ref="4"/><adjacentRight ref="1" drivingDir="same"/>')
           + scenes.straight(4, 100.4, 200, 4, '<predecessor ref="3"/><adjacentRight ref="2" drivingDir="same"/>'))
    _, right, left = edges(scene_of(tmp_path, lanes=gap))
    assert right == pytest.approx(np.full(len(right), -2), abs=0.02) and left == pytest.approx(np.full(len(left), 6), abs=0.02)


def test_a_change_of_lanes_where_there_is_one_beside(tmp_path):
    """A single lane runs into the right one of three, short at first, of which the goal is in the left one."""
    def three(first, last, numbers, following, before=None):
        return "".join(scenes.straight(
            n, first, last, 4 * k,
            (f'<predecessor ref="{before}"/>' if before and not k else "")
            + (f'<successor ref="{following[k]}"/>' if following else "")
            + (f'<adjacentLeft ref="{numbers[k + 1]}" drivingDir="same"/>' if k < 2 else "")
            + (f'<adjacentRight ref="{numbers[k - 1]}" drivingDir="same"/>' if k else "")) for k, n in enumerate(numbers))

    lanes = (scenes.straight(1, 0, 60, 0, '<successor ref="21"/>') + three(60, 70, (21, 22, 23), (31, 32, 33), before=1)
             + three(70, 200, (31, 32, 33), None))
    scene = scene_of(tmp_path, lanes=lanes, goal=scenes.GOAL.replace("<y>4</y>", "<y>8</y>"), parked=(120, 0))
    x, y, right, left = np.array(scene.points).T
    assert np.all(right + left > 3.5)
    assert np.abs(y[x < 58]).max() < 0.3 and y[x > 150] == pytest.approx(8, abs=0.1)
    before = x < 58
    assert np.all(y[before] + left[before] < 2.05) and np.all(y - right > -2.05)


def test_a_bend_that_the_body_does_not_fit_in(tmp_path):
    """A lane 2.5 m wide turns left with a radius of 5 m: the road takes of other lanes what the body needs there."""
    angles = np.linspace(0, np.pi / 2, 9)
    middle = np.vstack([np.column_stack([np.linspace(0, 60, 16), np.zeros(16)]),
                        np.column_stack([60 + 5 * np.sin(angles), 5 - 5 * np.cos(angles)])[1:],
                        np.column_stack([np.full(20, 65.0), np.linspace(8, 100, 20)])])
    psi = np.arctan2(*np.gradient(middle, axis=0).T[::-1])
    aside = 1.25 * np.column_stack([-np.sin(psi), np.cos(psi)])
    bend = scenes.lanelet(1, middle + aside, middle - aside)
    others = scenes.lanelet(2, [(40, 1.25), (63.75, 1.25)], [(40, -3), (63.75, -3)]) + scenes.lanelet(3, [(63.75, -3), (63.75, 40)], [(69, -3), (69, 40)])
    goal = scenes.GOAL.replace("<x>150</x><y>4</y>", "<x>65</x><y>60</y>").replace("<orientation>0<", "<orientation>1.5708<")
    goal = goal.replace("-0.2<", "1.3<").replace(">0.3</intervalEnd>", ">1.8</intervalEnd>")
    given = {"goal": goal, "start": start(speed=5), "parked": (20, 30)}
    alone, among = (scene_of(tmp_path, lanes=lanes, **given) for lanes in (bend, bend + others))
    assert not any("in bends" in note for note in alone.notes) and any("in bends" in note for note in among.notes)

    def widths(scene):
        x, y, right, left = np.array(scene.points).T
        return right[np.hypot(x - 65, y) < 5].max(), right[x < 45].max(), left.max()

    assert widths(alone)[0] < 1.45 and widths(among)[0] > 1.6
    assert widths(among)[1] < 1.45 and widths(among)[2] < 1.45  # as before where it is straight, and inside, beside no lane


def test_a_goal_at_the_end_of_the_map(tmp_path):
    goal = (scenes.GOAL.replace("<length>10</length>", "<length>2</length>").replace("<x>150</x>", "<x>200</x>"))
    scene = scene_of(tmp_path, goal=goal)
    assert scene.goal["x"] == pytest.approx(200 + scene.vehicle.centre, abs=0.01) and scene.goal["length"] == 2
    assert scene.points[-1][0] > scene.goal["x"] + 1
    assert any("beyond it" in note for note in scene.notes)


def test_a_goal_partly_beside_the_road_keeps_its_heading(tmp_path):
    goal = scenes.GOAL.replace("<orientation>0<", "<orientation>0.4<").replace("-0.2<", "0.3<").replace(">0.3</intervalEnd>", ">0.5</intervalEnd>")
    scene = scene_of(tmp_path, goal=goal.replace("<length>10<", "<length>12<"))
    assert scene.goal["psi"] == pytest.approx(0.4, abs=0.06) and scene.goal["psi_tolerance"] > 0.04
    assert scene.goal["length"] > 2


def test_a_lanelet_whose_direction_is_just_beside_the_heading(tmp_path):
    """Of the headings that the goal has, that which is nearest to the lane's: along it, not across."""
    goal = ('<goalState><position><lanelet ref="4"/></position><orientation><intervalStart>0.002</intervalStart>'
            "<intervalEnd>3.14</intervalEnd></orientation><time><intervalStart>50</intervalStart><intervalEnd>100</intervalEnd></time></goalState>")
    scene = scene_of(tmp_path, goal=goal)
    assert 0.05 < scene.goal["psi"] < 0.2 and scene.goal["psi_tolerance"] == pytest.approx(scene.goal["psi"] - 0.002, abs=0.01)
    assert scene.goal["length"] > 2 * scene.goal["width"] > 1


def test_intersections_that_the_reader_refuses(tmp_path):
    one = '<intersection id="{}"><incoming id="0"><incomingLanelet ref="1"/><successorsStraight ref="2"/></incoming></intersection>'
    scene = scene_of(tmp_path, more=one.format(301) + one.format(302))
    assert {f"right of way of intersection {k}: left out" for k in (301, 302)} <= set(scene.notes)


def test_headers_that_the_reader_refuses(tmp_path):
    text = scenes.commonroad()
    for found, put in (("<scenarioTags><urban/></scenarioTags>", ""), ("<gpsLatitude>999</gpsLatitude>", "<gpsLatitude/>")):
        assert found in text
        (tmp_path / "map.xml").write_text(text.replace(found, put))
        assert len(importing.commonroad(tmp_path / "map.xml").obstacles) == 3
    (tmp_path / "map.xml").write_text(scenes.commonroad("2018b").replace(' tags="urban"', ""))
    assert len(importing.commonroad(tmp_path / "map.xml").obstacles) == 3


def test_points_may_have_heights(tmp_path):
    """Of lanelets, starts, obstacles and goals alike: a road lies in the plane."""
    flat = scene_of(tmp_path).yaml()
    high = scenes.commonroad().replace("</y></point>", "</y><z>1.5</z></point>").replace("</y></center>", "</y><z>1.5</z></center>")
    (tmp_path / "map.xml").write_text(high)
    assert importing.commonroad(tmp_path / "map.xml").yaml() == flat


def test_what_the_reader_takes_and_cannot_use_is_a_bad_file(tmp_path, monkeypatch):
    from slalom.importing import _commonroad

    file = tmp_path / "map.xml"
    text = scenes.commonroad()
    file.write_text(text)
    with monkeypatch.context() as patched:
        patched.setattr(_commonroad, "lanes_of", lambda network: network.no_such_thing)
        with pytest.raises(importing.BadFile, match="what cannot be imported .AttributeError"):
            importing.commonroad(file)
    head, tail = text.split("<initialState>")[:-1], text.split("<initialState>")[-1]
    later = tail.replace("<time><exact>0</exact></time>", "<time><intervalStart>0</intervalStart><intervalEnd>1</intervalEnd></time>", 1)
    file.write_text("<initialState>".join([*head, later]))
    with pytest.raises(importing.BadFile, match="begins at no exact time"):
        importing.commonroad(file)


def test_long_lines_are_smoothed_by_their_bands():
    from slalom.importing._line import smoothed

    points = np.column_stack([np.arange(60.0), 3 * np.sin(np.arange(60) / 4)])
    third, ends = np.diff(np.eye(60), n=3, axis=0), np.diag([1e6, *[1] * 58, 1e6])
    weight = (12 / (2 * np.pi * np.hypot(*np.diff(points, axis=0).T).mean())) ** 6
    assert smoothed(points, 12) == pytest.approx(np.linalg.solve(ends + weight * third.T @ third, ends @ points), abs=1e-8)
    long = np.column_stack([np.arange(20_000.0), np.zeros(20_000)])
    assert smoothed(long, 12) == pytest.approx(long, abs=1e-3)


def test_of_lanes_over_each_other_the_straight_one_is_taken(tmp_path):
    """Two lanes begin at the same place, of which one turns off; the vehicle has just come onto both."""
    a = np.linspace(0, np.pi / 2, 12)
    bend = [[(20 + (20 - k) * np.sin(t), 20 - (20 - k) * np.cos(t)) for t in a] for k in (2, -2)]
    left_off = scenes.lanelet(1, bend[0], bend[1])
    lanes = left_off + scenes.straight(2, 20, 160, 0)
    for psi, ahead in ((0.02, True), (0.0, True)):
        scene = scene_of(tmp_path, lanes=lanes, start=start(x=22.5, y=0.1, psi=psi), goal="", parked=(150, 0))
        assert (scene.points[-1][0] > 80) == ahead
    middle = start(x=20 + 20 * np.sin(0.6), y=20 - 20 * np.cos(0.6), psi=0.6)
    assert scene_of(tmp_path, lanes=lanes, start=middle, goal="", parked=(150, 0)).points[-1][0] < 45


def test_a_vehicle_whose_middle_is_just_beside_its_lanelet(tmp_path):
    scene = scene_of(tmp_path, start=start(y=-2.6))
    assert scene.points[-1][0] > 190 and any("wider about the start" in note for note in scene.notes)
    with pytest.raises(importing.BadFile, match="off the road: 2.0 m from lanelet 1"):
        scene_of(tmp_path, start=start(y=-4.0))


def test_a_goal_whose_centre_is_beside_the_road_for_the_front_axle():
    from slalom.importing._goal import kept_on
    from slalom.importing._road import Road

    x = np.arange(0.0, 50.0)
    road = Road(np.column_stack([x, 0 * x]), 0 * x + 2, 0 * x + 3, None, [])
    for y, kept in ((3.2, 2.95), (-2.1, -1.95), (2.9, 2.9)):
        box = kept_on(road, {"x": 20.0, "y": y, "psi": 0.3, "length": 2.0, "width": 1.0})
        assert (box["x"], box["y"], box["length"]) == pytest.approx((20, kept, 2))
        assert box["width"] == pytest.approx(1 - 2 * abs(y - kept))


def test_circles_have_their_radius(tmp_path):
    """As a goal, where something may be, and before the judge."""
    circle = "<circle><radius>1.5</radius><center><x>{}</x><y>{}</y></center></circle>"
    goal = ("<goalState><position>" + circle.format(150, 4) + "</position>"
            "<time><intervalStart>50</intervalStart><intervalEnd>100</intervalEnd></time></goalState>")
    more = ('<dynamicObstacle id="14"><type>car</type><shape>' + scenes.box(2, 2) + "</shape>" + scenes.state("initialState", 0, 91, 1)
            + "<occupancySet><occupancy><shape>" + circle.format(95, 1) + "</shape><time><exact>1</exact></time></occupancy></occupancySet>"
            + "</dynamicObstacle>")
    scene = scene_of(tmp_path, goal=goal, more=more)
    # A circle of half the radius holds no rectangle that long and wide.
    assert scene.goal["length"] > 1.5 and scene.goal["length"] * scene.goal["width"] > 1.5**2 / 2
    last = [o for o in scene.obstacles if o["name"].startswith("car14")][-1]
    assert np.abs(np.array(last["polygon"])[:, 0]).max() == pytest.approx(1.5, abs=0.05)
