#include "settings.hpp"

#include <algorithm>
#include <cstdint>

#include "slalom/base/error.hpp"
#include "slalom/base/options.hpp"
#include "slalom/ocp/moments.hpp"

namespace slalom::python {
namespace {

/// Entry k of a choice that is one for all or a list.
template <class T>
const T& entry(const std::variant<T, std::vector<T>>& choice, std::size_t k) {
  if (const auto* one = std::get_if<T>(&choice)) return *one;
  return std::get<std::vector<T>>(choice)[k];
}

template <class T>
void check_length(const std::variant<T, std::vector<T>>& choice, std::size_t intervals,
                  const std::string& where) {
  if (const auto* list = std::get_if<std::vector<T>>(&choice); list && list->size() != intervals)
    throw InvalidValue(where, std::to_string(list->size()) + " entries",
                       std::to_string(intervals) + ", one for each interval, or one for all");
}

/// Of an interval, where the scheme has a choice and the user made none.
constexpr int kPoints = 4;

/// Warns of points for schemes that all have a number of their own.
void warn_of_unused_points(const SchemeChoice& choice, const std::string& where) {
  const auto* one = std::get_if<std::string>(&choice);
  const auto names = one ? std::vector{*one} : std::get<std::vector<std::string>>(choice);
  if (std::any_of(names.begin(), names.end(), ocp::has_choice_of_points)) return;
  warn(where + ": points do nothing with " + names.front() +
       ", which has its own; lgr, lgr_differential, lgr_flipped and lgl have a choice");
}

template <class List>
std::string names_of(const List& list) {
  std::string names;
  for (const auto& each : list) names += (names.empty() ? "" : ", ") + each.name;
  return names;
}

}  // namespace

OptionValue option_value(nb::handle given, const std::string& name) {
  nb::object value = nb::borrow(given);
  if (nb::hasattr(value, "dtype") && nb::hasattr(value, "item")) value = value.attr("item")();
  if (nb::isinstance<nb::bool_>(value)) return nb::cast<bool>(value);
  std::int64_t whole = 0;  // what is too large for it is out of every option's range as a real, too
  if (nb::isinstance<nb::int_>(value) && nb::try_cast(value, whole)) return whole;
  if (nb::isinstance<nb::str>(value)) return nb::cast<std::string>(value);
  return as<double>(value, "option " + name, "a number, a word or a truth value");
}

void check_alike(const ocp::Problem& problem, const ocp::Problem& earlier) {
  const auto form = [](const ocp::Problem& p) {
    return "states " + names_of(p.states()) + "; controls " + names_of(p.controls()) +
           "; static parameters " + names_of(p.static_parameters()) + "; slacks " +
           names_of(p.slacks()) + "; integrals " + names_of(p.integrals());
  };
  if (form(problem) != form(earlier))
    throw InvalidValue(problem.name() + ": warm_start", form(earlier), form(problem));
}

void check_at_most(std::int64_t value, std::int64_t most, const std::string& where) {
  if (value > most)
    throw InvalidValue(where, std::to_string(value), "at most " + std::to_string(most));
}

namespace {

/// A mistyped size shall not take all memory. Nothing interrupts the making of the schemes'
/// matrices, which comes before the set-up.
constexpr int kMostIntervals = 200'000, kMostPoints = 100;
constexpr double kMostEntries = 4e6;  ///< of all intervals' differentiation matrices together

void check_sizes(const MeshChoice& mesh, const PointsChoice::value_type& points,
                 const std::string& where) {
  const auto* count = std::get_if<int>(&mesh);
  const auto intervals =
      count ? std::int64_t{*count}
            : static_cast<std::int64_t>(std::get<std::vector<double>>(mesh).size());
  check_at_most(intervals, kMostIntervals, where + ": mesh");
  double entries = 0;
  const auto add = [&](int number, std::int64_t times) {
    check_at_most(number, kMostPoints, where + ": points");
    entries += static_cast<double>(times) * number * number;
  };
  if (const auto* one = std::get_if<int>(&points))
    add(*one, intervals);
  else
    for (const int number : std::get<std::vector<int>>(points)) add(number, 1);
  if (entries > kMostEntries)
    throw InvalidValue(where + ": mesh, points",
                       std::to_string(intervals) + " intervals of so many points",
                       "intervals times the square of their points of at most 4e6");
}

}  // namespace

ocp::PhasedTranscription::Grid grid_of(const GridChoice& choice, const std::string& where) {
  check_sizes(choice.mesh, choice.points.value_or(kPoints), where);
  const auto* intervals = std::get_if<int>(&choice.mesh);
  const auto mesh = intervals ? ocp::Mesh::uniform(*intervals)
                              : ocp::Mesh(std::get<std::vector<double>>(choice.mesh));
  check_length(choice.scheme, mesh.intervals(), where + ": scheme");
  const auto points = choice.points.value_or(kPoints);
  check_length(points, mesh.intervals(), where + ": points");
  if (choice.points) warn_of_unused_points(choice.scheme, where);
  if (choice.scheme.index() == 0 && points.index() == 0)
    return {mesh, ocp::scheme(std::get<0>(choice.scheme), std::get<0>(points))};
  std::vector<ocp::Scheme> schemes;
  for (std::size_t k = 0; k < mesh.intervals(); ++k)
    schemes.push_back(ocp::scheme(entry(choice.scheme, k), entry(points, k)));
  return {mesh, ocp::Schemes(std::move(schemes))};
}

bool same_grid(const ocp::Solution& answer, const ocp::PhasedTranscription::Grid& grid) {
  if (answer.mesh.breakpoints() != grid.mesh.breakpoints()) return false;
  for (std::size_t k = 0; k < grid.mesh.intervals(); ++k) {
    const auto &a = answer.scheme.of(k), &b = grid.schemes.of(k);
    if (a.name != b.name || a.points != b.points) return false;
  }
  return true;
}

nlp::Options options_of(const nb::kwargs& given, const std::vector<std::string>& others) {
  nlp::Options options;
  const auto& table = nlp::solver_options();
  for (const auto& [key, value] : given) {
    const auto name = nb::cast<std::string>(key);
    const auto* entry = table.find(name);
    if (entry == nullptr) {
      std::vector<std::string> names = {"mesh",  "scheme",     "points", "backend",
                                        "guess", "warm_start", "phases"};
      names.insert(names.end(), others.begin(), others.end());
      for (const auto& each : table.entries()) names.push_back(each.info.name);
      const auto nearest = nearest_name(name, names);
      throw InvalidValue("solve", "option '" + name + "'",
                         nearest.empty() ? std::string("an option of slalom.solver_options()")
                                         : "perhaps '" + nearest + "'");
    }
    const auto wanted = option_value(value, name);
    if (wanted == entry->get(options)) continue;  // a default may be what nobody could set
    table.set(options, *entry, wanted, "solve: " + name);
  }
  return options;
}

ocp::SolveSettings settings_of(const ocp::Problem& problem, const GridChoice& choice,
                               const std::string& backend, nb::handle guess,
                               const Solved* warm_start, const nb::kwargs& options,
                               const std::vector<std::string>& keywords) {
  const auto grid = with_moments(problem, grid_of(choice, problem.name()));
  ocp::SolveSettings settings;
  settings.mesh = grid.mesh;
  settings.scheme = grid.schemes;
  settings.backend = backend;
  settings.options = options_of(options, keywords);
  settings.guess = guess_of(problem, guess);
  if (warm_start == nullptr) return settings;
  check_alike(problem, *warm_start->problem);
  settings.previous = &warm_start->answer;  // where there is no point, or none that fits
  if (same_grid(warm_start->answer, grid)) settings.warm_start = warm_start->answer.point;
  return settings;
}

}  // namespace slalom::python
