#include "slalom/ocp/kinks.hpp"

#include <fmt/format.h>

#include <utility>

namespace slalom::ocp {
namespace {

using expr::Op;

/// One cost term's kinks.
class Rewriting {
 public:
  Rewriting(Problem& problem, std::string cost) : problem_(problem), cost_(std::move(cost)) {}

  /// The expression with its kinks replaced; `sign`: > 0 where it is to be small.
  Expr rewritten(const Expr& e, double sign) {
    if (e.is_constant() || e.is_symbol()) return e;
    const auto& args = e.node()->args();
    switch (e.node()->op()) {
      case Op::add:
        return rewritten(args[0], sign) + rewritten(args[1], sign);
      case Op::sub:
        return rewritten(args[0], sign) - rewritten(args[1], -sign);
      case Op::neg:
        return -rewritten(args[0], -sign);
      case Op::mul:
        for (const std::size_t i : {0U, 1U})
          if (args[i].is_constant())
            return args[i] * rewritten(args[1 - i], sign * args[i].value());
        return e;
      case Op::div:
        return args[1].is_constant() ? rewritten(args[0], sign * args[1].value()) / args[1] : e;
      case Op::abs:
        return sign > 0 ? held(args[0], -args[0], sign, "abs") : e;
      case Op::max:
        return sign > 0 ? held(args[0], args[1], sign, "max") : e;
      case Op::min:
        return sign < 0 ? held(args[0], args[1], sign, "min") : e;
      default:
        return e;
    }
  }
  std::vector<std::string> done() && { return std::move(done_); }

 private:
  /// A control that rows hold above both values, or below them.
  Expr held(const Expr& a, const Expr& b, double sign, const char* what) {
    const Expr first = rewritten(a, sign), second = rewritten(b, sign);
    const std::string name = fmt::format("{} {} of {}", what, done_.size() + 1, cost_);
    const Expr control = problem_.control(name);
    const auto row = [&](const Expr& value) {
      return sign > 0 ? control - value : value - control;
    };
    problem_.path(name + ": first", row(first), Bounds::at_least(0));
    problem_.path(name + ": second", row(second), Bounds::at_least(0));
    done_.push_back(
        fmt::format("cost {}: {} is the control '{}', held {} both of its values by rows", cost_,
                    what, name, sign > 0 ? "above" : "below"));
    return control;
  }

  Problem& problem_;
  std::string cost_;
  std::vector<std::string> done_;
};

}  // namespace

namespace {

/// Cost terms that were replaced, each with what was done.
using Replaced = std::vector<std::pair<std::string, std::vector<std::string>>>;

Replaced replace_kinks(Problem& problem) {
  Replaced replaced;
  const auto costs = problem.costs();
  for (const auto& cost : costs) {
    if (!cost.lagrange || !cost.enabled) continue;
    Rewriting rewriting(problem, cost.name);
    const Expr value = rewriting.rewritten(cost.value, 1);
    auto sentences = std::move(rewriting).done();
    if (sentences.empty()) continue;
    problem.enable_cost(cost.name, false);
    problem.lagrange(cost.name + ", kinks as rows", value);
    replaced.emplace_back(cost.name, std::move(sentences));
  }
  return replaced;
}

}  // namespace

std::vector<std::string> smooth_kinks(Problem& problem) {
  std::vector<std::string> done;
  for (const auto& [cost, sentences] : replace_kinks(problem))
    done.insert(done.end(), sentences.begin(), sentences.end());
  return done;
}

std::vector<std::string> costs_with_kinks(Problem problem) {
  std::vector<std::string> names;
  for (const auto& [cost, sentences] : replace_kinks(problem)) names.push_back(cost);
  return names;
}

}  // namespace slalom::ocp
