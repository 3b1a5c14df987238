#include "sol_file.hpp"

#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>
#include <sstream>
#include <string_view>

#include "slalom/base/error.hpp"

namespace slalom::nlp {
namespace {

/// The number that a text is, but for spaces around it; whatever the locale.
template <class T>
std::optional<T> whole(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return std::nullopt;
  text = text.substr(first, text.find_last_not_of(" \t") + 1 - first);
  if (text.front() == '+') text.remove_prefix(1);
  T value{};
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (read.ec != std::errc() || read.ptr != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The words of a line.
std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line);
  return {std::istream_iterator<std::string>(in), {}};
}

class Reader {
 public:
  Reader(const std::string& text, const std::string& where) : in_(text), where_(where) {}

  bool next() {
    ++number_;
    if (!std::getline(in_, line_)) return false;
    if (!line_.empty() && line_.back() == '\r') line_.pop_back();
    return true;
  }
  const std::string& line() const { return line_; }

  [[noreturn]] void fail(const std::string& expected) const {
    throw InvalidValue(where_ + ":" + std::to_string(number_),
                       in_ ? "'" + line_ + "'" : std::string("the end of the file"), expected);
  }
  std::size_t count(const char* what) {
    if (!next()) fail(what);
    const auto value = whole<std::size_t>(line_);
    if (!value) fail(what);
    return *value;
  }
  double real(const char* what) {
    if (!next()) fail(what);
    const auto value = whole<double>(line_);
    if (!value || !std::isfinite(*value)) fail(what);
    return *value;
  }

 private:
  std::istringstream in_;
  const std::string& where_;
  std::string line_;
  std::size_t number_ = 0;
};

void read_message(Reader& reader, SolFile& sol) {
  for (;;) {
    if (!reader.next()) reader.fail("a line 'Options'");
    if (reader.line() == "Options") return;
    if (reader.line().empty()) continue;
    sol.message += (sol.message.empty() ? "" : "; ") + reader.line();
  }
}

/// They are those of the .nl file's first line.
void skip_options(Reader& reader) {
  const std::size_t options = reader.count("the number of options");
  for (std::size_t i = 0; i < options; ++i) (void)reader.count("an option");
}

std::vector<double> read_numbers(Reader& reader, std::size_t count, const char* what) {
  std::vector<double> numbers;
  numbers.reserve(count);
  for (std::size_t i = 0; i < count; ++i) numbers.push_back(reader.real(what));
  return numbers;
}

/// suffix KIND COUNT NAME_LENGTH TABLE_LENGTH TABLE_LINES; of variables (kind 0) and real (4).
void read_suffix(Reader& reader, std::size_t variables, SolFile& sol) {
  const auto head = words_of(reader.line());
  std::size_t numbers[5] = {};  // kind, count, length of the name, of the table, its lines
  if (head.size() != 6) reader.fail("five numbers after 'suffix'");
  for (std::size_t i = 0; i < 5; ++i) {
    const auto number = whole<std::size_t>(head[i + 1]);
    if (!number) reader.fail("five numbers after 'suffix'");
    numbers[i] = *number;
  }
  const auto [kind, count, name_length, table_length, table_lines] = numbers;
  if (!reader.next()) reader.fail("a suffix's name");
  const std::string name = reader.line();
  for (std::size_t i = 0; i < table_lines; ++i)
    if (!reader.next()) reader.fail("a line of a suffix's table");
  const bool wanted = (kind & 3) == 0 && (kind & 4) != 0;
  auto& list = wanted ? sol.variable_suffixes[name] : sol.variable_suffixes[""];
  if (wanted) list.assign(variables, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    if (!reader.next()) reader.fail("an index and a number");
    const auto pair = words_of(reader.line());
    if (pair.size() != 2) reader.fail("an index and a number");
    const auto index = whole<std::size_t>(pair[0]);
    const auto value = whole<double>(pair[1]);
    if (!index || !value || !std::isfinite(*value)) reader.fail("an index and a finite number");
    if (!wanted) continue;
    if (*index >= variables) reader.fail("the index of a variable");
    list[*index] = *value;
  }
}

}  // namespace

SolFile read_sol(const std::string& text, std::size_t variables, std::size_t rows,
                 const std::string& where) {
  Reader reader(text, where);
  SolFile sol;
  read_message(reader, sol);
  skip_options(reader);
  const std::string rows_rule = std::to_string(rows) + " rows, as the .nl file has";
  const std::string variables_rule = std::to_string(variables) + " variables, as the .nl file has";
  if (reader.count("the number of rows") != rows) reader.fail(rows_rule);
  const std::size_t duals = reader.count("the number of duals");
  if (duals != 0 && duals != rows) reader.fail("0 or " + rows_rule);
  if (reader.count("the number of variables") != variables) reader.fail(variables_rule);
  const std::size_t primals = reader.count("the number of values");
  if (primals != 0 && primals != variables) reader.fail("0 or " + variables_rule);
  sol.y = read_numbers(reader, duals, "a row's multiplier");
  sol.x = read_numbers(reader, primals, "a variable's value");
  while (reader.next()) {
    if (reader.line().rfind("objno", 0) == 0) {
      const auto line = words_of(reader.line());
      if (line.size() != 3 || !whole<int>(line[1]) || !whole<int>(line[2]))
        reader.fail("two integers after 'objno'");
      sol.result = *whole<int>(line[2]);
    } else if (reader.line().rfind("suffix", 0) == 0) {
      read_suffix(reader, variables, sol);
    }
  }
  sol.variable_suffixes.erase("");
  return sol;
}

}  // namespace slalom::nlp
