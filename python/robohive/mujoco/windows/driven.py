"""Managed windows over physics of this process, which calls the callbacks that Python has set."""

import time
from collections.abc import Callable

from robohive.mujoco._functions import mj_forward, mj_resetData, mj_resetDataKeyframe, mj_step
from robohive.mujoco.enums.view import mjtGridPos
from robohive.mujoco.pictures.pulling import mjv_applyPerturbPose
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.model import MjModel
from robohive.mujoco.windows.handle import Handle

#: What a frame takes, and physics of it [s].
_FRAME, _SHARE = 1 / 60, 0.7
#: Simulated time behind real time that is given up [s].
_GIVE_UP = 0.1
#: Speeds: ten for each power of ten, from real time down to a thousandth.
_SLOWEST = 30

_SPACE, _STEP, _RESET, _SLOWER, _FASTER = 32, 262, 259, 45, 61


class Driven:
    """A simulation that goes by in real time in front of a window. The space bar runs and pauses, the right arrow steps, minus
    and equals change the speed, and backspace resets."""

    def __init__(self, model: MjModel, data: MjData, show: Callable[[Callable[[int], None]], Handle]) -> None:
        """Of a model, in a window that `show` opens, given what hears of keys."""
        self._m, self._d = model, data
        self._runs, self._slowness, self._owed = True, 0, 0.0
        self._keys: list[int] = []
        self._said = ""
        self._handle = show(self._keys.append)

    @property
    def _speed(self) -> float:
        """Simulated seconds for each real one."""
        return float(10 ** (-self._slowness / 10))

    def run(self) -> None:
        """Goes on until the window is closed."""
        last = time.monotonic()
        with self._handle:
            while self._handle.is_running():
                now = time.monotonic()
                self._owed += (now - last) * self._speed if self._runs else 0.0
                last = now
                self._obey()
                self._advance(now)
                self._say()
                self._handle.sync()
                time.sleep(max(0.0, _FRAME - (time.monotonic() - now)))

    def _advance(self, now: float) -> None:
        timestep = self._m.opt.timestep
        if not self._runs:
            mjv_applyPerturbPose(self._m, self._d, self._handle.perturb, 1)
            mj_forward(self._m, self._d)
        while self._runs and self._owed >= timestep and time.monotonic() - now < _SHARE * _FRAME:
            mj_step(self._m, self._d)
            self._owed -= timestep
        if self._owed > _GIVE_UP:
            self._owed = 0.0

    def _obey(self) -> None:
        pressed, self._keys[:] = list(self._keys), []
        for key in pressed:
            if key == _SPACE:
                self._runs = not self._runs
            elif key == _STEP:
                self._runs = False
                mj_step(self._m, self._d)
            elif key == _RESET:
                self._reset()
            elif key in (_SLOWER, _FASTER):
                self._slowness = min(max(self._slowness + (1 if key == _SLOWER else -1), 0), _SLOWEST)

    def _reset(self) -> None:
        if self._m.nkey:
            mj_resetDataKeyframe(self._m, self._d, 0)
        else:
            mj_resetData(self._m, self._d)

    def _say(self) -> None:
        says = "" if self._runs else "PAUSE"
        if self._runs and self._slowness:
            says = f"{100 * self._speed:.3g} %"
        if says != self._said:
            self._said = says
            self._handle.set_texts([(None, mjtGridPos.mjGRID_TOPRIGHT, says, None)] if says else [])
