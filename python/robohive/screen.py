"""The window of an environment."""

from __future__ import annotations

import time

from robohive import _core
from robohive.window import open_window, opening


class Screen:
    """A window that shows one environment as it goes.

    A person may close it: the environment goes on unseen.
    """

    def __init__(self, title: str, core: _core.Env, dt: float) -> None:
        """Opens it.

        Raises:
            WindowError: there is no display.
        """
        self._window = open_window(opening(title, left=False, right=False), core)
        self._dt, self._due = dt, time.monotonic()

    def show(self, core: _core.Env, waits: bool) -> None:
        """Shows the present state; `waits` until a control period has gone by since the last state that was shown."""
        if not self._window.sync_env(core):
            return
        now = time.monotonic()
        if waits and self._due > now:
            time.sleep(self._due - now)
        # Time that was lost is not caught up with.
        self._due = max(self._due, now) + self._dt if waits else now + self._dt

    def close(self) -> None:
        """Closes it."""
        self._window.close()
