#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "all_problems.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "slalom/problems/page.hpp"
#include "slalom/problems/run.hpp"

namespace slalom::app {
namespace {

using problems::Entry;
using problems::Run;
using problems::RunSettings;

struct ProblemsOptions {
  std::string name;
  bool all = false, json = false, fixed_mesh = false;
  RunSettings settings;
};

std::string list_text() {
  std::string text = fmt::format("{:<24}{:<62}{}\n", "name", "problem", "what it exercises");
  for (const auto& entry : all_problems())
    text += fmt::format("{:<24}{:<62}{}\n", entry.name, entry.title, tags_of(entry));
  return text;
}

nlohmann::ordered_json json_of(const Entry& entry) {
  nlohmann::ordered_json json{{"name", entry.name},
                              {"title", entry.title},
                              {"source", entry.source},
                              {"hard", entry.hard},
                              {"tags", nlohmann::ordered_json::array()},
                              {"maximised", entry.maximised}};
  for (const auto tag : entry.tags) json["tags"].push_back(to_string(tag));
  if (entry.published) {
    json["published"] = entry.published->value();
    json["published_where"] = entry.published->where;
  }
  if (entry.closed_form) json["closed_form"] = entry.closed_form->value;
  if (entry.converged) json["converged"] = *entry.converged;
  return json;
}

nlohmann::ordered_json json_of(const Run& run) {
  nlohmann::ordered_json json{{"status", to_string(run.status)},
                              {"backend", run.backend},
                              {"value", run.value},
                              {"difference", run.difference},
                              {"error", run.error},
                              {"agrees", run.agrees},
                              {"solve_s", run.wall_s},
                              {"meshes", nlohmann::ordered_json::array()}};
  for (const auto& mesh : run.meshes)
    json["meshes"].push_back({{"intervals", mesh.intervals},
                              {"points", mesh.points},
                              {"status", nlp::to_string(mesh.status)},
                              {"iterations", mesh.iterations},
                              {"solve_s", mesh.wall_s},
                              {"objective", mesh.objective},
                              {"error", mesh.largest_error}});
  return json;
}

std::string entry_text(const Entry& entry) {
  auto text = fmt::format("{}: {}\n  source     {}\n  hard       {}\n  exercises  {}\n", entry.name,
                          entry.title, entry.source, entry.hard, tags_of(entry));
  if (entry.published)
    text += fmt::format("  published  {} ({})\n", entry.published->printed, entry.published->where);
  if (entry.closed_form)
    text += fmt::format("  on paper   {:.10g} ({})\n", entry.closed_form->value,
                        entry.closed_form->formula);
  if (entry.converged) text += fmt::format("  converged  {:.10g}\n", *entry.converged);
  if (!entry.remark.empty()) text += fmt::format("  remark     {}\n", entry.remark);
  return text;
}

std::string run_text(const Run& run) {
  auto text = fmt::format("{:<6}{:>10}{:>8}  {:<18}{:>11}{:>10}{:>18}{:>11}\n", "mesh", "intervals",
                          "points", "status", "iterations", "solve [s]", "objective", "error");
  std::size_t number = 0;
  for (const auto& mesh : run.meshes)
    text += fmt::format("{:<6}{:>10}{:>8}  {:<18}{:>11}{:>10.3f}{:>18.10g}{:>11.2e}\n", ++number,
                        mesh.intervals, mesh.points, nlp::to_string(mesh.status), mesh.iterations,
                        mesh.wall_s, mesh.objective, mesh.largest_error);
  return text + fmt::format("{} by {}: value {:.10g}, error {:.2e}, difference {:.2e}: {}\n",
                            to_string(run.status), run.backend, run.value, run.error,
                            run.difference, run.agrees ? "agrees" : "differs");
}

int one(const ProblemsOptions& options) {
  const Entry& entry = problems::find(all_problems(), options.name);
  if (!options.json) print(entry_text(entry));
  const Run run = problems::run(entry, options.settings);
  if (options.json) {
    auto json = json_of(entry);
    json["run"] = json_of(run);
    print(text_of(json));
  } else {
    print(run_text(run));
  }
  return run.agrees ? kOk : kNotExpected;
}

int all(const ProblemsOptions& options) {
  RunSettings second = options.settings;
  second.scheme = options.settings.scheme == "lgr" ? "hermite_simpson" : "lgr";
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  if (!options.json)
    print(fmt::format("{:<24}{:>17}  {:<18}{:>17}{:>11}{:>11}{:>9}  {}\n", "name", "reference",
                      "scheme", "value", "difference", "error", "solve [s]", "status"));
  bool agree = true;
  for (const Entry& entry : all_problems())
    for (const RunSettings& settings : {options.settings, second}) {
      const Run run = problems::run(entry, settings);
      agree = agree && run.agrees;
      if (options.json) {
        json.push_back({{"name", entry.name}, {"scheme", settings.scheme}, {"run", json_of(run)}});
        continue;
      }
      print(fmt::format("{:<24}{:>17.10g}  {:<18}{:>17.10g}{:>11.1e}{:>11.1e}{:>9.2f}  {}, {}\n",
                        entry.name, entry.reference(), settings.scheme, run.value, run.difference,
                        run.error, run.wall_s, to_string(run.status),
                        run.agrees ? "agrees" : "differs"));
    }
  if (options.json) print(text_of(json));
  return agree ? kOk : kNotExpected;
}

int problems_command(const ProblemsOptions& options) {
  if (options.all) return all(options);
  if (!options.name.empty()) return one(options);
  if (!options.json) {
    print(list_text());
    return kOk;
  }
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const auto& entry : all_problems()) json.push_back(json_of(entry));
  print(text_of(json));
  return kOk;
}

}  // namespace

void add_problems(CLI::App& app, Command& run) {
  auto options = std::make_shared<ProblemsOptions>();
  auto* command =
      app.add_subcommand("problems", "List published optimal-control problems, or solve one");
  auto* name = command->add_option("NAME", options->name, "Problem to solve; none lists them");
  command->add_flag("--all", options->all, "Solve all, by two schemes")->excludes(name);
  command->add_option("--scheme", options->settings.scheme, "Collocation scheme");
  command
      ->add_option("--points", options->settings.points,
                   "Points in each interval (lgr, lgr_differential, lgr_flipped, lgl)")
      ->check(CLI::Range(1, 100));
  command->add_option("--intervals", options->settings.intervals, "Intervals of the first mesh")
      ->check(CLI::Range(1, 100000));
  command
      ->add_option(
          "--tolerance", options->settings.tolerance,
          "Relative tolerance of the refinement; by default the problem's own, mostly 1e-6")
      ->check(no_nan())
      ->check(CLI::Range(1e-14, 0.1));
  command->add_flag("--fixed-mesh", options->fixed_mesh, "Solve on the first mesh alone");
  command->add_option("--backend", options->settings.backend, "NLP solver");
  command->add_flag("--json", options->json, "Print the result as JSON");
  command->footer(
      std::string(
          "Example: slalom problems goddard --scheme lgr\n\nWith a problem, the exit code is "
          "1 unless the answer agrees with the known value.\n\n") +
      kExitCodeHelp);
  command->callback([options, &run] {
    options->settings.refined = !options->fixed_mesh;
    run = [options] { return problems_command(*options); };
  });
}

}  // namespace slalom::app
