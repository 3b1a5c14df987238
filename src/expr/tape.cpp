#include "tape.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "../base/kernel_choice.hpp"
#include "op.hpp"
#include "slalom/base/error.hpp"

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

std::size_t block_width(const Tape& tape, std::size_t lanes) {
  if (lanes >= 64 && tape.rows * 64 * sizeof(double) <= kCacheBytes) return 64;
  return lanes > 4 ? 16 : 4;
}

Kernel kernel() {
  return in_use<Kernel>(run_block_baseline, run_block_avx2, run_block_avx512);
}

/// Few numbers are not worth a call.
inline void copy(const double* from, std::size_t count, double* to) {
  if (count < 16) {
    for (std::size_t i = 0; i < count; ++i) to[i] = from[i];
  } else {
    std::memcpy(to, from, count * sizeof(double));
  }
}

/// Chooses instructions: finds products that can be fused with the one sum that reads them.
class Selection {
 public:
  Selection(const Dag& dag, const std::vector<Dag::Id>& results, const Given& given,
            const std::vector<Dag::Id>& family)
      : dag_(dag),
        needed_(dag.size(), 0),
        given_(dag.size(), 0),
        fused_(dag.size(), 0),
        reciprocal_(dag.size(), kNoId) {
    for (const auto& g : given.vertices) given_[g.id] = 1;
    for (const auto& r : given.reciprocals) reciprocal_[r.divisor] = r.id;
    const auto readers = mark(family.empty() ? results : family);
    for (Dag::Id id = 0; id < dag.size(); ++id)
      if (needed_[id] && !given_[id]) choose(id, readers);
    if (!family.empty()) mark(results);
  }

  /// Neither input nor fused into its reader.
  bool is_step(Dag::Id id) const {
    return needed_[id] && !given_[id] && !fused_[id] && arity(dag_[id].op) > 0;
  }
  bool needed(Dag::Id id) const { return needed_[id] != 0; }
  bool given(Dag::Id id) const { return given_[id] != 0; }

  struct Choice {
    Code code;
    std::size_t args;
    std::array<Dag::Id, 3> arg;
  };
  Choice operator[](Dag::Id id) const {
    const auto& v = dag_[id];
    if (v.op == Op::add && fused_[v.arg[1]]) return product(kProductPlus, v.arg[1], v.arg[0]);
    if (v.op == Op::add && fused_[v.arg[0]]) return product(kProductPlus, v.arg[0], v.arg[1]);
    if (v.op == Op::sub && fused_[v.arg[0]]) return product(kProductMinus, v.arg[0], v.arg[1]);
    if (v.op == Op::sub && fused_[v.arg[1]]) return product(kMinusProduct, v.arg[1], v.arg[0]);
    return plain(id);
  }

 private:
  static constexpr Dag::Id kNoId = std::numeric_limits<Dag::Id>::max();

  Choice plain(Dag::Id id) const {
    const auto& v = dag_[id];
    if (v.op == Op::div && reciprocal_[v.arg[1]] != kNoId && !given_[v.arg[0]])
      return {code_of(Op::mul), 2, {v.arg[0], reciprocal_[v.arg[1]], 0}};
    return {code_of(v.op), arity(v.op), v.arg};
  }
  /// Marks what `results` need; returns how often each vertex is read.
  std::vector<std::uint32_t> mark(const std::vector<Dag::Id>& results) {
    std::vector<std::uint32_t> readers(dag_.size(), 0);
    std::fill(needed_.begin(), needed_.end(), 0);
    for (auto id : results) needed_[id] = 1;
    for (auto id : results) readers[id] = 2;  // a result must stand on its own
    // A reciprocal's id is larger than its readers', but it is given: nothing is below it.
    for (auto id = static_cast<Dag::Id>(dag_.size()); id-- > 0;)
      if (needed_[id] && !given_[id]) {
        const auto choice = plain(id);
        for (std::size_t i = 0; i < choice.args; ++i) {
          needed_[choice.arg[i]] = 1;
          ++readers[choice.arg[i]];
        }
      }
    return readers;
  }
  void choose(Dag::Id id, const std::vector<std::uint32_t>& readers) {
    const auto& v = dag_[id];
    if (v.op != Op::add && v.op != Op::sub) return;
    for (const Dag::Id arg : {v.arg[1], v.arg[0]}) {
      const Op op = dag_[arg].op;
      if ((op != Op::mul && op != Op::square) || readers[arg] != 1 || given_[arg]) continue;
      fused_[arg] = 1;
      return;
    }
  }
  Choice product(Code code, Dag::Id factor, Dag::Id other) const {
    const auto& v = dag_[factor];
    return {code, 3, {v.arg[0], v.op == Op::square ? v.arg[0] : v.arg[1], other}};
  }

  const Dag& dag_;
  std::vector<char> needed_, given_, fused_;
  std::vector<Dag::Id> reciprocal_;
};

std::uint16_t add_steps(Tape& tape, const std::shared_ptr<const Steps>& steps) {
  const auto known = std::find(tape.steps.begin(), tape.steps.end(), steps);
  const auto index = known - tape.steps.begin();
  if (index > std::numeric_limits<std::uint16_t>::max())
    throw Error("function: more step functions than an instruction can name");
  if (known == tape.steps.end()) tape.steps.push_back(steps);
  return static_cast<std::uint16_t>(index);
}

}  // namespace

Tape compile(const Dag& dag, const std::vector<Dag::Id>& results, const Given& given,
             const std::vector<Dag::Id>& family) {
  const Selection selection(dag, results, given, family);
  std::vector<Dag::Id> last_reader(dag.size(), 0);
  for (Dag::Id id = 0; id < dag.size(); ++id)
    if (selection.is_step(id)) {
      const auto choice = selection[id];
      for (std::size_t i = 0; i < choice.args; ++i) last_reader[choice.arg[i]] = id;
    }
  for (auto id : results) last_reader[id] = std::numeric_limits<Dag::Id>::max();

  Tape tape;
  RowPool pool;
  std::vector<std::uint32_t> row(dag.size(), kNoRow);
  for (const auto& g : given.vertices)
    if (selection.needed(g.id)) tape.inputs.push_back({row[g.id] = pool.take(), g.input});
  for (Dag::Id id = 0; id < dag.size(); ++id) {
    if (!selection.needed(id) || selection.given(id) || arity(dag[id].op) != 0) continue;
    row[id] = pool.take();
    if (dag[id].op == Op::constant) {
      last_reader[id] = std::numeric_limits<Dag::Id>::max();
      tape.constants.push_back({row[id], dag[id].value});
    } else {
      tape.inputs.push_back({row[id], static_cast<std::size_t>(dag[id].value)});
    }
  }
  for (Dag::Id id = 0; id < dag.size(); ++id) {
    if (!selection.is_step(id)) continue;
    const auto [code, args, arg] = selection[id];
    Instruction step{
        code, 0, 0, row[arg[0]], args > 1 ? row[arg[1]] : 0, args > 2 ? row[arg[2]] : 0};
    if (code == code_of(Op::lookup)) step.steps = add_steps(tape, dag.steps(id));
    for (std::size_t i = 0; i < args; ++i) {
      const bool repeated = (i > 0 && arg[i] == arg[0]) || (i > 1 && arg[i] == arg[1]);
      if (!repeated && last_reader[arg[i]] == id && selection.is_step(arg[i]))
        pool.give_back(row[arg[i]]);  // an input's row is not ours to write to
    }
    row[id] = step.to = pool.take();
    tape.code.push_back(step);
  }
  std::vector<char> taken(pool.size(), 0);
  for (auto id : results) {
    const bool direct = selection.is_step(id) && !taken[row[id]];
    if (!direct) tape.copied.push_back(static_cast<std::uint32_t>(tape.outputs.size()));
    tape.outputs.push_back({row[id], direct});
    taken[row[id]] = 1;
  }
  tape.rows = pool.size();
  return tape;
}

TapeSpace::TapeSpace(const Tape& tape, std::size_t lanes)
    : width_(block_width(tape, lanes)), memory_(aligned_doubles(tape.rows * width_)) {
  for (std::size_t r = 0; r < tape.rows; ++r) own_.push_back(memory_.get() + r * width_);
  rows_ = own_;
  for (const auto& fill : tape.constants) std::fill_n(own_[fill.row], width_, fill.value);
}

void TapeSpace::run(const Tape& tape, const TapeRun& rows) {
  fill_same(tape, rows);
  std::size_t lane = 0;
  for (const std::size_t width : {width_, std::size_t{16}})
    for (; width <= width_ && lane + width <= rows.lanes; lane += width)
      run_whole(tape, rows, lane, width);
  if (lane < rows.lanes) run_rest(tape, rows, lane, rows.lanes - lane > 4 ? 16 : 4);
}

void TapeSpace::run(const Tape& tape, const PointRun& point) {
  constexpr std::size_t kWidth = 4;  // of which the idle lanes compute the same
  for (const auto& load : tape.inputs) {
    std::size_t i = load.input, piece = 0;
    while (i >= point.inputs[piece].size()) i -= point.inputs[piece++].size();
    std::fill_n(own_[load.row], kWidth, point.inputs[piece][i]);
  }
  kernel()(tape, own_.data(), kWidth);
  std::size_t k = 0;
  for (const auto& piece : point.outputs)
    for (double& number : piece) number = *own_[tape.outputs[k++].row];
}

void TapeSpace::fill_same(const Tape& tape, const TapeRun& rows) {
  for (const auto& load : tape.inputs)
    if (rows.inputs[load.input].same) {
      rows_[load.row] = own_[load.row];
      std::fill_n(own_[load.row], width_, *rows.inputs[load.input].numbers);
    }
}

void TapeSpace::run_whole(const Tape& tape, const TapeRun& rows, std::size_t lane,
                          std::size_t width) {
  for (const auto& load : tape.inputs)
    if (const InputRow& input = rows.inputs[load.input]; !input.same)
      rows_[load.row] = const_cast<double*>(input.numbers) + lane;  // never written to
  for (std::size_t k = 0; k < tape.outputs.size(); ++k)
    if (tape.outputs[k].direct) rows_[tape.outputs[k].row] = rows.outputs[k] + lane;
  kernel()(tape, rows_.data(), width);
  for (const auto k : tape.copied) copy(rows_[tape.outputs[k].row], width, rows.outputs[k] + lane);
}

/// Fewer lanes than a block has: the idle ones compute the last one again.
void TapeSpace::run_rest(const Tape& tape, const TapeRun& rows, std::size_t lane,
                         std::size_t width) {
  const std::size_t count = rows.lanes - lane;
  for (const auto& load : tape.inputs) {
    const InputRow& input = rows.inputs[load.input];
    if (input.same) continue;
    double* to = rows_[load.row] = own_[load.row];
    copy(input.numbers + lane, count, to);
    std::fill(to + count, to + width, to[count - 1]);
  }
  for (const auto& output : tape.outputs)
    if (output.direct) rows_[output.row] = own_[output.row];
  kernel()(tape, rows_.data(), width);
  for (std::size_t k = 0; k < tape.outputs.size(); ++k)
    copy(rows_[tape.outputs[k].row], count, rows.outputs[k] + lane);
}

}  // namespace slalom::expr
