#pragma once

// Every operation with the arguments it is tested at: inside its domain, off its kinks.

#include <array>
#include <random>
#include <string>
#include <vector>

#include "slalom/expr/expr.hpp"

namespace slalom::expr {

struct OpCase {
  Op op;
  const char* name;
  std::vector<std::array<double, 2>> range;  ///< of each argument

  Expr build(const std::vector<Expr>& a) const {
    if (range.size() == 1) return Expr::apply(op, a[0]);
    if (range.size() == 2) return Expr::apply(op, a[0], a[1]);
    return Expr::apply(op, a[0], a[1], a[2]);
  }
  std::vector<double> point(std::mt19937_64& random) const {
    std::vector<double> x;
    for (const auto& [lo, hi] : range)
      x.push_back(std::uniform_real_distribution<double>(lo, hi)(random));
    return x;
  }
  std::vector<Expr> symbols() const {
    std::vector<Expr> result;
    for (std::size_t i = 0; i < range.size(); ++i)
      result.push_back(Expr::symbol(std::string(1, static_cast<char>('a' + i))));
    return result;
  }
};

inline const std::vector<OpCase>& op_cases() {
  static const std::vector<OpCase> cases = {
      {Op::neg, "neg", {{-5, 5}}},
      {Op::square, "square", {{-5, 5}}},
      {Op::sqrt, "sqrt", {{0.3, 50}}},
      {Op::exp, "exp", {{-5, 5}}},
      {Op::log, "log", {{0.3, 50}}},
      {Op::sin, "sin", {{-14, 14}}},
      {Op::cos, "cos", {{-14, 14}}},
      {Op::tan, "tan", {{-1.4, 1.4}}},
      {Op::asin, "asin", {{-0.95, 0.95}}},
      {Op::acos, "acos", {{-0.95, 0.95}}},
      {Op::atan, "atan", {{-9, 9}}},
      {Op::sinh, "sinh", {{-4, 4}}},
      {Op::cosh, "cosh", {{-4, 4}}},
      {Op::tanh, "tanh", {{-3, 3}}},
      {Op::abs, "abs", {{0.2, 5}}},
      {Op::abs, "abs, negative", {{-5, -0.2}}},
      {Op::sign, "sign", {{0.2, 5}}},
      {Op::sign, "sign, negative", {{-5, -0.2}}},
      {Op::add, "add", {{-5, 5}, {-5, 5}}},
      {Op::sub, "sub", {{-5, 5}, {-5, 5}}},
      {Op::mul, "mul", {{-5, 5}, {-5, 5}}},
      {Op::div, "div", {{-5, 5}, {0.4, 5}}},
      {Op::div, "div, negative", {{-5, 5}, {-5, -0.4}}},
      {Op::pow, "pow", {{0.3, 4}, {-3, 3}}},
      {Op::atan2, "atan2, right", {{-5, 5}, {0.4, 5}}},
      {Op::atan2, "atan2, above", {{0.4, 5}, {-5, 5}}},
      {Op::atan2, "atan2, left below", {{-5, -0.4}, {-5, -0.4}}},
      {Op::min, "min, first", {{-5, -0.2}, {0.2, 5}}},
      {Op::min, "min, second", {{0.2, 5}, {-5, -0.2}}},
      {Op::max, "max, first", {{0.2, 5}, {-5, -0.2}}},
      {Op::max, "max, second", {{-5, -0.2}, {0.2, 5}}},
      {Op::select, "select, positive", {{0.2, 5}, {-5, 5}, {-5, 5}}},
      {Op::select, "select, otherwise", {{-5, -0.2}, {-5, 5}, {-5, 5}}},
  };
  return cases;
}

}  // namespace slalom::expr
