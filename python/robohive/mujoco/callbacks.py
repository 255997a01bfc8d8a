"""Callbacks. The engine calls no Python while it steps: there is only the handler of warnings, called after a step.

Setting another to None does nothing.
"""

import warnings
from collections.abc import Callable
from typing import Any


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


set_mjcb_act_bias = _setter("mjcb_act_bias")
get_mjcb_act_bias = _getter("mjcb_act_bias")
set_mjcb_act_dyn = _setter("mjcb_act_dyn")
get_mjcb_act_dyn = _getter("mjcb_act_dyn")
set_mjcb_act_gain = _setter("mjcb_act_gain")
get_mjcb_act_gain = _getter("mjcb_act_gain")
set_mjcb_contactfilter = _setter("mjcb_contactfilter")
get_mjcb_contactfilter = _getter("mjcb_contactfilter")
set_mjcb_control = _setter("mjcb_control")
get_mjcb_control = _getter("mjcb_control")
set_mjcb_passive = _setter("mjcb_passive")
get_mjcb_passive = _getter("mjcb_passive")
set_mjcb_sensor = _setter("mjcb_sensor")
get_mjcb_sensor = _getter("mjcb_sensor")
set_mjcb_time = _setter("mjcb_time")
get_mjcb_time = _getter("mjcb_time")
set_mju_user_free = _setter("mju_user_free")
get_mju_user_free = _getter("mju_user_free")
set_mju_user_malloc = _setter("mju_user_malloc")
get_mju_user_malloc = _getter("mju_user_malloc")

_warning: Any = None

#: What is wrong, by `mjtWarning`.
_TEXTS = (
    "the inertia matrix is nearly singular at degree of freedom {}; check masses and armatures",
    "there are more contacts than memory allows: {}",
    "there are more constraint rows than memory allows: {} bytes",
    "qpos is not finite or too large at degree of freedom {}; the simulation is unstable",
    "qvel is not finite or too large at degree of freedom {}; the simulation is unstable",
    "qacc is not finite or too large at degree of freedom {}; the simulation is unstable",
    "ctrl is not finite or too large at actuator {}; all controls count as zero",
)


def mju_warningText(warning: int, info: int) -> str:
    """What a warning (`mjtWarning`) says of a place."""
    return _TEXTS[int(warning)].format(int(info))


def _tell(kind: int, place: int, time: float) -> None:
    """Tells of the first warning of a kind since a reset, in the step that began at `time` [s]."""
    text = f"{mju_warningText(kind, place)}, at time {time:.4f} s"
    if _warning is not None:
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
    """Nothing to reset."""
