#include "slalom/io/recording_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "json_file.hpp"
#include "obstacle_json.hpp"
#include "slalom/base/error.hpp"
#include "slalom/io/drive_files.hpp"
#include "slalom/io/scenario_file.hpp"
#include "slalom/io/version.hpp"

namespace slalom::io {
namespace {

constexpr const char* kFormat = "slalom recorded solve 1";
constexpr const char* kPlanFormat = "slalom recorded plan 1";
constexpr const char* kContent =
    "a recorded solve or plan (JSON, from slalom simulate --record-failures)";
constexpr std::size_t kMaxRecordingBytes = 64 << 20;

vehicle::State state(const JsonReader& reader) {
  const auto list = reader.list();
  vehicle::State result{};
  if (list.size() != result.size())
    reader.refuse(fmt::format("{} numbers", list.size()), fmt::format("{}", result.size()));
  std::copy(list.begin(), list.end(), result.begin());
  return result;
}

template <class Row>
std::vector<Row> rows(const JsonReader& reader, std::size_t count) {
  std::vector<Row> result;
  for (const auto& list : reader.table(Row{}.size())) {
    result.emplace_back();
    std::copy(list.begin(), list.end(), result.back().begin());
  }
  if (result.size() != count)
    reader.refuse(fmt::format("{} rows", result.size()), fmt::format("{}, as t has", count));
  return result;
}

RecordedMotion motion(const JsonReader& reader, const std::string& file) {
  RecordedMotion result;
  auto& p = result.plan;
  result.scenario = parse_scenario(reader.at("scenario").text(), file + ": scenario");
  p.rung = reader.at("rung").one_of(planner::Rung::least_bad);
  p.t0 = reader.at("t0").real();
  p.tex = reader.at("tex").real();
  const JsonReader need = reader.at("need");
  p.clearance = need.at("clearance").real();
  if (need.has("edge")) p.edge = need.at("edge").real();  // older recordings have none
  p.wheel_load = need.at("wheel_load").real();
  const auto seen = need.at("seen").list();
  if (seen.size() != 3)
    need.at("seen").refuse(fmt::format("{} numbers", seen.size()), "x, y and radius");
  p.seen_x = seen[0];
  p.seen_y = seen[1];
  p.seen_radius = seen[2];
  p.obstacles = read_obstacles(reader.at("obstacles"));
  p.t = reader.at("t").list();
  p.states = rows<vehicle::State>(reader.at("states"), p.t.size());
  p.controls = rows<vehicle::Control>(reader.at("controls"), p.t.size());
  const JsonReader c = reader.at("certificate");
  // What was proved is what was asked for, where an older recording does not say.
  const double proved = c.has("proved_clearance") ? c.at("proved_clearance").real() : p.clearance;
  p.certificate = {.verified = c.at("verified").flag(),
                   .least_clearance = c.at("least_clearance").real(),
                   .proved_clearance = proved,
                   .nearest = c.at("nearest").text(),
                   .least_wheel_load = c.at("least_wheel_load").real(),
                   .until = c.at("until").real(),
                   .refused = c.at("refused").text(),
                   .refused_at = c.at("refused_at").real()};
  planner::check(p, file);
  return result;
}

}  // namespace

std::string to_json(const RecordedSolve& solve) {
  const auto& r = solve.recording;
  Json json;
  json["format"] = kFormat;
  json["version"] = kVersion;
  json["kernels"] = to_string(r.kernels);
  json["request"] = {{"X0p", json_numbers({r.X0p.begin(), r.X0p.end()})},
                     {"t0", r.t0},
                     {"t_start", r.t_start},
                     {"goal_in_range", r.goal_in_range}};
  if (r.obstacles) json["request"]["obstacles"] = json_obstacles(*r.obstacles);
  if (r.s) json["request"]["s"] = *r.s;
  json["options"] = json_options(r.options);
  json["status"] = nlp::to_string(r.status);
  json["iterations"] = r.iterations;
  json["phi"] = json_number(r.phi);
  json["cpu_s"] = r.cpu_s;
  json["wall_s"] = r.wall_s;
  json["start"] = json_point(r.start);
  json["end"] = json_point(r.end);
  json["scenario"] = to_yaml(solve.scenario);
  return json.dump() + "\n";
}

std::string to_json(const RecordedMotion& motion) {
  const auto& p = motion.plan;
  const auto& c = p.certificate;
  Json json;
  json["format"] = kPlanFormat;
  json["version"] = kVersion;
  json["rung"] = to_string(p.rung);
  json["t0"] = p.t0;
  json["tex"] = p.tex;
  json["need"] = {{"clearance", json_number(p.clearance)},
                  {"edge", json_number(p.edge)},
                  {"wheel_load", json_number(p.wheel_load)},
                  {"seen", json_numbers({p.seen_x, p.seen_y, p.seen_radius})}};
  json["obstacles"] = json_obstacles(p.obstacles);
  json["t"] = json_numbers(p.t);
  json["states"] = json_table(p.states);
  json["controls"] = json_table(p.controls);
  json["certificate"] = {{"verified", c.verified},
                         {"least_clearance", json_number(c.least_clearance)},
                         {"proved_clearance", json_number(c.proved_clearance)},
                         {"nearest", c.nearest},
                         {"least_wheel_load", json_number(c.least_wheel_load)},
                         {"until", json_number(c.until)},
                         {"refused", c.refused},
                         {"refused_at", json_number(c.refused_at)}};
  json["scenario"] = to_yaml(motion.scenario);
  return json.dump() + "\n";
}

Recorded read_recording(const std::string& file) {
  const Json json = read_json(file, kMaxRecordingBytes, kContent, {kFormat, kPlanFormat});
  const JsonReader reader(file, kContent, json);
  if (json.at("format") == kPlanFormat) return motion(reader, file);

  RecordedSolve solve;
  auto& r = solve.recording;
  solve.scenario = parse_scenario(reader.at("scenario").text(), file + ": scenario");
  const JsonReader request = reader.at("request");
  r.X0p = state(request.at("X0p"));
  r.t0 = request.at("t0").real();
  r.t_start = request.at("t_start").real();
  r.goal_in_range = request.at("goal_in_range").flag();
  if (request.has("obstacles")) r.obstacles = read_obstacles(request.at("obstacles"));
  if (request.has("s")) r.s = request.at("s").real();
  r.kernels = reader.at("kernels").one_of(kKernelSets.back());
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
