#include "number_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "csv.hpp"
#include "slalom/base/error.hpp"
#include "text_file.hpp"

namespace slalom::io {
namespace {

constexpr std::size_t kMostBytes = 64U << 20U;  // a day's drive in cycles of 10 ms

}  // namespace

std::vector<double> read_numbers(const OptionInfo& info, const Value& name) {
  const auto column = info.name == "solve_times" ? std::string("solve_time_s") : info.name;
  auto file = std::filesystem::path(name.text);
  if (file.is_relative() && name.place.line > 0)
    file = std::filesystem::path(name.place.source).parent_path() / file;
  CsvRows rows(read_file(file, kMostBytes, fmt::format("a file of {}", info.name)));
  std::vector<double> numbers;
  std::size_t at = 0;
  bool first = true;
  while (const auto texts = rows.next()) {
    const auto where = fmt::format("{}:{}", file.string(), rows.line());
    if (std::exchange(first, false) && !csv_number(texts->front())) {
      const auto found = std::find(texts->begin(), texts->end(), column);
      if (found == texts->end())
        throw InvalidValue(where, "no such column",
                           fmt::format("the column {}, or one number a line", column));
      at = static_cast<std::size_t>(found - texts->begin());
      continue;
    }
    const auto value = at < texts->size() ? csv_number((*texts)[at]) : std::nullopt;
    if (!value)
      throw InvalidValue(where,
                         at < texts->size() ? fmt::format("'{}'", (*texts)[at]) : "too few cells",
                         "a finite number");
    numbers.push_back(*value);
  }
  if (numbers.empty()) throw InvalidValue(file.string(), "no numbers", "at least one");
  return numbers;
}

}  // namespace slalom::io
