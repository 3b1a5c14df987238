"""Scenarios, planning and drives from Python are those of the command line."""

import fcntl
import os
import pickle
import re
import signal
import threading

import numpy as np
import pytest

import slalom

MINE = {
    "start": {"x": 0, "y": 0, "psi_deg": 0, "ux": np.float64(15)},
    "goal": {"x": 60, "y": 0, "psi_deg": 0, "sigma": 8},
    "obstacles": [{"name": "lorry", "x": 40, "y": -3, "a": 5, "b": 1.5}],
    "planner": {"base": "P_D"},
}


def test_a_drive_arrives():
    assert "E_B" in slalom.scenario_names() and "P_D" in slalom.planner_names()
    drive = slalom.simulate("E_B", planner="P_D")
    assert drive.outcome == "goal"
    assert drive.states.shape == (len(drive.t), len(slalom.state_names))
    assert drive.wheel_loads.shape == (len(drive.t), 4)
    assert drive.least_clearance == pytest.approx(drive.clearance.min(), abs=0.05) and drive.hit == ""
    assert drive.states[0, slalom.state_names.index("ux")] == 17
    assert all(np.isfinite(p.states).all() for p in drive.plans)
    assert [c.index for c in drive.cycles] == list(range(len(drive.cycles)))
    assert drive.scenario["planner.w_t"] == 100


def test_what_the_outcome_does_not_show():
    behind = slalom.load_scenario({**MINE, "goal": {"x": -60, "y": 0, "sigma": 8}, "obstacles": []},
                                  set={"loop.timeout": 15})
    assert any("behind" in sentence for sentence in behind.advice())
    assert slalom.load_scenario("E_B").advice() == []
    lorry = {"name": "lorry", "x": 10, "y": 4, "r": 1.5}
    drive = slalom.simulate({**MINE, "obstacles": [lorry]}, set={"loop.sm_crash": 0, "vehicle.width": 9})
    assert [text.split(": ")[0] for text in drive.marks].count("body_overlap") == 1, drive.marks
    assert all(len(text.split(": ", 1)[1]) > 20 for text in drive.marks)


def test_another_vehicle_is_chosen_by_name():
    assert {"hmmwv", "bmw_320i"} <= set(slalom.vehicle_names())
    car = slalom.load_scenario("E_B", vehicle="bmw_320i")
    assert car["vehicle.name"] == "bmw_320i" and car["vehicle.tyre"] == "combined_slip"
    assert car.replace(vehicle="hmmwv")["vehicle.m"] == 2688.7
    assert slalom.simulate("E_B", vehicle="bmw_320i").goal_time < 5.5
    with pytest.raises(slalom.InvalidValue, match="bmw_320i"):
        slalom.load_scenario("E_B", vehicle="tank")


def test_a_dict_may_have_any_letters():
    """JSON's pairs of surrogates are not YAML's."""
    assert slalom.load_scenario({**MINE, "name": "caf\u00e9 \U0001f3ce", "title": "a\nb\u2028c"}).name == "caf\u00e9 \U0001f3ce"
    with pytest.raises(ValueError, match="surrogates"):
        slalom.load_scenario({**MINE, "name": "\ud83c"})


def test_values_of_a_scenario():
    scenario = slalom.load_scenario("E_B", tex=0.25, set={"loop.timeout": 1, "loop.warm_up": False})
    assert scenario["loop.tex"] == 0.25 and scenario["loop.warm_up"] is False
    assert scenario["planner.scheme"] == "trapezoidal" and len(scenario["planner.w_s0"]) == 8
    assert "vehicle.m" in scenario.keys() and dict(scenario)["vehicle.m"] == 2688.7
    assert len(scenario.obstacles) == 3 and scenario.obstacles[0].vx == -2
    assert scenario.goal.y == 125 and scenario.start[0] == 200
    drive = slalom.simulate(scenario)
    assert drive.outcome == "timeout" and drive.time == pytest.approx(1)
    changed = scenario.replace(planner="P_A", set={"obstacles.O1.vx": 3, "goal.x": 7})
    assert (changed["planner.w_t"], changed.obstacles[0].vx, changed.goal.x) == (0, 3, 7)
    assert changed["loop.timeout"] == 1 and scenario.goal.x == 200
    with pytest.raises(KeyError, match="perhaps 'planner.w_t'"):
        scenario["planner.wt"]


def test_a_margin_that_is_not_stated_follows_the_footprint():
    rectangle = {"vehicle.footprint": "rectangle"}
    plain, stated = slalom.load_scenario("E_C"), slalom.load_scenario("E_C", set={"loop.sm_crash": 2})
    assert plain["loop.sm_crash"] == 2 and plain.replace(set=rectangle)["loop.sm_crash"] == 0
    assert pickle.loads(pickle.dumps(plain)).replace(set=rectangle)["loop.sm_crash"] == 0
    assert plain.replace(set=rectangle).replace(set={"vehicle.footprint": "point"})["loop.sm_crash"] == 2
    assert stated.replace(set=rectangle)["loop.sm_crash"] == 2


def test_a_scenario_as_a_dict_or_a_file(tmp_path):
    scenario = slalom.load_scenario(MINE, set={"obstacles.lorry.y": -4})
    assert scenario.obstacles[0].y == -4 and scenario.start[4] == 0
    file = tmp_path / "mine.yaml"
    file.write_text(scenario.to_yaml())
    assert slalom.load_scenario(file).to_yaml().splitlines()[1:] == \
        slalom.load_scenario(str(file)).to_yaml().splitlines()[1:]
    assert slalom.simulate(MINE).outcome == "goal"


@pytest.mark.parametrize("key, value", [
    ("loop.warm_up", False), ("loop.warm_up", np.bool_(False)), ("loop.tex", 0.25), ("loop.tex", np.float32(0.25)),
    ("loop.tex", np.array(0.25)), ("planner.N", 12), ("planner.N", np.int64(12)), ("planner.solver", "interior_point"),
    ("planner.X0_tol", [0.5] * 8), ("planner.X0_tol", (0.5,) * 8), ("planner.X0_tol", np.full(8, 0.5)),
    ("planner.X0_tol", [np.float64(0.5)] * 8), ("goal.sigma", {"value": 7, "unit": "m"}),
])
def test_set_takes_what_a_dict_takes(key, value):
    section, name = key.split(".")
    by_dict = slalom.load_scenario({**MINE, section: {**MINE.get(section, {}), name: value}})
    by_set = slalom.load_scenario(MINE, set={key: value})
    assert by_set.to_yaml() == by_dict.to_yaml() and by_set[key] == by_dict[key]


def test_set_takes_text_as_it_stands(tmp_path):
    (tmp_path / "times.csv").write_text("0.1\n0.2\n")
    scenario = slalom.load_scenario(MINE, set={
        "title": "a: b", "loop.latency": "recorded", "loop.solve_times": tmp_path / "times.csv"})
    assert scenario.title == "a: b" and list(scenario["loop.solve_times"]) == [0.1, 0.2]


@pytest.mark.parametrize("load, error, message", [
    (lambda: slalom.load_scenario("E_X"), ValueError, "E_B"),
    (lambda: slalom.load_scenario("E_B", set={"planner.w_tt": 1}), ValueError, "w_t"),
    (lambda: slalom.load_scenario("E_B", set={3: 1}), TypeError, "set"),
    (lambda: slalom.load_scenario({**MINE, "gaol": 1}), ValueError, "goal"),
    (lambda: slalom.load_scenario({**MINE, "goal": {"x": float("nan"), "y": 0}}), ValueError, "x"),
    (lambda: slalom.load_scenario({**MINE, "title": object()}), (TypeError, AttributeError), "tolist"),
    (lambda: slalom.load_scenario(3), TypeError, "load_scenario"),
    (lambda: slalom.simulate("E_B", tex=-1), ValueError, "tex"),
    (lambda: slalom.load_scenario("E_B").replace(planner="P_X"), ValueError, "P_X"),
])
def test_bad_scenarios(load, error, message):
    with pytest.raises(error, match=message):
        load()


def test_a_loop_of_ones_own():
    """Planner and plant, cycle by cycle, come where simulate does: see section 4 of the
    formulation for the order of steps."""
    scenario = slalom.load_scenario("E_B", planner="P_D", set={"loop.timeout": 2})
    drive = slalom.simulate(scenario)
    planner, plant = slalom.Planner(scenario), slalom.Plant(scenario)
    state, plan, t, tex = scenario.start, None, 0.0, scenario["loop.tex"]
    planner.plan(plant.advance(state, plan, t, t + tex), t0=t)  # the warm-up solve
    while t < drive.time:
        ahead = plant.advance(state, plan, t, t + tex)
        new = planner.plan(ahead, t0=t)
        assert new.solved and new.t_start == t + tex
        state, plan, t = ahead, new, t + tex
    np.testing.assert_array_equal(state, drive.states[-1])


def test_plans():
    scenario = slalom.load_scenario("E_B")
    planner = slalom.Planner(scenario)
    plan = planner.plan(scenario.start)
    assert plan.solved and plan.status == "solved" and "interior_point" in plan.backend
    assert plan.states.shape == (11, 8) and plan.controls.shape == (11, 2)
    assert plan.t[-1] == pytest.approx(plan.tf)
    assert sum(plan.cost_terms.values()) == pytest.approx(plan.cost)
    assert plan.worst_violation < 1e-6
    assert planner.plan(scenario.start).iterations < plan.iterations
    planner.reset()
    assert planner.plan(scenario.start).iterations == plan.iterations
    planner.reset()
    assert planner.plan(scenario.start, time_limit=0).status == "time_limit"
    with pytest.raises(slalom.InvalidValue, match="3 numbers.*state_names"):
        planner.plan([1, 2, 3])
    plant = slalom.Plant(scenario)
    with pytest.raises(slalom.InvalidValue, match="t1 before t0"):
        plant.advance(scenario.start, plan, 1, 0)
    with pytest.raises(TypeError):
        plant.advance(scenario.start, "plan", 0, 1)
    with pytest.raises(slalom.InvalidValue, match="at most 36000 s"):
        plant.advance(scenario.start, None, 0.0, 1.7e9)


@pytest.mark.parametrize(("scenario", "planner"), [("E_B", "P_D"), ("E_B", "P_E"), ("circuit", "P_L")])
@pytest.mark.parametrize(("wrong", "message"), [
    ({"t0": float("nan")}, "t0"), ({"t0": 1e16}, "t0"), ({"tex": float("nan")}, "tex"),
    ({"tex": -1}, "tex"), ({"tex": 1e9}, "tex"), ({"time_limit": float("nan")}, "time_limit"),
    ({"time_limit": -1}, "time_limit"), ({"best_iterate_tol": float("nan")}, "best_iterate_tol"),
    ({"best_iterate_tol": float("inf")}, "best_iterate_tol"), ({"x": float("nan")}, "state: found x = nan"),
    ({"ux": float("inf")}, "state: found ux = inf"), ({"ux": 1e18}, "state: found ux")])
def test_numbers_of_no_cycle_are_refused(scenario, planner, wrong, message):
    scenario = slalom.load_scenario(scenario, planner=planner)
    state = np.array(scenario.start, dtype=float)
    for name in set(wrong) & set(slalom.state_names):
        state[slalom.state_names.index(name)] = wrong[name]
    keywords = {key: value for key, value in wrong.items() if key not in slalom.state_names}
    with pytest.raises(slalom.InvalidValue, match=f"plan: .*{message}"):
        slalom.Planner(scenario).plan(state, **keywords)
    with pytest.raises(slalom.InvalidValue, match=f"plan_many: .*{message}"):
        slalom.Planner(scenario).plan_many([state], **keywords)


def test_verified_plans():
    scenario = slalom.load_scenario("E_B", planner="P_E")
    plan = slalom.Planner(scenario).plan(scenario.start)
    assert (plan.rung, plan.solved) == ("new", True)
    certificate = plan.certificate
    assert certificate.verified and certificate.refused == "" and certificate.until > plan.t_start
    assert certificate.nearest in {o.name for o in scenario.obstacles}
    assert certificate.least_clearance > 0 and certificate.least_wheel_load > 0
    taken = min((c for c in plan.candidates if c.certificate.verified), key=lambda c: c.cost)
    assert taken.cost == plan.cost and taken.name
    assert taken.certificate.least_clearance == certificate.least_clearance
    np.testing.assert_allclose(taken.path[[0, -1]], plan.states[[0, -1], :2])
    assert plan.fallback is None  # there is no plan before

    blocked = scenario.replace(set={"obstacles.O1.x": 200, "obstacles.O1.y": 20, "obstacles.O1.vx": 0})
    plan = slalom.Planner(blocked).plan(scenario.start)
    assert (plan.rung, plan.solved) == ("least_bad", False)
    assert not plan.certificate.verified and "O1" in plan.certificate.refused
    assert plan.status == f"unverified: {plan.certificate.refused}"
    assert "refused" in repr(plan.certificate)

    other = slalom.Planner(slalom.load_scenario("E_B", planner="P_D")).plan(scenario.start)
    assert (other.rung, other.certificate, other.candidates) == ("", None, [])


def test_obstacles_of_every_shape_and_motion():
    box = slalom.Obstacle(x=5, y=2, length=4, width=2, psi=np.pi / 2, vx=3, name="car")
    assert box.distance(5 + 3 + 1.5, 2, t=1) == pytest.approx(0.5)
    np.testing.assert_allclose(sorted(box.corners_at(0)[:, 1]), [0, 0, 4, 4], atol=1e-12)
    rock = slalom.Obstacle(x=5, y=2, polygon=np.array([[-1, -1], [2, 0], [0, 1]]))
    assert rock.corners_at(0).shape == (3, 2) and rock.distance(5, 2) < 0
    rows = [[1, 0, 0, 0], [2, 4, 0, 0.2], [4, 9, 3, 0.6]]
    car = slalom.Obstacle(r=1, table=rows, before="absent", after="stands", margin_rate=0.1)
    np.testing.assert_allclose(car.pose_at(2)[:3], rows[1][1:], atol=1e-12)
    assert (car.present(0.5), car.present(9)) == (False, True) and car.margin_rate == 0.1
    assert slalom.Obstacle(x=1, y=2, a=3, b=1, psi=0.5).corners_at(0).shape == (0, 2)
    walker = slalom.Obstacle(r=0.4, path=[[0, 0], [5, 0], [5, 9]], speed=1.4)
    np.testing.assert_allclose(np.array(walker.pose_at(2))[[0, 1, 3]], [2.8, 0, 1.4], atol=1e-12)
    scenario = slalom.load_scenario({**MINE, "obstacles": [
        {"name": "car", "x": 5, "y": 60, "length": 4, "width": 2, "psi": 0.5, "vx": 0.5},
        {"name": "walker", "r": 0.4, "path": [[0, 90], [5, 90]], "speed": 0.1}]},
        set={"obstacles.car.psi_deg": 90, "obstacles.car.x": 6})
    assert (scenario["obstacles.car.x"], scenario["obstacles.car.psi"]) == (6, np.pi / 2)
    again = scenario.replace(tex=0.25).obstacles
    np.testing.assert_array_equal(again[0].corners_at(3), scenario.obstacles[0].corners_at(3))
    np.testing.assert_array_equal(again[1].pose_at(3), scenario.obstacles[1].pose_at(3))


@pytest.mark.parametrize("wrong, message", [
    ({"x": 1, "y": 2}, "without size"),
    ({"x": 1, "y": 2, "r": 1, "length": 3, "width": 1}, "more than one size"),
    ({"r": 1}, "without place"),
    ({"r": 1, "table": [[0, 0, 0]]}, "1 row"),
    ({"r": 1, "table": [[0, 0, 0], [0, 1, 0]]}, "times that rise"),
    ({"r": 1, "table": [[0, 0, float("nan")], [1, 1, 0]]}, "finite number"),
    ({"r": 1, "table": "no such.csv"}, "no such file"),
    ({"r": 1, "path": [[0, 0], [1, 1]]}, "speed"),
    ({"x": 1, "y": 2, "polygon": [[0, 0], [1, 1], [2, 2]]}, "no area"),
    ({"x": 1, "y": 2, "length": 0, "width": 1}, "length = 0"),
])
def test_bad_obstacles(wrong, message):
    with pytest.raises(slalom.InvalidValue, match=message):
        slalom.Obstacle(**wrong)


def test_the_plant_may_differ_from_the_vehicle():
    scenario = slalom.load_scenario("E_B")
    heavy = scenario.replace(set={"plant.mass_factor": 1.4, "sensing.delay": 0.1})
    assert (heavy["plant.mass_factor"], heavy["vehicle.m"]) == (1.4, scenario["vehicle.m"])
    assert {"plant.actuator_delay", "sensing.noise_seed"} <= set(heavy.keys())
    turning = np.array(scenario.start)
    turning[5] = 0.05  # steering angle
    as_is, as_heavy = (slalom.Plant(s).advance(turning, None, 0, 1) for s in (scenario, heavy))
    assert abs(as_heavy[0] - as_is[0]) > 1e-3  # m


def test_cycles_are_told_as_they_come():
    seen = []
    drive = slalom.simulate("E_B", set={"loop.timeout": 2}, on_cycle=lambda c: seen.append(c.index))
    assert seen == [c.index for c in drive.cycles]

    def stop(cycle):
        if cycle.index == 2:
            raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        slalom.simulate("E_C", on_cycle=stop)


def test_interrupt_ends_a_drive():
    timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        while True:
            slalom.simulate("E_C")


def test_frame_plot_and_files(tmp_path):
    pandas = pytest.importorskip("pandas")
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    drive = slalom.simulate(MINE)
    frame = drive.to_frame()
    drive.write(tmp_path / "out")
    written = pandas.read_csv(tmp_path / "out" / "plant.csv", index_col=0)
    assert list(frame.columns) == list(written.columns)
    np.testing.assert_allclose(frame.to_numpy(), written.to_numpy(), rtol=1e-12, atol=1e-12)
    with pytest.raises(slalom.Error, match="out"):
        drive.write(tmp_path / "out")
    drive.write(tmp_path / "out", force=True)
    (tmp_path / "two").mkdir()
    with open(tmp_path / "two" / ".results.lock", "w") as other:  # as another process has it
        fcntl.flock(other, fcntl.LOCK_EX)
        for force in (False, True):
            with pytest.raises(slalom.Error, match="another process writes its results there"):
                drive.write(tmp_path / "two", force=force)
    drive.write(tmp_path / "two")
    assert not (tmp_path / "two" / ".results.lock").exists()
    path = drive.plot().axes[0]
    np.testing.assert_array_equal(path.lines[0].get_xdata(), drive.states[:, 0])
    assert len(path.patches) == 1


def test_obstacles_of_each_cycle_take_the_place_of_the_scenarios():
    scenario = slalom.load_scenario("E_B", planner="P_D")
    planner = slalom.Planner(scenario)
    free = planner.plan(scenario.start, obstacles=[])
    assert free.solved
    x = free.states[:, 0]
    wall = slalom.Obstacle(x=float(x[5]), y=float(free.states[5, 1]), r=3, name="wall")
    blocked = planner.plan(scenario.start, obstacles=[wall, slalom.Obstacle(x=150, y=20, a=2, b=1)])
    assert blocked.solved
    away = np.hypot(blocked.states[:, 0] - wall.x, blocked.states[:, 1] - wall.y)
    assert away[1:].min() > 5.5
    # Positions are those at t0, whenever that is.
    later = [slalom.Obstacle(x=wall.x, y=wall.y - 10, r=3, vy=10)]
    first, second = (slalom.Planner(scenario).plan(scenario.start, t0=t0, obstacles=later) for t0 in (0.0, 100.0))
    assert first.solved
    np.testing.assert_allclose(second.states, first.states, atol=1e-6)
    with pytest.raises(slalom.InvalidValue, match="r, or a and b"):
        slalom.Obstacle(x=0, y=0)
    with pytest.raises(slalom.InvalidValue, match="Obstacle: found r = -1"):
        slalom.Obstacle(x=0, y=0, r=-1)


def test_values_are_read_by_the_keys_that_set_them():
    scenario = slalom.load_scenario("E_C", set={"start.ux": 16, "obstacles.O2.vy": -12})
    assert scenario["start.ux"] == 16
    assert scenario["obstacles.O2.vy"] == -12
    assert scenario["goal.sigma"] == 25
    assert "obstacles.cone3.y" in scenario.keys()
    with pytest.raises(KeyError, match="perhaps 'obstacles.O2.v[xy]'"):
        scenario["obstacles.O2.vz"]


def test_the_extension_names_its_compiler():
    """As pages of measurements do; a stripped one says it nowhere else."""
    assert re.match(r"(clang version|g\+\+) \d+\.", slalom._core.__compiler__)
