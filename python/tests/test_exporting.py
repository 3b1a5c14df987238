"""Drives in other formats are read back by the packages of those formats; bad folders are refused."""

import csv
import dataclasses
import json
import os
import pathlib
import shutil
import subprocess
import types

import numpy as np
import pytest

import scenes
import slalom
from slalom import exporting
from slalom.exporting import __main__ as command
from slalom.exporting import _rerun
from slalom.exporting._shapes import believed, moves

PROGRAM = os.environ.get("SLALOM") or str(pathlib.Path(slalom.__file__).parent / "bin" / "slalom")
SCENARIO = """name: small
vehicle: {base: hmmwv, footprint: rectangle}
start: {x: 0, y: 0, psi_deg: 0, ux: 10}
goal: {x: 60, y: 0, psi_deg: 0, sigma: 8}
planner: {base: P_D}
loop: {sm_crash: 0}
obstacles:
  - {name: box, x: 30, y: 12, length: 4, width: 2, psi_deg: 30}
  - {name: round, x: 30, y: -12, r: 1, vx: 2}
  - {name: car, length: 4, width: 2, before: absent, after: goes_on, table: [[1, 60, -12, 3.1], [2, 52, -12, 3.1], [3, 44, -13, 3.3]]}
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    base = tmp_path_factory.mktemp("drive")
    (base / "small.yaml").write_text(SCENARIO)
    slalom.simulate(base / "small.yaml").write(base / "out")
    return base / "out"


def with_cycles(folder, copy, change):
    """A copy of a drive, the rows of its cycles.csv changed."""
    shutil.copytree(folder, copy)
    with open(folder / "cycles.csv", encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    names = list(rows[0])
    change(rows)
    with open(copy / "cycles.csv", "w", encoding="utf-8", newline="") as stream:
        writer = csv.DictWriter(stream, names, lineterminator="\n", extrasaction="ignore")
        writer.writeheader()
        writer.writerows(rows)
    return copy


def messages(file):
    reader = pytest.importorskip("mcap.reader", reason="needs the extra slalom[mcap]")
    with open(file, "rb") as stream:
        return [(schema, channel.topic, message.log_time, json.loads(message.data))
                for schema, channel, message in reader.make_reader(stream).iter_messages()]


def test_mcap_is_read_back(folder, tmp_path):
    pytest.importorskip("mcap", reason="needs the extra slalom[mcap]")
    exporting.mcap(folder, tmp_path / "drive.mcap")
    drive = exporting.read_drive(folder)
    found = messages(tmp_path / "drive.mcap")
    states = [(time, message) for _, topic, time, message in found if topic == "/state"]
    assert [time for time, _ in states] == np.round(drive.t * 1e9).astype(int).tolist()
    for name in slalom.state_names:
        np.testing.assert_array_equal([message[name] for _, message in states], drive.plant[name])
    for topic, columns in (("/control", slalom.control_names), ("/wheel_loads", ("Fz_rl", "Fz_fr")), ("/clearance", ("clearance",))):
        rows = [message for _, name, _, message in found if name == topic]
        for column in columns:
            np.testing.assert_array_equal([row[column] for row in rows], drive.plant[column])
    assert len([1 for _, topic, *_ in found if topic == "/cycle"]) == len(drive.cycles)
    assert len([1 for _, topic, *_ in found if topic == "/plan"]) == len(drive.driven()) > 3
    assert [time for _, _, time, _ in found] == sorted(time for _, _, time, _ in found)


def test_the_scene_is_where_the_drive_was(folder, tmp_path):
    pytest.importorskip("mcap", reason="needs the extra slalom[mcap]")
    exporting.mcap(folder, tmp_path / "drive.mcap")
    drive = exporting.read_drive(folder)
    there, moved = set(), {}
    for _, topic, time, message in messages(tmp_path / "drive.mcap"):
        if topic == "/map":
            assert [entity["id"] for entity in message["entities"]] == ["goal", "obstacle box"]
        if topic == "/scene":
            there -= {deleted["id"] for deleted in message["deletions"]}
            there |= {entity["id"] for entity in message["entities"]}
            assert there >= {"vehicle", "obstacle round"} and ("obstacle car" in there) == (time >= 1e9), time
            moved[time] = {entity["id"]: entity for entity in message["entities"]}
        if topic == "/plan":
            assert {entity["id"] for entity in message["entities"]} == {"plan", "expected car", "expected round"}
    last = moved[max(moved)]
    cube = last["vehicle"]["cubes"][0]
    x, y, psi = (drive.plant[name][-1] for name in ("x", "y", "psi"))
    ahead = drive.scenario["vehicle.front_overhang"] - drive.scenario["vehicle.length"] / 2
    assert cube["pose"]["position"]["x"] == pytest.approx(x + ahead * np.cos(psi))
    assert 2 * np.arctan2(cube["pose"]["orientation"]["z"], cube["pose"]["orientation"]["w"]) == pytest.approx(psi)
    assert (cube["size"]["x"], cube["size"]["y"]) == (drive.scenario["vehicle.length"], 2)
    corners = np.array([[p["x"], p["y"]] for p in last["obstacle car"]["triangles"][0]["points"][:4]])
    car = next(o for o in drive.scenario.obstacles if o.name == "car")
    np.testing.assert_allclose(corners.mean(axis=0), car.pose_at(drive.t[-1])[:2], atol=1e-9)


def test_messages_are_as_their_schemas_say(folder, tmp_path):
    jsonschema = pytest.importorskip("jsonschema", reason="needs the package jsonschema")
    pytest.importorskip("mcap", reason="needs the extra slalom[mcap]")
    exporting.mcap(folder, tmp_path / "drive.mcap")
    seen = {}
    for schema, topic, _, message in messages(tmp_path / "drive.mcap"):
        seen[topic] = schema.name
        assert schema.encoding == "jsonschema"
        jsonschema.validate(message, json.loads(schema.data))
    assert seen["/scene"] == seen["/map"] == seen["/plan"] == "foxglove.SceneUpdate"
    assert (seen["/tf"], seen["/pose"]) == ("foxglove.FrameTransform", "foxglove.PoseInFrame")


def test_what_a_plan_expects(folder):
    drive = exporting.read_drive(folder)
    car = next(o for o in drive.scenario.obstacles if o.name == "car")
    assert moves(car, drive.t) and not moves(drive.scenario.obstacles[0], drive.t)
    assert believed(drive, car, 0.0, np.array([0.5, 2.5])) == [None, pytest.approx(car.pose_at(2.5)[:3])]


@pytest.mark.parametrize("rule", ["known", "constant_velocity", "constant_turn"])
def test_what_a_plan_expects_of_held_obstacles(folder, rule):
    drive = exporting.read_drive(folder)
    held = {"planner.moving_avoidance": False, "planner.prediction": rule}
    drive = dataclasses.replace(drive, scenario=drive.scenario.replace(set=held))
    for obstacle in drive.scenario.obstacles:
        expected = [pytest.approx(obstacle.pose_at(1.5)[:3])] * 2
        assert believed(drive, obstacle, 1.5, np.array([1.5, 2.5])) == expected
    car = next(o for o in drive.scenario.obstacles if o.name == "car")
    assert believed(drive, car, 0.5, np.array([1.5])) == [None]


def test_plans_that_were_not_driven_are_not_shown(folder, tmp_path):
    """Nor is one that came late shown from before it was driven."""
    def change(rows):
        rows[1]["used"] = "0"
        rows[2]["t_swap"] = str(float(rows[2]["t_swap"]) + 0.125)
        rows[3]["t_swap"] = str(float(rows[3]["t_swap"]) - 0.125)

    before, drive = exporting.read_drive(folder), exporting.read_drive(with_cycles(folder, tmp_path / "copy", change))
    begins = [float(plan["t_start"][0]) for plan in before.plans]
    assert [row["cycle"] for _, row, _ in before.driven()][:4] == [1, 2, 3, 4]
    expected = [begins[0], begins[2] + 0.125, begins[3]]
    assert [t for t, _, _ in drive.driven()][:3] == pytest.approx(expected)
    assert [row["cycle"] for _, row, _ in drive.driven()][:3] == [1, 3, 4]

    shown = []
    recording = types.SimpleNamespace(set_time=lambda _, duration: shown.append(duration), log=lambda *_: None)
    _rerun._plans(types.SimpleNamespace(LineStrips2D=lambda *_, **__: None), recording, drive)
    assert shown[:3] == pytest.approx(expected) and len(shown) == len(drive.driven())

    pytest.importorskip("mcap", reason="needs the extra slalom[mcap]")
    exporting.mcap(tmp_path / "copy", tmp_path / "drive.mcap")
    times = [time * 1e-9 for _, topic, time, _ in messages(tmp_path / "drive.mcap") if topic == "/plan"]
    assert times[:3] == pytest.approx(expected) and len(times) == len(drive.driven())


def test_names_with_ends_of_lines_of_unicode(folder, tmp_path):
    def change(rows):
        rows[1]["passage_obstacle"] = "a\u2028b\u0085c"

    assert exporting.read_drive(with_cycles(folder, tmp_path / "copy", change)).cycles[1]["passage_obstacle"] == "a\u2028b\u0085c"


def without_column(name):
    def damage(copy):
        with open(copy / "cycles.csv", encoding="utf-8", newline="") as stream:
            rows = list(csv.reader(stream))
        k = rows[0].index(name)
        (copy / "cycles.csv").write_text("".join(",".join(row[:k] + row[k + 1:]) + "\n" for row in rows))
    return damage


def in_row(number, name, cell):
    def damage(copy):
        with open(copy / "cycles.csv", encoding="utf-8", newline="") as stream:
            rows = list(csv.reader(stream))
        rows[number][rows[0].index(name)] = cell
        (copy / "cycles.csv").write_text("".join(",".join(row) + "\n" for row in rows))
    return damage


def test_rerun(folder, tmp_path):
    pytest.importorskip("rerun", reason="needs the extra slalom[rerun]")
    exporting.rerun(folder, tmp_path / "drive.rrd")
    assert (tmp_path / "drive.rrd").read_bytes()[:3] == b"RRF" and (tmp_path / "drive.rrd").stat().st_size > 50_000


def test_a_commonroad_solution(tmp_path):
    pytest.importorskip("commonroad", reason="needs the extra slalom[commonroad]")
    from commonroad.common.solution import CommonRoadSolutionReader

    (tmp_path / "small.xml").write_text(scenes.commonroad())
    (tmp_path / "small.yaml").write_text(SCENARIO.replace("hmmwv", "bmw_320i"))
    slalom.simulate(tmp_path / "small.yaml", set={"loop.timeout": 1.03}).write(tmp_path / "out")
    file = tmp_path / "solution.xml"
    exporting.commonroad_solution(tmp_path / "out", file, scenario=tmp_path / "small.xml")
    solution = CommonRoadSolutionReader.open(str(file))
    drive = exporting.read_drive(tmp_path / "out")
    assert str(solution.scenario_id).startswith("ZAM_Small-1_1_T-1")
    part = solution.planning_problem_solutions[0]
    assert part.planning_problem_id == 100 and part.vehicle_type.name == "BMW_320i"
    states = part.trajectory.state_list
    assert [state.time_step for state in states] == list(range(12))  # the last goes on to the next step
    for k, state in enumerate(states[:-1]):
        at = {name: float(value[0]) for name, value in drive.at(np.array([0.1 * k])).items()}
        ahead = drive.scenario["vehicle.front_overhang"] - drive.scenario["vehicle.length"] / 2
        np.testing.assert_allclose(state.position, [at["x"] + ahead * np.cos(at["psi"]), at["y"] + ahead * np.sin(at["psi"])], atol=1e-6)
        assert state.velocity == pytest.approx(np.hypot(at["ux"], at["v"])) and state.yaw_rate == pytest.approx(at["r"])
    with pytest.raises(exporting.BadFile, match="--cost"):
        exporting.commonroad_solution(tmp_path / "out", tmp_path / "no.xml", scenario=tmp_path / "small.xml", cost="XY1")
    assert not (tmp_path / "no.xml").exists()


@pytest.mark.parametrize("damage, message", [
    (lambda f: shutil.rmtree(f), "no such folder"),
    (lambda f: (f / "plans.csv").unlink(), "plans.csv: found no such file"),
    (lambda f: (f / "plant.csv").write_text(""), "plant.csv: found no table"),
    (lambda f: (f / "plant.csv").write_text("t,x\n1,2\n"), "plant.csv:1: found no column y"),
    (lambda f: (f / "plant.csv").write_text((f / "plant.csv").read_text()[:-20]), "cells, expected 16"),
    (lambda f: (f / "plant.csv").write_text((f / "plant.csv").read_text().replace("0", "o")), "plant.csv"),
    (lambda f: (f / "plant.csv").write_text((f / "plant.csv").read_text().replace("\n0,", "\n,", 1)), "plant.csv:2: found t nan"),
    (lambda f: (f / "plans.csv").write_text((f / "plans.csv").read_text().replace("\n1,", "\none,", 1)), "plans.csv:2: found could not"),
    (lambda f: (f / "cycles.csv").write_text((f / "cycles.csv").read_text().split("\n")[0] + "\n"), "cycles.csv: found no row of cycle 1"),
    (without_column("cycle"), "cycles.csv:1: found no column cycle"),
    (without_column("t0"), "cycles.csv:1: found no column t0"),
    (without_column("t_swap"), "cycles.csv:1: found no column t_swap"),
    (without_column("used"), "cycles.csv:1: found no column used"),
    (without_column("status"), "cycles.csv:1: found no column status"),
    (in_row(2, "t0", "soon"), "cycles.csv:3: found t0 'soon'"),
    (in_row(2, "t0", "nan"), "cycles.csv:3: found t0 nan"),
    (in_row(2, "t0", ""), "cycles.csv:3: found t0 ''"),
    (lambda f: (f / "summary.json").write_text("[]"), "summary.json: found a list of JSON"),
    (lambda f: (f / "summary.json").write_text("{"), "summary.json: found no JSON"),
    (lambda f: (f / "resolved.yaml").write_text("name: [\n"), "resolved.yaml"),
])
def test_bad_folders(folder, tmp_path, capsys, damage, message):
    copy = tmp_path / "copy"
    shutil.copytree(folder, copy)
    damage(copy)
    before = sorted(p.name for p in copy.iterdir()) if copy.exists() else []
    assert command.main(["mcap", str(copy)], "slalom export") == 2
    error = capsys.readouterr().err
    assert error.startswith("slalom: ") and message in error and error.count("\n") == 1, error
    assert (sorted(p.name for p in copy.iterdir()) if copy.exists() else []) == before


@pytest.mark.parametrize("name", ["plant.csv", "plans.csv", "cycles.csv", "summary.json"])
def test_a_file_that_cannot_be_read_is_bad_input(folder, tmp_path, capsys, monkeypatch, name):
    """Which permissions show to others than root alone."""
    def denied(self, read):
        if self.name == name:
            raise PermissionError(13, "Permission denied", str(self))
        return read(self)

    copy = tmp_path / "copy"
    shutil.copytree(folder, copy)
    read_bytes, read_text = pathlib.Path.read_bytes, pathlib.Path.read_text
    monkeypatch.setattr(pathlib.Path, "read_bytes", lambda self: denied(self, read_bytes))
    monkeypatch.setattr(pathlib.Path, "read_text", lambda self, **more: denied(self, lambda s: read_text(s, **more)))
    assert command.main(["mcap", str(copy)], "slalom export") == 2
    error = capsys.readouterr().err
    assert f"{name}: found a file that cannot be read (Permission denied)" in error and error.count("\n") == 1, error


def test_the_command(folder, tmp_path, capsys):
    pytest.importorskip("mcap", reason="needs the extra slalom[mcap]")
    copy = tmp_path / "copy"
    shutil.copytree(folder, copy)
    assert command.main(["mcap", str(copy)]) == 0 and (copy / "drive.mcap").exists()
    assert capsys.readouterr().out == f"written to {copy / 'drive.mcap'}\n"
    assert command.main(["mcap", str(copy)]) == 3 and "--force" in capsys.readouterr().err
    assert command.main(["mcap", str(copy), "--force", "--quiet"]) == 0 and capsys.readouterr().out == ""
    assert command.main(["commonroad", str(copy)]) == 2 and "no --scenario" in capsys.readouterr().err


def test_the_program_runs_the_package(folder, tmp_path):
    """`slalom import` and `slalom export` have the options of the package, and its exit codes."""
    import sys
    environment = {**os.environ, "SLALOM_PYTHON": sys.executable}

    def run(*words):
        return subprocess.run([PROGRAM, *map(str, words)], env=environment, capture_output=True, text=True)

    (tmp_path / "ring.csv").write_text(scenes.track())
    done = run("import", "track", tmp_path / "ring.csv", "--out", tmp_path / "ring.yaml", "--speed", "9", "--quiet")
    assert done.returncode == 0 and done.stdout == "", done.stderr
    assert "ux: 9" in (tmp_path / "ring.yaml").read_text()
    done = run("import", "track", tmp_path / "ring.csv", "--out", tmp_path / "ring.yaml")
    assert done.returncode == 3 and done.stderr.startswith("slalom: ") and "--force" in done.stderr
    assert run("export", "mcap", tmp_path).returncode == 2
    from slalom.importing import __main__ as importing
    for name, parser in (("import", importing.parser("slalom import")), ("export", command.parser("slalom export"))):
        shown = run(name, "--help").stdout
        for action in parser._actions:
            assert all(option in shown for option in action.option_strings), (name, action)
