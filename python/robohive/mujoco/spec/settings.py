"""Settings of the compiler."""

from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from robohive.mujoco.spec.forms import forms


class _Settings:
    """Named settings."""

    _kind: ClassVar[str]

    def __init__(self, values: dict[str, Any] | None = None) -> None:
        given = values or {}
        for name, form in forms(self._kind).items():
            self.__dict__[name] = form.fresh(given.get(name, form.default))

    def __setattr__(self, name: str, value: Any) -> None:
        form = forms(self._kind).get(name)
        if form is None:
            raise AttributeError(f"'mujoco.{type(self).__name__}' object has no attribute '{name}'")
        self.__dict__[name] = form.accept(value)

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        return all(np.array_equal(value, other.__dict__[name]) for name, value in self.__dict__.items())

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        rows = (f"  {name}: {value!r}" for name, value in sorted(self.__dict__.items()))
        return "\n".join((f"<{type(self).__name__}", *rows, ">"))

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any: ...


class MjLROpt(_Settings):
    """How ranges of the lengths of actuators are computed."""

    _kind = "lengthrange"


class MjsCompiler(_Settings):
    """Settings of the compiler; `LRopt` says how ranges of lengths are computed, `authored` which settings the text gives."""

    _kind = "compiler"

    def __init__(
        self, values: dict[str, Any] | None = None, lengths: dict[str, Any] | None = None, authored: int = 0
    ) -> None:
        super().__init__(values)
        self.__dict__["LRopt"] = MjLROpt(lengths)
        self.__dict__["authored"] = authored

    def __setattr__(self, name: str, value: Any) -> None:
        if name == "authored":
            self.__dict__[name] = int(value)
        else:
            super().__setattr__(name, value)

    def _copied(self) -> "MjsCompiler":
        return MjsCompiler(self.__dict__, self.LRopt.__dict__, self.authored)


class MjStatistic(_Settings):
    """Statistics that replace the computed ones; NaN is computed."""

    _kind = "stat"
