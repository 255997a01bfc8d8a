"""Callbacks: functions of Python that passes call between their stages, and the handler of warnings.

While one is set, passes are put together in Python (`functions/called.py`), stage by stage, which takes longer.
"""

import ctypes
import threading
import warnings
from collections.abc import Callable
from typing import Any

from robohive.mujoco import _engine as _core

#: Those that are set, by name; threads change them and what the engine knows of them together.
_set: dict[str, Any] = {}
_lock = threading.RLock()


def is_any_set() -> bool:
    """Whether passes call functions of Python."""
    return any(one is not None for one in _set.values())


def _setter(name: str, summary: str) -> Callable[[Any], None]:
    def set_callback(callback: Any) -> None:
        if callback is not None and not callable(callback):
            raise TypeError("callback is not an Optional[Callable]")
        with _lock:
            before = _set.get(name)
            _set[name] = callback
            _core.set_called(is_any_set())
        # The one before is released outside of the lock: its end may set callbacks too.
        del before

    set_callback.__name__ = f"set_{name}"
    set_callback.__doc__ = f"Sets `{name}`, None for none: {summary}"
    return set_callback


def _refusing(name: str) -> Callable[[Any], None]:
    def set_callback(callback: Any) -> None:
        if callback is not None:
            raise NotImplementedError(f"{name}: the engine takes its memory from Rust's allocator alone")

    set_callback.__name__ = f"set_{name}"
    set_callback.__doc__ = f"Accepts None; `{name}` is never called."
    return set_callback


def _getter(name: str) -> Callable[[], Any]:
    def get_callback() -> Any:
        return _set.get(name)

    get_callback.__name__ = f"get_{name}"
    get_callback.__doc__ = f"`{name}`, None where none is set."
    return get_callback


set_mjcb_control = _setter("mjcb_control", "`callback(model, data)` sets controls, before actuators act.")
get_mjcb_control = _getter("mjcb_control")
set_mjcb_passive = _setter("mjcb_passive", "`callback(model, data)` adds to `qfrc_passive`.")
get_mjcb_passive = _getter("mjcb_passive")
set_mjcb_sensor = _setter("mjcb_sensor", "`callback(model, data, stage)` writes readings of user sensors.")
get_mjcb_sensor = _getter("mjcb_sensor")
set_mjcb_time = _setter("mjcb_time", "`callback()` is the clock of timers.")
get_mjcb_time = _getter("mjcb_time")
set_mjcb_act_bias = _setter("mjcb_act_bias", "`callback(model, data, id)` is the bias of an actuator of type `user` [N, N m].")
get_mjcb_act_bias = _getter("mjcb_act_bias")
set_mjcb_act_dyn = _setter("mjcb_act_dyn", "`callback(model, data, id)` is the rate of activation of an actuator of type `user` [1/s].")
get_mjcb_act_dyn = _getter("mjcb_act_dyn")
set_mjcb_act_gain = _setter("mjcb_act_gain", "`callback(model, data, id)` is the gain of an actuator of type `user`.")
get_mjcb_act_gain = _getter("mjcb_act_gain")
set_mjcb_contactfilter = _setter("mjcb_contactfilter", "`callback(model, data, geom1, geom2)` is not 0 where two geoms shall not touch.")
get_mjcb_contactfilter = _getter("mjcb_contactfilter")
set_mju_user_free = _refusing("mju_user_free")
get_mju_user_free = _getter("mju_user_free")
set_mju_user_malloc = _refusing("mju_user_malloc")
get_mju_user_malloc = _getter("mju_user_malloc")

_warning: Any = None

#: What is wrong, by `mjtWarning`.
_TEXTS = (
    "the inertia matrix is nearly singular at degree of freedom {}; check masses and armatures",
    "there are more contacts than memory allows: {}",
    "there are more constraint rows than memory allows: {} bytes",
    "QPOS is not finite or too large at degree of freedom {}; the simulation is unstable",
    "QVEL is not finite or too large at degree of freedom {}; the simulation is unstable",
    "QACC is not finite or too large at degree of freedom {}; the simulation is unstable",
    "CTRL is not finite or too large at actuator {}; all controls count as zero",
)


def mju_warningText(warning: int, info: int) -> str:
    """What a warning (`mjtWarning`) says of a place."""
    return _TEXTS[int(warning)].format(int(info))


def _tell(kind: int, place: int, time: float) -> None:
    """Tells of the first warning of a kind since a reset, in the step that began at `time` [s]."""
    text = f"{mju_warningText(kind, place)}, at time {time:.4f} s"
    if isinstance(_warning, ctypes._CFuncPtr):  # type: ignore[attr-defined]
        _warning(text.encode())
    elif _warning is not None:
        _warning(text)
    else:
        warnings.warn(text, RuntimeWarning, stacklevel=2)


def set_mju_user_warning(callback: Any) -> None:
    """Sets what is called with the text of a warning, the first of its kind since a reset; None for Python's warnings.

    The engine warns where `set_instability("reset")` makes it go on; otherwise what MuJoCo warns of is an exception.
    """
    global _warning
    _warning = callback


def get_mju_user_warning() -> Any:
    """The handler that was set."""
    return _warning


def mj_resetCallbacks() -> None:
    """Sets all callbacks of passes to None."""
    with _lock:
        before = dict(_set)
        _set.clear()
        _core.set_called(False)
    del before
