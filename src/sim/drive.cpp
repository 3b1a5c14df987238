#include "slalom/sim/drive.hpp"

namespace slalom::sim {

const std::vector<std::string>& outcome_names() {
  static const std::vector<std::string> names = {"goal",     "crash",       "wheel_lift",
                                                 "off_road", "not_optimal", "solve_time",
                                                 "timeout",  "interrupted"};
  return names;
}

const char* to_string(Outcome outcome) {
  return outcome_names().at(static_cast<std::size_t>(outcome)).c_str();
}

}  // namespace slalom::sim
