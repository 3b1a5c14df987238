#pragma once

#include <string>
#include <vector>

namespace slalom::app {

/// The command of a worker process: this very program, also when its file has been replaced
/// meanwhile.
inline std::vector<std::string> worker_command() {
  return {"/proc/self/exe", "sweep-worker"};
}

}  // namespace slalom::app
