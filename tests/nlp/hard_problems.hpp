#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "nlp/expression_problem.hpp"
#include "slalom/nlp/check.hpp"

namespace slalom::nlp {

/// Problems made to break a method: solves them by the back end of the parameter and judges how it
/// ended.
class HardProblem : public testing::TestWithParam<std::string> {
 protected:
  Answer solve(ExpressionProblem& problem) const {
    return make_solver(GetParam())->solve(problem, problem.cold_start(), {});
  }

  /// Solved, as the checker sees it, with objective `optimum`.
  Answer expect_solved(const Statement& statement, double optimum) const {
    ExpressionProblem problem(statement);
    Answer answer = solve(problem);
    EXPECT_EQ(answer.status, Status::solved) << answer.message;
    const Residuals residuals = check(problem, answer.point, {});
    EXPECT_TRUE(residuals.solved({}))
        << "violation " << residuals.violation << " of " << residuals.worst_constraint
        << ", stationarity " << residuals.stationarity << " at " << residuals.worst_variable
        << ", complementarity " << residuals.complementarity << " of " << residuals.worst_pair;
    EXPECT_NEAR(residuals.objective, optimum, 1e-6 * std::max(1.0, std::fabs(optimum)));
    return answer;
  }

  void expect_unbounded(const Statement& statement) const {
    ExpressionProblem problem(statement);
    const Answer answer = solve(problem);
    EXPECT_EQ(answer.status, Status::unbounded)
        << to_string(answer.status) << ' ' << answer.message << " after " << answer.iterations;
    EXPECT_TRUE(std::isfinite(answer.objective));
  }

  /// Infeasible, at a point whose largest violation is `violation`, of one of `names`.
  Answer expect_infeasible(const Statement& statement, double violation,
                           const std::vector<std::string>& names) const {
    ExpressionProblem problem(statement);
    Answer answer = solve(problem);
    EXPECT_EQ(answer.status, Status::infeasible)
        << to_string(answer.status) << ' ' << answer.message << " after " << answer.iterations;
    const Residuals residuals = check(problem, answer.point, {});
    EXPECT_NEAR(residuals.violation, violation, 1e-3);
    EXPECT_TRUE(std::count(names.begin(), names.end(), residuals.worst_constraint))
        << residuals.worst_constraint;
    return answer;
  }

  Answer expect_invalid(const Statement& statement, const std::string& function,
                        const std::string& variable) const {
    ExpressionProblem problem(statement);
    Answer answer = solve(problem);
    EXPECT_EQ(answer.status, Status::invalid_number) << to_string(answer.status);
    EXPECT_EQ(answer.fault.function, function);
    EXPECT_EQ(answer.fault.where, "stage 0");
    EXPECT_EQ(answer.fault.variable, variable);
    return answer;
  }
};

}  // namespace slalom::nlp
