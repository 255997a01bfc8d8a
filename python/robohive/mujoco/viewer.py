"""MuJoCo's window, by its names. There is none yet: programs can import this module, and opening a window is an error.

`mujoco.Renderer` draws pictures without one.
"""

from typing import Any, NoReturn


def _refuse(name: str) -> NoReturn:
    raise NotImplementedError(f"robohive.mujoco.viewer.{name} opens no window yet; mujoco.Renderer draws pictures without one")


class Handle:
    """A window that was opened: there is none."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        _refuse("Handle")


def launch(*args: Any, **kwargs: Any) -> NoReturn:
    """Would open a window and simulate.

    Raises:
        NotImplementedError: always.
    """
    _refuse("launch")


def launch_passive(*args: Any, **kwargs: Any) -> NoReturn:
    """Would open a window beside the program; see `launch`."""
    _refuse("launch_passive")


def launch_from_path(path: str) -> NoReturn:
    """Would open a window on a model; see `launch`."""
    _refuse("launch_from_path")


def launch_repl(*args: Any, **kwargs: Any) -> NoReturn:
    """Would open a window beside a prompt; see `launch`."""
    _refuse("launch_repl")
