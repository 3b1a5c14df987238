"""Answers judged and interpolated from Python: closed forms, and what names them."""

import math
import warnings

import numpy as np
import pytest
from problems import bryson_denham, decay, decay_at, swing

import slalom


def test_interpolation_is_that_of_the_scheme():
    s = decay().solve(mesh=10, scheme="lgr", points=6)
    t = np.linspace(0, 2, 37)
    exact, costate = decay_at(t)
    np.testing.assert_allclose(s(t)["x"], exact, atol=1e-9)
    np.testing.assert_allclose(s(t)["u"], -costate / 2, atol=1e-7)
    np.testing.assert_allclose(s.costate("x"), decay_at(s.nodes)[1], atol=1e-6)
    np.testing.assert_allclose(s(s.t)["x"], s.state("x"), atol=1e-12)


def test_interpolation_has_the_shape_of_its_times():
    s = decay().solve()
    assert isinstance(s(0.5)["x"], float)
    assert s(1)["x"] == s([1.0])["x"][0]
    assert s([[0, 1, 2], [2, 1, 0]])["u"].shape == (2, 3)
    assert s(-1, hold=True)["x"] == s(0)["x"] and s(9, hold=True)["x"] == s(2)["x"]
    assert s(np.array([]))["x"].shape == (0,)
    with pytest.raises(slalom.InvalidValue, match="NaN"):
        s(float("nan"))
    with pytest.raises((TypeError, ValueError)):
        s("noon")


def test_an_answer_is_of_the_problem_as_it_was():
    p = slalom.Problem("parameter")
    k = p.parameter("k", 1)
    x = p.state("x", initial=1)
    p.dynamics(x, -k * x)
    u = p.control("u", lower=0, upper=1)
    p.lagrange("effort", u)
    s = p.solve()
    p.set_parameter(k, 100)
    assert s.estimate_errors().largest < 1e-5
    assert s(0.5)["x"] == pytest.approx(np.exp(-0.5), rel=1e-5)


def test_answers_are_saved_whole_and_go_on(tmp_path):
    p = bryson_denham()
    s = p.solve()
    s.save(tmp_path / "answer.json")
    again = p.load_solution(tmp_path / "answer.json")
    assert again.objective == s.objective and again.status == s.status
    np.testing.assert_array_equal(again.state("x"), s.state("x"))
    np.testing.assert_array_equal(again.costate("v"), s.costate("v"))
    assert again(0.3) == s(0.3)
    assert p.solve(warm_start=again).iterations == p.solve(warm_start=s).iterations
    assert s.to_csv().splitlines()[0].startswith("t,")
    with pytest.raises(slalom.InvalidValue, match="another problem"):
        decay().load_solution(tmp_path / "answer.json")
    with pytest.raises((slalom.InvalidValue, OSError)):
        p.load_solution(tmp_path / "nothing.json")


def test_grids():
    breaks = [0, 0.1, 0.4, 1]
    s = decay().solve(mesh=breaks, scheme=["lgr", "lgl", "trapezoidal"], points=[3, 8, 2])
    np.testing.assert_allclose(s.mesh, breaks)
    np.testing.assert_allclose(s.nodes, 2 * s.mesh)
    assert [name for name, _ in s.schemes] == ["lgr", "lgl", "trapezoidal"]
    assert len(s.t) == 3 + 7 + 1 + 1
    assert "interior_point" in s.backend
    with pytest.raises(slalom.InvalidValue, match="2 entries.*3, one for each interval"):
        decay().solve(mesh=3, scheme=["lgr", "lgl"])
    with pytest.raises(slalom.InvalidValue, match="decay: points"):
        decay().solve(mesh=3, scheme="lgr", points=[3, 4])


def test_error_estimate_tells_a_coarse_mesh_from_a_fine_one():
    coarse, fine = decay().solve(mesh=4), decay().solve(mesh=40)
    e, f = coarse.estimate_errors(), fine.estimate_errors()
    assert e.interval.shape == (4,) and e.interval[e.worst] == e.largest
    assert set(e.state) <= {"x", "the cost's integral"}
    assert f.largest < 1e-3 * e.largest
    assert e.horizon > 0 and e.amplification > 0
    assert coarse.unresolved_controls().shape == (4,)
    with pytest.raises(slalom.InvalidValue, match="tolerance"):
        coarse.estimate_errors(tolerance=0)


def test_violation_between_the_nodes_is_named():
    s = bryson_denham().solve(mesh=10)
    v = s.largest_violation()
    assert v.value > 1e-5 and "x" in v.constraint and 0 < v.time < 1
    assert bryson_denham().solve(mesh=200).largest_violation().value < v.value / 10


def test_hamiltonian_is_constant():
    h = decay().solve(mesh=100).hamiltonian()
    assert h.shape == (101,)
    np.testing.assert_allclose(h, h[0], rtol=1e-3)


@pytest.mark.parametrize("refinement, scheme", [("h", "hermite_simpson"), ("hp", "lgr")])
def test_refinement(refinement, scheme):
    points = 3 if scheme == "lgr" else None
    r = decay().refine(tolerance=1e-9, refinement=refinement, mesh=4, scheme=scheme, points=points)
    assert r.converged and r.status == "converged"
    assert 0 < r.errors.largest <= 1e-9
    assert len(r.meshes) > 1 and r.meshes[0].intervals == 4
    assert r.meshes[-1].largest_error == r.errors.largest == r.solution.estimate_errors().largest
    assert r.solution.objective == pytest.approx(decay_at(0)[1] / 2, rel=1e-6)
    assert r.table().count("\n") == len(r.meshes) + 2
    assert 0 <= r.hamiltonian_gap <= 1e-6


def test_refinement_leaves_an_answer_that_is_no_minimum():
    p = slalom.Problem("linear-tangent steering")  # Bryson & Ho 1975, p. 59
    u, v, y = p.state("u", initial=0), p.state("v", initial=0, final=0), p.state("y", initial=0, final=1, lower=0)
    angle = p.control("angle", lower=-math.pi, upper=math.pi)
    p.dynamics(u, np.cos(angle))
    p.dynamics(v, np.sin(angle))
    p.dynamics(y, v)
    p.final_time(equal=2.05)
    p.mayer("speed", p.final(u), maximise=True)
    assert p.refine().solution.objective == pytest.approx(-0.80478321, abs=1e-6)


def test_refinement_says_what_it_did_not_reach():
    r = decay().refine(mesh=4, max_meshes=1)
    assert not r.converged and r.status == "mesh_limit" and r.errors.largest > 1e-6
    unsolved = decay().refine(max_iterations=0)
    assert unsolved.status == "not_solved" and unsolved.errors is None
    with pytest.raises(slalom.InvalidValue, match="'h' or 'hp'"):
        decay().refine(refinement="p")
    with pytest.raises(slalom.InvalidValue, match="lgr"):
        decay().refine(refinement="hp")
    with pytest.raises(slalom.InvalidValue, match="tolerance"):
        decay().refine(tolerence=1e-3)


def test_warm_start_takes_fewer_iterations():
    cold = swing().solve()
    guessed = swing().solve(guess=cold)
    warm = swing().solve(warm_start=cold)
    assert warm.solved and warm.iterations <= guessed.iterations < cold.iterations
    assert warm.iterations <= 1
    with pytest.raises(TypeError):
        swing().solve(warm_start=3)


def test_names_that_are_not_there_are_key_errors():
    s = decay().solve()
    for lookup, name in ((s.state, "y"), (s.control, "v"), (s.costate, "y"), (s.slack, "s"),
                         (s.static_parameter, "k"), (s.integral, "energy")):
        with pytest.raises(KeyError, match=f"no .*'{name}'") as caught:
            lookup(name)
        assert isinstance(caught.value, slalom.UnknownName)
        assert isinstance(caught.value, slalom.InvalidValue)
        assert str(caught.value).startswith("solution: ")


def test_values_by_name():
    p = slalom.Problem("values")
    x = p.state("x", initial=0)
    u = p.control("u", lower=0, upper=1)
    k = p.static_parameter("k", lower=1, upper=3)
    p.dynamics(x, k * u)
    area = p.integral("area", u, equal=0.5)
    p.mayer("reach", -p.final(x))
    p.mayer("use", area)
    s = p.solve()
    assert s.static_parameter("k") == pytest.approx(3) and s.integral("area") == pytest.approx(0.5)
    assert s.name == "values" and s.cost_terms["reach"] == pytest.approx(-1.5)


def test_solver_options_are_those_that_solve_takes():
    for row in slalom.solver_options():
        assert row["meaning"] and row["rule"]
        assert decay().solve(**{row["name"]: row["default"]}).solved or row["name"] == "floor"


def test_cubic_spline():
    x = slalom.Expr.symbol("x")
    knots, values = [0, 1, 3], [1, 2, -1]
    spline = slalom.cubic_spline(x, knots, values)
    for knot, value in zip(knots, values):
        assert spline.evaluate([(x, knot)]) == pytest.approx(value)
    with pytest.raises(slalom.InvalidValue, match="rise|increas"):
        slalom.cubic_spline(x, [0, 0], [1, 1])


def test_a_table_beyond_its_ends():
    def fall(**beyond):
        p = slalom.Problem("fall")  # air as far up as the table goes, and on
        h, v = p.state("h", initial=3, lower=-10), p.state("v", initial=0)
        p.dynamics(h, v)
        p.dynamics(v, -1 - slalom.cubic_spline(h, [0, 1, 2], [0.2, 0.1, 0], **beyond) * v)
        return p.solve(mesh=5)

    with pytest.warns(UserWarning, match="dynamics of v uses a table up to 1.0 beyond its ends"):
        assert fall().beyond_tables == {"dynamics of v": pytest.approx(1)}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert fall(beyond="hold").beyond_tables == {}
    with pytest.raises(slalom.InvalidValue, match="'line' or 'hold'"):
        fall(beyond="stop")


def wall(**soft):
    p = slalom.Problem("wall")
    x, v, u = p.state("x", initial=0, final=0), p.state("v", initial=1, final=-1), p.control("u")
    p.dynamics(x, v)
    p.dynamics(v, u)
    p.lagrange("effort", u**2 / 2)
    p.path("wall", x, upper=1 / 9, **soft)
    return p


def test_multipliers_by_name():
    s = wall().solve(mesh=40)
    m = s.multiplier("wall")
    assert m.shape == s.t.shape and (m >= -1e-9).all()
    # They sum to minus the derivative of the optimum 4 / (9 l) at l = 1/9.
    assert m.sum() == pytest.approx(36, rel=1e-2)
    np.testing.assert_array_equal(s.multipliers["wall"], m)
    assert isinstance(s.multiplier("tf"), float)
    with pytest.raises(KeyError, match="perhaps 'wall'"):
        s.multiplier("walls")
    with pytest.raises(KeyError, match="soft constraint"):
        s.excess("wall")


def test_soft_constraints():
    hard = wall().solve()
    exact = wall(soft="l1", weight=1e4).solve()
    cheap = wall(soft="l1", weight=1).solve()
    assert exact.objective == pytest.approx(hard.objective, rel=1e-5)
    assert cheap.objective < hard.objective - 0.1
    np.testing.assert_allclose(cheap.excess("wall"), np.maximum(cheap.state("x") - 1 / 9, 0),
                               atol=1e-5)
    p = wall()
    p.soften("wall", "l2", weight=10, tolerance=0.01)
    assert p.solve().cost_terms["soft wall"] > 0
    p.harden("wall")
    assert p.solve().objective == pytest.approx(hard.objective, rel=1e-9)
    p.enable("wall", False)
    assert p.solve().objective < cheap.objective
    for wrong, error, message in ((lambda: p.soften("wal"), KeyError, "perhaps 'wall'"),
                                  (lambda: p.soften("wall", "l3"), ValueError, "'l1' or 'l2'"),
                                  (lambda: wall(soft="l1", weight=0), ValueError, "weight"),
                                  (lambda: p.enable_cost("efort", False), KeyError, "effort")):
        with pytest.raises(error, match=message):
            wrong()


def test_forms_of_controls():
    for form, degree in (("constant", 0), ("linear", 1)):
        p = slalom.Problem("form")
        x = p.state("x", initial=1)
        u = p.control("u", form=form)
        p.dynamics(x, -x + u)
        p.lagrange("cost", x**2 + u**2)
        s = p.solve(mesh=5, scheme="lgr", points=4)
        t = s.nodes[1] + np.array([0.2, 0.5, 0.8]) * (s.nodes[2] - s.nodes[1])
        between = np.diff(s(t)["u"], degree + 1)
        np.testing.assert_allclose(between, 0, atol=1e-12)
    with pytest.raises(slalom.InvalidValue, match="'scheme', 'linear' or 'constant'"):
        p.control("w", form="cubic")


def test_scales_do_not_change_the_answer():
    def in_units(metre, scale=None):
        p = slalom.Problem("units")
        x = p.state("x", initial=0, final=metre, scale=scale)
        v, u = p.state("v", initial=0, final=0), p.control("u", lower=-6 * metre, upper=6 * metre)
        p.dynamics(x, v)
        p.dynamics(v, u)
        p.lagrange("effort", (u / metre) ** 2)
        p.path("slow", v, upper=1.2 * metre)
        p.set_scale("slow", metre)
        p.set_scale(u, metre)
        return p.solve().objective

    assert in_units(1e4) == pytest.approx(in_units(1), rel=1e-6)
    assert in_units(1e4, scale=5e3) == pytest.approx(in_units(1), rel=1e-5)
    for scale in (0, -1, float("nan")):
        with pytest.raises(slalom.InvalidValue, match="scale"):
            in_units(1, scale=scale)
    with pytest.raises(KeyError, match="slow"):
        wall().set_scale("slow", 1)


def test_warm_starts_from_another_mesh():
    first = swing().solve(mesh=30)
    finer = swing().solve(mesh=45, scheme="lgr", points=3, warm_start=first)
    assert finer.solved and finer.iterations < swing().solve(mesh=45, scheme="lgr", points=3).iterations
    with pytest.raises(slalom.InvalidValue, match="states a, w.*states x"):
        decay().solve(warm_start=first)


def test_value_of_an_expression():
    p = slalom.Problem("line")
    x, u = p.state("x", initial=0, final=2), p.control("u")
    p.dynamics(x, u)
    p.lagrange("effort", u**2)
    p.final_time(equal=4)
    s = p.solve(mesh=5)
    np.testing.assert_allclose(s.value(x + u * p.time), s.t, atol=1e-9)
    assert s.value(np.sin(x), 2.0) == pytest.approx(math.sin(1))
    assert s.value(x, [[1, 2], [3, 4]]) == pytest.approx(np.array([[0.5, 1], [1.5, 2]]))
    assert s.value(p.final(x) * p.tf) == pytest.approx(8)
    with pytest.raises(slalom.InvalidValue, match="foreign"):
        s.value(x * slalom.Expr.symbol("foreign"))


def test_times_beyond_the_end_are_warned_of():
    s = decay().solve(mesh=5)
    for t in (-0.1, 2.1, [1, 3]):
        with pytest.warns(UserWarning, match="hold=True"):
            s(t)
        with pytest.warns(UserWarning, match="hold=True"):
            s.value(slalom.Expr(1), t)
    assert s(2.1, hold=True) == s(2) and s(s.t[-1] + 1e-12) == s(2)


def test_scales_can_be_seen():
    p = slalom.Problem("line")
    x, u = p.state("x", initial=0, final=200), p.control("u", lower=-7, upper=7)
    p.dynamics(x, u)
    p.path("slow", 3 * u, upper=20)
    p.final_time(lower=1, upper=100, guess=40)
    p.mayer("duration", p.tf)
    s = p.solve(mesh=5)
    assert s.scales == {"x": 200, "u": 7, "t0": 40, "tf": 40, "slow": 20}
    p.set_scale(x, 30)
    assert p.solve(mesh=5).scales["x"] == 30


def test_conflicts_say_what_would_have_to_give():
    p = slalom.Problem("line")
    x, u = p.state("x", initial=0, final=5), p.control("u", lower=-1, upper=1)
    p.dynamics(x, u)
    s = p.solve(mesh=5)
    assert s.status == "infeasible"
    assert dict(s.conflicts)["final x"] == pytest.approx(-4, abs=0.01)
    assert dict(s.conflicts)["u"] == pytest.approx(4, abs=0.01)
    assert decay().solve(mesh=5).conflicts == []


def test_an_equation_of_high_index_is_named():
    p = slalom.Problem("pendulum")
    x, y, vx, vy = (p.state(name, initial=value)
                    for name, value in [("x", 0.6), ("y", -0.8), ("vx", 0), ("vy", 0)])
    tension = p.control("tension")
    p.dynamics(x, vx)
    p.dynamics(y, vy)
    p.dynamics(vx, -tension * x)
    p.dynamics(vy, -tension * y - 9.81)
    p.path("length", x**2 + y**2, equal=1)
    with pytest.warns(UserWarning, match="'length' is of index 3: controls meet it in derivative 2"):
        s = p.solve(mesh=10, max_iterations=3)
    assert not s.solved and s.high_index == {"length": 3}
