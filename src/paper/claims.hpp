#pragma once

#include <string>
#include <vector>

#include "reproduction.hpp"

namespace slalom::paper {

/// One thing the paper's drives show, and whether ours show it.
struct Claim {
  std::string text;  ///< what the paper found
  std::string ours;  ///< our numbers
  bool holds = false;
};

/// The paper's findings that can be read off these drives; those whose drives are missing are left
/// out.
std::vector<Claim> claims(const std::vector<ReproducedDrive>& drives);

}  // namespace slalom::paper
