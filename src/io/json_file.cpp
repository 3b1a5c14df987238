#include "json_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "slalom/base/error.hpp"
#include "text_file.hpp"

namespace slalom::io {

Json json_number(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
}

Json json_numbers(const std::vector<double>& list) {
  Json json = Json::array();
  for (const double value : list) json.push_back(json_number(value));
  return json;
}

Json json_point(const nlp::Start& point) {
  return {{"x", json_numbers(point.x)},
          {"y", json_numbers(point.y)},
          {"zl", json_numbers(point.zl)},
          {"zu", json_numbers(point.zu)}};
}

Json json_options(const nlp::Options& options) {
  Json json;
  for (const auto& entry : nlp::solver_options().entries()) {
    const OptionValue value = entry.get(options);
    if (const auto* real = std::get_if<double>(&value)) json[entry.info.name] = json_number(*real);
    if (const auto* whole = std::get_if<std::int64_t>(&value)) json[entry.info.name] = *whole;
    if (const auto* yes = std::get_if<bool>(&value)) json[entry.info.name] = *yes;
    if (const auto* text = std::get_if<std::string>(&value)) json[entry.info.name] = *text;
  }
  return json;
}

JsonReader::JsonReader(std::string file, std::string content, const Json& json, std::string path)
    : file_(std::move(file)), content_(std::move(content)), path_(std::move(path)), json_(json) {}

void JsonReader::refuse(const std::string& found, const std::string& expected) const {
  throw InvalidValue(where(), found, expected);
}

JsonReader JsonReader::at(const std::string& key) const {
  if (!has(key)) refuse(fmt::format("no '{}'", key), content_);
  return {file_, content_, json_.at(key), path_.empty() ? key : path_ + "." + key};
}
JsonReader JsonReader::at(std::size_t index) const {
  return {file_, content_, json_.at(index), fmt::format("{}[{}]", path_, index)};
}
std::size_t JsonReader::size() const {
  if (!json_.is_array()) refuse(shown(), "a list");
  return json_.size();
}

double JsonReader::real() const {
  if (json_.is_number()) return json_.get<double>();
  if (json_ == "nan") return std::numeric_limits<double>::quiet_NaN();
  if (json_ == "inf") return std::numeric_limits<double>::infinity();
  if (json_ == "-inf") return -std::numeric_limits<double>::infinity();
  refuse(shown(), "a number");
}
int JsonReader::whole() const {
  if (!json_.is_number_integer() || !std::in_range<int>(json_.get<std::int64_t>()))
    refuse(shown(), "an integer");
  return json_.get<int>();
}
std::size_t JsonReader::count() const {
  if (!json_.is_number_unsigned()) refuse(shown(), "an integer >= 0");
  return json_.get<std::size_t>();
}
bool JsonReader::flag() const {
  if (!json_.is_boolean()) refuse(shown(), "true or false");
  return json_.get<bool>();
}
std::string JsonReader::text() const {
  if (!json_.is_string()) refuse(shown(), "text");
  return json_.get<std::string>();
}

std::vector<double> JsonReader::list() const {
  if (!json_.is_array()) refuse(shown(), "a list of numbers");
  std::vector<double> result;
  for (std::size_t i = 0; i < json_.size(); ++i) result.push_back(at(i).real());
  return result;
}
std::vector<std::vector<double>> JsonReader::table(std::size_t width) const {
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i < size(); ++i) {
    rows.push_back(at(i).list());
    if (rows.back().size() != width)
      at(i).refuse(fmt::format("{} numbers", rows.back().size()), fmt::format("{}", width));
  }
  return rows;
}
std::vector<std::string> JsonReader::texts() const {
  std::vector<std::string> result;
  for (std::size_t i = 0; i < size(); ++i) result.push_back(at(i).text());
  return result;
}
std::vector<std::size_t> JsonReader::counts() const {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < size(); ++i) result.push_back(at(i).count());
  return result;
}

nlp::Start JsonReader::point() const {
  return {at("x").list(), at("y").list(), at("zl").list(), at("zu").list()};
}

nlp::Options JsonReader::options() const {
  nlp::Options options;
  for (const auto& entry : nlp::solver_options().entries()) {
    // Recordings older than the options in words lack them.
    if (entry.info.kind == OptionKind::text && !has(entry.info.name)) continue;
    const JsonReader value = at(entry.info.name);
    OptionValue read;
    switch (entry.info.kind) {
      case OptionKind::boolean:
        read = value.flag();
        break;
      case OptionKind::integer:
        read = std::int64_t{value.whole()};
        break;
      case OptionKind::real:
        read = value.real();
        break;
      default:
        read = value.text();
    }
    if (entry.info.kind != OptionKind::real) read = entry.info.checked(read, value.where());
    entry.set(options, read);
  }
  nlp::check(options, where());
  return options;
}

std::string JsonReader::shown() const {
  if (json_.is_array()) return "a list";
  if (json_.is_object()) return "an object";
  return json_.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json read_json(const std::string& file, std::size_t max_bytes, const std::string& content,
               const std::vector<std::string>& formats) {
  const std::string text = read_file(file, max_bytes, content);
  Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) throw InvalidValue(file, "no valid JSON", content);
  const JsonReader found = JsonReader(file, content, json).at("format");
  if (std::find(formats.begin(), formats.end(), found.text()) == formats.end())
    found.refuse("'" + found.text() + "'", fmt::format("'{}'", fmt::join(formats, "' or '")));
  return json;
}

}  // namespace slalom::io
