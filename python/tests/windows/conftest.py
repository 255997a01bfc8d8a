"""Displays of tests."""

import pytest


@pytest.fixture
def no_display(monkeypatch):
    """None."""
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"):
        monkeypatch.delenv(name, raising=False)
