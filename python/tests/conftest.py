"""For all tests."""

import signal

import pytest


@pytest.fixture(autouse=True)
def interrupts_arrive():
    """A run in the background inherits that SIGINT is ignored; tests of interrupts would not end."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)
