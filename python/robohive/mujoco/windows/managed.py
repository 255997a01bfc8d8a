"""Windows in which time goes by, while the program waits."""

from collections.abc import Callable
from typing import Any

from robohive import _core as _windows
from robohive.errors import WindowError
from robohive.mujoco._errors import FatalError
from robohive.mujoco._functions import mj_forward
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.model import MjModel
from robohive.mujoco.windows.handle import take_settings
from robohive.window import open_window, opening

Loader = Callable[[], tuple[Any, ...]]

#: How long the program waits before it looks whether it is interrupted [s].
_PATIENCE = 0.5


def opened(how: dict[str, Any], subject: Any = None) -> _windows.Window:
    """A window.

    Raises:
        FatalError: none can be opened.
    """
    try:
        return open_window(how, subject)
    except WindowError as error:
        raise FatalError(str(error)) from None


def title_of(model: MjModel) -> str:
    """What the title of a model's window says."""
    name = model.names.split(b"\0", 1)[0].decode(errors="replace")
    return f"RoboHive: {name}" if name else "RoboHive"


class Managed:
    """A window in which time goes by."""

    def __init__(self, loader: Loader | None, left: bool, right: bool, file: str | None = None) -> None:
        """A window of what `loader` returns, or of a file that it reads itself, again whenever it is saved.

        Raises:
            FatalError: none can be opened.
        """
        self._loader, self._file, self._panels = loader, file, {"left": left, "right": right}
        self._m: MjModel | None = None
        self._d: MjData | None = None
        trouble = self._load()
        subject = None if self._m is None else (self._m, self._d)
        self._window = opened(self._opening(), subject)
        if trouble:
            self._window.trouble(trouble)

    def _opening(self) -> dict[str, Any]:
        title = f"RoboHive: {self._file}" if self._file else "RoboHive"
        if self._m is not None:
            title = title_of(self._m)
        return opening(title, runs=True, file=self._file, **self._panels)

    def _load(self) -> str:
        """Asks the loader; returns why there is no model, or nothing."""
        if self._loader is None:
            return ""
        try:
            self._m, self._d = self._loader()[:2]
        except Exception as error:  # whatever a program's loader raises is shown in the window
            return str(error) or type(error).__name__
        return ""

    def run(self) -> None:
        """Waits until the window is closed. What ran in it is then in the model and the simulation.

        Raises:
            FatalError: the window was lost.
        """
        try:
            while self._window.wait(_PATIENCE) or self._window.is_open():
                self._window.take_keys()
                self._serve(self._window.take())
            self._serve(self._window.take())
            if self._d is not None and self._m is not None and self._window.finish(self._d):
                mj_forward(self._m, self._d)
        finally:
            lost = self._window.lost()
            self._window.close()
        if lost is not None:
            raise FatalError(f"the window was lost: {lost}")

    def _serve(self, done: dict[str, Any]) -> None:
        if self._m is not None:
            take_settings(self._window, self._m, done["settings"])
        if not done["reload"]:
            return
        trouble = self._load()
        if trouble:
            self._window.trouble(trouble)
        elif self._m is not None and self._d is not None:
            self._window.show(self._opening(), self._m, self._d)
            self._window.trouble("")
