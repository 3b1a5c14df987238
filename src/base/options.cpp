#include "slalom/base/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "slalom/base/error.hpp"

namespace slalom {
namespace {

const char* kind_name(const OptionValue& value) {
  static constexpr const char* names[] = {"a boolean", "an integer", "a number", "text", "a list"};
  return names[value.index()];
}

[[noreturn]] void wrong_kind(const OptionInfo& info, const OptionValue& value,
                             const std::string& where) {
  throw InvalidValue(where, fmt::format("{} {}", kind_name(value), to_string(value)),
                     fmt::format("{} for {}", info.rule(), info.name), {info.name});
}

void check_number(const OptionInfo& info, double value, const std::string& where) {
  if (!std::isfinite(value) || !info.range.contains(value))
    throw InvalidValue(where, fmt::format("{} = {}", info.name, value), info.range.to_string(),
                       {info.name});
}

}  // namespace

bool OptionRange::contains(double value) const {
  return (lo_open ? value > lo : value >= lo) && (hi_open ? value < hi : value <= hi);
}

std::string OptionRange::to_string() const {
  std::string text;
  if (std::isfinite(lo)) text += fmt::format(" {} {}", lo_open ? ">" : ">=", lo);
  if (std::isfinite(hi))
    text += fmt::format("{} {} {}", text.empty() ? "" : " and", hi_open ? "<" : "<=", hi);
  return text.empty() ? "a finite number" : "a number" + text;
}

std::string to_string(const OptionValue& value) {
  struct Printer {
    std::string operator()(bool v) const { return v ? "true" : "false"; }
    std::string operator()(std::int64_t v) const { return fmt::format("{}", v); }
    std::string operator()(double v) const { return fmt::format("{}", v); }
    std::string operator()(const std::string& v) const { return v; }
    std::string operator()(const std::vector<double>& v) const {
      return fmt::format("[{}]", fmt::join(v, ", "));
    }
  };
  return std::visit(Printer{}, value);
}

std::string OptionInfo::rule() const {
  switch (kind) {
    case OptionKind::boolean:
      return "true or false";
    case OptionKind::integer:
      return "an integer";
    case OptionKind::real:
      return range.to_string();
    case OptionKind::text:
      return "text";
    case OptionKind::choice:
      return fmt::format("one of {}", fmt::join(choices, ", "));
    case OptionKind::vector:
      return length == 0 ? "a list of numbers" : fmt::format("a list of {} numbers", length);
  }
  return "a value";
}

OptionValue OptionInfo::checked(const OptionValue& value, const std::string& where) const {
  switch (kind) {
    case OptionKind::boolean:
      if (!std::holds_alternative<bool>(value)) wrong_kind(*this, value, where);
      return value;
    case OptionKind::integer:
      if (!std::holds_alternative<std::int64_t>(value)) wrong_kind(*this, value, where);
      check_number(*this, static_cast<double>(std::get<std::int64_t>(value)), where);
      if (!std::in_range<int>(std::get<std::int64_t>(value)))  // options are stored as int
        throw InvalidValue(where, fmt::format("{} = {}", name, to_string(value)),
                           "an integer of at most 31 bits", {name});
      return value;
    case OptionKind::real: {
      double number = 0;
      if (const auto* i = std::get_if<std::int64_t>(&value)) {
        number = static_cast<double>(*i);
      } else if (const auto* d = std::get_if<double>(&value)) {
        number = *d;
      } else {
        wrong_kind(*this, value, where);
      }
      check_number(*this, number, where);
      return number;
    }
    case OptionKind::text:
      if (!std::holds_alternative<std::string>(value)) wrong_kind(*this, value, where);
      return value;
    case OptionKind::choice: {
      // Options are checked in every solve, which must not allocate: no text for good ones.
      const auto* word = std::get_if<std::string>(&value);
      if (word != nullptr && std::find(choices.begin(), choices.end(), *word) != choices.end())
        return value;
      if (word == nullptr) wrong_kind(*this, value, where);
      throw InvalidValue(where, fmt::format("{} = '{}'", name, *word), one_of(*word, choices),
                         {name});
    }
    case OptionKind::vector: {
      if (!std::holds_alternative<std::vector<double>>(value)) wrong_kind(*this, value, where);
      const auto& numbers = std::get<std::vector<double>>(value);
      if (length != 0 && numbers.size() != length)
        throw InvalidValue(where, fmt::format("{} with {} numbers", name, numbers.size()), rule(),
                           {name});
      for (double number : numbers) check_number(*this, number, where);
      return value;
    }
  }
  return value;
}

std::string nearest_name(std::string_view word, const std::vector<std::string>& candidates) {
  std::string best;
  const std::size_t allowed = std::max<std::size_t>(2, word.size() / 3);
  std::size_t best_distance = std::min(allowed + 1, word.size());  // something of `word` is left
  for (const auto& candidate : candidates) {
    std::vector<std::size_t> row(candidate.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= word.size(); ++i) {
      std::size_t diagonal = row[0];
      row[0] = i;
      for (std::size_t j = 1; j <= candidate.size(); ++j) {
        const std::size_t above = row[j];
        const std::size_t substitute = diagonal + (word[i - 1] == candidate[j - 1] ? 0 : 1);
        row[j] = std::min({row[j] + 1, row[j - 1] + 1, substitute});
        diagonal = above;
      }
    }
    if (row.back() < best_distance) {
      best_distance = row.back();
      best = candidate;
    }
  }
  return best;
}

std::string one_of(std::string_view word, const std::vector<std::string>& names) {
  const auto nearest = nearest_name(word, names);
  return fmt::format("one of {}{}", fmt::join(names, ", "),
                     nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest));
}

}  // namespace slalom
