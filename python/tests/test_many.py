"""Many solves and plans at once."""

import numpy as np
import pytest
import slalom


def stated():
    """Least energy from rest to rest: the objective is 6 (end / gain)^2. With its state x."""
    p = slalom.Problem("pushed")
    gain = p.parameter("gain", 1.0)
    x, v = p.state("x", initial=0, final=1), p.state("v", initial=0, final=0)
    u = p.control("u")
    p.dynamics(x, v)
    p.dynamics(v, gain * u)
    p.lagrange("effort", slalom.square(u) / 2)
    return p, x


def pushed():
    return stated()[0]


def test_each_is_what_it_would_be_alone():
    p = pushed()
    gains, ends = np.linspace(0.5, 3, 11), np.linspace(-2, 2, 11)
    many = p.solve_many({"gain": gains, "final x": ends}, mesh=10)
    assert len(many) == 11 and many.solved.all() and many.solved.dtype == bool
    np.testing.assert_allclose(many.objective, 6 * (ends / gains) ** 2, atol=1e-6)
    assert many.states["x"].shape == many.time.shape == (11, 21)
    np.testing.assert_array_equal(many.states["x"][:, -1], ends)
    one = many[-1]
    assert one.objective == many.objective[-1]
    np.testing.assert_array_equal(one.controls["u"], many.controls["u"][-1])
    with pytest.raises(IndexError):
        many[11]
    assert repr(many) == "<Solutions: 11 of 11 solved>"
    assert many.iterations.dtype == np.int64 and (many.tf == 1).all()


def test_the_same_bits_on_any_number_of_threads():
    p, gains = pushed(), np.geomspace(0.1, 10, 20)
    alone = p.solve_many({"gain": gains}, mesh=20, threads=1)
    for threads in (2, 3):
        np.testing.assert_array_equal(p.solve_many({"gain": gains}, mesh=20, threads=threads).controls["u"],
                                      alone.controls["u"])  # fmt: skip


def test_what_is_not_solved_is_among_the_answers():
    many = pushed().solve_many({"gain": [1.0, 0.0]}, mesh=10)
    assert many.solved.tolist() == [True, False]
    assert many.status[0] == "solved" and many.status[1] != "solved"


def test_a_warm_start_serves_all():
    p = pushed()
    nominal = p.solve(mesh=20)
    many = p.solve_many({"gain": [1.0, 1.001]}, mesh=20, warm_start=nominal)
    assert many.solved.all() and (many.iterations <= nominal.iterations).all()


def test_bad_numbers_are_refused_by_name():
    p = pushed()
    for numbers, text in [({"gian": [1.0]}, "perhaps 'gain'"), ({"gain": [[1.0]]}, "2 dimensions"),
                          ({"gain": [1.0, 2.0], "final x": [1.0]}, "as many as of gain"),
                          ({}, "no numbers"), ({"gain": [float("nan")]}, "a finite number")]:  # fmt: skip
        with pytest.raises(slalom.InvalidValue, match=text):
            p.solve_many(numbers)
    with pytest.raises(slalom.InvalidValue, match="threads"):
        p.solve_many({"gain": [1.0]}, threads=-1)


def test_a_time_limit_is_of_the_whole_call():
    many = pushed().solve_many({"gain": np.linspace(1, 2, 100000)}, mesh=100, time_limit=0.3)
    assert many.status[-1] == "time_limit" and not many.solved[-1]
    assert np.isnan(many.states["x"][-1]).all() and np.isnan(many.objective[-1])
    assert many.iterations[-1] == 0 and (many.iterations >= 0).all()
    with pytest.raises(slalom.Error, match="not begun"):
        many[-1]


def test_names_are_there_where_no_solve_was_begun():
    many = pushed().solve_many({"gain": []}, mesh=10)
    assert {name: values.shape for name, values in many.states.items()} == {"x": (0, 0), "v": (0, 0)}
    assert many.controls["u"].shape == (0, 0) and many.time.shape == (0, 0) and len(many.tf) == 0


@pytest.mark.parametrize("name", ["P_D", "P_E"])
def test_plans_from_many_states(name):
    scenario = slalom.load_scenario("E_B", planner=name)
    start = np.array([200, 8.5, 0, 0, np.pi / 2, 0, 17, 0])
    states = start + np.outer([0, 1, -1, 2], [0.2, 0, 0, 0, 0.01, 0, 0.3, 0])
    plans = slalom.Planner(scenario).plan_many(states, tex=0.5)
    for state, plan in zip(states, plans, strict=True):
        alone = slalom.Planner(scenario).plan(state, tex=0.5)
        assert plan.status == alone.status
        np.testing.assert_array_equal(plan.states, alone.states)
    with pytest.raises(slalom.InvalidValue, match=r"states\[1\]"):
        slalom.Planner(scenario).plan_many([start, start[:3]])


def test_a_row_that_was_constant_is_there_for_other_numbers():
    p = slalom.Problem("fixed")
    x, u, a = p.state("x", initial=1), p.control("u"), p.parameter("a", 1.0)
    p.dynamics(x, u)
    p.lagrange("effort", u * u)
    p.boundary("start", p.initial(x) - a, equal=0)
    for name in ("a", "initial x"):
        assert p.solve_many({name: [1.0, 2.0, 1.0]}, mesh=10).solved.tolist() == [True, False, True]


def test_times_that_one_mesh_does_not_serve_are_refused():
    p = pushed()
    p.final_time(lower=0.1, upper=50, guess=3)
    with pytest.raises(slalom.InvalidValue, match="solve 1.*at most the least tf"):
        p.solve_many({"t0": [0.0, 10.0]})
    p, x = stated()
    p.final_time(equal=1)
    p.path("way", x, at=0.3, equal=0.5)
    with pytest.raises(slalom.InvalidValue, match="solve 1.*share of the horizon"):
        p.solve_many({"tf": [1.0, 2.0]}, mesh=10)
