"""`MjSpec` as far as a model's text goes: parse, compile, copy. Its elements cannot be edited."""

from collections.abc import Mapping
from os import PathLike, fspath
from typing import Any

from robohive.mujoco.data import MjData
from robohive.mujoco.model import MjModel


class MjSpec:
    """A model as its text describes it.

    It can be compiled. Its elements are not open to Python: edit the text, or the compiled model's arrays.
    """

    def __init__(self) -> None:
        self.__dict__.update(_text="<mujoco/>", _path=None, assets={})

    @classmethod
    def from_file(
        cls, filename: str | PathLike[str], include: Mapping[str, bytes] | None = None, assets: Mapping[str, bytes] | None = None
    ) -> "MjSpec":
        """The description in a file.

        Raises:
            ValueError: what is wrong with it.
        """
        spec = cls()
        spec.__dict__.update(_path=fspath(filename), assets={**(include or {}), **(assets or {})})
        spec.compile()
        return spec

    @classmethod
    def from_string(
        cls, xml: str, include: Mapping[str, bytes] | None = None, assets: Mapping[str, bytes] | None = None
    ) -> "MjSpec":
        """The description in a text.

        Raises:
            ValueError: what is wrong with it.
        """
        spec = cls()
        spec.__dict__.update(_text=xml, assets={**(include or {}), **(assets or {})})
        spec.compile()
        return spec

    def compile(self) -> MjModel:
        """The model.

        Raises:
            ValueError: what is wrong with the description.
        """
        if self._path is not None:
            return MjModel.from_xml_path(self._path, self.assets)
        return MjModel.from_xml_string(self._text, self.assets)

    def recompile(self, model: MjModel, data: MjData) -> tuple[MjModel, MjData]:
        """The model and new data of it."""
        model = self.compile()
        return model, MjData(model)

    def copy(self) -> "MjSpec":
        """A copy."""
        other = MjSpec()
        other.__dict__.update(self.__dict__, assets=dict(self.assets))
        return other

    __copy__ = copy

    def __deepcopy__(self, memo: dict[int, Any]) -> "MjSpec":
        return self.copy()

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        raise NotImplementedError(f"MjSpec.{name}: elements of a description are not open to Python; edit its text")

    def __setattr__(self, name: str, value: Any) -> None:
        raise NotImplementedError(f"MjSpec.{name}: elements of a description are not open to Python; edit its text")
