#pragma once

namespace slalom::app {

/// From now on Ctrl-C, SIGTERM and SIGHUP end the program with kInterrupted.
void catch_interrupts();

/// For commands that look at interrupted(): from now on a signal only sets a flag, so that a drive
/// can end and be written; the third signal ends the program at once.
void poll_interrupts();

/// Whether one of these signals has come.
bool interrupted();

}  // namespace slalom::app
