"""Options, statistics and visual settings: structs whose fields are those of the engine's tables."""

from functools import cache
from typing import Any, ClassVar

import numpy as np


from robohive.mujoco import _engine as _core


@cache
def _kinds(group: str) -> dict[str, type]:
    """Python's type of each setting."""
    return {name: type(value) for name, value in _core.default_settings(group).items()}


class _Settings:
    """One group of settings, of a model or on its own with default values.

    Numbers are read from and written to the model at once; arrays are views, written with the next call.
    """

    _group: ClassVar[str]

    def __init__(self, model: _core.Model | None = None) -> None:
        inner = self.__dict__
        inner["_model"] = model
        inner["_fields"] = _kinds(self._group)
        if model is None:
            values = _core.default_settings(self._group)
            inner["_own"] = {
                name: np.array(value) if isinstance(value, list) else value for name, value in values.items()
            }

    def __getattr__(self, name: str) -> Any:
        inner = self.__dict__
        kind = inner.get("_fields", {}).get(name)
        if kind is None:
            raise AttributeError(f"'mujoco.{type(self).__name__}' object has no attribute '{name}'")
        model = inner["_model"]
        if model is None:
            return inner["_own"][name]
        if kind is list:
            array = model._array(f"{self._group}.{name}")
            inner[name] = array
            return array
        return kind(model._setting(self._group, name))

    def __setattr__(self, name: str, value: Any) -> None:
        inner = self.__dict__
        kind = inner["_fields"].get(name)
        if kind is None:
            raise AttributeError(f"'mujoco.{type(self).__name__}' object has no attribute '{name}'")
        if kind is list:
            getattr(self, name)[...] = value
        elif inner["_model"] is None:
            inner["_own"][name] = kind(value)
        else:
            inner["_model"]._set_setting(self._group, name, float(kind(value)))

    def __dir__(self) -> list[str]:
        return sorted(self._fields)

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        return all(np.array_equal(getattr(self, name), getattr(other, name)) for name in self._fields)

    __hash__ = None  # type: ignore[assignment]

    def __copy__(self) -> "_Settings":
        duplicate = type(self)()
        for name in self._fields:
            setattr(duplicate, name, getattr(self, name))
        return duplicate

    def __deepcopy__(self, memo: dict[int, Any]) -> "_Settings":
        return self.__copy__()

    def __repr__(self) -> str:
        rows = (f"  {name}: {getattr(self, name)!r}" for name in sorted(self._fields))
        return "\n".join((f"<{type(self).__name__}", *rows, ">"))


class MjOption(_Settings):
    """Simulation options (`model.opt`)."""

    _group = "opt"


class MjStatistic(_Settings):
    """Statistics of a model at its reference configuration (`model.stat`), lengths in metres."""

    _group = "stat"


class _Global(_Settings):
    """General visual settings."""

    _group = "vis.global"


class _Quality(_Settings):
    """Rendering quality."""

    _group = "vis.quality"


class MjVisualHeadlight(_Settings):
    """The light at the camera."""

    _group = "vis.headlight"


class _Map(_Settings):
    """Scale factors from physical to visual quantities."""

    _group = "vis.map"


class _Scale(_Settings):
    """Sizes of decorative elements."""

    _group = "vis.scale"


class MjVisualRgba(_Settings):
    """Colours of decorative elements."""

    _group = "vis.rgba"


class MjVisual:
    """Visual settings (`model.vis`); `global` is a word of Python, hence `global_`."""

    Global = _Global
    Quality = _Quality
    Headlight = MjVisualHeadlight
    Map = _Map
    Scale = _Scale
    Rgba = MjVisualRgba

    def __init__(self, model: _core.Model | None = None) -> None:
        self.global_ = _Global(model)
        self.quality = _Quality(model)
        self.headlight = MjVisualHeadlight(model)
        self.map = _Map(model)
        self.scale = _Scale(model)
        self.rgba = MjVisualRgba(model)

    def __getattr__(self, name: str) -> _Settings:
        if name == "global":
            return self.global_
        raise AttributeError(f"'mujoco.MjVisual' object has no attribute '{name}'")

    def __repr__(self) -> str:
        return "\n".join(("<MjVisual", *(f"  {name}: {group!r}" for name, group in vars(self).items()), ">"))


