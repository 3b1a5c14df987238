#pragma once

namespace slalom::app {

/// From now on Ctrl-C, SIGTERM and SIGHUP only set a flag, so that a drive can end and be written;
/// the third signal ends the program at once.
void catch_interrupts();

/// Whether one of these signals has come.
bool interrupted();

}  // namespace slalom::app
