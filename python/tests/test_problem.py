"""Problems: stated, solved, and refused with the right exception."""

import math
import os
import pathlib
import re
import signal
import threading
import time

import numpy as np
import pytest
from problems import bryson_denham

import slalom

README = pathlib.Path(os.environ.get("SLALOM_README", pathlib.Path(__file__).parents[2] / "README.md"))


def test_bryson_denham():
    s = bryson_denham().solve(mesh=90)
    assert s.solved and s.status == "solved"
    assert s.objective == pytest.approx(4, rel=1e-5)
    assert s.state("x").max() <= 1 / 9 + 1e-6
    assert s.t.shape == s.states["x"].shape == s.controls["u"].shape
    assert s.t[0] == 0 and s.t[-1] == s.tf == 1
    assert s.cost_terms == {"effort": pytest.approx(s.objective)}
    # Analytic: x enters its bound at 3 l = 1/3, and the control there is (t / (3 l) - 1) 2 / (3 l).
    np.testing.assert_allclose(s.control("u")[0], -2 / (3 / 9), rtol=1e-3)
    # At t = 0 the costate of v is dJ*/dv = -u, for stationarity is u + costate = 0.
    np.testing.assert_allclose(s.costate("v")[0], 6, rtol=1e-2)


def test_free_final_time_by_each_scheme():
    for scheme in slalom.scheme_names():
        p = slalom.Problem("minimum time")
        x, v = p.state("x", initial=0, final=1), p.state("v", initial=0, final=0)
        u = p.control("u", lower=-1, upper=1)
        p.dynamics(x, v)
        p.dynamics(v, u)
        p.final_time(lower=0.1, upper=10)
        p.mayer("duration", p.tf)
        s = p.solve(scheme=scheme, mesh=20)
        assert s.solved, scheme
        assert s.tf == pytest.approx(2, rel=0.1 if scheme == "backward_euler" else 1e-2), scheme


def test_guesses():
    p = bryson_denham()
    s = p.solve()
    again = p.solve(guess=s, mesh=60)
    assert again.objective == pytest.approx(s.objective, rel=1e-3)
    t = np.linspace(0, 1, 5)
    assert p.solve(guess={"t": t, "x": 0.1, "v": 1 - 2 * t, "u": np.cos}).solved
    assert p.solve(guess={"x": [0, 0.1, 0], "v": (1, -1), "t0": 0, "tf": 1}).solved
    for guess in ({"x": "one"}, {"t": "noon"}, 3, {1: 2}):
        with pytest.raises(TypeError):
            p.solve(guess=guess)
    other = slalom.Problem("other")
    other.dynamics(other.state("x", lower=-9, upper=9), other.control("w", lower=2, upper=4))
    begun = other.solve(guess=s, max_iterations=0)  # what both have by name
    np.testing.assert_allclose(begun.state("x")[::20], s(begun.t[::20])["x"], atol=1e-6)
    assert begun.control("w")[0] == 3


def test_guesses_are_where_the_solve_starts():
    p = slalom.Problem("start")
    x = p.state("x", lower=-9, upper=9)
    u = p.control("u", lower=-9, upper=9)
    k = p.static_parameter("k", lower=0, upper=9)
    p.dynamics(x, k * u)
    p.lagrange("cost", u**2)
    s = p.solve(max_iterations=0, guess={"x": (1, 3), "u": np.cos, "k": 2})
    assert s.state("x")[[0, -1]] == pytest.approx([1, 3]) and s.static_parameter("k") == 2
    np.testing.assert_allclose(s.control("u"), np.cos(s.t), atol=1e-3)
    again = p.solve(max_iterations=0, guess=s, mesh=7, scheme="lgr", points=3)
    assert again.state("x").shape == (22,) and again.static_parameter("k") == 2


def test_an_array_outlives_its_solution():
    x = bryson_denham().solve().state("x")
    assert x[0] == pytest.approx(0, abs=1e-8)


@pytest.mark.parametrize("state, message", [
    (lambda p: p.state("x"), "twice"),
    (lambda p: p.state("w", lower=1, upper=0), "bounds 1 to 0"),
    (lambda p: p.state("w", lower=float("nan")), "NaN"),
    (lambda p: p.boundary("b", p.tf, lower=0, equal=1), "equal beside"),
    (lambda p: p.path("b", p.tf), "path b.*no bounds"),
    (lambda p: p.boundary("b", p.tf), "boundary b.*no bounds"),
    (lambda p: p.solve(mesh=0), "mesh|interval"),
    (lambda p: p.solve(mesh=[0, 0.5, 0.4, 1]), "mesh|breakpoint"),
    (lambda p: p.solve(scheme="hermit_simpson"), "hermite_simpson"),
    (lambda p: p.solve(max_iteration=3), "max_iterations"),
    (lambda p: p.solve(tol=-1), "tol"),
    (lambda p: p.solve(backend="nothing"), "interior_point"),
    (lambda p: p.solve(guess={"t": [0, 1, 0.5]}), "rise"),
    (lambda p: p.solve(guess={"t": [0]}), "at least two"),
    (lambda p: p.solve(guess={"t": [0, 1], "x": [1, 2, 3]}), "3 numbers.*2, one for each time"),
    (lambda p: p.solve(guess={"x": lambda t: [1, 2]}), "2 numbers.*101, one for each time"),
    (lambda p: p.solve(guess={"uu": 1}), "perhaps 'u'"),
])
def test_bad_input_is_a_value_error_that_says_so(state, message):
    with pytest.raises(ValueError, match=message) as caught:
        state(bryson_denham())
    assert isinstance(caught.value, slalom.InvalidValue) and isinstance(caught.value, slalom.Error)
    assert caught.value.expected


def test_wrong_types_are_type_errors():
    with pytest.raises(TypeError):
        slalom.Problem(3)
    with pytest.raises(TypeError):
        bryson_denham().state("w", lower="low")
    with pytest.raises(TypeError):
        bryson_denham().solve(tol=[1])


def test_several_starts():
    p = slalom.Problem("two ways")
    x, y = p.state("x", initial=-2, final=2), p.state("y", initial=0, final=0)
    u, v = p.control("u"), p.control("v")
    p.dynamics(x, u)
    p.dynamics(y, v)
    p.path("disc", x**2 + (y - 0.3) ** 2, lower=1)
    p.lagrange("effort", u**2 + v**2)
    guess = {"y": lambda t: 3 * np.sin(np.pi * t)}
    s = p.solve(guess=guess, starts=8, seed=5)
    assert len(s.starts) == 8 and s.objective == min(a.objective for a in s.starts if a.solved)
    assert s.objective < p.solve(guess=guess).objective - 0.5
    assert p.solve(guess=guess).starts == []
    with pytest.raises(slalom.InvalidValue, match="starts"):
        p.solve(starts=0)


def test_kinks_of_a_cost_as_rows():
    p = slalom.Problem("least fuel")
    x, v = p.state("x", initial=0, final=1), p.state("v", initial=0, final=0)
    u = p.control("u", lower=-1, upper=1)
    p.dynamics(x, v)
    p.dynamics(v, u)
    p.final_time(equal=4)
    p.lagrange("fuel", abs(u))
    with pytest.warns(UserWarning, match="the cost 'fuel' has a kink .* smooth_kinks"):
        kinked = p.solve(max_iterations=100)
    assert not kinked.solved and kinked.kinks == ["fuel"]
    assert "abs 1 of fuel" in p.smooth_kinks()[0]
    s = p.solve()
    assert s.solved and s.objective == pytest.approx(4 - math.sqrt(12), rel=1e-3)
    assert s.kinks == []


def test_points_that_do_nothing_are_warned_of():
    for scheme, points in (("hermite_simpson", 6), (["trapezoidal"] * 2, [3, 3])):
        with pytest.warns(UserWarning, match="points do nothing"):
            bryson_denham().solve(mesh=2, scheme=scheme, points=points)


def test_maximised_terms_count_with_a_minus():
    p = slalom.Problem("far")
    x, u = p.state("x", initial=0), p.control("u", upper=2)
    p.dynamics(x, u)
    p.mayer("way", p.final(x), maximise=True)
    p.lagrange("comfort", -(u**2) / 8, maximise=True)
    s = p.solve(mesh=4)
    assert s.solved and s.objective == pytest.approx(-1.5, abs=1e-6)
    assert s.cost_terms == pytest.approx({"way": -2, "comfort": 0.5}, abs=1e-6)


def test_not_solved_is_a_status():
    s = bryson_denham().solve(max_iterations=1)
    assert not s.solved and s.status == "iteration_limit"


def endless():
    p = slalom.Problem("slow")
    x = p.state("x", initial=1)
    u = p.control("u")
    p.dynamics(x, -x**3 + u)
    p.lagrange("cost", x**2 + u**2)
    while True:
        p.solve(mesh=20000)


def test_interrupt_stops_a_solve():
    timer = threading.Timer(1, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    started = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        endless()
    assert time.monotonic() - started < 60


def test_interrupt_stops_a_simulation():
    p = slalom.Problem("fast")
    x, v = p.state("x"), p.state("v")
    p.dynamics(x, v)
    p.dynamics(v, -100 * x)
    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
    started = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        p.simulate([1, 0], {}, tf=1e6, steps=1_000_000)
    assert time.monotonic() - started < 30


def test_other_threads_run_during_a_solve():
    p = bryson_denham()
    solver = threading.Thread(target=lambda: p.solve(mesh=8000))
    solver.start()
    turns = 0
    while solver.is_alive():
        turns += 1
        time.sleep(0.001)
    assert turns > 3  # hundreds; one or two, before and after, if the solve kept the lock


def test_frame_and_plot():
    pandas = pytest.importorskip("pandas")
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    s = bryson_denham().solve()
    frame = s.to_frame()
    assert isinstance(frame, pandas.DataFrame) and list(frame.columns) == ["x", "v", "u"]
    axes = s.plot().axes
    assert [a.get_ylabel() for a in axes] == ["x", "v", "u"]


@pytest.mark.skipif(not README.exists(), reason="outside the source tree")
def test_ten_lines_of_the_readme():
    code = re.search(r"```python\n(.*?)```", README.read_text(), re.S).group(1)
    assert len(code.strip().splitlines()) == 10
    names = {}
    exec(code, names)
    assert names["s"].objective == pytest.approx(4, rel=1e-2)


def test_rows_and_costs_at_moments():
    p = slalom.Problem("pinned")
    x, u = p.state("x", initial=1, final=0.75), p.control("u")
    p.dynamics(x, u)
    p.lagrange("cost", x**2 + u**2)
    p.path("pin", x, equal=0.9, at=0.75)
    s = p.solve(mesh=10, scheme="lgr")  # at whose nodes controls may jump
    assert s.solved and len(s.mesh) == 12 and s(0.75)["x"] == pytest.approx(0.9)
    assert s.objective == pytest.approx(0.9205314415, rel=1e-5)  # as in phases: slalom problems
    warm = p.solve(mesh=10, scheme="lgr", warm_start=s)
    assert warm.solved and warm.iterations < s.iterations
    p.mayer("near", 5 * (x - 1) ** 2, at_share=0.25)
    p.mayer("far", x, maximise=True, at=0.5)
    p.breakpoint(0.33)
    again = p.solve(mesh=10)
    assert 0.33 in again.mesh and again.cost_terms["far"] == pytest.approx(-again(0.5)["x"])
    assert again.cost_terms["near"] == pytest.approx(5 * (again(0.25)["x"] - 1) ** 2)
    with pytest.raises(slalom.InvalidValue, match="both at and at_share"):
        p.mayer("twice", x, at=0.1, at_share=0.1)
    with pytest.raises(slalom.InvalidValue, match="no moment"):
        p.breakpoint()
    p.path("late", x, lower=0, at=7)
    with pytest.raises(slalom.InvalidValue, match="late: found the time 7"):
        p.solve()


@pytest.mark.parametrize(("wrong", "right"), [
    (lambda p: p.state("w", initial=(2, 1)), lambda p: p.state("w", initial=(1, 2))),
    (lambda p: p.state("w", final=(2, 1)), lambda p: p.state("w", final=(1, 2))),
    (lambda p: p.control("w", lower=2, upper=1), lambda p: p.control("w", lower=1, upper=2)),
    (lambda p: p.path("w", p.tf, upper=1, soft="l3"), lambda p: p.path("w", p.tf, upper=1, soft="l1")),
    (lambda p: p.boundary("w", p.tf, upper=1, soft="l1", weight=-1), lambda p: p.boundary("w", p.tf, upper=1)),
    (lambda p: p.path_family("w", [], p.tf, upper=1, soft="l2", tolerance=-1),
     lambda p: p.path_family("w", [], p.tf, upper=1)),
])
def test_what_is_refused_is_not_there_and_can_be_declared_again(wrong, right):
    p = slalom.Problem("refused")
    with pytest.raises(slalom.InvalidValue):
        wrong(p)
    right(p)
    with pytest.raises(slalom.InvalidValue, match="twice"):
        right(p)


def test_an_answer_of_another_problem_is_not_loaded(tmp_path):
    bryson_denham().solve(mesh=10).save(tmp_path / "answer.json")
    other = slalom.Problem("as many, by other names")
    for name in ("x", "w"):
        other.state(name)
    other.control("u")
    with pytest.raises(slalom.InvalidValue, match="with the states x, v, expected.*x, w"):
        other.load_solution(tmp_path / "answer.json")
    more = bryson_denham()
    more.integral("work", more.tf)
    with pytest.raises(slalom.InvalidValue, match="0 integrals, expected 1"):
        more.load_solution(tmp_path / "answer.json")
