#include "slalom/io/recording_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "slalom/base/error.hpp"
#include "slalom/io/drive_files.hpp"
#include "slalom/io/scenario_file.hpp"
#include "slalom/io/version.hpp"
#include "text_file.hpp"

namespace slalom::io {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "slalom recorded solve 1";
constexpr const char* kContent = "a recorded solve (JSON, from slalom simulate --record-failures)";
constexpr std::size_t kMaxRecordingBytes = 64 << 20;

/// JSON has no numbers that are not finite: they are text.
Json number(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
}

Json numbers(const std::vector<double>& list) {
  Json json = Json::array();
  for (const double value : list) json.push_back(number(value));
  return json;
}

Json point(const nlp::Start& at) {
  return {
      {"x", numbers(at.x)}, {"y", numbers(at.y)}, {"zl", numbers(at.zl)}, {"zu", numbers(at.zu)}};
}

Json options_json(const nlp::Options& options) {
  Json json;
  for (const auto& entry : nlp::solver_options().entries()) {
    const OptionValue value = entry.get(options);
    if (const auto* real = std::get_if<double>(&value)) json[entry.info.name] = number(*real);
    if (const auto* whole = std::get_if<std::int64_t>(&value)) json[entry.info.name] = *whole;
    if (const auto* yes = std::get_if<bool>(&value)) json[entry.info.name] = *yes;
    if (const auto* text = std::get_if<std::string>(&value)) json[entry.info.name] = *text;
  }
  return json;
}

/// The parts of a file, with messages that name the key.
class Reader {
 public:
  Reader(std::string file, const Json& json, std::string path = "")
      : file_(std::move(file)), path_(std::move(path)), json_(json) {}

  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
    throw InvalidValue(path_.empty() ? file_ : file_ + ": " + path_, found, expected);
  }
  Reader at(const std::string& key) const {
    if (!json_.is_object() || !json_.contains(key)) refuse(fmt::format("no '{}'", key), kContent);
    return {file_, json_.at(key), path_.empty() ? key : path_ + "." + key};
  }
  double real() const {
    if (json_.is_number()) return json_.get<double>();
    if (json_ == "nan") return std::numeric_limits<double>::quiet_NaN();
    if (json_ == "inf") return std::numeric_limits<double>::infinity();
    if (json_ == "-inf") return -std::numeric_limits<double>::infinity();
    refuse(shown(), "a number");
  }
  int whole() const {
    if (!json_.is_number_integer() || !std::in_range<int>(json_.get<std::int64_t>()))
      refuse(shown(), "an integer");
    return json_.get<int>();
  }
  bool flag() const {
    if (!json_.is_boolean()) refuse(shown(), "true or false");
    return json_.get<bool>();
  }
  std::string text() const {
    if (!json_.is_string()) refuse(shown(), "text");
    return json_.get<std::string>();
  }
  std::vector<double> list() const {
    if (!json_.is_array()) refuse(shown(), "a list of numbers");
    std::vector<double> result;
    for (std::size_t i = 0; i < json_.size(); ++i)
      result.push_back(Reader(file_, json_[i], fmt::format("{}[{}]", path_, i)).real());
    return result;
  }
  nlp::Start point() const {
    return {at("x").list(), at("y").list(), at("zl").list(), at("zu").list()};
  }
  /// The value of an enum whose values from 0 to `last` to_string names.
  template <class E>
  E one_of(E last) const {
    std::string names;
    for (int i = 0; i <= static_cast<int>(last); ++i) {
      const auto each = static_cast<E>(i);
      if (json_ == to_string(each)) return each;
      names += (i > 0 ? ", " : "") + std::string(to_string(each));
    }
    refuse(shown(), "one of " + names);
  }
  nlp::Options options() const {
    nlp::Options options;
    for (const auto& entry : nlp::solver_options().entries()) {
      const Reader value = at(entry.info.name);
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
  std::string where() const { return file_ + ": " + path_; }

 private:
  std::string shown() const {
    if (json_.is_array()) return "a list";
    if (json_.is_object()) return "an object";
    return json_.dump(-1, ' ', false, Json::error_handler_t::replace);
  }

  std::string file_, path_;
  const Json& json_;
};

vehicle::State state(const Reader& reader) {
  const auto list = reader.list();
  vehicle::State result{};
  if (list.size() != result.size())
    reader.refuse(fmt::format("{} numbers", list.size()), fmt::format("{}", result.size()));
  std::copy(list.begin(), list.end(), result.begin());
  return result;
}

}  // namespace

std::string to_json(const RecordedSolve& solve) {
  const auto& r = solve.recording;
  Json json;
  json["format"] = kFormat;
  json["version"] = kVersion;
  json["kernels"] = to_string(r.kernels);
  json["request"] = {{"X0p", numbers({r.X0p.begin(), r.X0p.end()})},
                     {"t0", r.t0},
                     {"tex", r.tex},
                     {"goal_in_range", r.goal_in_range}};
  json["options"] = options_json(r.options);
  json["status"] = nlp::to_string(r.status);
  json["iterations"] = r.iterations;
  json["phi"] = number(r.phi);
  json["cpu_s"] = r.cpu_s;
  json["wall_s"] = r.wall_s;
  json["start"] = point(r.start);
  json["end"] = point(r.end);
  json["scenario"] = to_yaml(solve.scenario);
  return json.dump() + "\n";
}

RecordedSolve read_recording(const std::string& file) {
  const std::string text = read_file(file, kMaxRecordingBytes, kContent);
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) throw InvalidValue(file, "no valid JSON", kContent);
  const Reader reader(file, json);
  if (const auto format = reader.at("format"); format.text() != kFormat)
    format.refuse("'" + format.text() + "'", fmt::format("'{}'", kFormat));

  RecordedSolve solve;
  auto& r = solve.recording;
  solve.scenario = parse_scenario(reader.at("scenario").text(), file + ": scenario");
  const Reader request = reader.at("request");
  r.X0p = state(request.at("X0p"));
  r.t0 = request.at("t0").real();
  r.tex = request.at("tex").real();
  r.goal_in_range = request.at("goal_in_range").flag();
  r.kernels = reader.at("kernels").one_of(KernelSet::avx2);
  r.options = reader.at("options").options();
  r.status = reader.at("status").one_of(nlp::Status::numerical_failure);
  r.iterations = reader.at("iterations").whole();
  r.phi = reader.at("phi").real();
  r.cpu_s = reader.at("cpu_s").real();
  r.wall_s = reader.at("wall_s").real();
  r.start = reader.at("start").point();
  r.end = reader.at("end").point();
  return solve;
}

void prepare_recordings(const std::string& folder, bool force) {
  namespace fs = std::filesystem;
  std::error_code error;
  std::vector<fs::path> old;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const auto name = it->path().filename().string();
    if (name.starts_with("cycle-") && name.ends_with(".json")) old.push_back(it->path());
  }
  if (!old.empty() && !force)
    throw Error(fmt::format("{}: holds recorded solves already ({}); use --force to replace them",
                            folder, old.front().filename().string()));
  prepare_folder(folder, true);
  for (const auto& file : old) fs::remove(file, error);
}

}  // namespace slalom::io
