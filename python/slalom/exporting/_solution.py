"""A drive as a CommonRoad solution, which others' checkers judge."""

from __future__ import annotations

import math
import os
from typing import Any

import numpy as np

from ..importing._commonroad import chosen_problem
from ..importing._files import BadFile
from ..importing._xml import MISSING, ExtraMissing, open_file
from ._drive import Array, Drive
from ._shapes import vehicle_box

VEHICLES = {"ford_escort": "FORD_ESCORT", "bmw_320i": "BMW_320i", "vw_vanagon": "VW_VANAGON"}


def solution(drive: Drive, scenario: str | os.PathLike[str], problem: int | None = None, cost: str = "JB1") -> str:
    """The text of a solution of the scenario, a CommonRoad XML that the drive's was imported from.

    It has states of the single-track model at the scenario's time steps. Their place is the body's centre.
    Where the drive ends between two steps, it goes on to the next at the velocity and yaw rate of its end.
    Raises BadFile, and ExtraMissing without the package's extra `commonroad`.
    """
    try:
        from commonroad.common.solution import (
            CommonRoadSolutionWriter,
            CostFunction,
            PlanningProblemSolution,
            Solution,
            VehicleModel,
            VehicleType,
        )
        from commonroad.scenario.state import STState
        from commonroad.scenario.trajectory import Trajectory
    except ImportError:
        raise ExtraMissing(MISSING) from None
    name = str(drive.scenario["vehicle.name"])
    if name not in VEHICLES:
        raise BadFile(
            drive.folder / "resolved.yaml", f"the vehicle {name}", "one of CommonRoad's: " + ", ".join(VEHICLES)
        )
    if cost not in CostFunction.__members__:
        raise BadFile("--cost", cost, "one of " + ", ".join(CostFunction.__members__))
    source, problems, _ = open_file(scenario)
    chosen = chosen_problem(scenario, problems.planning_problem_dict, problem)
    first = int(chosen.initial_state.time_step)
    states = [STState(time_step=first + k, **values) for k, values in enumerate(_states(drive, float(source.dt)))]
    done = Solution(
        source.scenario_id,
        [
            PlanningProblemSolution(
                chosen.planning_problem_id,
                VehicleModel.ST,
                VehicleType[VEHICLES[name]],
                CostFunction[cost],
                Trajectory(initial_time_step=first, state_list=states),
            )
        ],
    )
    return str(CommonRoadSolutionWriter(done).dump())


def _states(drive: Drive, step: float) -> list[dict[str, Any]]:
    """Of each time step: place of the body's centre, speed and slip angle of the centre of gravity."""
    end = float(drive.t[-1])
    count = math.ceil(end / step - 1e-6)
    at = _led_on(drive, np.arange(count + 1) * step)
    _, _, ahead = vehicle_box(drive.scenario)
    x, y = at["x"] + ahead * np.cos(at["psi"]), at["y"] + ahead * np.sin(at["psi"])
    return [
        {
            "position": np.array([x[k], y[k]]),
            "steering_angle": float(at["sa"][k]),
            "velocity": float(np.hypot(at["ux"][k], at["v"][k])),
            "orientation": float(np.angle(np.exp(1j * at["psi"][k]))),
            "yaw_rate": float(at["r"][k]),
            "slip_angle": float(np.arctan2(at["v"][k], at["ux"][k])),
        }
        for k in range(count + 1)
    ]


def _led_on(drive: Drive, times: Array) -> dict[str, Array]:
    """The plant at these times, beyond the drive's end at the velocity and yaw rate it had there."""
    at = drive.at(times)
    more = np.maximum(times - drive.t[-1], 0.0)
    front = float(drive.scenario["vehicle.la"])
    ux, r, psi = at["ux"], at["r"], at["psi"]
    sideways = at["v"] + front * r
    middle = psi + r * more / 2
    at["x"] = at["x"] + more * (ux * np.cos(middle) - sideways * np.sin(middle))
    at["y"] = at["y"] + more * (ux * np.sin(middle) + sideways * np.cos(middle))
    at["psi"] = psi + r * more
    return at
