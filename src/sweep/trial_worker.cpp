#include <unistd.h>

#include <csignal>
#include <iostream>
#include <string>

#include "slalom/base/error.hpp"
#include "slalom/base/kernels.hpp"
#include "slalom/io/drive_files.hpp"
#include "slalom/io/scenario_file.hpp"
#include "slalom/sim/closed_loop.hpp"
#include "slalom/sweep/open_sweep.hpp"
#include "trial_message.hpp"

namespace slalom::sweep {
namespace {

void write_line(int descriptor, std::string line) {
  line += '\n';
  std::size_t at = 0;
  while (at < line.size()) {
    const auto n = ::write(descriptor, line.data() + at, line.size() - at);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) throw Error("the sweep does not listen any more");
    at += static_cast<std::size_t>(n);
  }
}

}  // namespace

TrialAnswer run_trial(const TrialOrder& order, const std::function<bool()>& interrupted) {
  select_kernels(kernel_set(order.kernels));
  const auto scenario = io::parse_scenario(order.resolved, "trial");
  sim::LoopHooks hooks;
  hooks.interrupted = interrupted;
  const auto drive = sim::drive(scenario, hooks);
  TrialAnswer answer;
  answer.record = record_of(scenario, drive);
  if (order.folder.empty() || drive.outcome == sim::Outcome::interrupted) return answer;
  try {
    io::prepare_folder(order.folder, true);
    io::write_drive(order.folder, scenario, drive);
  } catch (const Error& error) {
    answer.not_written = error.what();
  }
  return answer;
}

void serve_trials() {
  // Ctrl-C and a batch system's SIGTERM reach the whole group; when to end is the supervisor's to
  // say, with whom a worker ends.
  for (const int signal : {SIGINT, SIGHUP, SIGTERM}) std::signal(signal, SIG_IGN);
  // What a library prints must not be taken for an answer.
  const int answers = ::dup(STDOUT_FILENO);
  ::dup2(STDERR_FILENO, STDOUT_FILENO);
  write_line(answers, "ready");
  for (std::string line; std::getline(std::cin, line);)
    write_line(answers, to_line(run_trial(parse_order(line))));
}

}  // namespace slalom::sweep
