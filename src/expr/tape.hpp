#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "../base/aligned.hpp"
#include "dag.hpp"

namespace slalom::expr {

/// What an instruction does: an Op, or a product and a sum in one (rounded once where the processor
/// can).
using Code = std::uint8_t;
constexpr Code code_of(Op op) {
  return static_cast<Code>(op);
}
inline constexpr Code kProductPlus = code_of(Op::select) + 1;   ///< a b + c
inline constexpr Code kProductMinus = code_of(Op::select) + 2;  ///< a b - c
inline constexpr Code kMinusProduct = code_of(Op::select) + 3;  ///< c - a b

/// One operation on whole rows of lanes.
struct Instruction {
  Code code;
  std::uint16_t steps;        ///< which step function a lookup has
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
  struct Output {
    std::uint32_t row;
    bool direct;  ///< computed where the result goes; else copied there
  };
  std::vector<Load> inputs;
  std::vector<Fill> constants;
  std::vector<std::shared_ptr<const Steps>> steps;
  std::vector<Instruction> code;
  std::vector<Output> outputs;        ///< row of each result
  std::vector<std::uint32_t> copied;  ///< those that are not direct
  std::size_t rows = 0;
};

/// What is known before a run, and read as input instead of being computed.
struct Given {
  struct Vertex {
    Dag::Id id;
    std::size_t input;
  };
  struct Reciprocal {
    Dag::Id divisor, id;  ///< id: of 1 / divisor, among the vertices
  };
  std::vector<Vertex> vertices;
  std::vector<Reciprocal> reciprocals;  ///< quotients by these divisors become products
};

/// `family`: results, `results` among them, of which each must have the same bits whichever others
/// it is computed with; empty: `results` alone.
Tape compile(const Dag& dag, const std::vector<Dag::Id>& results, const Given& given = {},
             const std::vector<Dag::Id>& family = {});

/// A row of `lanes` numbers, or one number for all lanes.
struct InputRow {
  const double* numbers;
  bool same;
};

/// Where an evaluation reads and writes; outputs one row of `lanes` doubles each.
struct TapeRun {
  std::size_t lanes;
  std::span<const InputRow> inputs;
  std::span<double* const> outputs;
};

/// The same for one lane, whose inputs and results stand number by number in the pieces of a call.
struct PointRun {
  std::span<const std::span<const double>> inputs;
  std::span<const std::span<double>> outputs;
};

/// Memory for runs of one tape at one number of lanes: a block's rows, of which inputs and results
/// are read and written where they stand. Constants are filled in once.
class TapeSpace {
 public:
  TapeSpace() = default;
  TapeSpace(const Tape& tape, std::size_t lanes);
  void run(const Tape& tape, const TapeRun& rows);
  /// Of a space made for one lane: the same numbers, with less to do around them.
  void run(const Tape& tape, const PointRun& point);

 private:
  void fill_same(const Tape& tape, const TapeRun& rows);
  void run_whole(const Tape& tape, const TapeRun& rows, std::size_t lane, std::size_t width);
  void run_rest(const Tape& tape, const TapeRun& rows, std::size_t lane, std::size_t width);

  std::size_t width_ = 0;
  AlignedDoubles memory_;
  std::vector<double*> own_, rows_;  ///< each row's place in memory_; where it is this time
};

/// Executes the code on a block of `width` lanes: 4, 16 or 64.
using Kernel = void (*)(const Tape& tape, double* const* rows, std::size_t width);
void run_block_baseline(const Tape& tape, double* const* rows, std::size_t width);
void run_block_avx2(const Tape& tape, double* const* rows, std::size_t width);
void run_block_avx512(const Tape& tape, double* const* rows, std::size_t width);

}  // namespace slalom::expr
