"""Scenarios and drives from Python are those of the command line."""

import numpy as np
import pytest

import slalom


def test_a_drive_arrives():
    assert "E_B" in slalom.scenario_names()
    drive = slalom.simulate("E_B", planner="P_D")
    assert drive.outcome == "goal"
    assert drive.states.shape == (len(drive.t), len(slalom.state_names))
    assert drive.wheel_loads.shape == (len(drive.t), 4)
    assert drive.least_clearance > 0
    assert drive.states[0, slalom.state_names.index("ux")] == 17
    assert all(np.isfinite(p.states).all() for p in drive.plans)


def test_overrides():
    scenario = slalom.load_scenario("E_B", tex=0.25, set={"loop.timeout": 1, "loop.warm_up": False})
    assert "0.25" in scenario.to_yaml()
    drive = slalom.simulate(scenario)
    assert drive.outcome == "timeout" and drive.time == pytest.approx(1)
    with pytest.raises(TypeError):
        slalom.simulate(scenario, tex=1)


def test_bad_scenarios():
    with pytest.raises(slalom.InvalidValue, match="E_B"):
        slalom.load_scenario("E_X")
    with pytest.raises(slalom.InvalidValue, match="w_t"):
        slalom.load_scenario("E_B", set={"planner.w_tt": 1})
