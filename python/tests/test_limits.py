"""Sizes and times that a caller gives are kept to, and what cannot be pickled says what to do instead."""

import copy
import pickle
import stat
import time

import numpy as np
import pytest
from problems import decay, swing, two_legs

import slalom


def test_sizes_are_bounded_before_anything_is_made():
    problem = decay()
    begin = time.process_time()
    for wrong in ({"points": 100_000, "scheme": "lgr", "mesh": 1}, {"points": 101, "scheme": "lgl"},
                  {"points": [4] * 39 + [10**6], "scheme": "lgr"}, {"mesh": 10**9},
                  {"mesh": 100_000, "points": 100, "scheme": "lgr"}):
        with pytest.raises(slalom.InvalidValue, match="at most"):
            problem.solve(**wrong)
        with pytest.raises(slalom.InvalidValue, match="at most"):
            problem.refine(**wrong)
        with pytest.raises(slalom.InvalidValue, match="at most"):
            slalom.Mpc(problem, **wrong)
    for wrong in ({"max_size": 10**9}, {"max_points": 1000}, {"max_meshes": 10**6}):
        with pytest.raises(slalom.InvalidValue, match="at most"):
            problem.refine(**wrong)
    with pytest.raises(slalom.InvalidValue, match="at most"):
        problem.simulate({"x": 1}, {"u": 0}, tf=1, steps=10**9)
    with pytest.raises(slalom.InvalidValue, match="threads.*at most"):
        problem.solve_many({"initial x": [1.0] * 2000}, threads=50_000)
    with pytest.raises(slalom.InvalidValue, match="samples.*at most"):
        problem.solve(mesh=2).largest_violation(samples=10**9)
    assert time.process_time() - begin < 10
    assert problem.solve(mesh=1, points=100, scheme="lgr").solved


def test_options_may_be_numpy_numbers():
    s = decay().solve(max_iterations=np.int64(200), tol=np.float32(1e-6), print_level=np.array(0))
    assert s.solved
    with pytest.raises(slalom.InvalidValue, match="max_iterations"):
        decay().solve(max_iterations=10**30)
    with pytest.raises(ValueError):
        decay().solve(max_iterations=np.array([1, 2]))


def test_time_limit_is_of_the_whole_call():
    begin = time.monotonic()
    s = decay().solve(mesh=20_000, time_limit=0.01)
    assert s.status == "time_limit"
    assert time.monotonic() - begin < 5
    refined = decay().refine(mesh=20_000, time_limit=0.01)
    assert refined.solution.status == "time_limit" and refined.status == "not_solved"
    assert [mesh.status for mesh in refined.meshes] == ["time_limit"] and refined.errors is None
    phased = two_legs().solve(mesh=20_000, time_limit=0.01)
    assert [part.status for part in (phased, *phased.phases)] == ["time_limit"] * 3


def test_a_refinement_that_is_stopped_keeps_its_last_answer():
    for limit in (0.2, 1, 5, 25):  # until the machine has the first mesh solved by then
        refined = swing().refine(mesh=2, tolerance=1e-30, max_meshes=1000, max_size=10**6, time_limit=limit)
        if len(refined.meshes) > 1:
            break
    assert refined.status == "stopped" and len(refined.meshes) > 1
    assert refined.solution.solved and refined.errors is not None


def test_a_solver_that_sleeps_is_ended(tmp_path):
    sleeper = tmp_path / "sleeper"
    sleeper.write_text("#!/bin/sh\nexec sleep 100\n")
    sleeper.chmod(sleeper.stat().st_mode | stat.S_IEXEC)
    begin = time.monotonic()
    s = decay().solve(backend="nl", nl_solver=str(sleeper), time_limit=0.5)
    assert s.status == "time_limit"
    assert time.monotonic() - begin < 10


def test_scenarios_are_pickled_to_the_bit():
    scenario = slalom.load_scenario("E_C", planner="P_D", set={"start.ux": 16.1, "loop.tex": 0.3})
    for again in (pickle.loads(pickle.dumps(scenario)), copy.deepcopy(scenario), copy.copy(scenario)):
        assert again.to_yaml() == scenario.to_yaml()
        assert (again.name, again.title) == (scenario.name, scenario.title)


@pytest.mark.parametrize(("make", "instead"), [
    (lambda: decay().solve(), "save"), (decay, "function"), (lambda: decay().refine(), "arrays"),
    (lambda: decay().simulate({"x": 1}, {"u": 0}, tf=1), "arrays"), (swing, "function"),
    (lambda: slalom.simulate("E_A", set={"loop.timeout": 0.3}), "write"),
    (lambda: slalom.Planner(slalom.load_scenario("E_A")), "each process"),
])
def test_what_cannot_be_pickled_says_what_to_do(make, instead):
    with pytest.raises(TypeError, match=f"cannot be pickled.*{instead}"):
        pickle.dumps(make())


def test_a_solve_that_did_not_begin_can_be_looked_at_and_gone_on_from(tmp_path):
    p = slalom.Problem("stopped")
    x, u = p.state("x", initial=0, final=1), p.control("u")
    k, q = p.static_parameter("k", guess=1, lower=1, upper=2), p.integral("q", u * u)
    p.dynamics(x, k * u)
    p.mayer("effort", q)
    stopped = p.solve(time_limit=0)
    assert stopped.status == "time_limit"
    assert stopped.static_parameter("k") == 1 and stopped.integral("q") == 0
    with pytest.raises(slalom.InvalidValue, match="did not begin"):
        stopped.hamiltonian()
    assert p.solve(mesh=20, warm_start=stopped).solved
    assert p.solve_many({"final x": [1.0]}, warm_start=stopped).solved.all()
    header, *rows = stopped.to_csv().splitlines()
    assert header == "t,tau,x,u,costate x"
    assert len(rows) == len(stopped.t) and all(row.endswith(",") for row in rows)
    stopped.save(tmp_path / "stopped.json")
    again = p.load_solution(tmp_path / "stopped.json")
    assert again.status == "time_limit" and again.integral("q") == 0
    np.testing.assert_array_equal(again.state("x"), stopped.state("x"))
    assert len(two_legs().solve(time_limit=0).phases[1].to_csv().splitlines()) > 1


def below(start, **softness):
    """Least effort from `start` on, where a family keeps x below its members' numbers."""
    p = slalom.Problem("below")
    x, u = p.state("x", initial=start), p.control("u")
    p.dynamics(x, u)
    p.lagrange("effort", u * u)
    c = slalom.Expr.symbol("c")
    return p, p.path_family("wall", [c], x - c, upper=0, **softness)


def test_a_family_with_numbers_by_point_may_be_infeasible():
    p, wall = below(0)
    p.set_members(wall, ["one"], [[-1.0] * 81])
    assert p.solve().status == "infeasible"
    p.set_members(wall, ["one"], [[1.0] * 81])
    solution = p.solve()
    assert solution.solved and abs(solution(0.5)["x"]) < 1e-6


def test_excesses_of_a_family_are_by_point_and_member():
    p, wall = below(1, soft="l1")
    p.set_members(wall, ["near", "far"], [[0.0], [9.0]])
    excess = p.solve(mesh=10).excess("wall")
    assert excess.shape == (21, 2) and excess[0, 0] > 0.9 and (abs(excess[:, 1]) < 1e-6).all()
