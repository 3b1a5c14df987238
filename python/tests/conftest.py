"""For all tests."""

import os
import signal

import pytest


@pytest.fixture(autouse=True)
def interrupts_arrive():
    """A run in the background inherits that SIGINT is ignored; tests of interrupts would not end."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def unexpected_skips(reporter):
    """Reasons for which tests were skipped and that SLALOM_MAY_SKIP, one on each line, does not have; without it, none."""
    known = os.environ.get("SLALOM_MAY_SKIP")
    if known is None:
        return set()
    reasons = {report.longrepr[2].removeprefix("Skipped: ") for report in reporter.stats.get("skipped", [])}
    return reasons - set(known.splitlines())


def pytest_sessionfinish(session):
    """A test that is always skipped tests nothing: where it is known what is installed, others skipped are a failure."""
    reporter = session.config.pluginmanager.get_plugin("terminalreporter")
    if reporter and unexpected_skips(reporter) and session.exitstatus == pytest.ExitCode.OK:
        session.exitstatus = pytest.ExitCode.TESTS_FAILED


def pytest_terminal_summary(terminalreporter):
    for reason in sorted(unexpected_skips(terminalreporter)):
        terminalreporter.write_line(f"skipped, which SLALOM_MAY_SKIP does not have: {reason}", red=True)
