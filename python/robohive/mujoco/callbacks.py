"""Callbacks: there are none. The engine calls no Python while it steps; setting one to None does nothing."""

from collections.abc import Callable
from typing import Any

_NAMES = (
    "mjcb_act_bias mjcb_act_dyn mjcb_act_gain mjcb_contactfilter mjcb_control mjcb_passive mjcb_sensor mjcb_time "
    "mju_user_free mju_user_malloc"
).split()


def _setter(name: str) -> Callable[[Any], None]:
    def set_callback(callback: Any) -> None:
        if callback is not None:
            raise NotImplementedError(f"{name}: the engine steps without the interpreter, and calls nothing back")

    set_callback.__name__ = f"set_{name}"
    set_callback.__doc__ = f"Accepts None; `{name}` is never called."
    return set_callback


def _getter(name: str) -> Callable[[], None]:
    def get_callback() -> None:
        return None

    get_callback.__name__ = f"get_{name}"
    get_callback.__doc__ = f"None: `{name}` is never called."
    return get_callback


for _name in _NAMES:
    globals()[f"set_{_name}"] = _setter(_name)
    globals()[f"get_{_name}"] = _getter(_name)

_warning: Any = None


def set_mju_user_warning(callback: Any) -> None:
    """Keeps a handler of warnings. What MuJoCo warns of is an exception or a Python warning here."""
    global _warning
    _warning = callback


def get_mju_user_warning() -> Any:
    """The handler that was set."""
    return _warning


def mj_resetCallbacks() -> None:
    """Nothing to reset."""


__all__ = [
    *(f"{way}_{name}" for name in _NAMES for way in ("set", "get")),
    "get_mju_user_warning",
    "mj_resetCallbacks",
    "set_mju_user_warning",
]
