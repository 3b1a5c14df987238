#include "nl_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "graph.hpp"
#include "slalom/expr/spline.hpp"

namespace slalom::nlp {
namespace {

using expr::Expr;
using expr::Node;

/// A row or the objective, taken apart.
struct Output {
  AffineParts parts;
  std::map<std::uint32_t, double> columns;  ///< all variables it has, with linear coefficients

  bool nonlinear() const { return !parts.nonlinear.empty(); }
};

class Writer {
 public:
  Writer(const Formulas& formulas, const Limits& limits, const Start& start, bool with_duals)
      : limits_(limits), start_(start), with_duals_(with_duals) {
    read(formulas);
    order_rows();
    order_variables();
    name_shared();
  }

  NlFile write() {
    header();
    bodies();
    starts();
    bounds();
    sparsity();
    return std::move(file_);
  }

 private:
  template <class... Args>
  void put(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(file_.text), format, std::forward<Args>(args)...);
  }

  // --- reading -----------------------------------------------------------------------------
  void read(const Formulas& formulas) {
    for (std::uint32_t i = 0; i < formulas.variables.size(); ++i)
      index_.emplace(formulas.variables[i].node(), i);
    std::vector<Expr> all = formulas.rows;
    all.push_back(formulas.objective);
    formulas_ = expr::simplified(expr::without_lookups(all));
    in_rows_.assign(index_.size(), 0);
    in_objective_.assign(index_.size(), 0);
    for (std::size_t r = 0; r < formulas.rows.size(); ++r)
      rows_.push_back(take_apart(formulas_[r], r, in_rows_));
    objective_ = take_apart(formulas_.back(), kObjective, in_objective_);
  }

  Output take_apart(const Expr& value, std::size_t user, std::vector<char>& nonlinear) {
    Output output;
    output.parts = affine_parts(value, index_);
    for (const auto& [variable, coefficient] : output.parts.linear)
      output.columns[variable] = coefficient;
    for (const Node* symbol : graph_.add(output.parts, user)) {
      nonlinear[index_.at(symbol)] = 1;
      output.columns.try_emplace(index_.at(symbol), 0.0);
    }
    return output;
  }

  // --- order -------------------------------------------------------------------------------
  void order_rows() {
    for (const bool nonlinear : {true, false})
      for (std::uint32_t r = 0; r < rows_.size(); ++r)
        if (rows_[r].nonlinear() == nonlinear) file_.rows.push_back(r);
    row_place_.resize(rows_.size());
    for (std::uint32_t k = 0; k < rows_.size(); ++k) row_place_[file_.rows[k]] = k;
  }

  /// Gay 2005, table 4: nonlinear in rows and objective, in rows alone, in the objective alone, and
  /// the linear ones.
  void order_variables() {
    const auto add = [&](bool in_rows, bool in_objective) {
      for (std::uint32_t i = 0; i < index_.size(); ++i)
        if ((in_rows_[i] != 0) == in_rows && (in_objective_[i] != 0) == in_objective)
          file_.variables.push_back(i);
      return file_.variables.size();
    };
    both_ = add(true, true);
    in_rows_end_ = add(true, false);
    in_objective_end_ = add(false, true);
    add(false, false);
    place_.resize(index_.size());
    for (std::uint32_t k = 0; k < index_.size(); ++k) place_[file_.variables[k]] = k;
    for (const auto& [symbol, i] : index_) names_.emplace(symbol, place_[i]);
  }

  /// Defined variables follow the others: those of many rows and the objective, of many rows, and
  /// then those of one row or of the objective alone, which stand before it.
  void name_shared() {
    const auto shared = graph_.shared();
    const auto add = [&](std::vector<Shared>& to, auto condition) {
      for (const auto& item : shared)
        if (condition(item)) to.push_back(item);
      return to.size();
    };
    const auto everywhere = [](const Shared& s) { return s.in_objective && s.rows > 0; };
    common_both_ = add(common_, everywhere);
    add(common_, [](const Shared& s) { return s.rows > 1 && !s.in_objective; });
    add(local_, [](const Shared& s) { return s.local() && !s.in_objective; });
    row_local_ = local_.size();
    std::stable_sort(local_.begin(), local_.end(), [&](const Shared& a, const Shared& b) {
      return row_place_[a.last_row] < row_place_[b.last_row];
    });
    add(local_, [](const Shared& s) { return s.local() && s.in_objective; });
    for (const auto* list : {&common_, &local_})
      for (const auto& item : *list) names_.emplace(item.node, names_.size());
  }

  // --- writing -----------------------------------------------------------------------------
  void header() {
    std::size_t ranges = 0, equations = 0, entries = 0, nonlinear_rows = 0;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const double lower = limits_.gl[r], upper = limits_.gu[r];
      equations += lower == upper ? 1 : 0;
      ranges += lower < upper && std::isfinite(lower) && std::isfinite(upper) ? 1 : 0;
      entries += rows_[r].columns.size();
      nonlinear_rows += rows_[r].nonlinear() ? 1 : 0;
    }
    put("g3 1 1 0\n {} {} 1 {} {}\n", index_.size(), rows_.size(), ranges, equations);
    put(" {} {}\n 0 0\n", nonlinear_rows, objective_.nonlinear() ? 1 : 0);
    put(" {} {} {}\n", in_rows_end_, in_objective_end_ > in_rows_end_ ? in_objective_end_ : both_,
        both_);
    put(" 0 0 0 1\n 0 0 0 0 0\n {} {}\n 0 0\n", entries, objective_.columns.size());
    put(" {} {} 0 {} {}\n", common_both_, common_.size() - common_both_, row_local_,
        local_.size() - row_local_);
  }

  /// `user`: 0 of many, else 1 + row, or past them the objective.
  void define(const Shared& shared, std::size_t user) {
    put("V{} 0 {}\n", names_.at(shared.node), user);
    write_tree(shared.node, false, names_, file_.text);
  }

  void bodies() {
    for (const auto& shared : common_) define(shared, 0);
    auto local = local_.begin();
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const auto& output = rows_[file_.rows[k]];
      for (; local != local_.end() && !local->in_objective && local->last_row == file_.rows[k];
           ++local)
        define(*local, k + 1);
      put("C{}\n", k);
      AffineParts body = output.parts;
      if (!output.nonlinear()) body.constant = 0;  // it is taken off the bounds
      write_sum(body, names_, file_.text);
    }
    for (; local != local_.end(); ++local) define(*local, rows_.size() + 1);
    put("O0 0\n");
    write_sum(objective_.parts, names_, file_.text);
  }

  void starts() {
    if (with_duals_) {
      put("d{}\n", rows_.size());
      for (std::size_t k = 0; k < rows_.size(); ++k) put("{} {}\n", k, -start_.y[file_.rows[k]]);
    }
    put("x{}\n", index_.size());
    for (std::size_t k = 0; k < index_.size(); ++k) put("{} {}\n", k, start_.x[file_.variables[k]]);
    if (!with_duals_) return;
    const auto suffix = [&](const char* name, const std::vector<double>& list, double sign) {
      put("S4 {} {}\n", index_.size(), name);
      for (std::size_t k = 0; k < index_.size(); ++k)
        put("{} {}\n", k, sign * list[file_.variables[k]]);
    };
    suffix("ipopt_zL_in", start_.zl, 1);
    suffix("ipopt_zU_in", start_.zu, -1);
  }

  void bound(double lower, double upper) {
    const bool has_lower = std::isfinite(lower), has_upper = std::isfinite(upper);
    if (lower == upper)
      put("4 {}\n", lower);
    else if (has_lower && has_upper)
      put("0 {} {}\n", lower, upper);
    else if (has_upper)
      put("1 {}\n", upper);
    else if (has_lower)
      put("2 {}\n", lower);
    else
      put("3\n");
  }
  void bounds() {
    if (!rows_.empty()) put("r\n");
    for (const auto r : file_.rows) {
      const double constant = rows_[r].nonlinear() ? 0 : rows_[r].parts.constant;
      bound(limits_.gl[r] - constant, limits_.gu[r] - constant);
    }
    put("b\n");
    for (const auto i : file_.variables) bound(limits_.xl[i], limits_.xu[i]);
  }

  void row_entries(const Output& output) {
    std::map<std::uint32_t, double> in_file;
    for (const auto& [variable, coefficient] : output.columns)
      in_file.emplace(place_[variable], coefficient);
    for (const auto& [column, coefficient] : in_file) put("{} {}\n", column, coefficient);
  }
  void sparsity() {
    std::vector<std::size_t> count(index_.size(), 0);
    for (const auto& row : rows_)
      for (const auto& [variable, coefficient] : row.columns) ++count[place_[variable]];
    put("k{}\n", index_.size() - 1);
    std::size_t sum = 0;
    for (std::size_t k = 0; k + 1 < index_.size(); ++k) put("{}\n", sum += count[k]);
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const auto& row = rows_[file_.rows[k]];
      if (row.columns.empty()) continue;
      put("J{} {}\n", k, row.columns.size());
      row_entries(row);
    }
    if (objective_.columns.empty()) return;
    put("G0 {}\n", objective_.columns.size());
    row_entries(objective_);
  }

  const Limits& limits_;
  const Start& start_;
  const bool with_duals_;
  std::vector<Expr> formulas_;  ///< own the nodes
  VariableIndex index_;
  Graph graph_;
  std::vector<Output> rows_;
  Output objective_;
  std::vector<char> in_rows_, in_objective_;  ///< by variable: nonlinear there
  std::size_t both_ = 0, in_rows_end_ = 0, in_objective_end_ = 0;
  std::vector<std::uint32_t> place_, row_place_;  ///< in the file
  std::vector<Shared> common_, local_;
  std::size_t common_both_ = 0, row_local_ = 0;
  NlNames names_;
  NlFile file_;
};

}  // namespace

NlFile nl_file(const Formulas& formulas, const Limits& limits, const Start& start,
               bool with_duals) {
  return Writer(formulas, limits, start, with_duals).write();
}

}  // namespace slalom::nlp
