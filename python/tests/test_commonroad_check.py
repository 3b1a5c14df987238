"""tools/commonroad_check.py tells drives that touch something or leave the road from those that do not."""

import os
import pathlib
import subprocess
import sys

import numpy as np
import pytest

import scenes

README = os.environ.get("SLALOM_README")
pytest.importorskip("commonroad", reason="needs the extra slalom[commonroad]")
pytestmark = pytest.mark.skipif(not README, reason="SLALOM_README does not say where the sources are")


def solution(lateral, steps=105, speed=13.0):
    """A drive straight on along y(x) = lateral(x) from (20, 0), as CommonRoad's XML of single-track states."""
    states = []
    for k in range(steps + 1):
        x = 20 + 0.1 * k * speed
        values = {"x": x, "y": lateral(x), "steeringAngle": 0, "velocity": speed, "orientation": 0, "yawRate": 0,
                  "slipAngle": 0, "time": k}
        states.append("<stState>" + "".join(f"<{name}>{value}</{name}>" for name, value in values.items()) + "</stState>")
    return ('<?xml version="1.0" ?>\n<CommonRoadSolution benchmark_id="ST2:JB1:ZAM_Small-1_1_T-1:2020a" date="2026-11-30T00:00:00">\n'
            f'<stTrajectory planningProblem="100">{"".join(states)}</stTrajectory></CommonRoadSolution>\n')


def judged(folder, drives):
    (folder / "scenarios").mkdir()
    for name, lateral in drives.items():
        (folder / "scenarios" / f"{name}.xml").write_text(scenes.commonroad())
        (folder / "drives" / name).mkdir(parents=True)
        (folder / "drives" / name / "solution.xml").write_text(solution(lateral))
    tool = pathlib.Path(README).parent / "tools" / "commonroad_check.py"
    return subprocess.run([sys.executable, tool, folder / "scenarios", folder / "drives"], capture_output=True, text=True)


def rows(text):
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if line.startswith("| ")]
    return {row[0]: row for row in cells[1:]}


def test_verdicts(tmp_path):
    done = judged(tmp_path, {
        "into_the_parked_car": lambda x: 0.0,
        "past_it": lambda x: float(np.interp(x, [30, 50], [0, 4])),
        "into_the_grass": lambda x: float(np.interp(x, [70, 90], [0, -2]) if x > 69 else np.interp(x, [30, 50, 65, 69], [0, 4, 4, 0])),
        "stays_right": lambda x: float(np.interp(x, [30, 50, 70, 90], [0, 4, 4, 0])),
    })
    found = rows(done.stdout)
    assert done.returncode == 1 and "2 of 4 drives touch nothing" in done.stdout, done.stdout + done.stderr
    assert [found["into_the_parked_car"][k] for k in (3, 4)] == ["from 2.80 s", "no"]  # 60 - 2.27 - 2.25 m along
    assert [found["past_it"][k] for k in (3, 4)] == ["no", "no"] and found["past_it"][6] == "9.70 s"
    assert found["into_the_grass"][3] == "no" and found["into_the_grass"][4].startswith("from 4.")
    assert found["stays_right"][6] == "no"
    assert float(found["past_it"][5]) == pytest.approx(4 - 1.61 / 2 - 0.5 - 0.9 * np.cos(0.1) - 2.25 * np.sin(0.1), abs=0.06)


def test_nothing_to_judge(tmp_path):
    done = judged(tmp_path, {})
    assert done.returncode == 2 and "found no NAME/solution.xml" in done.stderr


def test_a_shape_that_is_read_elsewhere_is_not_judged(tmp_path):
    shape = scenes.box(4, 2).replace("</rectangle>", "<orientation>1</orientation><center><x>0</x><y>0</y></center></rectangle>")
    text = scenes.commonroad(more=scenes.obstacle("2020a", 15, "static", "car", shape, scenes.state("initialState", 0, 80, 9)))
    (tmp_path / "a.xml").write_text(text)
    (tmp_path / "solution.xml").write_text(solution(lambda x: 0.0))
    tool = pathlib.Path(README).parent / "tools" / "commonroad_check.py"
    done = subprocess.run([sys.executable, tool, tmp_path / "a.xml", tmp_path / "solution.xml"], capture_output=True, text=True)
    assert done.returncode == 2 and "obstacle 15 has a shape with a place" in done.stderr, done.stdout + done.stderr


def test_circles_have_their_radius(tmp_path):
    """A walker of .4 m in radius at y = 1.3 beside a drive along y = 0 is .095 m away."""
    walker = scenes.obstacle("2020a", 15, "static", "pedestrian", "<circle><radius>0.4</radius></circle>",
                             scenes.state("initialState", 0, 80, 1.3))
    text = scenes.commonroad(parked=(60, 20), more=walker)
    (tmp_path / "a.xml").write_text(text)
    (tmp_path / "solution.xml").write_text(solution(lambda x: 0.0))
    tool = pathlib.Path(README).parent / "tools" / "commonroad_check.py"
    done = subprocess.run([sys.executable, tool, tmp_path / "a.xml", tmp_path / "solution.xml"], capture_output=True, text=True)
    assert float(rows(done.stdout)["a"][5]) == pytest.approx(1.3 - 0.4 - 1.61 / 2, abs=0.01), done.stdout + done.stderr
