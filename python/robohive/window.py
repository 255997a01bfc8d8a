"""Windows: each is a process of its own, whose main thread it belongs to. So a program has as many as it likes, on every system,
and goes on when one is closed or dies.
"""

from __future__ import annotations

import atexit
import sys
import weakref
from typing import Any

from robohive import _core
from robohive.errors import WindowError

#: What a window's process runs: the extension module alone, without this package or those of others around it. The process that
#: asked decides what an interrupt does.
_PROCESS = """
import signal, sys
from importlib.util import module_from_spec, spec_from_file_location
signal.signal(signal.SIGINT, signal.SIG_IGN)
spec = spec_from_file_location("_core", sys.argv[1])
core = module_from_spec(spec)
spec.loader.exec_module(core)
try:
    core.serve_window()
except RuntimeError:
    sys.exit(1)
"""

_open: weakref.WeakSet[_core.Window] = weakref.WeakSet()


def opening(
    title: str, *, left: bool = True, right: bool = True, keys: bool = True, runs: bool = False, file: str | None = None
) -> dict[str, Any]:
    """What a window opens with.

    Args:
        title: What its title says.
        left: Whether its left panel is shown.
        right: Whether its right panel is shown.
        keys: Whether its keys do something; else the program alone hears of them.
        runs: Whether time goes by in it.
        file: A model that it reads itself.
    """
    return {"title": title, "left": left, "right": right, "keys": keys, "runs": runs, "file": file}


def _command() -> list[str]:
    """The process of a window."""
    if not _core.HAS_WINDOWS:
        raise WindowError(
            "this wheel was built without windows; `maturin build --features window` builds one that has them"
        )
    if not sys.executable:
        raise WindowError("a window is a process of its own, and sys.executable names no Python to run it")
    return [sys.executable, "-I", "-S", "-c", _PROCESS, str(_core.__file__)]


def open_window(opening: dict[str, Any], subject: Any = None) -> _core.Window:
    """A window: of an environment of the extension module, of a model and its simulation, or empty.

    Raises:
        WindowError: there is no display, or another reason why none opens.
    """
    command = _command()
    try:
        if isinstance(subject, _core.Env):
            window = _core.Window.of_env(command, opening, subject)
        else:
            window = _core.Window.open(command, opening, subject)
    except RuntimeError as error:
        raise WindowError(
            f"{error}. Without a display, pictures need no window (render_mode rgb_array, mujoco.Renderer), and `xvfb-run python "
            "…` runs a program with one that nobody sees"
        ) from None
    _open.add(window)
    return window


def _close_all() -> None:
    for window in list(_open):
        window.close()


atexit.register(_close_all)
