#include "slalom/problems/library.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "slalom/base/error.hpp"
#include "slalom/base/options.hpp"
#include "statement.hpp"

namespace slalom::problems {

const char* to_string(Tag tag) {
  switch (tag) {
    case Tag::singular_arc:
      return "singular_arc";
    case Tag::state_constraint:
      return "state_constraint";
    case Tag::high_order_constraint:
      return "high_order_constraint";
    case Tag::stiff:
      return "stiff";
    case Tag::bang_bang:
      return "bang_bang";
    case Tag::local_optima:
      return "local_optima";
    case Tag::phases:
      return "phases";
    case Tag::parameter_estimation:
      return "parameter_estimation";
    case Tag::free_final_time:
      return "free_final_time";
  }
  return "unknown";
}

const std::vector<Tag>& all_tags() {
  static const std::vector<Tag> tags = {Tag::singular_arc,
                                        Tag::state_constraint,
                                        Tag::high_order_constraint,
                                        Tag::stiff,
                                        Tag::bang_bang,
                                        Tag::local_optima,
                                        Tag::phases,
                                        Tag::parameter_estimation,
                                        Tag::free_final_time};
  return tags;
}

bool is_hard(Tag tag) {
  return tag < Tag::phases;
}

double Published::value() const {
  return std::strtod(printed.c_str(), nullptr);
}

double Published::resolution() const {
  const std::size_t exponent = printed.find_first_of("eE");
  const std::string mantissa = printed.substr(0, exponent);
  const std::size_t point = mantissa.find('.');
  const auto decimals =
      point == std::string::npos ? 0 : static_cast<int>(mantissa.size() - point - 1);
  const int power = exponent == std::string::npos ? 0 : std::atoi(printed.c_str() + exponent + 1);
  return 0.5 * std::pow(10.0, power - decimals);
}

bool Entry::has(Tag tag) const {
  return std::find(tags.begin(), tags.end(), tag) != tags.end();
}

double Entry::reference() const {
  if (closed_form) return closed_form->value;
  return converged ? *converged : published->value();
}

double Entry::tolerance() const {
  const double value = reference();
  const double relative = value == 0 ? 1e-5 : 1e-5 * std::fabs(value);
  return closed_form || converged ? relative : std::max(relative, published->resolution());
}

const std::vector<Entry>& library() {
  static const std::vector<Entry> all = [] {
    std::vector<Entry> list;
    for (auto* part : {classics, singular_arcs, state_constraints, bang_bang, aerospace, biology,
                       phases, ascent, parameter_estimation})
      for (auto& entry : part()) list.push_back(std::move(entry));
    return list;
  }();
  return all;
}

const Entry& find(const std::vector<Entry>& entries, const std::string& name) {
  std::vector<std::string> names;
  for (const auto& entry : entries) {
    if (entry.name == name) return entry;
    names.push_back(entry.name);
  }
  const std::string nearest = nearest_name(name, names);
  throw InvalidValue(
      "problem", "'" + name + "'",
      nearest.empty() ? "a name that 'slalom problems' lists" : "perhaps '" + nearest + "'");
}

}  // namespace slalom::problems
