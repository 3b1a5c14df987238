#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "document.hpp"
#include "slalom/base/options.hpp"

namespace slalom::io {

/// Where each key of a scenario was last given, by its path ("planner.w_t", "obstacles.O2").
using Places = std::map<std::string, Place>;

/// A key of a section and the setting behind it.
struct Field {
  OptionInfo info;
  std::function<void(const OptionValue&)> store;  ///< value already checked
  std::function<OptionValue()> load;
  std::vector<std::string> excludes = {};  ///< keys that set the same thing and are written instead

  /// Whether the key is `excludes[0]` in degrees.
  bool in_degrees() const { return !excludes.empty() && info.name == excludes[0] + "_deg"; }
};

/// The keys of one map of a configuration file, bound to one settings struct. A section reads a map
/// strictly and takes single values from the command line.
class Section {
 public:
  /// `path` prefixes every key in Places and in messages, e.g. "planner".
  explicit Section(std::string path) : path_(std::move(path)) {}

  /// Adds all options of `table`, bound to `settings`, which must outlive the section.
  template <class S>
  Section& add(const OptionTable<S>& table, S& settings) {
    for (const auto& entry : table.entries())
      add({entry.info,
           [&entry, &settings](const OptionValue& value) { entry.set(settings, value); },
           [&entry, &settings] { return entry.get(settings); }});
    return *this;
  }
  Section& add(Field field);
  /// Lets `key`_deg set the angle `key` in degrees; 90 gives pi/2 to the bit.
  Section& add_degrees(const std::string& key);

  const std::string& path() const { return path_; }
  const std::vector<Field>& fields() const { return fields_; }
  std::vector<std::string> keys() const;
  /// The field of that key, or nullptr.
  const Field* find(const std::string& key) const;

  /// Reads every member of `map`; `others` are keys the caller reads itself. Throws InvalidValue
  /// for an unknown key (with the nearest known one), a wrong kind or unit, a value out of range
  /// and two keys that exclude each other.
  void read(const Value& map, Places& places, const std::vector<std::string>& others = {}) const;
  /// Sets one key; `key_place` is for messages about the key, `value.place` for the value, which
  /// becomes the place of the keys too that set the same thing.
  void set(const std::string& key, const Value& value, const Place& key_place,
           Places& places) const;

 private:
  std::string path_;
  std::vector<Field> fields_;
};

/// What values files may have for an option, as messages have it.
std::string rule_of(const OptionInfo& info);

/// Throws InvalidValue at `place`: an unknown key of `path`, with the nearest of `known`.
[[noreturn]] void unknown_key(const std::string& key, const Place& place, const std::string& path,
                              const std::vector<std::string>& known);

/// Throws InvalidValue unless `value` is a map; `content` says what it should hold.
void require_map(const Value& value, const std::string& content);
/// The value of `key` in a map, which `what` names; throws InvalidValue where there is none.
const Value& require_key(const Value& map, const std::string& what, const std::string& key);

/// What the scalar, list or {value, unit, source} map means for an option of this kind. Throws
/// InvalidValue for another unit than the option's, and for values no option can hold.
OptionValue to_option_value(const OptionInfo& info, const Value& value);

/// The text of a scalar; throws InvalidValue for anything else.
const std::string& to_text(const Value& value, const std::string& what);
/// The items of a list; throws InvalidValue for anything else. `content` says what was expected.
const std::vector<Value>& items_of(const Value& list, const std::string& content);

/// Each item of a list of maps, as the table has it; keys that are left out keep S's defaults.
template <class S>
std::vector<S> read_list(const Value& list, const std::string& path, const OptionTable<S>& table) {
  std::vector<S> result;
  Places places;
  for (const auto& item : items_of(list, "a list of " + path)) {
    S one;
    Section(path).add(table, one).read(item, places);
    result.push_back(std::move(one));
  }
  return result;
}

}  // namespace slalom::io
