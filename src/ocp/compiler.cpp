#include "compiler.hpp"

#include <algorithm>
#include <utility>

#include "slalom/base/error.hpp"

namespace slalom::ocp {
namespace {

/// The longer of points and members runs within the other.
void place_lanes(const std::vector<std::size_t>& points, std::size_t members, Batch& batch) {
  const auto add = [&](std::size_t point, std::size_t member) {
    batch.lane_point.push_back(static_cast<std::uint32_t>(point));
    batch.lane_member.push_back(static_cast<std::uint32_t>(member));
  };
  if (members > points.size()) {
    for (auto point : points)
      for (std::size_t m = 0; m < members; ++m) add(point, m);
  } else {
    for (std::size_t m = 0; m < members; ++m)
      for (auto point : points) add(point, m);
  }
  batch.lanes = batch.lane_point.size();
}

template <class List>
auto find_symbol(const List& list, const Expr& symbol) {
  return std::find_if(list.begin(), list.end(),
                      [&](const auto& each) { return each.symbol.same(symbol); });
}

}  // namespace

std::size_t Compiler::add(const std::vector<Output>& outputs, const Lanes& lanes) {
  Batch batch;
  BatchData data;
  data.family = lanes.family;
  place_lanes(lanes.points,
              lanes.family == kNone ? 1 : problem_.constraints()[lanes.family].member_values.size(),
              batch);

  std::vector<Expr> values;
  for (const auto& output : outputs) {
    values.push_back(output.value);
    batch.outputs.push_back(output.name);
  }
  const Expr t =
      problem_.initial_time() + problem_.tau() * (problem_.final_time() - problem_.initial_time());
  values = expr::substitute(values, {problem_.time()}, {t});

  std::vector<Expr> variables, data_symbols;
  for (const auto& symbol : expr::symbols_of(values)) {
    if (add_datum(symbol, lanes, batch, data)) {
      data_symbols.push_back(symbol);
      continue;
    }
    if (const auto placed = find_symbol(lanes.placed, symbol); placed != lanes.placed.end()) {
      variables.push_back(symbol);
      add_placed(batch, *placed);
      continue;
    }
    const Meaning meaning = meaning_of(symbol, outputs);
    if (auto source = data_source(meaning)) {
      data.sources.push_back(std::move(*source));
      data_symbols.push_back(symbol);
      continue;
    }
    variables.push_back(symbol);
    add_gather(batch, meaning, symbol, lanes.end);
  }
  batch.function = expr::Function(std::move(variables), std::move(data_symbols), values);
  out_.batches.push_back(std::move(batch));
  out_.batch_data.push_back(std::move(data));
  return out_.batches.size() - 1;
}

/// Members' numbers, tau elsewhere, a soft constraint's weight.
bool Compiler::add_datum(const Expr& symbol, const Lanes& lanes, const Batch& batch,
                         BatchData& data) const {
  if (lanes.family != kNone) {
    const auto& symbols = problem_.constraints()[lanes.family].symbols;
    for (std::size_t i = 0; i < symbols.size(); ++i)
      if (symbols[i].same(symbol)) {
        data.sources.push_back({DataSource::Kind::member, i, {}});
        return true;
      }
  }
  if (const auto tau = find_symbol(lanes.taus, symbol); tau != lanes.taus.end()) {
    DataSource source{DataSource::Kind::tau, 0, {}};
    for (const std::size_t point : batch.lane_point)
      source.points.push_back(static_cast<std::uint32_t>(tau->point(point)));
    data.sources.push_back(std::move(source));
    return true;
  }
  if (lanes.soft != kNone && lanes.weight.same(symbol)) {
    data.sources.push_back({DataSource::Kind::weight, lanes.soft, {}});
    return true;
  }
  return false;
}

/// Of what is no variable: a fixed end of the horizon among them.
std::optional<DataSource> Compiler::data_source(Meaning meaning) const {
  using Kind = Meaning::Kind;
  if (meaning.kind == Kind::tau) return DataSource{DataSource::Kind::tau, 0, {}};
  if (meaning.kind == Kind::parameter)
    return DataSource{DataSource::Kind::parameter, meaning.index, {}};
  if (meaning.kind == Kind::t0 && is_fixed(problem_.t0()))
    return DataSource{DataSource::Kind::t0, 0, {}};
  if (meaning.kind == Kind::tf && is_fixed(problem_.tf()))
    return DataSource{DataSource::Kind::tf, 0, {}};
  return std::nullopt;
}

/// Throws for a symbol this problem did not make, naming the function that uses it.
Meaning Compiler::meaning_of(const Expr& symbol, const std::vector<Output>& outputs) const {
  if (const Meaning* known = symbols_.find(symbol)) return *known;
  std::string user = problem_.name();
  for (const auto& output : outputs)
    for (const auto& used : expr::symbols_of({output.value}))
      if (used.same(symbol)) user = problem_.name() + ": " + output.name;
  throw InvalidValue(user, "the symbol '" + symbol.name() + "'",
                     "symbols made by this problem only");
}

std::size_t Compiler::variable_at(Meaning meaning, std::size_t point, const End* end) const {
  const Layout& layout = out_.layout;
  using Kind = Meaning::Kind;
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
}

void Compiler::add_gather(Batch& batch, Meaning meaning, const Expr& symbol, const End* end) const {
  if (meaning.kind == Meaning::Kind::slack &&
      (end == nullptr || *end != problem_.slacks()[meaning.index].end))
    throw InvalidValue(problem_.name(), "slack '" + symbol.name() + "' away from its end",
                       "slacks in boundary rows and Mayer terms of their own end only");
  add_placed(batch, {symbol, [&](const Batch& b, std::size_t lane) {
                       return variable_at(meaning, b.lane_point[lane], end);
                     }});
}

void Compiler::add_placed(Batch& batch, const Placed& placed) const {
  for (std::size_t lane = 0; lane < batch.lanes; ++lane)
    batch.gather.push_back(static_cast<std::uint32_t>(placed.variable(batch, lane)));
  batch.gather_scale.push_back(
      out_.structure.variable_scale[batch.gather[batch.gather.size() - batch.lanes]]);
  batch.variables.push_back(placed.symbol.name());
}

}  // namespace slalom::ocp
