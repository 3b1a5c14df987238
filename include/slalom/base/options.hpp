#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace slalom {

/// What an option can hold. Integers are accepted where a double is wanted.
using OptionValue = std::variant<bool, std::int64_t, double, std::string, std::vector<double>>;

enum class OptionKind { boolean, integer, real, text, choice, vector };

/// The interval (or length, for vectors) an option's value must lie in.
struct OptionRange {
  double lo = -std::numeric_limits<double>::infinity();
  double hi = std::numeric_limits<double>::infinity();
  bool lo_open = false;  ///< lo itself excluded
  bool hi_open = false;  ///< hi itself excluded

  /// Any finite number.
  static OptionRange any() { return {}; }
  static OptionRange positive() { return {.lo = 0, .lo_open = true}; }
  static OptionRange non_negative() { return {.lo = 0}; }
  static OptionRange closed(double lo, double hi) { return {.lo = lo, .hi = hi}; }
  bool contains(double value) const;
  /// e.g. "a number > 0 and <= 10"
  std::string to_string() const;
};

/// Everything about one option except how to reach it in its struct.
struct OptionInfo {
  std::string name;  ///< key in files and on the command line
  OptionKind kind = OptionKind::real;
  OptionRange range;
  std::string unit;                  ///< SI unit, "1" for a pure number, "" for text
  std::string doc;                   ///< what it is and why it has its default
  std::vector<std::string> choices;  ///< for OptionKind::choice
  std::size_t length = 0;            ///< for OptionKind::vector: required length, 0 = any
  std::string source;                ///< where the default comes from (paper's table, equation)

  /// What values it takes, as messages have it: "a number > 0", "one of off, tex".
  std::string rule() const;
  /// Throws InvalidValue(where, ...), with the name as its key, unless `value` has this option's
  /// kind and lies in its range.
  /// Returns the value converted to the option's own kind (an integer given for a real).
  OptionValue checked(const OptionValue& value, const std::string& where) const;
};

/// Text of a value as files have it: 0.5, true, [1, 2].
std::string to_string(const OptionValue& value);

/// The options of a settings struct S. Each is registered once, with name, kind, bounds, unit,
/// reason and access; files, command line and documentation all read this table.
template <class S>
class OptionTable {
 public:
  struct Entry {
    OptionInfo info;
    std::function<void(S&, const OptionValue&)> set;  ///< value already checked
    std::function<OptionValue(const S&)> get;
  };

  OptionTable& real(std::string name, double S::*member, OptionRange range, std::string unit,
                    std::string doc, std::string source = "") {
    return add({{std::move(name),
                 OptionKind::real,
                 range,
                 std::move(unit),
                 std::move(doc),
                 {},
                 0,
                 std::move(source)},
                [member](S& s, const OptionValue& v) { s.*member = std::get<double>(v); },
                [member](const S& s) -> OptionValue { return s.*member; }});
  }
  OptionTable& integer(std::string name, int S::*member, OptionRange range, std::string unit,
                       std::string doc, std::string source = "") {
    return add(
        {{std::move(name),
          OptionKind::integer,
          range,
          std::move(unit),
          std::move(doc),
          {},
          0,
          std::move(source)},
         [member](S& s, const OptionValue& v) {
           s.*member = static_cast<int>(std::get<std::int64_t>(v));
         },
         [member](const S& s) -> OptionValue { return static_cast<std::int64_t>(s.*member); }});
  }
  OptionTable& boolean(std::string name, bool S::*member, std::string doc,
                       std::string source = "") {
    return add(
        {{std::move(name), OptionKind::boolean, {}, "", std::move(doc), {}, 0, std::move(source)},
         [member](S& s, const OptionValue& v) { s.*member = std::get<bool>(v); },
         [member](const S& s) -> OptionValue { return s.*member; }});
  }
  OptionTable& text(std::string name, std::string S::*member, std::string doc) {
    return add({{std::move(name), OptionKind::text, {}, "", std::move(doc), {}, 0, ""},
                [member](S& s, const OptionValue& v) { s.*member = std::get<std::string>(v); },
                [member](const S& s) -> OptionValue { return s.*member; }});
  }
  /// An enum E whose values 0, 1, ... are named by `choices` in that order.
  template <class E>
  OptionTable& choice(std::string name, E S::*member, std::vector<std::string> choices,
                      std::string doc) {
    return add({{std::move(name), OptionKind::choice, {}, "", std::move(doc), choices, 0, ""},
                [member, choices](S& s, const OptionValue& v) {
                  for (std::size_t i = 0; i < choices.size(); ++i)
                    if (choices[i] == std::get<std::string>(v)) s.*member = static_cast<E>(i);
                },
                [member, choices](const S& s) -> OptionValue {
                  return choices.at(static_cast<std::size_t>(s.*member));
                }});
  }
  /// A fixed-length vector of reals; `range` holds for every element.
  template <std::size_t N>
  OptionTable& vector(std::string name, std::array<double, N> S::*member, OptionRange range,
                      std::string unit, std::string doc, std::string source = "") {
    return add({{std::move(name),
                 OptionKind::vector,
                 range,
                 std::move(unit),
                 std::move(doc),
                 {},
                 N,
                 std::move(source)},
                [member](S& s, const OptionValue& v) {
                  const auto& from = std::get<std::vector<double>>(v);
                  for (std::size_t i = 0; i < N; ++i) (s.*member)[i] = from[i];
                },
                [member](const S& s) -> OptionValue {
                  return std::vector<double>((s.*member).begin(), (s.*member).end());
                }});
  }

  /// The number at `index` of a settings struct that is an array.
  OptionTable& element(std::string name, std::size_t index, OptionRange range, std::string unit,
                       std::string doc) {
    return add(
        {{std::move(name), OptionKind::real, range, std::move(unit), std::move(doc), {}, 0, ""},
         [index](S& s, const OptionValue& v) { s[index] = std::get<double>(v); },
         [index](const S& s) -> OptionValue { return s[index]; }});
  }

  /// A list of reals of any length; `range` holds for every element.
  OptionTable& numbers(std::string name, std::vector<double> S::*member, OptionRange range,
                       std::string unit, std::string doc, std::string source = "") {
    return add(
        {{std::move(name),
          OptionKind::vector,
          range,
          std::move(unit),
          std::move(doc),
          {},
          0,
          std::move(source)},
         [member](S& s, const OptionValue& v) { s.*member = std::get<std::vector<double>>(v); },
         [member](const S& s) -> OptionValue { return s.*member; }});
  }

  const std::vector<Entry>& entries() const { return entries_; }
  const Entry* find(std::string_view name) const {
    for (const auto& entry : entries_)
      if (entry.info.name == name) return &entry;
    return nullptr;
  }
  /// Checks and stores one value; throws InvalidValue naming `where`.
  void set(S& settings, const Entry& entry, const OptionValue& value,
           const std::string& where) const {
    entry.set(settings, entry.info.checked(value, where));
  }
  /// Throws InvalidValue naming `where` when a value already stored is outside its range (settings
  /// made in code rather than read from a file).
  void check(const S& settings, const std::string& where) const {
    for (const auto& entry : entries_) (void)entry.info.checked(entry.get(settings), where);
  }

 private:
  OptionTable& add(Entry entry) {
    entries_.push_back(std::move(entry));
    return *this;
  }
  std::vector<Entry> entries_;
};

/// The candidate nearest to `word` by edit distance. Empty when none is near: when the distance is
/// more than 2 and more than a third of the length, or nothing of `word` is left.
std::string nearest_name(std::string_view word, const std::vector<std::string>& candidates);
/// "one of a, b, c (did you mean 'b'?)": what was expected where `word` is none of `names`.
std::string one_of(std::string_view word, const std::vector<std::string>& names);

}  // namespace slalom
