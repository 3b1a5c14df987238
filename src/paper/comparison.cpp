#include "comparison.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "../report/words.hpp"

namespace slalom::paper {

const PaperDrive* find(const PaperData& paper, const ReproducedDrive& drive) {
  for (const auto& one : paper.drives)
    if (one.environment == drive.scenario.name && one.planner == drive.scenario.planner.name)
      return &one;
  return nullptr;
}

const ReproducedDrive* find(const std::vector<ReproducedDrive>& drives,
                            const std::string& environment, const std::string& planner) {
  for (const auto& one : drives)
    if (one.scenario.name == environment && one.scenario.planner.name == planner) return &one;
  return nullptr;
}

bool as_paper(const sim::Drive& drive, const PaperDrive& paper) {
  return paper.outcome == sim::to_string(drive.outcome) && paper.hit == drive.hit &&
         paper.earliest <= drive.time && drive.time <= paper.latest;
}

std::string ended_words(const sim::Drive& drive) {
  auto words = report::outcome_words(drive);
  words.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(words.front())));
  return words;
}

std::vector<double> cpu_times(const ReproducedDrive& one) {
  return one.cpu.empty() ? sim::solve_times(one.drive, true) : one.cpu;
}

std::vector<std::vector<const ReproducedDrive*>> by_environment(
    const std::vector<ReproducedDrive>& drives) {
  std::vector<std::vector<const ReproducedDrive*>> groups;
  for (const auto& one : drives) {
    const auto same = [&](const auto& g) { return g.front()->scenario.name == one.scenario.name; };
    const auto group = std::find_if(groups.begin(), groups.end(), same);
    if (group == groups.end())
      groups.push_back({&one});
    else
      group->push_back(&one);
  }
  return groups;
}

std::string note(const PaperData& paper, const std::string& topic) {
  for (const auto& one : paper.notes)
    if (one.topic == topic) return one.text;
  return "";
}

std::optional<PositionComparison> compare(const sim::Drive& drive, const PaperDrive& paper,
                                          const PaperDrive::Snapshot& snapshot) {
  if (drive.plant.empty() || snapshot.t > drive.time + 0.05) return std::nullopt;
  const auto away = [&](const vehicle::State& s) {
    return std::hypot(s[vehicle::X] - snapshot.x, s[vehicle::Y] - snapshot.y);
  };
  PositionComparison result;
  result.t = std::min(snapshot.t, drive.time);
  const auto state = report::state_at(drive, result.t);
  result.x = state[vehicle::X];
  result.y = state[vehicle::Y];
  result.psi = state[vehicle::PSI];
  result.distance = away(state);
  result.unlagged = paper.lag > 0 && snapshot.t > 0
                        ? away(report::state_at(drive, result.t - paper.lag))
                        : std::numeric_limits<double>::quiet_NaN();
  result.comparable = snapshot.comparable;
  result.within = result.distance <= snapshot.tolerance;
  return result;
}

}  // namespace slalom::paper
