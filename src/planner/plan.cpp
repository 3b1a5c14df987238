#include "slalom/planner/plan.hpp"

namespace slalom::planner {

PlanStatus plan_status(nlp::Status status) {
  return static_cast<PlanStatus>(status);
}

const char* to_string(PlanStatus status) {
  if (status == PlanStatus::not_confirmed) return "not_confirmed";
  if (status == PlanStatus::no_prediction) return "no prediction";
  if (status == PlanStatus::unverified) return "unverified";
  if (status == PlanStatus::passes_through) return "passes_through";
  return nlp::to_string(static_cast<nlp::Status>(status));
}

const char* to_string(Rung rung) {
  switch (rung) {
    case Rung::new_plan:
      return "new";
    case Rung::rest:
      return "rest";
    case Rung::least_bad:
      return "least_bad";
    default:
      return "";
  }
}

std::string SolveReport::status_text() const {
  std::string text = to_string(status);
  if (!detail.empty()) text += ": " + detail;
  return text;
}

namespace {

/// Absolute times of the nodes.
std::vector<double> times(const Plan& plan) {
  std::vector<double> result;
  result.reserve(plan.t.size());
  for (const double t : plan.t) result.push_back(plan.t_start + t);
  return result;
}

}  // namespace

const Candidate* fallback(const Plan& plan) {
  if (plan.rung != Rung::new_plan || plan.candidates.empty()) return nullptr;
  const Candidate& first = plan.candidates.front();  // the rest is looked at first
  return first.name == to_string(Rung::rest) && first.certificate.verified ? &first : nullptr;
}

bool usable(const Plan& plan) {
  return vehicle::ControlSignal::usable(times(plan), plan.controls);
}

vehicle::ControlSignal control_signal(const Plan& plan) {
  return {times(plan), plan.controls};
}

}  // namespace slalom::planner
