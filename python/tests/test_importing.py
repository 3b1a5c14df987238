"""Scenarios of other formats become scenario files, whole or not at all; bad files are refused with file and line."""

import pathlib

import numpy as np
import pytest

import scenes
import slalom
from slalom import importing
from slalom.importing import __main__ as command


@pytest.fixture(params=["2018b", "2020a"])
def version(request):
    pytest.importorskip("commonroad", reason="needs the extra slalom[commonroad]")
    return request.param


def written(folder, text, name="small.xml"):
    file = folder / name
    file.write_bytes(text if isinstance(text, bytes) else text.encode())
    return file


def test_a_track(tmp_path):
    scene = importing.track(written(tmp_path, scenes.track(), "ring.csv"))
    assert scene.closed and len(scene.points) == 60 and scene.goal == {"time": 60}
    assert scene.points[0] == [40, 0, 3, 4]
    assert scene.start["psi"] == pytest.approx(np.pi / 2) and scene.start["y"] == 0
    scene.write(tmp_path / "ring.yaml")
    assert slalom.load_scenario(tmp_path / "ring.yaml").name == "ring"
    commented = written(tmp_path, "# one\u2028two\r\n" + scenes.track().replace("\n", "\r\n"), "commented.csv")
    assert importing.track(commented).points == scene.points


def test_laps_of_a_track_are_driven(tmp_path):
    scene = importing.track(written(tmp_path, scenes.track(), "ring.csv"), laps=1)
    scene.write(tmp_path / "ring.yaml")
    drive = slalom.simulate(tmp_path / "ring.yaml")
    assert drive.outcome == "goal" and 0 < drive.goal_time < 40


def without_line(text, number):
    lines = text.splitlines()
    return "\n".join(lines[:number] + lines[number + 1:])


def eight():
    a = np.linspace(0, 2 * np.pi, 200, endpoint=False)
    return "x_m,y_m,w_tr_right_m,w_tr_left_m\n" + "".join(f"{60 * np.sin(t):.3f},{60 * np.sin(t) * np.cos(t):.3f},3,3\n" for t in a)


@pytest.mark.parametrize("text, place, message", [
    ("", "", "0 bytes"),
    (b"\0" * 1_000_000, "", "1000000 bytes without content"),
    (b"x_m,y_m,w_tr_right_m,w_tr_left_m\n\xff\xfe1,2,3,4\n", ":2", "no text"),
    ("a,b\n1,2\n", ":1", "the columns x_m"),
    (scenes.track().replace("40.0000,0.0000,3.0,4.0", "40.0000,nan,3.0,4.0"), ":2", "y_m nan"),
    (scenes.track().replace("40.0000,0.0000,3.0,4.0", "40.0000,zero,3.0,4.0"), ":2", "y_m 'zero'"),
    (scenes.track().replace("40.0000,0.0000,3.0,4.0", "40.0000,3.0,4.0"), ":2", "3 numbers"),
    ("\n".join(scenes.track().splitlines()[:5]), "", "4 rows"),
    ("\n".join(scenes.track().splitlines()[:31]), ":31", "a gap"),
    (without_line(scenes.track(), 0) + "\n", ":1", "the columns x_m"),
    (scenes.track(right=0.5, left=0.5), ":2", "the 1.61 m of the vehicle"),
    (scenes.track(right=-1.0), ":2", "none below zero"),
    (scenes.track(left=90.0), ":", "cross itself within its own width"),
    (eight(), ":", "crosses the line of line"),
    ("# x_m,y_m,w_tr_right_m,w_tr_left_m\n" + "1,1,3,3\n" * 20, ":3", "the same point twice"),
])
def test_bad_tracks(tmp_path, text, place, message):
    file = written(tmp_path, text, "bad.csv")
    with pytest.raises(importing.BadFile) as error:
        importing.track(file)
    assert str(error.value).startswith(f"{file}{place}") and message in str(error.value), error.value


def test_crossings_of_long_lines():
    """The same as of all pairs at once, in little memory."""
    import tracemalloc

    from slalom.importing._line import _crossings, crossings

    rng = np.random.default_rng(4)
    first, second = (np.cumsum(rng.normal(size=(n, 2)), axis=0) % 20 for n in (150, 333))
    pairs = crossings(first, second)
    assert len(pairs) > 20 and np.array_equal(pairs, _crossings(first, second))
    assert crossings(first[:2], first[:2]).shape == (0, 2)
    angles = np.linspace(0, 2 * np.pi, 4000)
    ring = np.column_stack([600 * np.cos(angles), 600 * np.sin(angles)])
    tracemalloc.start()
    assert len(crossings(ring, 1.01 * ring)) == 0
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 20e6


@pytest.mark.parametrize("name", ["null", "Null", "NULL", "true", "yes", "Off", "n", "lap\U0001f3ce", "ring\u2028\u0085road", "a b"])
def test_names_are_text(tmp_path, name):
    scene = importing.track(written(tmp_path, scenes.track(), name + ".csv"))
    scene.write(tmp_path / "ring.yaml")
    assert slalom.load_scenario(tmp_path / "ring.yaml").name == name


def test_comments_stay_comments(tmp_path):
    """Names of files, and what they say, may have line breaks."""
    scene = importing.track(written(tmp_path, scenes.track(), "ring\nstart: {x: 9}.csv"))
    scene.notes += ["one\ntwo: 3", "four\rfive: \u0085six: \x1b[1m"]
    text = scene.yaml()
    assert [line for line in text.splitlines() if line.startswith(("start", "two", "five", "six"))] == [
        line for line in text.splitlines() if line.startswith("start: {x: 40")]
    assert "# - one two: 3" in text and "# - four five: six: ?[1m" in text
    scene.write(tmp_path / "ring.yaml")


def test_a_scene(tmp_path, version):
    scene = importing.commonroad(written(tmp_path, scenes.commonroad(version)))
    car = scene.vehicle
    # The body's centre, 20 m along, is `centre` behind the front axle; lateral speed is that of the c.g.
    assert scene.start["x"] == pytest.approx(20 + car.centre * np.cos(0.1))
    assert scene.start["y"] == pytest.approx(car.centre * np.sin(0.1))
    assert scene.start["ux"] == pytest.approx(12 * np.cos(0.05))
    assert scene.start["v"] == pytest.approx(12 * np.sin(0.05) + 0.2 * (car.centre - car.la))
    # The goal lies in the left lane: its rectangle moves to the front axle, too.
    assert scene.goal["x"] == pytest.approx(150 + car.centre * np.cos(scene.goal["psi"]), abs=1e-3)
    assert scene.goal["psi"] == pytest.approx(0, abs=1e-9) and scene.goal["psi_tolerance"] == pytest.approx(0.2)
    assert scene.goal["length"] == 10 and scene.goal["width"] == pytest.approx(2 - 2 * car.centre * np.sin(0.2))
    assert [scene.goal[k] for k in ("ux_min", "ux_max", "t_min", "t_max")] == pytest.approx([5, 20, 5, 10])
    # The road: both lanes of this way, not the third.
    x, y, right, left = np.array(scene.points).T
    assert y + left == pytest.approx(np.full(len(x), 6), abs=0.01) and y - right == pytest.approx(np.full(len(x), -2), abs=0.01)
    assert x[0] <= 20 - car.length / 2 and x[-1] >= 199
    assert {round(p[1], 3) for line in scene.lanes for p in line} == {2}
    parked, ahead, walker = scene.obstacles
    assert (parked["x"], parked["y"], parked["length"], parked["width"]) == (60, 0.5, 4.5, 1.8)
    assert parked["psi"] == pytest.approx(0.1)
    assert len(ahead["table"]) == 21 and ahead["table"][-1] == pytest.approx([2, 60, 4, 0])
    assert (ahead["before"], ahead["after"]) == ("absent", "absent")
    assert walker["r"] == 0.4 and [row[0] for row in walker["table"]] == pytest.approx([0, 0.1, 0.3])
    text = scene.yaml()
    assert f"CommonRoad {version}" in text and "dt 0.1 s" in text and "planning problem 100" in text
    scene.write(tmp_path / "small.yaml")
    assert [o.name for o in slalom.load_scenario(tmp_path / "small.yaml").obstacles] == [o["name"] for o in scene.obstacles]


def test_lanes_of_the_other_way_where_they_are_needed(tmp_path, version):
    wide = scenes.commonroad(version, parked=(60, 2))
    wide = wide.replace("<length>4.5</length><width>1.8</width>", "<length>4.5</length><width>7.5</width>")
    file = written(tmp_path, wide)
    for oncoming, edge in (("never", 6), ("needed", 10), ("always", 10)):
        scene = importing.commonroad(file, oncoming=oncoming)
        x, y, _, left = np.array(scene.points)[20].T
        assert y + left == pytest.approx(edge, abs=0.01)
        assert any("parkedVehicle11 leaves" in note for note in scene.notes) == (oncoming != "always")


def test_a_recorded_drive_of_the_vehicle_is_no_obstacle(tmp_path, version):
    itself = scenes.obstacle(version, 15, "dynamic", "car", scenes.box(4.5, 1.6),
                             scenes.state("initialState", 0, 20.1, 0.1, 0.1, scenes.exact("velocity", 12)),
                             scenes.state("state", 1, 21.3, 0.1, 0.1))
    scene = importing.commonroad(written(tmp_path, scenes.commonroad(version, more=itself)))
    assert not any(o["name"] == "car15" for o in scene.obstacles) and any("car15: left out" in n for n in scene.notes)
    beside = itself.replace("<x>20.1</x>", "<x>21.5</x>").replace("<x>21.3</x>", "<x>22.7</x>")  # told of another point of it
    scene = importing.commonroad(written(tmp_path, scenes.commonroad(version, more=beside)))
    assert any("car15: left out" in n for n in scene.notes)
    ahead = itself.replace("<x>20.1</x>", "<x>23.9</x>").replace("<x>21.3</x>", "<x>25.1</x>")  # a bumper in its own
    scene = importing.commonroad(written(tmp_path, scenes.commonroad(version, more=ahead)))
    assert any(o["name"] == "car15" for o in scene.obstacles)
    later = itself.replace("<exact>0</exact></time>", "<exact>5</exact></time>").replace("<exact>1</exact></time>", "<exact>6</exact></time>")
    scene = importing.commonroad(written(tmp_path, scenes.commonroad(version, more=later)))
    assert [row[0] for o in scene.obstacles if o["name"] == "car15" for row in o["table"]] == pytest.approx([0.5, 0.6])


def test_goals_of_other_kinds(tmp_path, version):
    def goal_of(text, **others):
        return importing.commonroad(written(tmp_path, scenes.commonroad(version, goal=text, **others)))

    time = "<time><intervalStart>30</intervalStart><intervalEnd>40</intervalEnd></time>"
    lane = goal_of(f'<goalState><position><lanelet ref="4"/></position>{time}</goalState>').goal
    assert 100 <= lane["x"] - lane["length"] / 2 and lane["x"] + lane["length"] / 2 <= 202 and lane["length"] > 80
    assert 2 <= lane["y"] - lane["width"] / 2 + 0.03 and lane["y"] + lane["width"] / 2 <= 6.03 and lane["width"] > 2.5
    scene = goal_of(f"<goalState>{time}</goalState>")
    assert scene.goal == {"time": pytest.approx(4)} and scene.points and not scene.limits
    scene = goal_of("<goalState>" + time.replace(">40<", ">90<") + "</goalState>")  # the lanes end 180 m ahead
    assert 9 * scene.limits["ux_max"] == pytest.approx(200 - scene.start["x"] - scene.vehicle.front_overhang - 2, abs=0.1)
    scene = goal_of("")
    assert scene.goal == {"time": pytest.approx(2)} and any("there is none; as far as possible" in n for n in scene.notes)
    two = scenes.GOAL.replace("<x>150</x>", "<x>120</x>") + scenes.GOAL
    scene = goal_of(two)
    assert scene.goal["x"] < 125 and any("goal 2 of 2: left out" in n for n in scene.notes)
    off = scenes.state("initialState", 0, 20, 90, 0, scenes.exact("velocity", 0))
    scene = goal_of(scenes.GOAL.replace("<y>4</y>", "<y>90</y>"), start=off)
    assert not scene.points and any("neither start nor goal" in n for n in scene.notes)
    assert scene.start["ux"] == scene.vehicle.ux_min


def test_what_is_not_carried_over_is_named(tmp_path):
    pytest.importorskip("commonroad", reason="needs the extra slalom[commonroad]")
    more = ('<trafficLight id="71"><cycle><cycleElement><duration>3</duration><color>red</color></cycleElement></cycle></trafficLight>'
            f'<planningProblem id="99">{scenes.START}{scenes.GOAL}</planningProblem>')
    lanes = scenes.LANES.replace('<lanelet id="1">', '<lanelet id="1">', 1).replace(
        '<successor ref="2"/>', '<successor ref="2"/><stopLine><lineMarking>solid</lineMarking></stopLine><trafficLightRef ref="71"/>', 1)
    file = written(tmp_path, scenes.commonroad(lanes=lanes, more=more))
    notes = importing.commonroad(file, problem=100).notes
    for part in ("planning problem 99", "traffic light 71", "stop lines of lanelets 1"):
        assert any(part in note and "left out" in note for note in notes), (part, notes)
    assert all(f"# - {note}" in importing.commonroad(file, problem=100).yaml() for note in notes)
    with pytest.raises(importing.BadFile, match="no planning problem 5, expected one of 99, 100"):
        importing.commonroad(file, problem=5)


def test_where_an_obstacle_may_be(tmp_path):
    pytest.importorskip("commonroad", reason="needs the extra slalom[commonroad]")

    def occupancy(k):
        corners = [(90 + k, 0), (92 + 2 * k, 0), (92 + 2 * k, 2), (90 + k, 2)]
        return (f"<occupancy><shape><polygon>{scenes.xml_points(corners)}</polygon></shape>"
                f"<time><intervalStart>{k}</intervalStart><intervalEnd>{k + 1}</intervalEnd></time></occupancy>")

    more = ('<dynamicObstacle id="14"><type>car</type><shape>' + scenes.box(2, 2) + "</shape>"
            + scenes.state("initialState", 0, 91, 1, 0, scenes.exact("velocity", 3))
            + "<occupancySet>" + "".join(map(occupancy, range(1, 9))) + "</occupancySet></dynamicObstacle>")
    parts = [o for o in importing.commonroad(written(tmp_path, scenes.commonroad(more=more))).obstacles if o["name"].startswith("car14")]
    assert 2 <= len(parts) <= 5 and all("polygon" in part for part in parts)
    times = [[row[0] for row in part["table"]] for part in parts]
    assert times[0][0] <= 0 and times[-1][-1] >= 0.9
    assert all(ends[1] >= begins[0] for ends, begins in zip(times, times[1:]))
    for k in range(1, 9):  # each set lies in a part that is there
        there = [p for p, t in zip(parts, times) if t[0] <= k * 0.1 <= t[1]]
        reach = max(max(x for x, _ in p["polygon"]) + p["table"][0][1] for p in there)
        assert reach >= 92 + 2 * k - 0.03


@pytest.mark.parametrize("change, place, message", [
    (lambda text: "", "", "0 bytes"),
    (lambda text: " " * 1_000_000, "", "without content"),
    (lambda text: text[:len(text) // 2], ":", "cut short"),
    (lambda text: "<osm/>", ":1", "the element <osm>"),
    (lambda text: text.replace("2020a", "2017a"), ":2", "version '2017a', expected 2018b or 2020a"),
    (lambda text: text.replace('timeStepSize="0.1"', 'timeStepSize="0"'), ":2", "timeStepSize '0'"),
    (lambda text: text.replace("<x>150</x>", "<x>nan</x>"), ":7", "<x> 'nan'"),
    (lambda text: text.replace("<width>1.8</width>", "<width>0</width>"), ":5", "<width> 0"),
    (lambda text: text.replace("<point><x>0</x><y>2</y></point>", "", 1), ":4", "lanelet 1 with 5 points"),
    (lambda text: text.replace('<successor ref="2"/>', '<successor ref="77"/>'), ":4", "successor '77' of lanelet 1"),
    (lambda text: text.replace("<shape><circle><radius>0.4</radius></circle></shape>", "<shape></shape>"), ":5", "an empty <shape>"),
    (lambda text: text.replace("<y>-4.9</y>", ""), ":5", "<point> without <y>"),
    (lambda text: text.replace('id="12"', 'id="twelve"'), ":5", "the id 'twelve'"),
    (lambda text: text.split("<planningProblem")[0] + "</commonRoad>", "", "no planningProblem"),
    (lambda text: text.replace("<x>20</x><y>0</y>", "<x>20</x><y>-9</y>"), "", "off the road: 7.0 m from lanelet 1"),
    (lambda text: text.replace("<orientation><exact>0.1</exact></orientation><time><exact>0</exact></time><velocity><exact>12",
                               "<orientation><exact>3</exact></orientation><time><exact>0</exact></time><velocity><exact>12"),
     "", "faces against lanelet 1"),
    (lambda text: text.replace("<velocity><exact>12<", "<velocity><exact>-12<"), "", "does not drive backwards"),
    (lambda text: text.replace("<x>150</x><y>4</y>", "<x>50</x><y>8</y>"), "", "no way from lanelet 1"),
    (lambda text: text.replace("<x>150</x><y>4</y>", "<x>150</x><y>40</y>"), "", "a goal at (150, 40), off the road: 34.0 m from lanelet"),
    (lambda text: text.replace(scenes.LANES, scenes.LANES.replace("<y>2</y>", "<y>0.8</y>").replace("<y>-2</y>", "<y>-0.8</y>")
                                             .replace(' drivingDir="same"', ' drivingDir="opposite"')).replace("<y>4</y></center>", "<y>0</y></center>"),
     "", "m wide at"),
])
def test_bad_scenes(tmp_path, change, place, message):
    pytest.importorskip("commonroad", reason="needs the extra slalom[commonroad]")
    file = written(tmp_path, change(scenes.commonroad()))
    with pytest.raises(importing.BadFile) as error:
        importing.commonroad(file)
    assert str(error.value).startswith(f"{file}{place}") and message in str(error.value), error.value


def test_the_command(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    file = written(tmp_path, scenes.track(), "ring.csv")
    assert command.main(["track", str(file)]) == 0 and (tmp_path / "ring.yaml").exists()
    assert "60 points" in capsys.readouterr().out
    before = (tmp_path / "ring.yaml").read_text()
    assert command.main(["track", str(file), "--speed", "9"], "slalom import") == 3
    assert capsys.readouterr().err.startswith("slalom: ring.yaml: stands already") and (tmp_path / "ring.yaml").read_text() == before
    assert command.main(["track", str(file), "--speed", "9", "--force", "--quiet"]) == 0
    assert "ux: 9" in (tmp_path / "ring.yaml").read_text() and capsys.readouterr().out == ""
    assert command.main(["track", "none.csv"]) == 2 and "none.csv: found no such file" in capsys.readouterr().err
    assert command.main(["track", str(file), "--out", "no/folder/ring.yaml"]) == 3
    assert command.main(["track", str(file), "--vehicle", "bmw_320j", "--force"]) == 2
    assert "bmw_320j" in capsys.readouterr().err
    assert sorted(p.name for p in tmp_path.iterdir()) == ["ring.csv", "ring.yaml"]


def test_a_file_that_cannot_be_read_is_bad_input(tmp_path, monkeypatch, capsys):
    def denied(self, *_, **__):
        raise PermissionError(13, "Permission denied", str(self))

    file = written(tmp_path, scenes.track(), "ring.csv")
    for call in ("read_bytes", "is_file"):  # of the file, and of one in a folder that may not be searched
        with monkeypatch.context() as patch:
            patch.setattr(pathlib.Path, call, denied)
            assert command.main(["track", str(file), "--out", str(tmp_path / "ring.yaml")]) == 2
        assert "ring.csv: found a file that cannot be read (Permission denied)" in capsys.readouterr().err
    assert command.main(["track", str(tmp_path / ("n" * 300 + ".csv"))]) == 2  # longer than a name may be


def test_without_the_extra(tmp_path, monkeypatch, capsys):
    monkeypatch.setitem(__import__("sys").modules, "commonroad.common.file_reader", None)
    assert command.main(["commonroad", str(written(tmp_path, scenes.commonroad()))]) == 2
    assert "pip install 'slalom[commonroad]'" in capsys.readouterr().err
