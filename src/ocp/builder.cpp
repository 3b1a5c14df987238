#include "builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "slalom/base/error.hpp"
#include "sparsity.hpp"
#include "symbols.hpp"

namespace slalom::ocp {
namespace {

/// One of a function's outputs: a row or a cost term, with the lanes' coefficients decided later.
struct Output {
  std::string name;
  Expr value;
};

class Builder {
 public:
  Builder(const Problem& problem, const Mesh& mesh, const Schemes& schemes)
      : problem_(problem), mesh_(mesh), schemes_(schemes), symbols_(problem) {
    schemes.check(mesh);
    check_dynamics();
    sort_terms();
    out_.layout = make_layout(problem, mesh, schemes, symbols_.find_lifts());
    out_.structure.variable_scale = variable_scales(problem, out_.layout);
  }

  Transcribed build() {
    add_lifts();
    add_point_function();
    add_path_rows(Points::after_first);
    add_families();
    add_ends();
    run_time_forward();
    finish();
    return std::move(out_);
  }

 private:
  void check_dynamics() const {
    if (problem_.states().empty())
      throw InvalidValue(problem_.name(), "no states", "at least one state");
    for (const auto& state : problem_.states())
      if (!state.has_rate)
        throw InvalidValue(problem_.name() + ": state " + state.name, "no dynamics",
                           "a call of dynamics for each state");
  }

  void sort_terms() {
    for (const auto& cost : problem_.costs())
      if (cost.enabled) out_.terms.push_back(cost.name);
  }

  // --- rows --------------------------------------------------------------------------------
  std::size_t add_row(RowName name, std::size_t stage, Bounds bounds, double scale) {
    rows_.push_back({std::move(name), stage, bounds, scale});
    return rows_.size() - 1;
  }

  std::size_t term_index(const std::string& name) const {
    const auto it = std::find(out_.terms.begin(), out_.terms.end(), name);
    return static_cast<std::size_t>(it - out_.terms.begin());
  }

  void add_lifts() {
    const Layout& layout = out_.layout;
    const std::size_t last = layout.points() - 1;
    for (std::size_t i = 0; i < layout.nx; ++i) {
      const double scale = 1 / problem_.states()[i].scale;
      for (const auto& [lifted, point, symbol] :
           {std::tuple{layout.lifted_initial[i], std::size_t{0},
                       problem_.states()[i].initial_symbol},
            std::tuple{layout.lifted_final[i], last, problem_.states()[i].final_symbol}}) {
        if (lifted == kNone) continue;
        const auto row = add_row({"copy of " + symbol.name()}, layout.point_stage[point],
                                 Bounds::equal(0), scale);
        linear_.push_back({row, layout.state(point, i), 1});
        linear_.push_back({row, lifted, -1});
      }
    }
  }

  /// Where the bounds of t0 and tf leave it open.
  void run_time_forward() {
    if (problem_.t0().bounds.upper <= problem_.tf().bounds.lower) return;
    const auto row = add_row({"tf after t0"}, out_.layout.intervals() + 1, Bounds::at_least(0), 1);
    linear_.push_back({row, out_.layout.tf, 1});
    linear_.push_back({row, out_.layout.t0, -1});
  }

  // --- functions ---------------------------------------------------------------------------
  /// Compiles `outputs` into a batch over `lane_points` (times the members of `family`).
  std::size_t add_batch(const std::vector<Output>& outputs,
                        const std::vector<std::size_t>& lane_points, std::size_t family,
                        const End* end) {
    Batch batch;
    BatchData data;
    data.family = family;
    const std::size_t members =
        family == kNone ? 1 : problem_.constraints()[family].member_values.size();
    batch.lanes = lane_points.size() * members;
    place_lanes(lane_points, members, batch);

    std::vector<Expr> values;
    for (const auto& output : outputs) {
      values.push_back(output.value);
      batch.outputs.push_back(output.name);
    }
    const Expr t = problem_.initial_time() +
                   problem_.tau() * (problem_.final_time() - problem_.initial_time());
    values = expr::substitute(values, {problem_.time()}, {t});

    std::vector<Expr> variables, data_symbols;
    for (const auto& symbol : expr::symbols_of(values)) {
      if (add_family_datum(symbol, family, data)) {
        data_symbols.push_back(symbol);
        continue;
      }
      const Meaning meaning = meaning_of(symbol, outputs);
      if (const auto source = data_source(meaning)) {
        data.sources.push_back(*source);
        data_symbols.push_back(symbol);
        continue;
      }
      variables.push_back(symbol);
      add_gather(batch, meaning, symbol, end);
    }
    batch.function = expr::Function(std::move(variables), std::move(data_symbols), values);
    out_.batches.push_back(std::move(batch));
    out_.batch_data.push_back(std::move(data));
    uses_.emplace_back();
    return out_.batches.size() - 1;
  }

  /// The longer of points and members runs within the other.
  static void place_lanes(const std::vector<std::size_t>& lane_points, std::size_t members,
                          Batch& batch) {
    const auto add = [&](std::size_t point, std::size_t member) {
      batch.lane_point.push_back(static_cast<std::uint32_t>(point));
      batch.lane_member.push_back(static_cast<std::uint32_t>(member));
    };
    if (members > lane_points.size()) {
      for (auto point : lane_points)
        for (std::size_t m = 0; m < members; ++m) add(point, m);
    } else {
      for (std::size_t m = 0; m < members; ++m)
        for (auto point : lane_points) add(point, m);
    }
  }

  bool add_family_datum(const Expr& symbol, std::size_t family, BatchData& data) const {
    if (family == kNone) return false;
    const auto& symbols = problem_.constraints()[family].symbols;
    for (std::size_t i = 0; i < symbols.size(); ++i)
      if (symbols[i].same(symbol)) {
        data.sources.push_back({DataSource::Kind::member, i});
        return true;
      }
    return false;
  }

  /// Of what is no variable: a fixed end of the horizon among them.
  std::optional<DataSource> data_source(Meaning meaning) const {
    using Kind = Meaning::Kind;
    if (meaning.kind == Kind::tau) return DataSource{DataSource::Kind::tau, 0};
    if (meaning.kind == Kind::parameter)
      return DataSource{DataSource::Kind::parameter, meaning.index};
    if (meaning.kind == Kind::t0 && is_fixed(problem_.t0()))
      return DataSource{DataSource::Kind::t0, 0};
    if (meaning.kind == Kind::tf && is_fixed(problem_.tf()))
      return DataSource{DataSource::Kind::tf, 0};
    return std::nullopt;
  }

  /// Throws for a symbol this problem did not make, naming the function that uses it.
  Meaning meaning_of(const Expr& symbol, const std::vector<Output>& outputs) const {
    if (const Meaning* known = symbols_.find(symbol)) return *known;
    std::string user = problem_.name();
    for (const auto& output : outputs)
      for (const auto& used : expr::symbols_of({output.value}))
        if (used.same(symbol)) user = problem_.name() + ": " + output.name;
    throw InvalidValue(user, "the symbol '" + symbol.name() + "'",
                       "symbols made by this problem only");
  }

  void add_gather(Batch& batch, Meaning meaning, const Expr& symbol, const End* end) const {
    const Layout& layout = out_.layout;
    using Kind = Meaning::Kind;
    const auto variable_at = [&](std::size_t point) -> std::size_t {
      switch (meaning.kind) {
        case Kind::state:
          return layout.state(point, meaning.index);
        case Kind::control:
          return layout.control(point, meaning.index);
        case Kind::initial:
          return end != nullptr && *end == End::initial ? layout.state(point, meaning.index)
                                                        : layout.lifted_initial[meaning.index];
        case Kind::final:
          return end != nullptr && *end == End::final ? layout.state(point, meaning.index)
                                                      : layout.lifted_final[meaning.index];
        case Kind::slack:
          return layout.slack[meaning.index];
        case Kind::t0:
          return layout.t0;
        case Kind::tf:
          return layout.tf;
        case Kind::integral:
          return layout.integrals + meaning.index;
        default:
          return layout.static_parameters + meaning.index;
      }
    };
    if (meaning.kind == Kind::slack &&
        (end == nullptr || *end != problem_.slacks()[meaning.index].end))
      throw InvalidValue(problem_.name(), "slack '" + symbol.name() + "' away from its end",
                         "slacks in boundary rows and Mayer terms of their own end only");
    for (auto point : batch.lane_point)
      batch.gather.push_back(static_cast<std::uint32_t>(variable_at(point)));
    batch.gather_scale.push_back(out_.structure.variable_scale[variable_at(batch.lane_point[0])]);
    batch.variables.push_back(symbol.name());
  }

  void use(std::size_t batch, std::size_t output, std::size_t lane, std::size_t row,
           std::size_t term, double coefficient) {
    uses_[batch].push_back({output, lane, row, term, coefficient});
  }

  std::vector<std::size_t> points(Points which) const {
    std::vector<std::size_t> list(out_.layout.points());
    std::iota(list.begin(), list.end(), std::size_t{0});
    if (which == Points::after_first) list.erase(list.begin());
    return list;
  }

  /// Rates, integrands and path rows at all points: one function, for they share most of the model.
  void add_point_function() {
    const Expr duration = problem_.final_time() - problem_.initial_time();
    std::vector<Output> outputs;
    for (const auto& state : problem_.states())
      outputs.push_back({"dynamics of " + state.name, duration * state.rate});
    std::vector<std::size_t> terms;
    for (const auto& cost : problem_.costs()) {
      if (!cost.enabled || !cost.lagrange) continue;
      terms.push_back(term_index(cost.name));
      outputs.push_back({cost.name, duration * cost.value});
    }
    const std::size_t first_integral = outputs.size();
    for (const auto& integral : problem_.integrals())
      outputs.push_back({"integrand of " + integral.name, duration * integral.integrand});
    const std::size_t first_path = outputs.size();
    std::vector<const Problem::Constraint*> paths;
    for (const auto& row : problem_.constraints())
      if (!absent(row, Problem::Kind::path) && row.points == Points::all) {
        paths.push_back(&row);
        outputs.push_back({row.name, row.value});
      }
    const auto batch = add_batch(outputs, points(Points::all), kNone, nullptr);
    add_defects(batch);
    hold_controls();
    add_quadrature(batch, terms, first_integral);
    for (std::size_t i = 0; i < paths.size(); ++i)
      for (std::size_t point = 0; point < out_.layout.points(); ++point)
        use_as_row(batch, first_path + i, point, {paths[i]->name}, point, paths[i]->bounds);
  }

  void use_as_row(std::size_t batch, std::size_t output, std::size_t lane, RowName name,
                  std::size_t point, Bounds bounds) {
    const Layout& layout = out_.layout;
    name.text += " at " + layout.point_name(point);
    const auto row = add_row(std::move(name), layout.point_stage[point], bounds, 1);
    use(batch, output, lane, row, kNone, 1);
  }

  void add_defects(std::size_t batch) {
    const Layout& layout = out_.layout;
    const std::size_t intervals = layout.intervals(), most = schemes_.most_points() - 1;
    out_.defect_begin = rows_.size();
    out_.defect_rows.assign(most * layout.nx * intervals, kNone);
    for (std::size_t d = 0; d < most; ++d)
      for (std::size_t i = 0; i < layout.nx; ++i) {
        const auto& state = problem_.states()[i];
        for (std::size_t k = 0; k < intervals; ++k)
          if (d < schemes_.of(k).defects())
            out_.defect_rows[(d * layout.nx + i) * intervals + k] =
                add_row({fmt::format("defect {} of {} in interval {}", d, state.name, k)}, k,
                        Bounds::equal(0), 1 / state.scale);
        for (std::size_t j = 0; j <= most; ++j)
          for (std::size_t k = 0; k < intervals; ++k)
            if (defect_row(out_, d, i, k) != kNone && j < schemes_.of(k).points.size())
              add_defect_terms(batch, d, i, j, k);
      }
    out_.defect_end = rows_.size();
  }
  void add_defect_terms(std::size_t batch, std::size_t d, std::size_t i, std::size_t j,
                        std::size_t k) {
    const Scheme& scheme = schemes_.of(k);
    const std::size_t row = defect_row(out_, d, i, k), point = out_.layout.node_point[k] + j;
    if (scheme.state[d][j] != 0)
      linear_.push_back({row, out_.layout.state(point, i), scheme.state[d][j]});
    if (scheme.rate[d][j] != 0) use(batch, i, point, row, kNone, -length(k) * scheme.rate[d][j]);
  }
  double length(std::size_t k) const { return mesh_.breakpoints()[k + 1] - mesh_.breakpoints()[k]; }

  /// A control at a point that no interval collocates would hang in the air: it is held.
  void hold_controls() {
    const Layout& layout = out_.layout;
    std::vector<char> collocated(layout.points(), 0);
    for (std::size_t k = 0; k < layout.intervals(); ++k)
      for (std::size_t j = 0; j < schemes_.of(k).points.size(); ++j)
        if (schemes_.of(k).collocates(j)) collocated[layout.node_point[k] + j] = 1;
    for (std::size_t point = 0; point < layout.points(); ++point) {
      if (collocated[point]) continue;
      std::size_t from = point;
      while (from > 0 && !collocated[from]) --from;
      while (!collocated[from]) ++from;
      for (std::size_t i = 0; i < layout.nu; ++i) {
        const auto& control = problem_.controls()[i];
        const auto row = add_row({control.name + " held at " + layout.point_name(point)},
                                 std::min(layout.point_stage[point], layout.point_stage[from]),
                                 Bounds::equal(0), 1 / control.scale);
        linear_.push_back({row, layout.control(point, i), 1});
        linear_.push_back({row, layout.control(from, i), -1});
      }
    }
  }

  void add_quadrature(std::size_t batch, const std::vector<std::size_t>& terms,
                      std::size_t first_integral) {
    const Layout& layout = out_.layout;
    std::vector<double> weight(layout.points(), 0.0);
    for (std::size_t k = 0; k < layout.intervals(); ++k)
      for (std::size_t j = 0; j < schemes_.of(k).points.size(); ++j)
        weight[layout.node_point[k] + j] += length(k) * schemes_.of(k).weight[j];
    for (std::size_t k = 0; k <= layout.intervals(); ++k) {
      const double whole = weight[layout.node_point[k]];
      out_.share_after.push_back(k == layout.intervals() || whole == 0
                                     ? 0
                                     : length(k) * schemes_.of(k).weight.front() / whole);
    }
    for (std::size_t t = 0; t < terms.size(); ++t)
      for (std::size_t point = 0; point < layout.points(); ++point)
        if (weight[point] != 0) use(batch, layout.nx + t, point, kNone, terms[t], weight[point]);
    for (std::size_t i = 0; i < problem_.integrals().size(); ++i) {
      const auto& integral = problem_.integrals()[i];
      const auto row = add_row({"integral " + integral.name}, layout.intervals() + 1,
                               Bounds::equal(0), 1 / integral.scale);
      linear_.push_back({row, layout.integrals + i, -1});
      for (std::size_t point = 0; point < layout.points(); ++point)
        if (weight[point] != 0) use(batch, first_integral + i, point, row, kNone, weight[point]);
    }
  }

  void add_path_rows(Points which) {
    std::vector<Output> outputs;
    std::vector<const Problem::Constraint*> paths;
    for (const auto& row : problem_.constraints())
      if (!absent(row, Problem::Kind::path) && row.points == which) {
        paths.push_back(&row);
        outputs.push_back({row.name, row.value});
      }
    if (outputs.empty()) return;
    const auto lanes = points(which);
    const auto batch = add_batch(outputs, lanes, kNone, nullptr);
    for (std::size_t i = 0; i < paths.size(); ++i)
      for (std::size_t lane = 0; lane < lanes.size(); ++lane)
        use_as_row(batch, i, lane, {paths[i]->name}, lanes[lane], paths[i]->bounds);
  }

  void add_families() {
    for (std::size_t f = 0; f < problem_.constraints().size(); ++f) {
      const auto& family = problem_.constraints()[f];
      if (absent(family, Problem::Kind::family)) continue;
      const auto lanes = points(family.points);
      const auto batch = add_batch({{family.name, family.value}}, lanes, f, nullptr);
      for (std::size_t lane = 0; lane < out_.batches[batch].lanes; ++lane)
        use_as_row(batch, 0, lane, {"", f, out_.batches[batch].lane_member[lane]},
                   out_.batches[batch].lane_point[lane], family.bounds);
    }
  }

  void add_ends() {
    for (const End end : {End::initial, End::final}) {
      std::vector<Output> outputs;
      std::vector<const Problem::Constraint*> rows;
      for (const auto& row : problem_.constraints())
        if (!absent(row, Problem::Kind::boundary) && symbols_.end_of(row.value, row.name) == end) {
          rows.push_back(&row);
          outputs.push_back({row.name, row.value});
        }
      std::vector<std::size_t> terms;
      for (const auto& cost : problem_.costs())
        if (cost.enabled && !cost.lagrange && symbols_.end_of(cost.value, cost.name) == end) {
          terms.push_back(term_index(cost.name));
          outputs.push_back({cost.name, cost.value});
        }
      if (outputs.empty()) continue;
      const std::size_t point = end == End::initial ? 0 : out_.layout.points() - 1;
      const auto batch = add_batch(outputs, {point}, kNone, &end);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto row =
            add_row({rows[i]->name}, out_.layout.point_stage[point], rows[i]->bounds, 1);
        use(batch, i, 0, row, kNone, 1);
      }
      for (std::size_t i = 0; i < terms.size(); ++i)
        use(batch, rows.size() + i, 0, kNone, terms[i], 1);
    }
  }

  // --- sparsity and scatter lists ----------------------------------------------------------
  void finish() {
    fill_rows(rows_, out_);
    fill_variable_limits(problem_, out_.layout, out_.structure.variable_scale, out_.limits);
    fill_sparsity(rows_, linear_, uses_, out_);
    for (auto& batch : out_.batches) batch.finish();
    fill_data(problem_, out_);
    check_freedom();
  }

  void check_freedom() const {
    std::size_t free = 0, equations = 0;
    for (std::size_t i = 0; i < out_.layout.variables; ++i)
      free += out_.limits.xl[i] < out_.limits.xu[i] ? 1 : 0;
    for (std::size_t r = 0; r < rows_.size(); ++r)
      equations += out_.limits.gl[r] == out_.limits.gu[r] ? 1 : 0;
    if (equations > free)
      throw InvalidValue(problem_.name(),
                         fmt::format("{} equations for {} free variables", equations, free),
                         "no more equations than unknowns");
  }

  const Problem& problem_;
  const Mesh& mesh_;
  const Schemes& schemes_;
  const Symbols symbols_;
  std::vector<RowInfo> rows_;
  std::vector<RowTerm> linear_;
  std::vector<std::vector<Use>> uses_;
  Transcribed out_;
};

}  // namespace

Transcribed transcribe(const Problem& problem, const Mesh& mesh, const Schemes& schemes) {
  return Builder(problem, mesh, schemes).build();
}

std::string RowName::in(const Problem& problem) const {
  if (family == kNone) return text;
  const auto& constraint = problem.constraints()[family];
  return fmt::format("{}[{}]{}", constraint.name, constraint.members[member], text);
}

}  // namespace slalom::ocp
