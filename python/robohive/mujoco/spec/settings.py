"""Settings of the compiler."""

from typing import TYPE_CHECKING, Any, ClassVar

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
