"""What contestants are asked for, and what their answers must meet, in unscaled units."""

from dataclasses import dataclass

ROUNDING = 1e-9  # relative


@dataclass(frozen=True)
class Level:
    floor: float  # barrier floor; 0: none
    tol: float  # asked for without a floor
    violation: float  # largest row, bound or defect [its unit]
    stationarity: float  # largest component of the Lagrangian's gradient [cost units]
    complementarity: float  # |s z / mu - 1| at the floor; |s z| without [cost units]

    @property
    def dual_tol(self):
        """What a solver is asked for in the unscaled gradient."""
        return self.stationarity if self.floor > 0 else 0.1 * self.stationarity

    def confirms(self, entry):
        """Whether the checker's residuals make `entry` an answer (one that is missing never does). Rounding refuses
        none: a multiplier that stands for as much as is allowed may come out of the check the least bit larger."""
        return all(entry[k] is not None and entry[k] <= getattr(self, k) * (1 + ROUNDING)
                   for k in ("violation", "stationarity", "complementarity"))  # fmt: skip


# The floor as docs/formulation.md defines "solved"; without one the tolerance itself for rows, ten
# times it for complementarity, and a thousand times for the gradient: some entries of the Jacobian
# are 1e5 [N/rad], which solvers scale before they look.
LEVELS = {
    "floor": Level(0.9, 1e-6, 1e-6, 1e-3, 1e-2),
    "1e-2": Level(0.0, 1e-2, 1e-2, 10.0, 1e-1),
    "1e-6": Level(0.0, 1e-6, 1e-6, 1e-3, 1e-5),
}
