#include "all_problems.hpp"

#include "slalom/planner/vehicle_cycle.hpp"

namespace slalom::app {

const std::vector<problems::Entry>& all_problems() {
  static const auto all = [] {
    auto entries = problems::library();
    entries.push_back(planner::vehicle_cycle());
    return entries;
  }();
  return all;
}

}  // namespace slalom::app
