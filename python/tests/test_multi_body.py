"""Another vehicle than the planner believes in, as a plant: examples/multi_body_plant.py."""

import importlib.util
import os
import pathlib

import pytest
import slalom

pytest.importorskip("scipy")
pytest.importorskip("vehiclemodels", reason="commonroad-vehicle-models is not installed")

README = pathlib.Path(os.environ.get("SLALOM_README", pathlib.Path(__file__).parents[2] / "README.md"))
EXAMPLE = README.resolve().parent / "examples" / "multi_body_plant.py"


@pytest.fixture(scope="module")
def example():
    spec = importlib.util.spec_from_file_location("multi_body_plant", EXAMPLE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_state_goes_there_and_back(example):
    state = [3, -2, 0.2, 0.1, 1.2, 0.05, 20, 1]
    assert example.MultiBody(2, state).state() == pytest.approx(state)


@pytest.mark.parametrize("car", ["ford_escort", "bmw_320i", "vw_vanagon"])
def test_our_model_is_near_theirs(example, car):
    """Without braking, where tyres are far from sliding: 1 % of the way after 2 s."""
    scenario = slalom.load_scenario(example.LANE_CHANGE, vehicle=car, set={"start.ux": 20, "start.sa": 0.01})
    ((along, across),) = example.same_controls(car, scenario, None, [2.0])["combined_slip"]
    assert abs(along) < 0.4 and abs(across) < 0.4
    assert abs(along) + abs(across) > 1e-3  # they are two models


def test_the_multi_body_model_arrives(example):
    outcome, t, least = example.closed_loop("bmw_320i", 20)
    assert outcome == "goal" and least > 1
