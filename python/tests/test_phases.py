"""Several phases: linked, solved, refused, and shown."""

import numpy as np
import pytest
from problems import swing, two_legs

import slalom


def test_two_legs():
    s = two_legs().solve(mesh=10, scheme="trapezoidal")
    assert s.solved and s.objective == pytest.approx(2, rel=1e-6)
    assert len(s) == 2 and s["slow down"].tf == s[-1].tf
    assert s[0].tf == pytest.approx(1, rel=1e-5)
    assert s[0].state("x")[-1] == pytest.approx(s[1].state("x")[0])
    assert set(s.link_multipliers) == {"x from speed up to slow down", "v from speed up to slow down",
                                       "time from speed up to slow down"}
    assert [phase.name for phase in s.phases] == ["speed up", "slow down"]
    assert s[0].estimate_errors().largest < 1e-8


def test_grids_and_guesses_of_single_phases():
    cold = two_legs().solve(mesh=10)
    s = two_legs().solve(mesh=6, scheme="lgr", phases={
        "slow down": {"mesh": [0, 0.5, 1], "scheme": "lgl", "points": 5, "guess": {"x": (0.5, 1)}}},
        guess=cold)
    assert s.solved and s.objective == pytest.approx(2, rel=1e-3)
    assert s[0].schemes == [("lgr", 5)] * 6 and s[1].schemes == [("lgl", 5)] * 2
    assert two_legs().solve(mesh=11, warm_start=cold).solved
    single = slalom.PhasedProblem("single")
    single.add(slalom.Problem("alone"))
    with pytest.raises(slalom.InvalidValue, match="2 phases"):
        single.solve(warm_start=cold)


@pytest.mark.parametrize("state, error, message", [
    (lambda p: p.solve(phases={"slow dwn": {}}), KeyError, "perhaps 'slow down'"),
    (lambda p: p.solve(phases={"slow down": {"meh": 3}}), KeyError, "perhaps 'mesh'"),
    (lambda p: p.solve(phases={"slow down": {"mesh": "many"}}), TypeError, "mesh"),
    (lambda p: p.solve(phases={"slow down": 3}), TypeError, "slow down"),
    (lambda p: p.solve(mesh=[0, 2, 1]), ValueError, "mesh|breakpoint"),
    (lambda p: p.solve(max_iteration=3), ValueError, "max_iterations"),
    (lambda p: p.connect(0, 7), ValueError, "phase 7"),
    (lambda p: p.link("time from speed up to slow down", slalom.Expr(0)), ValueError, "twice"),
    (lambda p: p.link("free", slalom.Expr.symbol("z"), upper=float("inf")), ValueError, "link free.*no bounds"),
    (lambda p: p.link("foreign", slalom.Expr.symbol("z")) or p.solve(), ValueError, "'z'"),
    (lambda p: p.add(slalom.Problem("speed up")), ValueError, "twice"),
    (lambda p: p.solve()["up"], KeyError, "no phase 'up'"),
    (lambda p: p.solve()[2], IndexError, "no such phase"),
])
def test_bad_input(state, error, message):
    with pytest.raises(error, match=message):
        state(two_legs())


def test_a_phase_without_link_is_refused():
    p = slalom.PhasedProblem("apart")
    for leg in ("a", "b"):
        phase = slalom.Problem(leg)
        phase.dynamics(phase.state("x", initial=0), phase.control("u"))
        p.add(phase)
    with pytest.raises(slalom.InvalidValue, match="no link"):
        p.solve()


def test_frame_and_plot():
    pandas = pytest.importorskip("pandas")
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    s = two_legs().solve(mesh=4)
    frame = s.to_frame()
    assert isinstance(frame, pandas.DataFrame) and list(frame.index.names) == ["phase", "t"]
    np.testing.assert_array_equal(frame.loc["slow down"]["x"], s[1].state("x"))
    axes = s.plot().axes
    assert [a.get_ylabel() for a in axes] == ["x", "v", "u"]
    assert len(axes[0].lines) == 4  # a curve and points for each phase
    np.testing.assert_allclose(axes[0].lines[0].get_ydata()[-1], axes[0].lines[2].get_ydata()[0],
                               atol=1e-6)


def test_a_phase_with_other_numbers():
    p = two_legs()
    leg = slalom.Problem("slow down")
    with pytest.raises(slalom.InvalidValue):
        p.replace("slow down", leg)
    with pytest.raises(KeyError, match="perhaps 'slow down'"):
        p.replace("slow dow", leg)


def test_refinement():
    r = two_legs().refine(mesh=4, refinement="hp", scheme="lgr", points=2, tolerance=1e-8)
    assert r.converged and len(r.errors) == 2 and max(e.largest for e in r.errors) <= 1e-8
    assert r.solution["slow down"].tf == pytest.approx(2, rel=1e-2)
    assert r.table().splitlines()[-1] == "converged"
    warm = two_legs().solve(mesh=30, warm_start=r.solution)
    assert warm.solved
    with pytest.raises(slalom.InvalidValue, match="max_meshes"):
        two_legs().refine(max_mesh=2)


def test_rows_added_to_a_phase_after_add_count():
    p = slalom.PhasedProblem("single")
    leg = slalom.Problem("leg")
    x, u = leg.state("x", initial=0, final=1), leg.control("u")
    p.add(leg)
    leg.dynamics(x, u)
    leg.lagrange("effort", u**2)
    leg.path("least", u, lower=0.5)
    leg.path("most", x, upper=2)
    s = p.solve(mesh=4)
    assert s.solved and s.objective == pytest.approx(1)
    leg.final_time(equal=2)
    leg.path("fast", u, lower=0.6)
    assert p.solve(mesh=4).conflicts
    assert p.refine(mesh=4).status == "not_solved"


def test_a_constant_and_a_cost_of_several_phases():
    p = slalom.PhasedProblem("decay")  # x' = -k x fitted to exp(-t) at t = 1 and t = 3
    ends = []
    for number, (begin, end) in enumerate([(0, 1), (1, 3)]):
        leg = slalom.Problem(f"leg {number}")
        x, k = leg.state("x", initial=1 if number == 0 else None), leg.static_parameter("k", guess=0.3)
        leg.dynamics(x, -k * x)
        leg.initial_time(equal=begin)
        leg.final_time(equal=end)
        p.add(leg)
        ends.append((leg.final(x), float(np.exp(-end))))
    p.connect(0, 1)
    with pytest.raises(slalom.InvalidValue, match="perhaps 'k'"):
        p.share("kk")
    p.share("k")
    p.mayer("misfit", sum((value - measured)**2 for value, measured in ends))
    with pytest.raises(slalom.InvalidValue, match="twice"):
        p.mayer("misfit", ends[0][0])
    s = p.solve(mesh=8)
    assert s.solved and s.objective < 1e-9
    assert s.cost_terms["misfit"] == pytest.approx(s.objective)
    assert [s[n].static_parameter("k") for n in (0, 1)] == pytest.approx([1, 1], rel=1e-4)
    p.mayer("speed", 0.01 * ends[0][0], maximise=True)  # beside it, a slower decay
    slower = p.solve(mesh=8)
    assert slower.objective == pytest.approx(sum(slower.cost_terms.values()))
    assert slower.cost_terms["speed"] == pytest.approx(-0.01 * slower[0].state("x")[-1])
    assert slower[1].static_parameter("k") < 1 - 1e-3


def test_gaps_of_connected_phases():
    p = slalom.PhasedProblem("stages")
    masses = []
    for k in range(2):
        leg = slalom.Problem(f"{k}")
        x, m, u = leg.state("x", initial=0 if k == 0 else None), leg.state("m"), leg.control("u")
        leg.dynamics(x, u)
        leg.dynamics(m, -1)
        leg.lagrange("effort", u**2)
        leg.initial_time(equal=k)
        leg.final_time(equal=k + 1)
        if k == 0:
            leg.initial_bounds(m, equal=10)
        else:
            leg.final_bounds(x, equal=1)
        p.add(leg)
        masses.append(m)
    with pytest.raises(slalom.InvalidValue, match="no state 'mass'"):
        p.connect(0, 1, without=["mass"])
    p.connect(0, 1, jumps={"m": -4})
    s = p.solve(mesh=4)
    assert s.solved
    assert s[1].state("m")[0] == pytest.approx(s[0].state("m")[-1] - 4)


def test_warm_starts_on_the_same_mesh():
    one = slalom.PhasedProblem("one")
    one.add(swing())
    cold = swing().solve(mesh=20)
    warm = swing().solve(mesh=20, warm_start=one.solve(mesh=20)["swing"])
    assert warm.solved and warm.iterations < cold.iterations
    stopped = one.solve(mesh=20, time_limit=0)
    assert swing().solve(mesh=20, warm_start=stopped[0]).solved
    p, x, u = pushed()
    earlier = p.solve(mesh=20)
    p.path("sum", x + u, upper=50)
    assert p.solve(mesh=20, warm_start=earlier).solved  # with a row more


def pushed():
    p = slalom.Problem("pushed")
    x, u = p.state("x", initial=0, final=1), p.control("u")
    p.dynamics(x, u)
    p.lagrange("effort", u**2)
    return p, x, u


def test_warm_starts_of_problems_with_another_link():
    p, legs = slalom.PhasedProblem("pieces"), []
    for k in range(2):
        leg = slalom.Problem(f"piece {k}")
        x, u = leg.state("x"), leg.control("u", lower=-3, upper=3)
        leg.dynamics(x, u - x**3)
        leg.lagrange("effort", u**2)
        leg.initial_time(equal=k)
        leg.final_time(equal=k + 1)
        if k == 0:
            leg.initial_bounds(x, equal=0)
        else:
            leg.final_bounds(x, equal=1)
        p.add(leg)
        legs.append((leg, x))
    p.connect(0, 1)
    earlier = p.solve(mesh=10)
    p.link("even", legs[1][0].final(legs[1][1]) - legs[0][0].final(legs[0][1]), upper=0.9)
    for mesh in (10, 15):
        assert p.solve(mesh=mesh, warm_start=earlier).solved
