"""`MjModel`: a compiled model, whose arrays are numpy arrays that may be written."""

import copy
import warnings
from collections.abc import Callable, Mapping
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar
from weakref import WeakValueDictionary

import numpy as np
from numpy.typing import NDArray

from robohive.mujoco import _engine as _core
from robohive.mujoco.last import remember
from robohive.mujoco.log import compile_timed
from robohive.mujoco.structs import absent, named
from robohive.mujoco.structs.fields import declare
from robohive.mujoco.structs.options import MjOption, MjStatistic, MjVisual
from robohive.mujoco.vfs import MjVfs, given_files, refuse_repeated

#: Arrays that are handed out as read-only copies: the structure that a model was compiled into, which no edit can change.
_STRUCTURE = ("names_map", "B_", "D_", "M_", "mapM", "mapD", "plugin_attr")
_BYTES = ("names", "paths", "text_data")
#: What a program may say that there is.
_FLAGS = ("flg_gravcomp", "flg_surfacevel", "flg_adhesion")
#: Texts that MuJoCo shows as numbers.
_LETTERS = ("plugin_attr",)
_Part = TypeVar("_Part", MjOption, MjStatistic, MjVisual)


class MjModel(_core.Model, named.ModelElements):
    """A compiled model.

    Every array of the model is an attribute of MuJoCo's name: a numpy array with the shape of MuJoCo's, that may be
    written. What is written takes effect in the next call that is given the model, and nothing is derived from it
    (`mj_setConst` does). Numbers that do not fit (NaN, references to no element) make that call raise a `ValueError`
    that names array and place, until they are corrected.

    Arrays of sparsity are read-only copies. `tex_data` may be written; pictures show it.
    """

    _shapes: dict[str, list[int]]
    _size_values: dict[str, int]
    _views: WeakValueDictionary[Any, Any]
    #: Arrays of elements that were asked for.
    _slices: dict[tuple[str, int, str], Any]

    def __new__(cls, compiled: _core.CompiledModel) -> "MjModel":
        return super().__new__(cls, compiled)

    def __init__(self, compiled: _core.CompiledModel) -> None:
        sizes = dict.fromkeys(absent.SIZES, 0) | self._size_table()
        described = self._describe()
        inner = self.__dict__
        inner["_size_values"] = sizes
        inner["_shapes"] = {name: shape for name, (_, shape) in described.items() if "." not in name}
        # Views hold their owner, so that it only holds them weakly.
        inner["_views"] = WeakValueDictionary()
        inner["_slices"] = {}
        inner["_flags"] = {}
        inner.update(sizes)

    @classmethod
    def from_xml_path(
        cls, filename: str | PathLike[str], assets: Mapping[str, bytes] | None = None, vfs: MjVfs | None = None
    ) -> "MjModel":
        """Loads a model from an MJCF file; files that it names are looked for among `assets` or in `vfs`, then on the disk.

        Raises:
            ValueError: what is wrong, every finding with file, line, column and element.
        """
        path, files = fspath(filename), _as_bytes(_own_names(given_files(vfs, assets)))
        model = cls._of(lambda: _core.load_path(path, files))
        remember(path, False, files)
        return model

    @classmethod
    def from_xml_string(
        cls, xml: str | bytes, assets: Mapping[str, bytes] | None = None, vfs: MjVfs | None = None
    ) -> "MjModel":
        """Loads a model from MJCF text; see `from_xml_path`."""
        text = xml.decode() if isinstance(xml, bytes) else xml
        files = _as_bytes(_own_names(given_files(vfs, assets)))
        model = cls._of(lambda: _core.load_text(text, files))
        remember(text, True, files)
        return model

    @classmethod
    def from_binary_path(
        cls, filename: str, assets: Mapping[str, bytes] | None = None, vfs: MjVfs | None = None
    ) -> "MjModel":
        """Loads a model that `mj_saveModel` or `robohive compile` wrote.

        Raises:
            ValueError: the file is none of these; MuJoCo's own `.mjb` files are no exception.
        """
        content = _as_bytes(given_files(vfs, assets)).get(filename)
        if content is None:
            with open(filename, "rb") as file:
                content = file.read()
        try:
            return cls(_core.CompiledModel.from_bytes(content))
        except ValueError as error:
            raise ValueError(
                f"{filename}: {error}; MuJoCo's own binary files cannot be read, load the XML that they were made of"
            ) from None

    @classmethod
    def _of(cls, load: Callable[[], tuple[_core.CompiledModel, list[str]]]) -> "MjModel":
        with compile_timed():
            compiled, findings = load()
        for finding in findings:
            warnings.warn(finding, stacklevel=3)
        return cls(compiled)

    def _look_up(self, name: str) -> Any:
        inner = self.__dict__
        value: Any
        if name in _BYTES:
            value = self._bytes(name)
        elif name in inner["_shapes"]:
            value = self._copied(name) if name.startswith(_STRUCTURE) else self._array(name)
            if name in _LETTERS:
                value = value.view(np.int8)
            if name.startswith(_STRUCTURE):
                value.flags.writeable = False
        else:
            value = absent.of_model(name, inner["_size_values"])
        inner[name] = value
        return value

    if not TYPE_CHECKING:  # for checkers, what is not declared is an error

        def __getattr__(self, name: str) -> NoReturn:
            raise AttributeError(f"'mujoco.MjModel' object has no attribute '{name}'")

    def __setattr__(self, name: str, value: Any) -> None:
        if name in self._shapes:
            getattr(self, name)[...] = value
        elif name in _FLAGS:
            super().__setattr__(name, value)
        else:
            _refuse(self, name)

    @property
    def opt(self) -> MjOption:
        """Simulation options."""
        return self._part(MjOption)

    @property
    def stat(self) -> MjStatistic:
        """Statistics at the reference configuration, lengths in metres."""
        return self._part(MjStatistic)

    @property
    def vis(self) -> MjVisual:
        """Visual settings."""
        return self._part(MjVisual)

    def _part(self, kind: type[_Part]) -> _Part:
        part: _Part | None = self._views.get(kind)
        if part is None:
            part = self._views[kind] = kind(self)
        return part

    @property
    def _address(self) -> int:
        return id(self)

    @property
    def flg_gravcomp(self) -> bool:
        """Some body has gravity compensation, or the program says so."""
        return self._flag("flg_gravcomp", self.body_gravcomp)

    @flg_gravcomp.setter
    def flg_gravcomp(self, value: bool) -> None:
        self._set_flag("flg_gravcomp", value, self.body_gravcomp)

    @property
    def ngravcomp(self) -> int:  # type: ignore[override]
        """1 with `flg_gravcomp`, else 0."""
        return int(self.flg_gravcomp)

    @property
    def flg_surfacevel(self) -> bool:
        """Some geom has a surface velocity, or the program says so."""
        return self._flag("flg_surfacevel", self.geom_surfacevel)

    @flg_surfacevel.setter
    def flg_surfacevel(self, value: bool) -> None:
        self._set_flag("flg_surfacevel", value, self.geom_surfacevel)

    @property
    def flg_adhesion(self) -> bool:
        """Some geom or pair has adhesion, or the program says so."""
        return self._flag("flg_adhesion", self.geom_adhesion) or bool(self.pair_adhesion.any())

    @flg_adhesion.setter
    def flg_adhesion(self, value: bool) -> None:
        self._set_flag("flg_adhesion", value, self.geom_adhesion, self.pair_adhesion)

    def _flag(self, name: str, values: NDArray[Any]) -> bool:
        return bool(self.__dict__["_flags"].get(name)) or bool(values.any())

    def _set_flag(self, name: str, value: bool, *arrays: NDArray[Any]) -> None:
        """The engine looks at the numbers themselves: a flag that is set changes nothing, and none hides them."""
        if not value and any(array.any() for array in arrays):
            raise NotImplementedError(f"{name} cannot be cleared while there are numbers that are not 0; write zeros there")
        self.__dict__["_flags"][name] = bool(value)

    @property
    def _sizes(self) -> NDArray[np.int64]:
        """All sizes, as MuJoCo's bindings have them."""
        return np.array(list(self._size_values.values()), np.int64)

    @property
    def signature(self) -> int:
        """A number that models of equal sizes share."""
        return hash(tuple(self._size_values.values()))

    def bind(self, specs: Any) -> Any:
        """What the model says of an element of the `MjSpec` that it was compiled of, or of a list of them.

        Raises:
            ValueError: the description was compiled again, or is another one.
        """
        from robohive.mujoco.spec.bind import bound

        return bound(self, self, specs)

    def __copy__(self) -> "MjModel":
        return type(self)(self._compiled())

    def __deepcopy__(self, memo: dict[int, Any]) -> "MjModel":
        duplicate = copy.copy(self)
        memo[id(self)] = duplicate
        return duplicate

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpickle, (self._to_bytes(),)


_ARRAYS, _SIZES = _core.model_fields()
declare(MjModel, (*_ARRAYS, *_SIZES, *absent.SIZES, *absent.MODEL_NAMES))


def _unpickle(content: bytes) -> MjModel:
    return MjModel(_core.CompiledModel.from_bytes(content))


def _refuse(owner: Any, name: str) -> NoReturn:
    kind = type(owner).__name__
    if hasattr(owner, name):
        raise AttributeError(f"'mujoco.{kind}' attribute '{name}' cannot be set")
    raise AttributeError(f"'mujoco.{kind}' object has no attribute '{name}'")


def _as_bytes(assets: Mapping[str, bytes] | None) -> dict[str, bytes]:
    return {name: bytes(content) for name, content in (assets or {}).items()}


def _own_names(files: dict[str, Any]) -> dict[str, Any]:
    refuse_repeated(files)
    return files
