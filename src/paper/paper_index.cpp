#include "paper_index.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <regex>

#include "../io/section.hpp"
#include "claims.hpp"
#include "paper_files.hpp"
#include "slalom/base/error.hpp"
#include "slalom/io/scenario_file.hpp"

namespace slalom::paper {
namespace {

/// The texts of a scalar or of a list of scalars.
std::vector<std::string> texts_of(const io::Value& value) {
  if (value.kind != io::Value::Kind::sequence) return {io::to_text(value, "a value")};
  std::vector<std::string> texts;
  for (const auto& item : value.items) texts.push_back(io::to_text(item, "a value"));
  return texts;
}

/// Ours at "section.key" of a resolved scenario; of obstacles, a column over all.
std::vector<std::string> resolved(const io::Value& scenario, const std::string& path) {
  const auto dot = path.find('.');
  const auto key = path.substr(dot + 1);
  const io::Value* section = scenario.find(path.substr(0, dot));
  if (section == nullptr) return {};
  std::vector<std::string> column;
  for (const auto& item : section->items)
    if (const auto* value = item.find(key)) column.push_back(io::to_text(*value, "a value"));
  const auto* value = section->find(key);
  return value != nullptr ? texts_of(*value) : column;
}

const OptionTable<io::ScenarioRequest>& source_options() {
  using R = io::ScenarioRequest;
  static const auto table = [] {
    OptionTable<R> t;
    t.text("scenario", &R::name_or_file, "Whose values ours are.");
    return t;
  }();
  return table;
}

const OptionTable<IndexRow>& row_options() {
  static const auto table = [] {
    OptionTable<IndexRow> t;
    t.text("of", &IndexRow::of, "Table or figure of the paper.")
        .text("command", &IndexRow::command, "What makes ours.")
        .text("where", &IndexRow::where, "Where ours stands.");
    return t;
  }();
  return table;
}

std::string filled(const io::Value* text, const Context& context) {
  try {
    return text == nullptr ? "–" : Template(*text).fill(context);
  } catch (const NotDriven& missing) {
    if (context.evidence->whole)
      throw InvalidValue(text->place.to_string(), "'" + missing.what + "'", "what is driven");
    return "–";
  }
}

}  // namespace

std::vector<std::string> expanded(const io::Value& value) {
  static const std::regex times(R"((\d+) x (\S+))"), span(R"((\d+):(\d+):(\d+))");
  std::vector<std::string> values;
  for (const auto& text : texts_of(value)) {
    std::smatch found;
    if (std::regex_match(text, found, times)) {
      values.insert(values.end(), std::stoul(found[1]), found[2].str());
    } else if (std::regex_match(text, found, span)) {
      for (int v = std::stoi(found[1]); v <= std::stoi(found[3]); v += std::stoi(found[2]))
        values.push_back(std::to_string(v));
    } else {
      values.push_back(text);
    }
  }
  return values;
}

bool agrees(const std::string& printed, double ours) {
  const auto dot = printed.find('.');
  const auto decimals = dot == std::string::npos ? 0 : printed.size() - dot - 1;
  return fmt::format("{:.{}f}", ours, decimals) ==
         fmt::format("{:.{}f}", std::strtod(printed.c_str(), nullptr), decimals);
}

std::string compare_parameters(const std::string& table) {
  const io::Value root = read_map("tables.yaml", {"veh", "parama", "enva", "envc"});
  const auto* own = root.find(table);
  if (own == nullptr) throw InvalidValue(table, "no such table", "one of config/paper/tables.yaml");
  io::ScenarioRequest request;
  io::Places places;
  io::Section(table).add(source_options(), request).read(*own, places, {"planner", "values"});
  if (const auto* planner = own->find("planner")) request.planner = planner->text;
  const auto scenario =
      io::parse_text(io::to_yaml(io::load_scenario(request)), table, "a scenario");
  std::size_t count = 0;
  std::vector<std::string> others;
  for (const auto& item : io::items_of(*own->find("values"), "a list of values")) {
    const auto& key = item.find("key")->text;
    const auto printed = expanded(*item.find("value")), ours = resolved(scenario, key);
    count += printed.size();
    for (std::size_t i = 0; i < printed.size(); ++i) {
      const auto place = printed.size() > 1 ? fmt::format("{}[{}]", key, i + 1) : key;
      const auto mine = printed.size() == ours.size() ? ours[i] : "–";
      if (mine == "–" || !agrees(printed[i], std::strtod(mine.c_str(), nullptr)))
        others.push_back(fmt::format("{} {}, ours {}", place, printed[i], mine));
    }
  }
  return fmt::format("{} of {} values as printed", count - others.size(), count) +
         (others.empty() ? "" : fmt::format("; differ: {}", fmt::join(others, ", ")));
}

std::vector<IndexRow> paper_index(const Evidence& evidence) {
  const io::Value root = read_map("index.yaml", {"rows"});
  const Context context{&evidence, nullptr, evidence.trials, nullptr};
  std::vector<IndexRow> rows;
  for (const auto& item : io::items_of(*root.find("rows"), "a list of tables and figures")) {
    IndexRow row;
    io::Places places;
    io::Section("rows").add(row_options(), row).read(item, places, {"ours", "printed"});
    row.ours = filled(item.find("ours"), context);
    row.printed = filled(item.find("printed"), context);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace slalom::paper
