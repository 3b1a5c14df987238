"""What a type checker must accept of the package, and (where it is told to ignore) refuse.

Checked by mypy --strict, which complains of an ignore that is not needed; never run."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

import slalom
from slalom import Expr, Problem


def stated() -> Problem:
    p = Problem("typed")
    x = p.state("x", lower=0, initial=1, final=(None, 2))
    u: Expr = p.control("u")
    p.dynamics(x, -x / 2 + slalom.sin(u) ** 2 + 1)
    p.lagrange("effort", slalom.maximum(u, 0))
    p.path("row", 3 - u * x, lower=0)
    p.state(3)  # type: ignore[arg-type]
    p.dynamics("x", u)  # type: ignore[arg-type]
    p.initial(1)  # type: ignore[arg-type]
    return p


def solved() -> float:
    p = stated()
    s = p.solve(mesh=np.linspace(0, 1, 5), scheme=["lgr"] * 4, points=[3, 4, 5, 6], tol=1e-6)
    t: NDArray[np.float64] = s.t
    values: dict[str, Any] = s(t)
    r = p.refine(refinement="hp", scheme="lgr", guess=s)
    s.solve()  # type: ignore[attr-defined]
    p.solve(warm_start="s")  # type: ignore[arg-type]
    return float(values["x"][0] + r.solution.state("x")[0]) + (r.errors.largest if r.errors else 0) + len(s.mesh)


def phased() -> str:
    p = slalom.PhasedProblem("typed")
    number: int = p.add(stated())
    p.connect(0, 1, without=["x"], jumps={"y": -1})
    p.link("link", 0)
    s = p.solve(phases={"typed": {"mesh": 3}})
    return s[number].status + s["typed"].worst_constraint


def refused() -> str:
    try:
        return str(slalom.load_scenario("nowhere").name)
    except slalom.UnknownName as error:
        return error.found
    except slalom.InvalidValue as error:
        return error.where + error.expected


def driven() -> float:
    scenario = slalom.load_scenario({"start": {"x": 0, "y": 0}}, set={"loop.tex": 0.5})
    planner, plant = slalom.Planner(scenario), slalom.Plant(scenario)
    plan = planner.plan(scenario.start, t0=1)
    ahead: NDArray[np.float64] = plant.advance(scenario.start, plan, 0, scenario["loop.tex"])
    drive = slalom.simulate(scenario, on_cycle=lambda cycle: print(cycle.plan.status))
    slalom.simulate(3)  # type: ignore[arg-type]
    plant.advance(scenario.start, "plan", 0, 1)  # type: ignore[arg-type]
    return drive.time + (drive.goal_time or 0) + len(ahead)


def simulated() -> str:
    p = stated()
    s = p.simulate({"x": 1.0}, lambda t, x: [0.0], tf=1)
    r = slalom.PhasedProblem("p").refine(refinement="hp")
    return s.message + r.solution["typed"].status + str(p.solve(guess=s).objective)


def moved(answer: slalom.Solution, other: Problem) -> float:
    by: slalom.Sensitivity = answer.sensitivity("initial x")
    predicted = answer.predict({"initial x": 1.1}).objective + answer.predict(other).objective
    rate: NDArray[np.float64] = by.states["x"]
    answer.sensitivity(3)  # type: ignore[arg-type]
    return by.objective + by.tf + predicted + len(rate) + answer.sensitivity_numbers["t0"]


def receding(problem: Problem) -> str:
    def update(now: Problem, cycle: slalom.MpcCycle) -> None:
        now.set_scale("row", cycle.t + 1)

    loop = slalom.Mpc(problem, tex=0.5, goal={"x": (1, 0.1)}, update=update)
    result = loop.run([0, 0])
    return result.status + result.cycles[0].solution.status + loop.step([0, 0], 1)


def swept() -> int:
    slalom.write_parquet("out", "trials.parquet")
    slalom.write_parquet(3, "trials.parquet")  # type: ignore[arg-type]
    return int(slalom.read_trials("out").num_rows)
