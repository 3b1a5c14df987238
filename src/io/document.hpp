#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "slalom/base/error.hpp"

namespace slalom::io {

/// Where a value stands: a line and column of a file (1-based), or an option of the command line.
struct Place {
  std::string source;  ///< file as the user named it, or e.g. "--set planner.w_t"
  int line = 0;        ///< 0: no line, as on the command line
  int column = 0;

  /// "file:line:column", or the option alone.
  std::string to_string() const;
};

struct Member;

/// A YAML value with its place. Scalars keep their text: what it means depends on the key.
struct Value {
  enum class Kind { null, scalar, sequence, map };

  Kind kind = Kind::null;
  Place place;
  std::string text;             ///< of a scalar
  bool quoted = false;          ///< a quoted scalar is text, whatever it looks like
  std::vector<Value> items;     ///< of a sequence
  std::vector<Member> members;  ///< of a map, in file order; keys are unique

  /// The value of `key`, or nullptr.
  const Value* find(const std::string& key) const;
  /// "a map", "text 'abc'", ... for messages.
  std::string describe() const;
};

struct Member {
  std::string key;
  Place place;  ///< of the key
  Value value;
};

/// Limits that end hostile input within a second or two; real files stay far below them.
inline constexpr std::size_t kMaxDocumentBytes = 12 << 20;
inline constexpr std::size_t kMaxNodes = 400000;
inline constexpr std::size_t kMaxDepth = 32;

/// Reads the single YAML document of a file. Throws InvalidValue naming the place for a missing or
/// unreadable file, a folder, an empty, binary or too large file, a YAML error, an alias, a doubled
/// or non-scalar key, and nesting or size beyond the limits. `content` names what the file should
/// hold, e.g. "a scenario".
Value parse_file(const std::filesystem::path& file, const std::string& content);

/// The same for text that came from `source`; positions count from 1:1.
Value parse_text(const std::string& text, const std::string& source, const std::string& content);

/// The value of a command-line assignment; every place in it is `source` alone.
Value parse_argument(const std::string& text, const std::string& source);

}  // namespace slalom::io
