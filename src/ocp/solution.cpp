#include "lookup.hpp"
#include "slalom/ocp/solve.hpp"
#include "solved.hpp"

namespace slalom::ocp {

std::vector<double> Solution::time() const {
  std::vector<double> result;
  for (std::size_t k = 0; k < trajectory.tau.size(); ++k) result.push_back(trajectory.time(k));
  return result;
}
std::vector<double> Solution::state(const std::string& name) const {
  return column(trajectory.states, index_of(name, state_names, "state"));
}
std::vector<double> Solution::control(const std::string& name) const {
  return column(trajectory.controls, index_of(name, control_names, "control"));
}
double Solution::static_parameter(const std::string& name) const {
  return trajectory.static_parameters[index_of(name, static_parameter_names, "static parameter")];
}
double Solution::slack(const std::string& name) const {
  return trajectory.slacks[index_of(name, slack_names, "slack")];
}
const Multipliers& Solution::multiplier(const std::string& name) const {
  return multipliers[index_of(name, names_of(multipliers), "multiplier")];
}
const Excesses& Solution::excess(const std::string& name) const {
  return excesses[index_of(name, names_of(excesses), "soft constraint")];
}
double Solution::cost_term(const std::string& name) const {
  std::vector<std::string> names;
  for (const auto& term : cost_terms) names.push_back(term.first);
  return cost_terms[index_of(name, names, "cost term")].second;
}
std::vector<double> Solution::costate(const std::string& state_name) const {
  return column(costates, index_of(state_name, state_names, "state"));
}

}  // namespace slalom::ocp
