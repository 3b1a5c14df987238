#include "numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "slalom/base/error.hpp"
#include "slalom/base/options.hpp"
#include "symbols.hpp"

namespace slalom::ocp {
namespace {

using Kind = Number::Kind;
using Side = Number::Side;

class List {
 public:
  void add(Number number) { numbers.push_back(std::move(number)); }
  void add_bounds(const std::string& name, Kind kind, std::size_t index, Bounds bounds) {
    if (bounds.lower == bounds.upper) {
      add({name, bounds.lower, kind, index, Side::both});
      return;
    }
    if (std::isfinite(bounds.lower)) add({"lower " + name, bounds.lower, kind, index, Side::lower});
    if (std::isfinite(bounds.upper)) add({"upper " + name, bounds.upper, kind, index, Side::upper});
  }
  template <class Variables>
  void add_bounds(Kind kind, const Variables& variables) {
    for (std::size_t i = 0; i < variables.size(); ++i)
      add_bounds(variables[i].name, kind, i, variables[i].bounds);
  }
  void add_constraint(std::size_t index, const Problem::Constraint& row) {
    add_bounds(row.name, Kind::constraint, index, row.bounds);
    if (row.soft) add({"weight of " + row.name, row.soft->weight, Kind::weight, index});
    for (std::size_t m = 0; m < row.member_values.size(); ++m)
      for (std::size_t s = 0; s < row.symbols.size(); ++s)
        add({fmt::format("{}[{}].{}", row.name, row.members[m], row.symbols[s].name()),
             row.numbers_at(m)[s], Kind::member, index, Side::both, m, s});
  }

  std::vector<Number> numbers;
};

/// Moves bounds of variables and rows.
class LimitsMoved {
 public:
  LimitsMoved(const Problem& problem, const Transcribed& t, nlp::Limits& out)
      : problem_(problem), t_(t), out_(out) {}

  void move(const Number& number) {
    const Layout& layout = t_.layout;
    const std::size_t last = layout.points() - 1;
    switch (number.kind) {
      case Kind::state:
        return move_state(number);
      case Kind::initial:
        return move_end(number, 0, problem_.states()[number.index].initial);
      case Kind::final:
        return move_end(number, last, problem_.states()[number.index].final);
      case Kind::control:
        for (std::size_t point = 0; point <= last; ++point)
          move(layout.control(point, number.index), number.side);
        return;
      case Kind::slack:
        return move(layout.slack[number.index], number.side);
      case Kind::static_parameter:
        return move(layout.static_parameters + number.index, number.side);
      case Kind::integral:
        return move(layout.integrals + number.index, number.side);
      case Kind::t0:
        return move(layout.t0, number.side);
      case Kind::tf:
        return move(layout.tf, number.side);
      case Kind::constraint:
        return move_rows(number);
      default:
        return;
    }
  }

 private:
  void move(std::size_t variable, Side side) {
    const double rate = 1 / t_.structure.variable_scale[variable];
    if (side != Side::upper) out_.xl[variable] = rate;
    if (side != Side::lower) out_.xu[variable] = rate;
  }
  /// A state's bounds hold at an end where those of the end are wider.
  void move_state(const Number& number) {
    const auto& state = problem_.states()[number.index];
    const std::size_t last = t_.layout.points() - 1;
    for (const std::size_t point : t_.layout.state_points) {
      const Bounds end = point == 0 ? state.initial : point == last ? state.final : Bounds{};
      const std::size_t variable = t_.layout.state(point, number.index);
      if (number.side != Side::upper && state.bounds.lower > end.lower) move(variable, Side::lower);
      if (number.side != Side::lower && state.bounds.upper < end.upper) move(variable, Side::upper);
    }
  }
  void move_end(const Number& number, std::size_t point, Bounds end) {
    const Bounds all = problem_.states()[number.index].bounds;
    const std::size_t variable = t_.layout.state(point, number.index);
    if (number.side != Side::upper && end.lower >= all.lower) move(variable, Side::lower);
    if (number.side != Side::lower && end.upper <= all.upper) move(variable, Side::upper);
  }
  void move_rows(const Number& number) {
    for (std::size_t r = 0; r < t_.origins.size(); ++r) {
      if (t_.origins[r].constraint != number.index) continue;
      if (number.side != Side::upper) out_.gl[r] = t_.structure.row_scale[r];
      if (number.side != Side::lower) out_.gu[r] = t_.structure.row_scale[r];
    }
  }

  const Problem& problem_;
  const Transcribed& t_;
  nlp::Limits& out_;
};

/// Whether a column of a batch's data holds the number in a lane.
bool holds(const DataSource& source, const Batch& batch, std::size_t family, std::size_t lane,
           const Number& number) {
  using Source = DataSource::Kind;
  switch (source.kind) {
    case Source::parameter:
      return number.kind == Kind::parameter && source.index == number.index;
    case Source::member:
      return number.kind == Kind::member && family == number.index &&
             source.index == number.symbol && batch.lane_member[lane] == number.member;
    case Source::weight:
      return number.kind == Kind::weight && source.index == number.index;
    case Source::t0:
      return number.kind == Kind::t0;
    case Source::tf:
      return number.kind == Kind::tf;
    default:
      return false;
  }
}

/// Throws where the mesh has a node at a time whose share moves with an end of the horizon.
void check_nodes(const Problem& problem, const Number& number) {
  if ((number.kind != Kind::t0 && number.kind != Kind::tf) || number.side != Side::both) return;
  Problem moved = problem;
  const double by = 1e-3 * (problem.tf().bounds.lower - problem.t0().bounds.lower);
  const auto end = Bounds::equal(number.value + (number.kind == Kind::tf ? by : -by));
  number.kind == Kind::tf ? moved.final_time(end, end.lower) : moved.initial_time(end, end.lower);
  if (moved.moments() != problem.moments())
    throw InvalidValue(problem.name() + ": sensitivity to " + number.name,
                       "a row, a cost term or a breakpoint at a time",
                       "moments as shares of the horizon, for the mesh does not move");
}

Bounds moved(Bounds bounds, Number::Side side, double value) {
  if (side != Number::Side::upper) bounds.lower = value;
  if (side != Number::Side::lower) bounds.upper = value;
  return bounds;
}

}  // namespace

void set_number(const Number& number, double value, Problem& problem) {
  switch (number.kind) {
    case Kind::parameter:
      return problem.set_parameter(problem.parameters()[number.index].symbol, value);
    case Kind::initial: {
      const auto& state = problem.states()[number.index];
      return problem.initial_bounds(state.symbol, moved(state.initial, number.side, value));
    }
    case Kind::final: {
      const auto& state = problem.states()[number.index];
      return problem.final_bounds(state.symbol, moved(state.final, number.side, value));
    }
    case Kind::t0:
      return problem.initial_time(moved(problem.t0().bounds, number.side, value),
                                  problem.t0().guess);
    case Kind::tf:
      return problem.final_time(moved(problem.tf().bounds, number.side, value), problem.tf().guess);
    case Kind::weight: {
      Soft soft = *problem.constraints()[number.index].soft;
      soft.weight = value;
      return problem.soften({number.index}, soft);
    }
    case Kind::member: {
      const auto& family = problem.constraints()[number.index];
      auto values = family.member_values;
      auto& own = values[number.member];
      for (std::size_t i = number.symbol; i < own.size(); i += family.symbols.size())
        own[i] = value;
      return problem.set_members({number.index}, family.members, std::move(values));
    }
    default:
      throw InvalidValue(
          problem.name() + ": " + number.name, fmt::format("{}", value),
          "a number that may be set after its declaration: a parameter, bounds at an "
          "end, t0, tf, a member's number or a weight");
  }
}

std::vector<Number> numbers(const Problem& problem) {
  List list;
  for (std::size_t i = 0; i < problem.parameters().size(); ++i)
    list.add({problem.parameters()[i].name, problem.parameters()[i].value, Kind::parameter, i});
  for (std::size_t i = 0; i < problem.states().size(); ++i) {
    const auto& state = problem.states()[i];
    list.add_bounds("initial " + state.name, Kind::initial, i, state.initial);
    list.add_bounds("final " + state.name, Kind::final, i, state.final);
  }
  list.add_bounds("t0", Kind::t0, 0, problem.t0().bounds);
  list.add_bounds("tf", Kind::tf, 0, problem.tf().bounds);
  list.add_bounds(Kind::state, problem.states());
  list.add_bounds(Kind::control, problem.controls());
  list.add_bounds(Kind::static_parameter, problem.static_parameters());
  list.add_bounds(Kind::slack, problem.slacks());
  list.add_bounds(Kind::integral, problem.integrals());
  for (std::size_t c = 0; c < problem.constraints().size(); ++c)
    if (const auto& row = problem.constraints()[c]; !absent(row, row.kind))
      list.add_constraint(c, row);
  return std::move(list.numbers);
}

Direction direction_of(const Problem& problem, const Transcribed& transcribed,
                       const Number& number) {
  check_nodes(problem, number);
  Direction direction;
  for (std::size_t b = 0; b < transcribed.batches.size(); ++b) {
    const Batch& batch = transcribed.batches[b];
    const BatchData& data = transcribed.batch_data[b];
    auto& rates = direction.data.emplace_back(data.sources.size() * batch.lanes, 0.0);
    for (std::size_t i = 0; i < data.sources.size(); ++i)
      for (std::size_t lane = 0; lane < batch.lanes; ++lane)
        rates[i * batch.lanes + lane] =
            holds(data.sources[i], batch, data.family, lane, number) ? 1 : 0;
  }
  const nlp::Structure& shape = transcribed.structure;
  for (auto* list : {&direction.limits.xl, &direction.limits.xu})
    list->assign(shape.variables, 0.0);
  for (auto* list : {&direction.limits.gl, &direction.limits.gu}) list->assign(shape.rows, 0.0);
  LimitsMoved(problem, transcribed, direction.limits).move(number);
  return direction;
}

Direction direction_between(const Transcribed& from, const Transcribed& to) {
  Direction direction;
  for (std::size_t b = 0; b < from.batches.size(); ++b) {
    const auto before = from.batches[b].data(), after = to.batches[b].data();
    auto& rates = direction.data.emplace_back(before.size());
    for (std::size_t i = 0; i < rates.size(); ++i) rates[i] = after[i] - before[i];
  }
  const auto change = [](const std::vector<double>& before, const std::vector<double>& after) {
    std::vector<double> rates(before.size(), 0.0);
    for (std::size_t i = 0; i < rates.size(); ++i)
      if (std::isfinite(before[i]) && std::isfinite(after[i])) rates[i] = after[i] - before[i];
    return rates;
  };
  direction.limits = {change(from.limits.xl, to.limits.xl), change(from.limits.xu, to.limits.xu),
                      change(from.limits.gl, to.limits.gl), change(from.limits.gu, to.limits.gu)};
  return direction;
}

std::size_t number_named(const std::string& where, const std::string& name,
                         const std::vector<std::string>& known) {
  const auto found = std::find(known.begin(), known.end(), name);
  if (found != known.end()) return static_cast<std::size_t>(found - known.begin());
  const std::string nearest = nearest_name(name, known);
  throw InvalidValue(
      where, "no number '" + name + "'",
      nearest.empty() ? "one of sensitivity_numbers()" : "perhaps '" + nearest + "'");
}

}  // namespace slalom::ocp
