#include "evaluation.hpp"

#include "../io/file_set.hpp"
#include "../io/json_file.hpp"
#include "comparison.hpp"
#include "concept_cases.hpp"
#include "paper_index.hpp"
#include "published_sweep.hpp"
#include "slalom/io/version.hpp"
#include "sweep_evaluation.hpp"

namespace slalom::paper {
namespace {

using io::Json;

Json text_or_null(const std::string& text) {
  return text.empty() ? Json() : Json(text);
}

Evidence evidence_of(const Reproduction& all, const report::PublishedSweep& published,
                     const std::vector<SweepTrial>* trials) {
  Evidence evidence{{}, &all.paper, &published, trials};
  evidence.whole = !all.besides.empty() && trials != nullptr;
  for (const auto& one : all.drives) evidence.drives[one.folder] = &one;
  for (const auto& one : all.cases) evidence.drives[one.driven.folder] = &one.driven;
  for (const auto& one : all.besides) evidence.drives[one.folder] = &one;
  return evidence;
}

Json claims_json(const std::vector<Judged>& claims) {
  Json list = Json::array();
  for (const auto& claim : claims)
    list.push_back({{"claim", claim.id},
                    {"says", claim.says},
                    {"at", claim.at},
                    {"printed", claim.printed},
                    {"ours", claim.ours},
                    {"verdict", verdict_words(claim.verdict)}});
  return list;
}

Json left_out_json(const std::vector<LeftOut>& claims) {
  Json list = Json::array();
  for (const auto& claim : claims)
    list.push_back({{"claim", claim.id}, {"asks_for", claim.asks_for}});
  return list;
}

Json snapshots_json(const sim::Drive& drive, const PaperDrive& printed) {
  Json list = Json::array();
  for (const auto& shot : printed.snapshots) {
    if (shot.t == 0) continue;  // the start is given
    Json entry = {{"t_s", shot.t},
                  {"x_m", shot.x},
                  {"y_m", shot.y},
                  {"tolerance_m", shot.tolerance},
                  {"comparable", shot.comparable},
                  {"ours", nullptr}};
    if (const auto ours = compare(drive, printed, shot))
      entry["ours"] = {{"x_m", ours->x},
                       {"y_m", ours->y},
                       {"distance_m", ours->distance},
                       {"within", ours->within}};
    list.push_back(std::move(entry));
  }
  return list;
}

Json printed_json(const sim::Drive& drive, const PaperDrive* printed) {
  if (printed == nullptr) return {};
  return {{"outcome", printed->outcome},
          {"hit", text_or_null(printed->hit)},
          {"time_s", printed->time},
          {"earliest_s", printed->earliest},
          {"latest_s", number_or_null(printed->latest)},
          {"note", text_or_null(printed->note)},
          {"as_paper", as_paper(drive, *printed)},
          {"snapshots", snapshots_json(drive, *printed)}};
}

Json drive_json(const ReproducedDrive& one, const PaperDrive* printed) {
  const auto& drive = one.drive;
  Json end;
  if (!drive.plant.empty()) {
    const auto& state = drive.plant.back().state;
    end = {{"x_m", state[vehicle::X]}, {"y_m", state[vehicle::Y]}, {"ux_mps", state[vehicle::UX]}};
  }
  return {{"folder", one.folder},
          {"scenario", one.scenario.name},
          {"title", one.scenario.title},
          {"planner", one.scenario.planner.name},
          {"outcome", sim::to_string(drive.outcome)},
          {"hit", text_or_null(drive.hit)},
          {"time_s", drive.time},
          {"goal_time_s", drive.goal_time ? Json(*drive.goal_time) : Json()},
          {"least_clearance_m", number_or_null(drive.least_clearance)},
          {"end", end},
          {"printed", printed_json(drive, printed)}};
}

Json drives_json(const Reproduction& all) {
  Json list = Json::array();
  for (const auto& one : all.drives) list.push_back(drive_json(one, find(all.paper, one)));
  return list;
}

Json cases_json(const std::vector<ConceptCase>& cases) {
  Json list = Json::array();
  for (const auto& one : cases) {
    auto entry = drive_json(one.driven, nullptr);
    entry["case"] = one.name;
    entry["specifications"] = one.specifications;
    entry["says"] = one.says;
    entry["faster_than"] = text_or_null(one.faster_than);
    entry["planner_words"] = planner_words(one);
    entry["ended"] = ended(one);
    entry["holds"] = holds(one, cases);
    list.push_back(std::move(entry));
  }
  return list;
}

Json effort_terms(const ControlEffort& effort) {
  return {{"steering_angle", effort.steering_angle},
          {"steering_rate", effort.steering_rate},
          {"jerk", effort.jerk},
          {"total", effort.total()}};
}

Json printed_effort(const PaperData::Effort& effort) {
  return {{"steering_angle", effort.steering_angle},
          {"steering_rate", effort.steering_rate},
          {"jerk", effort.jerk},
          {"total", effort.total}};
}

/// P_B and P_C of the standing obstacles, by the paper's measure and by the cost's weights, which
/// are P_C's. The paper's figures are of the obstacle field of its figures.
Json effort_json(const Reproduction& all) {
  Json list = Json::array();
  for (const char* environment : {"E_A-figure", "E_A"}) {
    const auto* B = find(all.drives, environment, "P_B");
    const auto* C = find(all.drives, environment, "P_C");
    if (B == nullptr || C == nullptr) continue;
    const auto& weights = C->scenario.planner;
    Json entry = {{"environment", environment},
                  {"P_B", effort_terms(effort_paper(B->drive))},
                  {"P_C", effort_terms(effort_paper(C->drive))},
                  {"weights", {weights.w_sa, weights.w_sr, weights.w_jx}},
                  {"weighted",
                   {{"P_B", effort_terms(effort_weighted(B->drive, weights))},
                    {"P_C", effort_terms(effort_weighted(C->drive, weights))}}},
                  {"printed", nullptr}};
    if (std::string(environment) == "E_A-figure")
      entry["printed"] = {{"P_B", printed_effort(all.paper.effort_P_B)},
                          {"P_C", printed_effort(all.paper.effort_P_C)}};
    list.push_back(std::move(entry));
  }
  return list;
}

Json index_json(const std::vector<IndexRow>& rows) {
  Json list = Json::array();
  for (const auto& row : rows)
    list.push_back({{"of", row.of},
                    {"command", row.command},
                    {"where", row.where},
                    {"ours", row.ours},
                    {"printed", row.printed}});
  return list;
}

/// What each figure in figures/ shows.
Json figures_json(const Reproduction& all) {
  Json list = Json::array();
  for (const auto& figure : reproduction_figures(all.drives, all.paper, all.cases))
    list.push_back({{"file", figure.file}, {"caption", figure.caption}});
  return list;
}

Json sweeps_json(const Reproduction& all, const report::PublishedSweep& published) {
  const auto claims = load_claims().sweep;
  Json list = Json::array();
  for (const auto& sweep : all.sweeps) {
    const auto trials = sweep_trials(sweep.table);
    auto entry = sweep_json(sweep.table, trials, published);
    entry["folder"] = sweep.folder;
    entry["claims"] = claims_json(judge(claims, evidence_of(all, published, &trials)));
    list.push_back(std::move(entry));
  }
  return list;
}

/// The trials of the first sweep; none without a sweep.
std::optional<std::vector<SweepTrial>> first_trials(const Reproduction& all) {
  if (all.sweeps.empty()) return std::nullopt;
  return sweep_trials(all.sweeps.front().table);
}

}  // namespace

std::vector<Judged> judge_drives(const Reproduction& reproduction) {
  const auto published = published_sweep();
  const auto trials = first_trials(reproduction);
  return judge(load_claims().drives,
               evidence_of(reproduction, published, trials ? &*trials : nullptr));
}

std::string evaluation_json(const Reproduction& reproduction) {
  const auto published = published_sweep();
  const auto trials = first_trials(reproduction);
  const auto evidence = evidence_of(reproduction, published, trials ? &*trials : nullptr);
  std::vector<LeftOut> left_out;
  const auto claims = judge(load_claims().drives, evidence, &left_out);
  const Json json = {{"format", "slalom evaluation 1"},
                     {"version", io::kVersion},
                     {"repeats", reproduction.repeats},
                     {"drives", drives_json(reproduction)},
                     {"effort", effort_json(reproduction)},
                     {"cases", cases_json(reproduction.cases)},
                     {"claims", claims_json(claims)},
                     {"claims_left_out", left_out_json(left_out)},
                     {"figures", figures_json(reproduction)},
                     {"index", index_json(paper_index(evidence))},
                     {"printed_counts", counts_json(published.counts)},
                     {"sweeps", sweeps_json(reproduction, published)}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_reproduction(const std::filesystem::path& folder, const Reproduction& reproduction) {
  const auto& [paper, drives, cases, besides, sweeps, repeats] = reproduction;
  io::FileSet files;
  files.add(folder / "index.html",
            reproduction_page(drives, paper, cases, judge_drives(reproduction)));
  files.add(folder / "evaluation.json", evaluation_json(reproduction));
  for (const auto& figure : reproduction_figures(drives, paper, cases))
    files.add(folder / "figures" / figure.file, figure.svg);
  files.commit();
}

}  // namespace slalom::paper
