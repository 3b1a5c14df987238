#include "interrupt.hpp"

#include <unistd.h>

#include <csignal>

#include "exit_code.hpp"

namespace slalom::app {
namespace {

volatile std::sig_atomic_t signals = 0;
volatile std::sig_atomic_t polled = 0;

/// Two are harmless where they are looked at: a shell and make may each pass on the same Ctrl-C.
void on_signal(int) {
  signals = signals + 1;
  if (polled == 0 || signals >= 3) _exit(kInterrupted);
}

}  // namespace

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  for (int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
}

void poll_interrupts() {
  polled = 1;
}

bool interrupted() {
  return signals != 0;
}

}  // namespace slalom::app
