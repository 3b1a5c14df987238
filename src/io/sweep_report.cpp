#include "slalom/io/sweep_report.hpp"

#include <algorithm>
#include <set>

#include "config_dir.hpp"
#include "file_set.hpp"
#include "section.hpp"
#include "slalom/io/sweep.hpp"
#include "sweep_folder.hpp"

namespace slalom::io {
namespace {

using study::PaperSweep;

const OptionTable<PaperSweep::Count>& count_options() {
  using C = PaperSweep::Count;
  static const auto table = [] {
    const auto range = OptionRange::non_negative();
    OptionTable<C> t;
    t.text("planner", &C::planner, "Planner.")
        .integer("passed", &C::passed, range, "1", "Trials that arrive.")
        .integer("trials", &C::trials, range, "1", "All trials.");
    return t;
  }();
  return table;
}

const OptionTable<PaperSweep::Point>& point_options() {
  using P = PaperSweep::Point;
  static const auto table = [] {
    const auto range = OptionRange::non_negative();
    OptionTable<P> t;
    t.text("planner", &P::planner, "Planner.")
        .real("tex", &P::tex, range, "s", "Execution horizon.")
        .real("speed", &P::speed, range, "m/s", "Greatest speed of O2 looked at.")
        .real("rtf", &P::rtf, range, "1", "Real-time factor.")
        .real("pos", &P::pos, OptionRange::closed(0, 1), "1", "Probability of safety.");
    return t;
  }();
  return table;
}

const OptionTable<PaperSweep::Note>& note_options() {
  using N = PaperSweep::Note;
  static const auto table = [] {
    OptionTable<N> t;
    t.text("topic", &N::topic, "Table of the page.").text("text", &N::text, "What to know.");
    return t;
  }();
  return table;
}

template <class S>
std::vector<S> read_members(const Value& root, const std::string& key,
                            const OptionTable<S>& table) {
  const Value* list = root.find(key);
  return list == nullptr ? std::vector<S>{} : read_list(*list, key, table);
}

}  // namespace

PaperSweep load_paper_sweep() {
  const Value root = parse_file(config_dir() / "paper" / "sweep.yaml", "the paper's figures");
  require_map(root, "the paper's figures (a map)");
  const std::vector<std::string> known = {"counts", "points", "notes"};
  for (const auto& member : root.members)
    if (std::find(known.begin(), known.end(), member.key) == known.end())
      unknown_key(member.key, member.place, "", known);
  PaperSweep paper;
  paper.counts = read_members(root, "counts", count_options());
  paper.points = read_members(root, "points", point_options());
  paper.notes = read_members(root, "notes", note_options());
  return paper;
}

void write_sweep_report(const std::filesystem::path& folder) {
  const auto table = read_sweep(folder);
  std::set<std::int64_t> kept;
  std::error_code error;
  for (const auto& record : table.trials)
    if (std::filesystem::exists(drive_folder(folder, record.trial) / "report.html", error))
      kept.insert(record.trial);
  FileSet files;
  for (const auto& figure : study::sweep_figures(table))
    files.add(folder / "figures" / figure.file, figure.svg);
  files.add(folder / "index.html", study::sweep_page(table, load_paper_sweep(), kept));
  files.commit();
}

}  // namespace slalom::io
