"""MuJoCo's window, by its names. Every window is a process of its own: there may be several, also on macOS, without `mjpython`.

    python -m robohive.mujoco.viewer --mjcf=FILE
"""

import argparse
import atexit
import os
from collections.abc import Callable
from os import PathLike
from typing import Any

from robohive.mujoco._functions import mj_forward
from robohive.mujoco.callbacks import is_any_set
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.model import MjModel
from robohive.mujoco.windows.driven import Driven
from robohive.mujoco.windows.handle import Handle
from robohive.mujoco.windows.managed import Loader, Managed, opened, title_of
from robohive.window import opening

__all__ = ["Handle", "launch", "launch_from_path", "launch_passive"]

CallbackType = Callable[[MjModel, MjData], None]
LoaderType = Callable[[], tuple[MjModel, MjData]]
KeyCallbackType = Callable[[int], None]

#: Windows that stay open though a program keeps nothing of them.
_handles: list[Handle] = []


def launch(
    model: MjModel | None = None,
    data: MjData | None = None,
    *,
    loader: LoaderType | None = None,
    show_left_ui: bool = True,
    show_right_ui: bool = True,
) -> None:
    """Opens a window that simulates, and returns when it is closed.

    With a model the simulation starts from `data`, and `data` holds its last state when the window is closed. With a loader, the
    window shows the model that it returns and calls it again for each reload. With neither, the window is empty until a file is
    dropped on it. With callbacks of physics (`set_mjcb_control` …) it goes by in this process, which calls them.

    Raises:
        FatalError: no window can be opened, or it was lost.
        ValueError: data without a model, or a model and a loader.
    """
    if model is None and data is not None:
        raise ValueError("mjData is specified but mjModel is not")
    if callable(model) and data is not None:
        raise ValueError("mjData should not be specified when an mjModel loader is used")
    if loader is not None and model is not None:
        raise ValueError("model and loader are both specified")
    load: Loader | None = loader
    if model is not None:
        given = model, MjData(model) if data is None else data
        load = lambda: given  # noqa: E731
    if load is not None and is_any_set():
        shown, simulation = load()[:2]
        _drive(shown, simulation, show_left_ui, show_right_ui)
    else:
        Managed(load, show_left_ui, show_right_ui).run()


def _drive(model: MjModel, data: MjData, left: bool, right: bool) -> None:
    """Simulates here rather than in the window, which cannot call functions of Python."""

    def show(hear: Callable[[int], None]) -> Handle:
        return launch_passive(model, data, key_callback=hear, show_left_ui=left, show_right_ui=right)

    Driven(model, data, show).run()


def launch_from_path(path: str | PathLike[str]) -> None:
    """Opens a window on a model file, which is read again whenever it is saved, and returns when the window is closed.

    Raises:
        FatalError: no window can be opened, or it was lost.
    """
    if is_any_set():
        model = MjModel.from_xml_path(path)
        _drive(model, MjData(model), True, True)
    else:
        Managed(None, True, True, os.fspath(path)).run()


def launch_passive(
    model: MjModel,
    data: MjData,
    *,
    key_callback: KeyCallbackType | None = None,
    show_left_ui: bool = True,
    show_right_ui: bool = True,
    builtin_keys: bool = True,
) -> Handle:
    """Opens a window beside the program, which simulates and tells the window with `sync`.

    Args:
        model: The model.
        data: The simulation.
        key_callback: Called with the number of GLFW of every key that is pressed in the window, in a thread of its own.
        show_left_ui: Whether the left panel is shown.
        show_right_ui: Whether the right panel is shown.
        builtin_keys: Whether keys do what they do in MuJoCo's viewer; without, the callback alone hears of them.

    Raises:
        FatalError: no window can be opened.
        ValueError: an argument has another type.
    """
    if not isinstance(model, MjModel):
        raise ValueError(f"`model` is not a mujoco.MjModel: got {model!r}")
    if not isinstance(data, MjData):
        raise ValueError(f"`data` is not a mujoco.MjData: got {data!r}")
    if key_callback is not None and not callable(key_callback):
        raise ValueError(f"`key_callback` is not callable: got {key_callback!r}")
    mj_forward(model, data)
    how = opening(title_of(model), left=show_left_ui, right=show_right_ui, keys=builtin_keys)
    handle = Handle(opened(how, (model, data)), model, data, key_callback)
    _handles[:] = [each for each in _handles if each.is_running()] + [handle]
    return handle


def _close_all() -> None:
    for handle in _handles:
        handle.close()


atexit.register(_close_all)


def main(arguments: list[str] | None = None) -> None:
    """`python -m robohive.mujoco.viewer`."""
    parser = argparse.ArgumentParser(prog="python -m robohive.mujoco.viewer", description="A model in a window.")
    parser.add_argument("--mjcf", metavar="FILE", help="the model; without one, drop a file on the window")
    given: Any = parser.parse_args(arguments)
    if given.mjcf is None:
        launch()
    else:
        launch_from_path(os.path.expanduser(given.mjcf))


if __name__ == "__main__":
    main()
