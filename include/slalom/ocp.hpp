#pragma once

/// All of optimal control: expressions, problems in one phase or several, guesses, solving, judging
/// and refining answers, receding horizons. It is in slalom::ocp, except for the functions of
/// slalom::expr (sin, square, min, cubic_spline, ...), which are found by their arguments.

#include "slalom/expr/expr.hpp"
#include "slalom/expr/spline.hpp"
#include "slalom/ocp/errors.hpp"
#include "slalom/ocp/guess.hpp"
#include "slalom/ocp/interpolant.hpp"
#include "slalom/ocp/kinks.hpp"
#include "slalom/ocp/mpc.hpp"
#include "slalom/ocp/phases.hpp"
#include "slalom/ocp/prepared.hpp"
#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/refine.hpp"
#include "slalom/ocp/scaling.hpp"
#include "slalom/ocp/scheme.hpp"
#include "slalom/ocp/sensitivity.hpp"
#include "slalom/ocp/simulate.hpp"
#include "slalom/ocp/solve.hpp"
#include "slalom/ocp/starts.hpp"
#include "slalom/ocp/trajectory.hpp"
#include "slalom/ocp/values.hpp"
