"""Optimal control and real-time trajectory planning."""

import os as _os
import pathlib as _pathlib

# The built-in scenarios, planners and vehicles that the package carries.
_config = _pathlib.Path(__file__).parent / "config"
if _config.is_dir():
    _os.environ.setdefault("SLALOM_CONFIG_DIR", str(_config))

from ._core import (  # noqa: E402
    ConstraintId,
    Drive,
    Error,
    ErrorEstimate,
    Expr,
    InvalidValue,
    MeshRecord,
    PhasedProblem,
    PhasedSolution,
    Plan,
    Problem,
    Refined,
    Scenario,
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

__all__ = [
    "ConstraintId", "Drive", "Error", "ErrorEstimate", "Expr", "InvalidValue", "MeshRecord",
    "PhasedProblem", "PhasedSolution", "Plan", "Problem", "Refined", "Scenario", "Solution",
    "UnknownName", "Violation", "__version__", "absolute", "arccos", "arcsin", "arctan", "arctan2",
    "backends", "control_names", "cos", "cosh", "cubic_spline", "exp", "load_scenario", "log",
    "maximum", "minimum", "power", "scenario_names", "scheme_names", "select", "sign", "simulate",
    "sin", "sinh", "solver_options", "sqrt", "square", "state_names", "tan", "tanh",
]
