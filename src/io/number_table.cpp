#include "number_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "csv.hpp"
#include "section.hpp"
#include "text_file.hpp"

namespace slalom::io {
namespace {

namespace fs = std::filesystem;
using Row = std::vector<double>;

constexpr std::size_t kMostBytes = 16U << 20U;
constexpr std::size_t kMostRows = 100'000;

std::string in_words(const std::vector<Column>& columns) {
  std::vector<std::string> names;
  for (const auto& column : columns)
    names.push_back(column.may_be_absent ? column.names[0] + " (or without)" : column.names[0]);
  return fmt::format("{}", fmt::join(names, ", "));
}

std::size_t fewest(const std::vector<Column>& columns) {
  return static_cast<std::size_t>(std::count_if(columns.begin(), columns.end(),
                                                [](const auto& c) { return !c.may_be_absent; }));
}

std::vector<Row> rows_of_list(const Value& list, const std::vector<Column>& columns,
                              const std::string& what) {
  std::vector<Row> rows;
  for (const Value& item : list.items) {
    Row row;
    for (const Value& number : items_of(item, fmt::format("{}: {}", what, in_words(columns)))) {
      const auto value =
          number.kind == Value::Kind::scalar ? csv_number(number.text) : std::nullopt;
      if (!value)
        throw InvalidValue(number.place.to_string(), number.describe(), "a finite number");
      row.push_back(*value);
    }
    const std::size_t wanted = rows.empty() ? row.size() : rows[0].size();
    if (row.size() < fewest(columns) || row.size() > columns.size() || row.size() != wanted)
      throw InvalidValue(
          item.place.to_string(), fmt::format("{} with {} numbers", what, row.size()),
          rows.empty() ? in_words(columns) : fmt::format("{} as in the first", wanted));
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Where each column stands in a file whose first line has these cells.
std::vector<std::size_t> places_of(const std::vector<Column>& columns,
                                   const std::vector<std::string>& cells,
                                   const std::string& where) {
  std::vector<std::size_t> places;
  for (const auto& column : columns) {
    const auto found = std::find_if(cells.begin(), cells.end(), [&](const auto& cell) {
      return std::find(column.names.begin(), column.names.end(), cell) != column.names.end();
    });
    if (found != cells.end())
      places.push_back(static_cast<std::size_t>(found - cells.begin()));
    else if (!column.may_be_absent)
      throw InvalidValue(where, fmt::format("no column {}", column.names[0]),
                         fmt::format("a first line with the columns {}", in_words(columns)));
  }
  return places;
}

std::vector<Row> rows_of_file(const Value& name, const std::vector<Column>& columns,
                              const std::string& what) {
  fs::path file = name.text;
  if (file.is_relative() && name.place.line > 0)
    file = fs::path(name.place.source).parent_path() / file;
  CsvRows lines(read_file(file, kMostBytes, fmt::format("a file with {}", what)));
  std::vector<Row> rows;
  std::vector<std::size_t> places;
  bool first = true;
  while (const auto line = lines.next()) {
    const auto& cells = *line;
    const auto where = fmt::format("{}:{}", file.string(), lines.line());
    if (std::exchange(first, false)) {
      places = places_of(columns, cells, where);
      continue;
    }
    Row row;
    for (const std::size_t place : places) {
      const auto number = place < cells.size() ? csv_number(cells[place]) : std::nullopt;
      if (!number)
        throw InvalidValue(
            where, place < cells.size() ? fmt::format("'{}'", cells[place]) : "too few cells",
            "a finite number");
      row.push_back(*number);
    }
    rows.push_back(std::move(row));
    if (rows.size() > kMostRows)
      throw InvalidValue(where, fmt::format("more than {} rows", kMostRows), "fewer");
  }
  return rows;
}

}  // namespace

std::vector<std::vector<double>> read_rows(const Value& value, const std::vector<Column>& columns,
                                           const std::string& what) {
  if (value.kind == Value::Kind::sequence) return rows_of_list(value, columns, what);
  if (value.kind == Value::Kind::scalar) return rows_of_file(value, columns, what);
  throw InvalidValue(value.place.to_string(), value.describe(),
                     fmt::format("a list of {}, or the name of a CSV file with such", what));
}

}  // namespace slalom::io
