// The order of elimination of a sparse symmetric system, and its fronts.

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>

#include "assembly.hpp"

namespace slalom::kkt {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};
/// Zeros that a merger of two small fronts may add to a column, in all.
constexpr std::size_t kMostZeros = 64;

/// Pairs every equation it can with a free variable of its row, by augmenting paths. Eliminated
/// together, a pair has a pivot of order 2 where the equation alone has none (Duff & Pralet, SIAM
/// J. Matrix Anal. Appl. 27(2), 2005).
class Pairing {
 public:
  explicit Pairing(const Pattern& p) : rows_(p.equations), of_variable_(p.variables, kNone) {
    for (const auto& entry : p.jacobian)
      if (!p.fixed[entry.variable]) rows_[entry.equation].push_back(entry.variable);
    seen_by_.assign(p.variables, kNone);
    for (std::uint32_t e = 0; e < p.equations; ++e) augment(e);
  }
  /// The equation paired with a variable, or kNone.
  std::uint32_t of(std::size_t variable) const { return of_variable_[variable]; }

 private:
  struct Step {
    std::uint32_t equation;
    std::size_t next;  ///< of its row's entries
  };
  bool augment(std::uint32_t equation) {
    std::vector<Step> path{{equation, 0}};
    while (!path.empty()) {
      auto& [e, next] = path.back();
      if (next == rows_[e].size()) {
        path.pop_back();
        continue;
      }
      const std::uint32_t i = rows_[e][next++];
      if (seen_by_[i] == equation) continue;
      seen_by_[i] = equation;
      if (of_variable_[i] != kNone) {
        path.push_back({of_variable_[i], 0});
        continue;
      }
      for (const auto& step : path)
        of_variable_[rows_[step.equation][step.next - 1]] = step.equation;
      return true;
    }
    return false;
  }

  std::vector<std::vector<std::uint32_t>> rows_;
  std::vector<std::uint32_t> of_variable_;
  std::vector<std::uint32_t> seen_by_;  ///< the last equation whose search came past
};

/// Nodes (a variable, an equation, or a pair of both) and what each touches.
struct Graph {
  std::vector<std::vector<std::uint32_t>> ids;
  std::vector<std::set<std::uint32_t>> touches;

  explicit Graph(const Pattern& p) {
    const Pairing pairing(p);
    std::vector<std::uint32_t> node(p.variables + p.equations, kNone);
    const auto add = [&](std::uint32_t id, bool fresh) {
      if (fresh) ids.emplace_back();
      ids.back().push_back(id);
      node[id] = static_cast<std::uint32_t>(ids.size() - 1);
    };
    for (std::uint32_t i = 0; i < p.variables; ++i) {
      if (p.fixed[i]) continue;
      add(i, true);
      if (pairing.of(i) != kNone)
        add(static_cast<std::uint32_t>(p.variables) + pairing.of(i), false);
    }
    for (std::size_t id = p.variables; id < node.size(); ++id)
      if (node[id] == kNone) add(static_cast<std::uint32_t>(id), true);
    touches.resize(ids.size());
    const auto couple = [&](std::size_t a, std::size_t b) {
      if (node[a] == kNone || node[b] == kNone || node[a] == node[b]) return;
      touches[node[a]].insert(node[b]);
      touches[node[b]].insert(node[a]);
    };
    for (const auto& place : p.hessian) couple(place.row, place.col);
    for (const auto& entry : p.jacobian) couple(p.variables + entry.equation, entry.variable);
  }
};

/// A front in terms of nodes.
struct Supernode {
  std::vector<std::uint32_t> own, later;
  std::size_t own_rows = 0, later_rows = 0, parent = kNoFront;
  bool merged = false;
};

/// Eliminates nodes by minimum degree; one supernode a node, in that order.
std::vector<Supernode> eliminate(Graph& graph) {
  const auto rows = [&](std::uint32_t node) { return graph.ids[node].size(); };
  const auto degree = [&](std::uint32_t node) {
    std::size_t sum = 0;
    for (const auto other : graph.touches[node]) sum += rows(other);
    return sum;
  };
  using Candidate = std::pair<std::size_t, std::uint32_t>;  // degree, node
  std::set<Candidate> queue;
  std::vector<std::size_t> degrees(graph.ids.size()), step_of(graph.ids.size(), kNoFront);
  for (std::uint32_t node = 0; node < graph.ids.size(); ++node)
    queue.emplace(degrees[node] = degree(node), node);
  std::vector<Supernode> list;
  while (!queue.empty()) {
    const std::uint32_t node = queue.begin()->second;
    queue.erase(queue.begin());
    step_of[node] = list.size();
    const auto touched = std::move(graph.touches[node]);
    Supernode& super = list.emplace_back();
    super.own = {node};
    super.own_rows = rows(node);
    super.later.assign(touched.begin(), touched.end());
    super.later_rows = degrees[node];
    for (const auto a : touched) {
      queue.erase({degrees[a], a});
      auto& reach = graph.touches[a];
      reach.erase(node);
      degrees[a] -= rows(node);
      for (const auto b : touched)
        if (b != a && reach.insert(b).second) degrees[a] += rows(b);
      queue.emplace(degrees[a], a);
    }
  }
  for (auto& super : list)
    for (const auto node : super.later) super.parent = std::min(super.parent, step_of[node]);
  return list;
}

/// Merges fronts into their parents where that adds no zeros, or few.
void merge(std::vector<Supernode>& list) {
  for (std::size_t k = 0; k < list.size(); ++k) {
    Supernode& child = list[k];
    if (child.parent == kNoFront) continue;
    Supernode& parent = list[child.parent];
    const std::size_t zeros = parent.own_rows + parent.later_rows - child.later_rows;
    if (zeros * child.own_rows > kMostZeros) continue;
    parent.own.insert(parent.own.begin(), child.own.begin(), child.own.end());
    parent.own_rows += child.own_rows;
    child.merged = true;
  }
  // A merged front's children belong to the front it went into.
  for (std::size_t k = list.size(); k-- > 0;)
    if (auto& parent = list[k].parent; parent != kNoFront && list[parent].merged && !list[k].merged)
      while (list[parent].merged) parent = list[parent].parent;
}

}  // namespace

std::vector<FrontPlan> plan_forest(const Pattern& p) {
  Graph graph(p);
  auto list = eliminate(graph);
  merge(list);
  std::vector<std::size_t> place(list.size(), kNoFront), front_of(p.variables + p.equations, 0);
  std::vector<FrontPlan> plans;
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (list[k].merged) continue;
    place[k] = plans.size();
    auto& plan = plans.emplace_back();
    for (const auto node : list[k].own)
      for (const auto id : graph.ids[node]) {
        front_of[id] = place[k];
        plan.ids.push_back(id);
      }
    plan.own = plan.ids.size();
    for (const auto node : list[k].later)
      plan.ids.insert(plan.ids.end(), graph.ids[node].begin(), graph.ids[node].end());
  }
  for (std::size_t k = 0; k < list.size(); ++k)
    if (place[k] != kNoFront && list[k].parent != kNoFront)
      plans[place[k]].parent = place[list[k].parent];
  distribute(p, front_of, plans);
  return plans;
}

}  // namespace slalom::kkt
