#include "symbols.hpp"

#include "slalom/base/error.hpp"

namespace slalom::ocp {

Symbols::Symbols(const Problem& problem) : problem_(problem) {
  const auto learn = [&](const Expr& symbol, Meaning meaning) {
    meaning_.emplace(symbol.node(), meaning);
  };
  using Kind = Meaning::Kind;
  for (std::size_t i = 0; i < problem_.states().size(); ++i) {
    learn(problem_.states()[i].symbol, {Kind::state, i});
    learn(problem_.states()[i].initial_symbol, {Kind::initial, i});
    learn(problem_.states()[i].final_symbol, {Kind::final, i});
  }
  for (std::size_t i = 0; i < problem_.controls().size(); ++i)
    learn(problem_.controls()[i].symbol, {Kind::control, i});
  for (std::size_t i = 0; i < problem_.slacks().size(); ++i)
    learn(problem_.slacks()[i].symbol, {Kind::slack, i});
  for (std::size_t i = 0; i < problem_.static_parameters().size(); ++i)
    learn(problem_.static_parameters()[i].symbol, {Kind::static_parameter, i});
  for (std::size_t i = 0; i < problem_.integrals().size(); ++i)
    learn(problem_.integrals()[i].symbol, {Kind::integral, i});
  for (std::size_t i = 0; i < problem_.parameters().size(); ++i)
    learn(problem_.parameters()[i].symbol, {Kind::parameter, i});
  learn(problem_.initial_time(), {Kind::t0, 0});
  learn(problem_.final_time(), {Kind::tf, 0});
  learn(problem_.tau(), {Kind::tau, 0});
  learn(problem_.time(), {Kind::time, 0});
}

const Meaning* Symbols::find(const Expr& symbol) const {
  const auto it = meaning_.find(symbol.node());
  return it == meaning_.end() ? nullptr : &it->second;
}

template <class F>
void Symbols::for_symbols(const Expr& value, F see) const {
  for (const auto& symbol : expr::symbols_of({value})) {
    const auto it = meaning_.find(symbol.node());
    if (it != meaning_.end()) see(it->second, symbol);
  }
}

End Symbols::end_of(const Expr& value, const std::string& name) const {
  End end = End::initial;
  for_symbols(value, [&](Meaning meaning, const Expr& symbol) {
    using Kind = Meaning::Kind;
    switch (meaning.kind) {
      case Kind::final:
        end = End::final;
        break;
      case Kind::slack:
        if (problem_.slacks()[meaning.index].end == End::final) end = End::final;
        break;
      case Kind::state:
      case Kind::control:
      case Kind::tau:
      case Kind::time:
        throw InvalidValue(problem_.name() + ": " + name, "'" + symbol.name() + "'",
                           "end values only: initial(x), final(x), t0, tf, parameters");
      default:
        break;
    }
  });
  return end;
}

Lifts Symbols::find_lifts() const {
  Lifts lifts{std::vector<char>(problem_.states().size(), 0),
              std::vector<char>(problem_.states().size(), 0)};
  const auto note = [&](const Expr& value, bool at_initial, bool at_final) {
    for_symbols(value, [&](Meaning meaning, const Expr&) {
      if (meaning.kind == Meaning::Kind::initial && !at_initial) lifts.initial[meaning.index] = 1;
      if (meaning.kind == Meaning::Kind::final && !at_final) lifts.final[meaning.index] = 1;
    });
  };
  const auto note_boundary = [&](const Expr& value, const std::string& name) {
    const End end = end_of(value, name);
    note(value, end == End::initial, end == End::final);
  };
  for (const auto& state : problem_.states()) note(state.rate, false, false);
  for (const auto& integral : problem_.integrals()) note(integral.integrand, false, false);
  for (const auto& cost : problem_.costs()) {
    if (!cost.enabled) continue;
    cost.at_end() ? note_boundary(cost.value, cost.name) : note(cost.value, false, false);
  }
  for (const auto& row : problem_.constraints()) {
    if (absent(row, row.kind)) continue;
    row.kind == Problem::Kind::boundary ? note_boundary(row.value, row.name)
                                        : note(row.value, false, false);
  }
  return lifts;
}

bool absent(const Problem::Constraint& row, Problem::Kind kind) {
  return !row.enabled || row.kind != kind || !row.bounds.bounded() ||
         (kind == Problem::Kind::family && row.member_values.empty());
}

bool is_fixed(const Problem::Variable& time) {
  return time.bounds.lower == time.bounds.upper;
}

}  // namespace slalom::ocp
