#include "assembly.hpp"

#include <algorithm>
#include <limits>

#include "slalom/base/error.hpp"

namespace slalom::kkt {
namespace {

constexpr std::uint32_t kAbsent = std::numeric_limits<std::uint32_t>::max();

std::uint32_t narrow(std::size_t n) {
  return static_cast<std::uint32_t>(n);
}

/// Distributes the system's entries over the fronts.
class Planner {
 public:
  Planner(const Pattern& pattern, std::vector<std::size_t> stage_of, std::vector<FrontPlan> plans)
      : p_(pattern), stage_(std::move(stage_of)), plans_(std::move(plans)) {
    place_.resize(plans_.size());
    for (std::size_t f = 0; f < plans_.size(); ++f) {
      place_[f].assign(stage_.size(), kAbsent);
      for (std::size_t i = 0; i < plans_[f].ids.size(); ++i)
        place_[f][plans_[f].ids[i]] = narrow(i);
    }
  }

  std::vector<FrontPlan> run() {
    for (std::size_t e = 0; e < p_.hessian_row.size(); ++e)
      copy(&FrontPlan::hessian, e, p_.hessian_row[e], p_.hessian_col[e]);
    for (std::size_t i = 0; i < p_.variables; ++i) copy(&FrontPlan::diagonal, i, i, i);
    for (std::size_t r = 0; r < p_.rows(); ++r) p_.equation[r] ? equation(r) : inequality(r);
    return std::move(plans_);
  }

 private:
  bool left_out(std::size_t id) const { return id < p_.variables && p_.fixed[id]; }

  struct Position {
    std::size_t front;
    std::uint32_t row, col;
  };
  Position position(std::size_t a, std::size_t b) const {
    const std::size_t front = std::min(stage_[a], stage_[b]);
    const auto i = place_[front][a], j = place_[front][b];
    if (i == kAbsent || j == kAbsent)
      throw Error("kkt: an entry couples stages " + std::to_string(stage_[a]) + " and " +
                  std::to_string(stage_[b]) + ", which are no neighbours");
    return {front, std::max(i, j), std::min(i, j)};
  }
  void copy(std::vector<FrontPlan::Copy> FrontPlan::*list, std::size_t source, std::size_t a,
            std::size_t b) {
    if (left_out(a) || left_out(b)) return;
    const auto at = position(a, b);
    (plans_[at.front].*list).push_back({narrow(source), at.row, at.col});
  }
  void equation(std::size_t r) {
    const std::size_t id = p_.variables + r;
    for (auto e = p_.row_begin[r]; e < p_.row_begin[r + 1]; ++e)
      copy(&FrontPlan::jacobian, e, id, p_.col[e]);
    copy(&FrontPlan::row_diagonal, r, id, id);
  }
  void inequality(std::size_t r) {
    for (auto e = p_.row_begin[r]; e < p_.row_begin[r + 1]; ++e)
      for (auto f = p_.row_begin[r]; f <= e; ++f) {
        if (left_out(p_.col[e]) || left_out(p_.col[f])) continue;
        const auto at = position(p_.col[e], p_.col[f]);
        plans_[at.front].products.push_back({narrow(r), narrow(e), narrow(f), at.row, at.col});
      }
  }

  const Pattern& p_;
  std::vector<std::size_t> stage_;
  std::vector<FrontPlan> plans_;
  std::vector<std::vector<std::uint32_t>> place_;
};

std::vector<std::size_t> stage_of_ids(const Pattern& p) {
  std::vector<std::size_t> stage(p.variables + p.rows(), p.stages());
  for (std::size_t k = 0; k < p.stages(); ++k)
    std::fill(stage.begin() + static_cast<std::ptrdiff_t>(p.stage_begin[k]),
              stage.begin() + static_cast<std::ptrdiff_t>(p.stage_begin[k + 1]), k);
  for (std::size_t r = 0; r < p.rows(); ++r)
    if (!p.border[r]) stage[p.variables + r] = p.row_stage[r];
  return stage;
}

}  // namespace

std::vector<FrontPlan> plan_chain(const Pattern& p) {
  const auto stage = stage_of_ids(p);
  std::vector<FrontPlan> plans(p.stages() + 1);
  for (std::size_t i = 0; i < p.variables; ++i)
    if (!p.fixed[i]) plans[stage[i]].ids.push_back(narrow(i));
  std::vector<std::size_t> variables;
  for (auto& plan : plans) variables.push_back(plan.ids.size());
  for (std::size_t r = 0; r < p.rows(); ++r)
    if (p.equation[r]) plans[stage[p.variables + r]].ids.push_back(narrow(p.variables + r));
  const auto border = plans.back().ids;
  for (auto& plan : plans) plan.own = plan.ids.size();
  for (std::size_t k = 0; k < p.stages(); ++k) {
    auto& ids = plans[k].ids;
    if (k + 1 < p.stages()) {
      plans[k].next = variables[k + 1];
      ids.insert(ids.end(), plans[k + 1].ids.begin(),
                 plans[k + 1].ids.begin() + static_cast<std::ptrdiff_t>(variables[k + 1]));
    }
    ids.insert(ids.end(), border.begin(), border.end());
  }
  return Planner(p, stage, std::move(plans)).run();
}

FrontPlan plan_whole(const Pattern& p) {
  FrontPlan plan;
  for (std::size_t i = 0; i < p.variables; ++i)
    if (!p.fixed[i]) plan.ids.push_back(narrow(i));
  for (std::size_t r = 0; r < p.rows(); ++r)
    if (p.equation[r]) plan.ids.push_back(narrow(p.variables + r));
  plan.own = plan.ids.size();
  std::vector<FrontPlan> plans{std::move(plan)};
  return Planner(p, std::vector<std::size_t>(p.variables + p.rows(), 0), std::move(plans)).run()[0];
}

void assemble(const FrontPlan& plan, const Values& values, std::size_t offset, Front& front) {
  for (const auto& c : plan.hessian)
    front.at(offset + c.row, offset + c.col) += values.hessian[c.source];
  for (const auto& c : plan.diagonal)
    front.at(offset + c.row, offset + c.col) += values.diagonal[c.source];
  for (const auto& c : plan.jacobian)
    front.at(offset + c.row, offset + c.col) += values.jacobian[c.source];
  for (const auto& c : plan.row_diagonal)
    front.at(offset + c.row, offset + c.col) -= values.row_diagonal[c.source];
  for (const auto& p : plan.products)
    front.at(offset + p.row, offset + p.col) +=
        values.row_diagonal[p.weight] * values.jacobian[p.first] * values.jacobian[p.second];
}

}  // namespace slalom::kkt
