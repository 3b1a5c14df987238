#include "evaluate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "slalom/base/error.hpp"

namespace slalom::paper {
namespace {

const Function* find_function(const std::string& name) {
  for (const auto* table : {&list_functions(), &drive_functions(), &sweep_functions()})
    if (const auto found = table->find(name); found != table->end()) return &found->second;
  return nullptr;
}

double apply(const std::string& name, double a, double b) {
  if (name == "+") return a + b;
  if (name == "-") return a - b;
  if (name == "*") return a * b;
  if (name == "/") return a / b;
  if (name == "<") return a < b;
  if (name == "<=") return a <= b;
  if (name == ">") return a > b;
  if (name == ">=") return a >= b;
  if (name == "==") return a == b;
  if (name == "!=") return a != b;
  if (name == "and") return a != 0 && b != 0;
  return a != 0 || b != 0;  // or
}

Numbers as_numbers(const Value& value, const std::string& what) {
  if (const auto* list = std::get_if<Numbers>(&value)) return *list;
  if (const auto* one = std::get_if<double>(&value)) return {*one};
  throw InvalidValue(what, "text '" + std::get<std::string>(value) + "'", "a number");
}

/// Item by item; a single number goes with every item of a list.
Value combine(const std::string& name, const Value& a, const Value& b) {
  if (std::holds_alternative<std::string>(a) && std::holds_alternative<std::string>(b)) {
    const bool same = std::get<std::string>(a) == std::get<std::string>(b);
    if (name == "==" || name == "!=") return double(same == (name == "=="));
  }
  const auto left = as_numbers(a, name), right = as_numbers(b, name);
  if (std::holds_alternative<double>(a) && std::holds_alternative<double>(b))
    return apply(name, left[0], right[0]);
  const bool one_left = std::holds_alternative<double>(a);
  const bool one_right = std::holds_alternative<double>(b);
  if (!one_left && !one_right && left.size() != right.size())
    throw InvalidValue(name, fmt::format("lists of {} and {}", left.size(), right.size()),
                       "lists of one length");
  Numbers result(one_left ? right.size() : left.size());
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = apply(name, left[one_left ? 0 : i], right[one_right ? 0 : i]);
  return result;
}

Value operate(const Expression& expression, const Context& context) {
  const auto& name = expression.name;
  const auto left = evaluate(expression.parts[0], context);
  if (name == "negate") return combine("-", 0.0, left);
  if (name == "not") return combine("==", left, 0.0);
  return combine(name, left, evaluate(expression.parts[1], context));
}

/// What a word means within trials; text where it means nothing.
Value trial_word(const std::string& name, const SweepTrial& trial) {
  if (name == "planner") return trial.planner;
  if (name == "outcome") return trial.outcome;
  if (name == "hit") return trial.hit;
  if (name == "tex") return trial.tex;
  if (name == "speed") return trial.speed;
  if (name == "passed") return double(trial.outcome == "goal");
  if (name == "longest") return trial.longest;
  if (name == "longest_wall") return trial.longest_wall;
  if (name == "median") return trial.median;
  return name;
}

Value word(const std::string& name, const Context& context) {
  if (context.names != nullptr)
    if (const auto found = context.names->find(name); found != context.names->end())
      return evaluate(found->second, context);
  if (context.trial != nullptr) return trial_word(name, *context.trial);
  if (name == "tex" && context.trials != nullptr && !context.trials->empty())
    return context.trials->front().tex;
  return name;
}

}  // namespace

void check_names(const Expression& expression, const std::string& where) {
  for (const auto& part : expression.parts) check_names(part, where);
  if (expression.kind != Expression::Kind::call) return;
  const auto* function = find_function(expression.name);
  if (function == nullptr) throw InvalidValue(where, "'" + expression.name + "'", "a measure");
  const auto count = expression.parts.size();
  if (count < function->least || count > function->most)
    throw InvalidValue(
        where, fmt::format("{} of {} arguments", expression.name, count),
        fmt::format("at least {} and no more than {}", function->least, function->most));
}

Value evaluate(const Expression& expression, const Context& context) {
  switch (expression.kind) {
    case Expression::Kind::number:
      return expression.number;
    case Expression::Kind::word:
      return word(expression.name, context);
    case Expression::Kind::operation:
      return operate(expression, context);
    case Expression::Kind::call:
      break;
  }
  return find_function(expression.name)->call(expression.parts, context);
}

double number_of(const Expression& expression, const Context& context) {
  const auto list = numbers_of(expression, context);
  if (list.size() != 1)
    throw InvalidValue(expression.name, fmt::format("a list of {}", list.size()), "a number");
  return list.front();
}

Numbers numbers_of(const Expression& expression, const Context& context) {
  return as_numbers(evaluate(expression, context), expression.name);
}

std::string text_of(const Expression& expression, const Context& context) {
  const auto value = evaluate(expression, context);
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  throw InvalidValue(expression.name, "a number", "a name");
}

Function eager(std::size_t arguments, std::function<double(const std::vector<Numbers>&)> function) {
  return {arguments, arguments,
          [function = std::move(function)](const auto& parts, const Context& context) -> Value {
            std::vector<Numbers> values;
            for (const auto& part : parts) values.push_back(numbers_of(part, context));
            return function(values);
          }};
}

}  // namespace slalom::paper
