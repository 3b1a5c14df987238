#include "csv.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "number.hpp"

namespace slalom::io {

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::vector<std::string> csv_cells(const std::string& line) {
  std::vector<std::string> all(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      all.back() += line[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      all.emplace_back();
    } else if (c != '\r') {
      all.back() += c;
    }
  }
  return all;
}

std::optional<double> csv_number(const std::string& text) {
  const auto number = read_number(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::optional<std::vector<std::string>> CsvRows::next() {
  constexpr const char* kBlanks = " \t\r";
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // with which spreadsheets begin
  for (std::string line; std::getline(lines_, line);) {
    if (++line_ == 1 && line.starts_with(kByteOrderMark)) line.erase(0, kByteOrderMark.size());
    const auto begin = line.find_first_not_of(kBlanks);
    if (begin == std::string::npos) continue;
    if (std::exchange(first_, false) && line[begin] == '#') line.erase(0, begin + 1);
    auto cells = csv_cells(line);
    for (auto& cell : cells) {
      cell.erase(0, std::min(cell.find_first_not_of(kBlanks), cell.size()));
      cell.erase(cell.find_last_not_of(kBlanks) + 1);
    }
    return cells;
  }
  return std::nullopt;
}

}  // namespace slalom::io
