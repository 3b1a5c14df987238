"""Optimal control and real-time trajectory planning."""

import os as _os
import pathlib as _pathlib

# The built-in scenarios, planners and vehicles that the package carries.
_config = _pathlib.Path(__file__).parent / "config"
if _config.is_dir():
    _os.environ.setdefault("SLALOM_CONFIG_DIR", str(_config))

from ._core import (  # noqa: E402
    Candidate,
    Certificate,
    ConstraintId,
    Cycle,
    Drive,
    Error,
    ErrorEstimate,
    Expr,
    Goal,
    InvalidValue,
    MeshRecord,
    Mpc,
    MpcCycle,
    MpcResult,
    Obstacle,
    PhasedProblem,
    PhasedRefined,
    PhasedSolution,
    Plan,
    Planner,
    Plant,
    Problem,
    Refined,
    Region,
    Road,
    Scenario,
    Simulation,
    Solution,
    UnknownName,
    Violation,
    __version__,
    absolute,
    arccos,
    arcsin,
    arctan,
    arctan2,
    backends,
    control_names,
    cos,
    cosh,
    cubic_spline,
    exp,
    load_scenario,
    log,
    maximum,
    minimum,
    planner_names,
    power,
    scenario_names,
    scheme_names,
    select,
    sign,
    simulate,
    sin,
    sinh,
    solver_options,
    sqrt,
    square,
    state_names,
    tan,
    tanh,
)
from ._trials import read_trials, write_parquet  # noqa: E402

__all__ = [
    "Candidate", "Certificate", "ConstraintId", "Cycle", "Drive", "Error", "ErrorEstimate", "Expr", "Goal", "InvalidValue",
    "MeshRecord", "Mpc", "MpcCycle", "MpcResult", "Obstacle", "PhasedProblem", "PhasedRefined", "PhasedSolution", "Plan", "Planner", "Plant",
    "Problem", "Refined", "Region", "Road", "Scenario", "Simulation", "Solution", "UnknownName", "Violation",
    "__version__", "absolute", "arccos", "arcsin", "arctan", "arctan2", "backends", "control_names",
    "cos", "cosh", "cubic_spline", "exp", "load_scenario", "log", "maximum", "minimum",
    "planner_names", "power", "read_trials", "scenario_names", "scheme_names", "select", "sign", "simulate", "sin",
    "sinh", "solver_options", "sqrt", "square", "state_names", "tan", "tanh", "write_parquet",
]
