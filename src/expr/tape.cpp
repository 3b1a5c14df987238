#include "tape.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <new>

#include "op.hpp"
#include "slalom/expr/kernels.hpp"

namespace slalom::expr {
namespace {

constexpr std::uint32_t kNoRow = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kCacheBytes = 48 * 1024;  ///< a block's rows should fit the L1 data cache

/// Rows handed out and taken back.
class RowPool {
 public:
  std::uint32_t take() {
    if (free_.empty()) return next_++;
    const auto row = free_.back();
    free_.pop_back();
    return row;
  }
  void give_back(std::uint32_t row) { free_.push_back(row); }
  std::size_t size() const { return next_; }

 private:
  std::vector<std::uint32_t> free_;
  std::uint32_t next_ = 0;
};

/// Aligned memory that only grows; one for each thread.
class Workspace {
 public:
  double* reserve(std::size_t doubles) {
    if (doubles > size_) {
      memory_.reset(new (std::align_val_t{64}) double[doubles]);
      size_ = doubles;
    }
    return memory_.get();
  }

 private:
  struct Delete {
    void operator()(double* p) const { operator delete[](p, std::align_val_t{64}); }
  };
  std::unique_ptr<double[], Delete> memory_;
  std::size_t size_ = 0;
};

std::size_t block_width(const Tape& tape, std::size_t lanes) {
  for (std::size_t width : {std::size_t{64}, std::size_t{16}})
    if (lanes > width / 4 && tape.rows * width * sizeof(double) <= kCacheBytes) return width;
  return lanes > 4 ? 16 : 4;
}

}  // namespace

Tape compile(const Dag& dag, const std::vector<Dag::Id>& results) {
  std::vector<char> needed(dag.size(), 0);
  for (auto id : results) needed[id] = 1;
  for (auto id = static_cast<Dag::Id>(dag.size()); id-- > 0;)
    if (needed[id])
      for (std::size_t i = 0; i < arity(dag[id].op); ++i) needed[dag[id].arg[i]] = 1;

  std::vector<Dag::Id> last_reader(dag.size(), 0);
  for (Dag::Id id = 0; id < dag.size(); ++id)
    if (needed[id])
      for (std::size_t i = 0; i < arity(dag[id].op); ++i) last_reader[dag[id].arg[i]] = id;
  for (auto id : results) last_reader[id] = std::numeric_limits<Dag::Id>::max();

  Tape tape;
  RowPool pool;
  std::vector<std::uint32_t> row(dag.size(), kNoRow);
  for (Dag::Id id = 0; id < dag.size(); ++id) {
    if (!needed[id] || arity(dag[id].op) != 0) continue;
    row[id] = pool.take();
    if (dag[id].op == Op::constant) {
      last_reader[id] = std::numeric_limits<Dag::Id>::max();
      tape.constants.push_back({row[id], dag[id].value});
    } else {
      tape.inputs.push_back({row[id], static_cast<std::size_t>(dag[id].value)});
    }
  }
  for (Dag::Id id = 0; id < dag.size(); ++id) {
    const std::size_t n = arity(dag[id].op);
    if (!needed[id] || n == 0) continue;
    const auto& arg = dag[id].arg;
    Instruction step{dag[id].op, 0, row[arg[0]], n > 1 ? row[arg[1]] : 0, n > 2 ? row[arg[2]] : 0};
    for (std::size_t i = 0; i < n; ++i) {
      const bool repeated = (i > 0 && arg[i] == arg[0]) || (i > 1 && arg[i] == arg[1]);
      if (!repeated && last_reader[arg[i]] == id) pool.give_back(row[arg[i]]);
    }
    row[id] = step.to = pool.take();
    tape.code.push_back(step);
  }
  for (auto id : results) tape.outputs.push_back(row[id]);
  tape.rows = pool.size();
  return tape;
}

void run(const Tape& tape, const TapeRun& rows) {
  thread_local Workspace memory;
  const std::size_t width = block_width(tape, rows.lanes);
  double* workspace = memory.reserve(tape.rows * width);
  const Kernel kernel = current_kernels() == KernelSet::avx2 ? run_block_avx2 : run_block_baseline;
  for (const auto& fill : tape.constants)
    std::fill_n(workspace + fill.row * width, width, fill.value);
  for (std::size_t lane = 0; lane < rows.lanes; lane += width) {
    const std::size_t count = std::min(width, rows.lanes - lane);
    for (const auto& load : tape.inputs) {
      double* to = workspace + load.row * width;
      const double* from = rows.inputs[load.input] + lane;
      std::memcpy(to, from, count * sizeof(double));
      std::fill(to + count, to + width, from[count - 1]);  // idle lanes compute the last one again
    }
    kernel(tape, workspace, width);
    for (std::size_t k = 0; k < tape.outputs.size(); ++k)
      std::memcpy(rows.outputs[k] + lane, workspace + tape.outputs[k] * width,
                  count * sizeof(double));
  }
}

}  // namespace slalom::expr
