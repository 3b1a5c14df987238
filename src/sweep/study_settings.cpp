#include "slalom/sweep/study.hpp"

namespace slalom::sweep {

const OptionTable<StudySettings>& study_options() {
  static const auto table = [] {
    using S = StudySettings;
    OptionTable<S> t;
    t.integer("repeats", &S::repeats, OptionRange::closed(1, kMaxTrials), "1",
              "How often each trial is run; solve times differ, and drives that go by the clock.")
        .choice("keep", &S::keep, {"figures", "drives"},
                "figures: a row a trial; drives: the folder of each drive too.")
        .integer("seed", &S::seed, OptionRange::closed(0, 2147483647), "1",
                 "Of the random draws; the same seed gives the same trials.")
        .real("time_limit", &S::time_limit, OptionRange::positive(), "s",
              "Wall clock of one trial; beyond it the trial counts as hung.")
        .integer("retries", &S::retries, OptionRange::closed(0, 10), "1",
                 "How often a trial is tried again whose worker died or hung.")
        .choice("kernels", &S::kernels, {"best", "baseline", "avx2", "avx512"},
                "Instruction set all trials run on; best is avx2 where the processor has it: "
                "avx512 makes a cycle 5 to 8 % faster and gives other last places.");
    return t;
  }();
  return table;
}

}  // namespace slalom::sweep
