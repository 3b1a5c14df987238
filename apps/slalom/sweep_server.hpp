#pragma once

#include <filesystem>

namespace slalom::app {

/// Shows the folder of a sweep at http://localhost:port/ until interrupted(), to this machine
/// alone, and drives a trial again when its drive is asked for and was not kept; `port` 0 takes a
/// free one. Prints the address. Throws Error when the port is taken.
void serve_sweep(const std::filesystem::path& folder, int port);

}  // namespace slalom::app
