// Damaged stores: a good one in which one value, or a stretch of bytes, is another.
#include <algorithm>
#include <fstream>
#include <iterator>

#include "../../src/sweep/store_reader.hpp"
#include "../../src/sweep/trial_store.hpp"
#include "fuzz.hpp"
#include "slalom/io/scenario_file.hpp"
#include "slalom/sweep/sweep.hpp"

namespace {

using namespace slalom;

constexpr const char* kColumns[] = {"study.format",    "study.name",
                                    "study.title",     "study.scenarios",
                                    "study.identity",  "study.kernels",
                                    "study.planners",  "study.columns",
                                    "study.repeats",   "study.size",
                                    "bases.number",    "bases.resolved",
                                    "trials.trial",    "trials.identity",
                                    "trials.scenario", "trials.planner",
                                    "trials.axes",     "trials.repeat",
                                    "trials.outcome",  "trials.hit",
                                    "trials.message",  "trials.nearest",
                                    "trials.time_s",   "trials.least_clearance_m",
                                    "trials.cycles",   "trials.max_solve_time_s",
                                    "trials.rests",    "trials.least_bads",
                                    "trials.marks"};

/// The bytes of a store with two trials.
const std::string& good() {
  static const std::string bytes = [] {
    report::SweepTable study;
    study.name = study.title = "s";
    study.identity = "0123";
    study.kernels = "baseline";
    study.scenarios = {"E_A"};
    study.planners = {"P_C"};
    study.columns = {"loop.tex"};
    study.size = 2;
    const auto file = test::fuzz_folder() / "good.sqlite";
    {
      sweep::TrialStore store(file, study, {io::to_yaml(io::load_scenario({"E_A", {}, {}, {}}))});
      for (int trial : {1, 2}) {
        report::TrialRecord record;
        record.trial = trial;
        record.scenario = "E_A";
        record.planner = "P_C";
        record.values = {"0.5"};
        record.outcome = "goal";
        store.add(record);
      }
      store.checkpoint();
    }
    std::ifstream in(file, std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(in), {}};
  }();
  return bytes;
}

/// Sets a column of all rows: to a text, a blob, or the number that the text is.
void set(const std::string& file, const std::string& column, char kind, const std::string& value) {
  const sweep::Database store(file, sweep::Database::Mode::read);
  const auto dot = column.find('.');
  const char* as = kind % 3 == 0 ? "?" : kind % 3 == 1 ? "CAST(? AS BLOB)" : "CAST(? AS NUMERIC)";
  const auto sql =
      "UPDATE " + column.substr(0, dot) + " SET " + column.substr(dot + 1) + " = " + as;
  sweep::Statement(store, sql.c_str()).bind(1, value).run();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return test::fuzz(data, size, [](const std::string& input) {
    if (input.size() < 3) return;
    auto bytes = good();
    const auto which = static_cast<unsigned char>(input[0]);
    const bool raw = which >= 200;
    if (raw) {
      const auto at =
          256U * static_cast<unsigned char>(input[1]) + static_cast<unsigned char>(input[2]);
      for (std::size_t i = 3; i < input.size(); ++i) bytes[(at + i) % bytes.size()] = input[i];
    }
    const auto file = test::fuzz_file(bytes, "trials.sqlite");
    if (!raw) set(file, kColumns[which % std::size(kColumns)], input[1], input.substr(2));
    try {
      (void)sweep::trials_csv(test::fuzz_folder());
    } catch (const Error&) {
    }
    (void)sweep::stored_base(file, 2);
  });
}
