#include "published_sweep.hpp"

#include "../io/section.hpp"
#include "paper_files.hpp"

namespace slalom::paper {
namespace {

using report::PublishedSweep;

const OptionTable<PublishedSweep::Count>& count_options() {
  using C = PublishedSweep::Count;
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

const OptionTable<PublishedSweep::Point>& point_options() {
  using P = PublishedSweep::Point;
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

template <class S>
std::vector<S> read_members(const io::Value& root, const std::string& key,
                            const OptionTable<S>& table) {
  const io::Value* list = root.find(key);
  return list == nullptr ? std::vector<S>{} : io::read_list(*list, key, table);
}

}  // namespace

PublishedSweep published_sweep() {
  const io::Value root = read_map("sweep.yaml", {"counts", "points", "notes"});
  PublishedSweep paper;
  paper.counts = read_members(root, "counts", count_options());
  paper.points = read_members(root, "points", point_options());
  paper.notes = read_notes<PublishedSweep::Note>(root);
  return paper;
}

}  // namespace slalom::paper
