"""Settings back to what they are in a model that states none."""

from typing import Any

from robohive.mujoco.spec.settings import MjLROpt
from robohive.mujoco.structs.options import MjOption, MjVisual, _Settings


def _reset(settings: _Settings) -> None:
    fresh = type(settings)()
    for name in settings._fields:
        setattr(settings, name, getattr(fresh, name))


def mj_defaultOption(opt: MjOption) -> None:
    """Sets the options of physics to their defaults."""
    _reset(opt)


def mj_defaultVisual(vis: MjVisual) -> None:
    """Sets all visual settings to their defaults."""
    for group in ("global_", "quality", "headlight", "map", "scale", "rgba"):
        _reset(getattr(vis, group))


def mj_defaultLROpt(opt: MjLROpt) -> None:
    """Sets the options of length ranges to their defaults."""
    fresh: Any = MjLROpt()
    for name in dir(fresh):
        if not name.startswith("_"):
            setattr(opt, name, getattr(fresh, name))
