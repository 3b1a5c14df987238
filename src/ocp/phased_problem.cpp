#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "checks.hpp"
#include "slalom/base/error.hpp"
#include "slalom/base/options.hpp"
#include "slalom/ocp/phases.hpp"

namespace slalom::ocp {

PhasedProblem::PhasedProblem(std::string name) : name_(std::move(name)) {}

std::size_t PhasedProblem::add(Problem phase) {
  for (const auto& known : phases_)
    if (known.name() == phase.name())
      throw InvalidValue(name_, "the phase '" + phase.name() + "' twice", "names that differ");
  phases_.push_back(std::move(phase));
  return phases_.size() - 1;
}

void PhasedProblem::link(const std::string& name, const Expr& value, Bounds bounds) {
  add_links({{name, value, bounds}});
}

/// All or, where one is refused, none.
void PhasedProblem::add_links(const std::vector<Link>& links) {
  for (const auto& [name, value, bounds] : links) {
    for (const auto& known : links_)
      if (known.name == name)
        throw InvalidValue(name_, "the link '" + name + "' twice", "names that differ");
    check_row_bounds(name_ + ": link " + name, bounds);
    if (expr::symbols_of({value}).empty())
      throw InvalidValue(name_ + ": link " + name, "a function of no variable",
                         "one of end values, times, static parameters or integrals");
  }
  links_.insert(links_.end(), links.begin(), links.end());
}

void PhasedProblem::share(const std::string& static_parameter) {
  const Problem* before = nullptr;
  std::vector<Link> links;
  std::vector<std::string> known;
  for (const auto& phase : phases_)
    for (const auto& parameter : phase.static_parameters()) {
      known.push_back(parameter.name);
      if (parameter.name != static_parameter) continue;
      if (before != nullptr) {
        const auto& other = before->static_parameters();
        const auto same = std::find_if(other.begin(), other.end(),
                                       [&](const auto& p) { return p.name == static_parameter; });
        links.push_back(
            {fmt::format("{} of {} and {}", static_parameter, before->name(), phase.name()),
             same->symbol - parameter.symbol, Bounds::equal(0)});
      }
      before = &phase;
    }
  if (!links.empty()) return add_links(links);
  const auto nearest = nearest_name(static_parameter, known);
  throw InvalidValue(
      name_ + ": share",
      before == nullptr ? "no static parameter '" + static_parameter + "'"
                        : fmt::format("'{}' of {} alone", static_parameter, before->name()),
      before != nullptr || nearest.empty() ? "the name of a static parameter of two phases or more"
                                           : "perhaps '" + nearest + "'");
}

void PhasedProblem::mayer(const std::string& name, const Expr& term) {
  for (const auto& known : costs_)
    if (known.name == name)
      throw InvalidValue(name_, "the cost term '" + name + "' twice", "names that differ");
  costs_.push_back({name, term});
}

void PhasedProblem::replace(std::size_t number, Problem with) {
  const Problem& now = phase(number, "replace");
  if (with.name() != now.name() || !with.time().same(now.time()))
    throw InvalidValue(name_ + ": replace", "another problem " + with.name(),
                       "the phase " + now.name() + " with other numbers");
  phases_[number] = std::move(with);
}

const Problem& PhasedProblem::phase(std::size_t number, const char* what) const {
  if (number >= phases_.size())
    throw InvalidValue(name_ + ": " + what, fmt::format("phase {}", number),
                       fmt::format("one of the {} phases, from 0", phases_.size()));
  return phases_[number];
}

void PhasedProblem::connect(std::size_t from, std::size_t to, const Gaps& gaps) {
  const Problem &a = phase(from, "connect"), &b = phase(to, "connect");
  const auto left_out = [&](const std::string& name) {
    return std::find(gaps.without.begin(), gaps.without.end(), name) != gaps.without.end();
  };
  std::vector<std::string> common{"time"};
  std::vector<std::pair<std::string, Expr>> rows;
  for (const auto& state : a.states())
    for (const auto& other : b.states()) {
      if (state.name != other.name) continue;
      common.push_back(state.name);
      if (left_out(state.name)) continue;
      rows.emplace_back(state.name, state.final_symbol - other.initial_symbol);
    }
  const auto check = [&](const std::string& name) {
    if (std::find(common.begin(), common.end(), name) != common.end()) return;
    const auto nearest = nearest_name(name, common);
    throw InvalidValue(name_ + ": connect",
                       fmt::format("no state '{}' of both {} and {}", name, a.name(), b.name()),
                       nearest.empty() ? "states that both have" : "perhaps '" + nearest + "'");
  };
  for (const auto& name : gaps.without) check(name);
  for (const auto& [name, jump] : gaps.jumps) check(name);
  if (common.size() == 1)
    throw InvalidValue(name_ + ": connect",
                       fmt::format("no state of {} that {} has too", a.name(), b.name()),
                       "states of the same name, or links of their own");
  if (!left_out("time")) rows.emplace_back("time", a.final_time() - b.initial_time());
  std::vector<Link> links;
  for (auto& [name, difference] : rows) {
    for (const auto& [jumping, jump] : gaps.jumps)
      if (jumping == name) difference += jump;
    links.push_back(
        {fmt::format("{} from {} to {}", name, a.name(), b.name()), difference, Bounds::equal(0)});
  }
  add_links(links);
}

}  // namespace slalom::ocp
