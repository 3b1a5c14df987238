#include "paper_data.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "../io/config_dir.hpp"
#include "../io/section.hpp"
#include "paper_files.hpp"

namespace slalom::paper {

io::Value read_map(const std::string& file, const std::vector<std::string>& known) {
  io::Value root = io::parse_file(io::config_dir() / "paper" / file, "the paper's figures");
  io::require_map(root, "the paper's figures (a map)");
  for (const auto& member : root.members)
    if (std::find(known.begin(), known.end(), member.key) == known.end())
      io::unknown_key(member.key, member.place, "", known);
  return root;
}

namespace {

const OptionTable<PaperDrive>& drive_options() {
  static const auto table = [] {
    OptionTable<PaperDrive> t;
    t.text("environment", &PaperDrive::environment, "Scenario.")
        .text("planner", &PaperDrive::planner, "Planner.")
        .text("outcome", &PaperDrive::outcome, "How the drive ended.")
        .text("hit", &PaperDrive::hit, "Obstacle crashed into.")
        .real("time", &PaperDrive::time, OptionRange::positive(), "s", "End of the drive.")
        .real("earliest", &PaperDrive::earliest, OptionRange::non_negative(), "s", "Of ours.")
        .real("latest", &PaperDrive::latest, OptionRange::positive(), "s", "Of ours.")
        .real("end_ux", &PaperDrive::end_ux, OptionRange::any(), "m/s", "Speed at the end.")
        .real("lag", &PaperDrive::lag, OptionRange::non_negative(), "s", "Lag of the series.")
        .text("note", &PaperDrive::note, "Where and why ours differs.");
    return t;
  }();
  return table;
}

const OptionTable<PaperDrive::Snapshot>& snapshot_options() {
  using S = PaperDrive::Snapshot;
  static const auto table = [] {
    const auto any = OptionRange::any();
    OptionTable<S> t;
    t.real("t", &S::t, OptionRange::non_negative(), "s", "The instant meant.")
        .real("t_printed", &S::t_printed, OptionRange::non_negative(), "s", "As printed.")
        .real("x", &S::x, any, "m", "East position.")
        .real("y", &S::y, any, "m", "North position.")
        .real("psi", &S::psi, any, "rad", "Heading.")
        .boolean("comparable", &S::comparable, "False where the series lags.")
        .real("tolerance", &S::tolerance, OptionRange::positive(), "m", "How far ours may be.");
    return t;
  }();
  return table;
}

const OptionTable<PaperData::Mentioned>& mentioned_options() {
  using M = PaperData::Mentioned;
  static const auto table = [] {
    OptionTable<M> t;
    t.text("environment", &M::environment, "Scenario.").text("planner", &M::planner, "Planner.");
    return t;
  }();
  return table;
}

const OptionTable<PaperData::Effort>& effort_options() {
  using E = PaperData::Effort;
  static const auto table = [] {
    const auto range = OptionRange::non_negative();
    OptionTable<E> t;
    t.real("steering_angle", &E::steering_angle, range, "1", "Of the steering angle.")
        .real("steering_rate", &E::steering_rate, range, "1", "Of the steering rate.")
        .real("jerk", &E::jerk, range, "1", "Of the jerk.")
        .real("total", &E::total, range, "1", "Sum.");
    return t;
  }();
  return table;
}

/// A drive as its file has it: what is driven, with one override.
struct DriveEntry {
  std::string name, scenario, planner, set;
  std::string over;  ///< a key that takes each of `values`: one drive a value
  std::vector<double> values;
};

const OptionTable<DriveEntry>& besides_options() {
  using E = DriveEntry;
  static const auto table = [] {
    OptionTable<E> t;
    t.text("name", &E::name, "Its folder, or that of its group.")
        .text("scenario", &E::scenario, "What is driven.")
        .text("planner", &E::planner, "By which planner.")
        .text("set", &E::set, "One override, as of --set.")
        .text("over", &E::over, "A key that takes each of the values.")
        .numbers("values", &E::values, OptionRange::any(), "", "The values.");
    return t;
  }();
  return table;
}

/// A case as its file has it.
struct CaseEntry : ConceptCase {
  std::string scenario, planner, set;
};

const OptionTable<CaseEntry>& case_options() {
  using C = CaseEntry;
  static const auto table = [] {
    OptionTable<C> t;
    t.text("case", &C::name, "Its letter.")
        .text("scenario", &C::scenario, "What is driven.")
        .text("planner", &C::planner, "By which planner.")
        .text("set", &C::set, "One override, as of --set.")
        .text("specifications", &C::specifications, "What its planner has.")
        .text("says", &C::says, "What the text says.")
        .text("outcome", &C::outcome, "How the drive ends by the text.")
        .text("faster_than", &C::faster_than, "A case it is to beat.");
    return t;
  }();
  return table;
}

PaperDrive read_drive(const io::Value& map) {
  PaperDrive drive;
  io::Places places;
  io::Section("drives").add(drive_options(), drive).read(map, places, {"snapshots"});
  if (const io::Value* snapshots = map.find("snapshots"))
    drive.snapshots = io::read_list(*snapshots, "snapshots", snapshot_options());
  return drive;
}

void read_effort(const io::Value& root, const std::string& key, PaperData::Effort& effort) {
  io::Places places;
  if (const io::Value* map = root.find(key))
    io::Section(key).add(effort_options(), effort).read(*map, places);
}

}  // namespace

PaperData load_paper_data() {
  PaperData paper;
  const io::Value drives = read_map("drives.yaml", {"drives", "mentioned", "besides"});
  if (const io::Value* list = drives.find("drives"))
    for (const auto& item : io::items_of(*list, "a list of drives"))
      paper.drives.push_back(read_drive(item));
  if (const io::Value* list = drives.find("mentioned"))
    paper.mentioned = io::read_list(*list, "mentioned", mentioned_options());
  const io::Value results = read_map("results.yaml", {"effort_P_B", "effort_P_C", "notes"});
  read_effort(results, "effort_P_B", paper.effort_P_B);
  read_effort(results, "effort_P_C", paper.effort_P_C);
  paper.notes = read_notes<PaperData::Note>(results);
  return paper;
}

namespace {

/// A drive by the request's tex and overrides, after its own.
ReproducedDrive prepared(const io::ScenarioRequest& request, const std::string& scenario,
                         const std::string& planner, const std::vector<std::string>& own,
                         const std::string& folder) {
  auto wanted = request;
  wanted.name_or_file = scenario;
  wanted.planner = planner;
  wanted.overrides.insert(wanted.overrides.begin(), own.begin(), own.end());
  return {io::load_scenario(wanted), {}, folder, {}};
}

std::vector<std::string> list_unless_empty(const std::string& text) {
  return text.empty() ? std::vector<std::string>() : std::vector<std::string>{text};
}

}  // namespace

std::vector<ReproducedDrive> load_drives(const PaperData& paper,
                                         const io::ScenarioRequest& request) {
  std::vector<ReproducedDrive> drives;
  const auto add = [&](const std::string& environment, const std::string& planner) {
    drives.push_back(prepared(request, environment, planner, {}, environment + "/" + planner));
  };
  for (const auto& one : paper.drives) add(one.environment, one.planner);
  for (const auto& one : paper.mentioned) add(one.environment, one.planner);
  return drives;
}

std::vector<ReproducedDrive> load_besides(const io::ScenarioRequest& request) {
  const io::Value root = read_map("drives.yaml", {"drives", "mentioned", "besides"});
  std::vector<ReproducedDrive> drives;
  const io::Value* list = root.find("besides");
  if (list == nullptr) return drives;
  for (const auto& entry : io::read_list(*list, "besides", besides_options())) {
    auto own = list_unless_empty(entry.set);
    if (entry.over.empty())
      drives.push_back(prepared(request, entry.scenario, entry.planner, own, entry.name));
    for (const double value : entry.values) {
      auto with = own;
      with.push_back(fmt::format("{}={}", entry.over, value));
      drives.push_back(prepared(request, entry.scenario, entry.planner, with,
                                fmt::format("{}/{}", entry.name, value)));
    }
  }
  return drives;
}

std::vector<ConceptCase> load_concept_cases(const io::ScenarioRequest& request) {
  const io::Value root = read_map("cases.yaml", {"cases"});
  std::vector<ConceptCase> cases;
  const io::Value* list = root.find("cases");
  if (list == nullptr) return cases;
  for (auto& entry : io::read_list(*list, "cases", case_options())) {
    entry.driven = prepared(request, entry.scenario, entry.planner, list_unless_empty(entry.set),
                            "cases/" + entry.name);
    cases.push_back(std::move(entry));
  }
  return cases;
}

}  // namespace slalom::paper
