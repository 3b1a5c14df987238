#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "dag.hpp"

namespace slalom::expr {

/// One operation on whole rows of lanes.
struct Instruction {
  Op op;
  std::uint32_t to, a, b, c;  ///< rows
};

/// Straight-line code for some vertices of a Dag, with rows reused once their last reader is past,
/// so that a block of lanes stays in the first-level cache.
struct Tape {
  struct Load {
    std::uint32_t row;
    std::size_t input;
  };
  struct Fill {
    std::uint32_t row;
    double value;
  };
  std::vector<Load> inputs;
  std::vector<Fill> constants;
  std::vector<Instruction> code;
  std::vector<std::uint32_t> outputs;  ///< row of each result
  std::size_t rows = 0;
};

Tape compile(const Dag& dag, const std::vector<Dag::Id>& results);

/// Where an evaluation reads and writes; inputs and outputs one pointer a row of `lanes` doubles.
struct TapeRun {
  std::size_t lanes;
  std::span<const double* const> inputs;
  std::span<double* const> outputs;
};

void run(const Tape& tape, const TapeRun& rows);

/// Executes the code on a workspace of rows of `width` lanes (width from block_widths).
using Kernel = void (*)(const Tape& tape, double* workspace, std::size_t width);
void run_block_baseline(const Tape& tape, double* workspace, std::size_t width);
void run_block_avx2(const Tape& tape, double* workspace, std::size_t width);

}  // namespace slalom::expr
