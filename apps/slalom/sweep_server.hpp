#pragma once

#include <filesystem>

namespace slalom::app {

/// Shows the pages of a sweep's folder until interrupted(), and drives a trial again when the page
/// asks for its drive and it was not kept; `port` 0 takes a free one. Prints the address, which
/// holds a secret: whoever on this machine does not know it is shown nothing. Throws Error when the
/// port is taken.
void serve_sweep(const std::filesystem::path& folder, int port);

}  // namespace slalom::app
