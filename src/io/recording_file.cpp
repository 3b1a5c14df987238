#include "slalom/io/recording_file.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "json_file.hpp"
#include "slalom/base/error.hpp"
#include "slalom/io/drive_files.hpp"
#include "slalom/io/scenario_file.hpp"
#include "slalom/io/version.hpp"

namespace slalom::io {
namespace {

constexpr const char* kFormat = "slalom recorded solve 1";
constexpr const char* kContent = "a recorded solve (JSON, from slalom simulate --record-failures)";
constexpr std::size_t kMaxRecordingBytes = 64 << 20;

vehicle::State state(const JsonReader& reader) {
  const auto list = reader.list();
  vehicle::State result{};
  if (list.size() != result.size())
    reader.refuse(fmt::format("{} numbers", list.size()), fmt::format("{}", result.size()));
  std::copy(list.begin(), list.end(), result.begin());
  return result;
}

Json json_obstacles(const std::vector<world::Obstacle>& obstacles) {
  Json json = Json::array();
  for (const auto& o : obstacles)
    json.push_back({{"name", o.name}, {"numbers", json_numbers({o.x, o.y, o.a, o.b, o.vx, o.vy})}});
  return json;
}

std::vector<world::Obstacle> obstacles(const JsonReader& reader) {
  std::vector<world::Obstacle> result;
  for (std::size_t i = 0; i < reader.size(); ++i) {
    const JsonReader one = reader.at(i), numbers = one.at("numbers");
    const auto n = numbers.list();
    if (n.size() != 6) numbers.refuse(fmt::format("{} numbers", n.size()), "x, y, a, b, vx, vy");
    result.push_back({one.at("name").text(), n[0], n[1], n[2], n[3], n[4], n[5]});
  }
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
  if (!r.obstacles.empty()) json["request"]["obstacles"] = json_obstacles(r.obstacles);
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

RecordedSolve read_recording(const std::string& file) {
  const Json json = read_json(file, kMaxRecordingBytes, kContent, kFormat);
  const JsonReader reader(file, kContent, json);

  RecordedSolve solve;
  auto& r = solve.recording;
  solve.scenario = parse_scenario(reader.at("scenario").text(), file + ": scenario");
  const JsonReader request = reader.at("request");
  r.X0p = state(request.at("X0p"));
  r.t0 = request.at("t0").real();
  r.t_start = request.at("t_start").real();
  r.goal_in_range = request.at("goal_in_range").flag();
  if (request.has("obstacles")) r.obstacles = obstacles(request.at("obstacles"));
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
