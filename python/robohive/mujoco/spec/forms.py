"""Attributes of elements: what values they take, from the engine's declarations."""

from collections.abc import Iterable
from enum import IntEnum
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from robohive.mujoco import _engine as _core
from robohive.mujoco import _enums

_DTYPES = {"reals": np.float64, "singles": np.float32, "integers": np.int32}
#: Arrays of which the first numbers suffice, the others being zero.
_SHORT = {"size", "stiffness", "damping"}
#: Attributes of the engine that Python holds in another way.
_INNER = {
    "mesh": ("builtin", "params", "path"),
    "hfield": ("path",),
    "texture": ("path", "cubepaths"),
    "skin": ("path",),
    "plugin": ("plugin", "expanded"),
}
_CODES = {("geom", "typeinertia"): "mjtGeomInertia"}
#: What bodies and tuples have beside the engine's plain values: form, length, default.
_MORE: dict[str, dict[str, tuple[str, int | None, Any]]] = {
    "body": {
        "mass": ("real", None, 0.0),
        "ipos": ("reals", 3, [np.nan, 0, 0]),
        "iquat": ("reals", 4, [1, 0, 0, 0]),
        "inertia": ("reals", 3, [0, 0, 0]),
        "fullinertia": ("reals", 6, [np.nan, 0, 0, 0, 0, 0]),
        "explicitinertial": ("flag", None, False),
        "childclass": ("text", None, ""),
    },
    "frame": {"childclass": ("text", None, "")},
    "mesh": {"needsdf": ("flag", None, False)},
    "flex": {
        "size": ("reals", 3, [0, 0, 0]),
        "passive": ("integer", None, 0),
        "elastic2d": ("integer", None, 0),
    },
    "skin": {
        "bodyname": ("texts", None, []),
        "bindpos": ("singles", None, []),
        "bindquat": ("singles", None, []),
        "vertid": ("lists of integers", None, []),
        "vertweight": ("lists of singles", None, []),
    },
    "plugin": {"plugin_name": ("text", None, ""), "active": ("flag", None, False)},
    "tuple": {
        "objtype": ("integers", None, []),
        "objname": ("texts", None, []),
        "objprm": ("reals", None, []),
    },
}


class _Items(list[Any]):
    """A list of a fixed length, without negative places."""

    def __getitem__(self, index: Any) -> Any:
        return super().__getitem__(self._checked(index))

    def __setitem__(self, index: Any, value: Any) -> None:
        super().__setitem__(self._checked(index), value)

    def _checked(self, index: Any) -> Any:
        if not isinstance(index, slice) and not 0 <= index < len(self):
            raise IndexError("no element has this number")
        return index


class MjStringVec(_Items):
    """Texts, whose places can be assigned."""


class MjCharVec(_Items):
    """Letters, whose places can be assigned."""


class Form(NamedTuple):
    """What values an attribute takes."""

    name: str
    word: str
    enum: type[IntEnum] | None
    length: int | None
    default: Any

    def fresh(self, value: Any) -> Any:
        """A value of the engine as Python holds it; never shared."""
        if self.enum is not None:
            return self.enum(int(value))
        match self.word:
            case "reals" | "singles" | "integers":
                return np.array(value, _DTYPES[self.word]).ravel()
            case "texts":
                return MjStringVec(value)
            case "lists of integers" | "lists of singles":
                return self._rows(value)
            case "letters" if isinstance(value, bytes):
                return value if self.length is None else MjCharVec(value.decode())
            case "letters":
                return MjCharVec(value)
        return value

    def accept(self, value: Any) -> Any:
        """A value of a program as Python holds it.

        Raises:
            TypeError: it is of another type.
            ValueError: it has another length.
        """
        if self.enum is not None:
            return self.enum(_whole(value))
        match self.word:
            case "reals" | "singles" | "integers":
                return self._numbers(value)
            case "flag":
                return bool(value) if not isinstance(value, str) else _refuse(self.name, value)
            case "integer":
                return _whole(value)
            case "real":
                return float(value) if not isinstance(value, str) else _refuse(self.name, value)
            case "text":
                return value if isinstance(value, str) else _refuse(self.name, value)
            case "texts":
                return MjStringVec(self._texts(value))
            case "lists of integers" | "lists of singles":
                return self._rows(value)
        return self._letters(value)

    def _numbers(self, value: Any) -> Any:
        if isinstance(value, (str, bytes)):
            _refuse(self.name, value)
        try:
            numbers = np.array(value, _DTYPES[self.word])
        except ValueError:
            return _refuse(self.name, value)
        if self.length is None:
            return numbers.ravel()
        if self.name in _SHORT and (numbers.ndim == 0 or 1 <= numbers.size <= self.length):
            return np.concatenate((numbers.ravel(), np.zeros(self.length - numbers.size, numbers.dtype)))
        if numbers.size != self.length or numbers.ndim == 0:
            sizes = f"1 to {self.length}" if self.name in _SHORT else self.length
            raise ValueError(f"{self.name} should be a list/array of size {sizes}.")
        return numbers.ravel()

    def _rows(self, value: Any) -> list[Any]:
        dtype = np.int32 if self.word.endswith("integers") else np.float32
        if isinstance(value, (str, bytes)) or any(isinstance(row, (str, bytes)) for row in value):
            _refuse(self.name, value)
        return [np.array(row, dtype).ravel() for row in value]

    def _texts(self, value: Iterable[Any]) -> list[str]:
        texts = list(value)
        if isinstance(value, str) or not all(isinstance(text, str) for text in texts):
            _refuse(self.name, value)
        if self.length is not None and len(texts) != self.length:
            raise ValueError(f"{self.name} must have exactly {self.length} elements, got {len(texts)}.")
        return texts

    def _letters(self, value: Any) -> Any:
        if self.length is None:
            return bytes(value)
        letters = list(value.decode() if isinstance(value, bytes) else value)
        if len(letters) != self.length:
            raise ValueError(f"{self.name} should have length {self.length}, not {len(letters)}.")
        if not all(isinstance(letter, str) and len(letter) == 1 for letter in letters):
            raise ValueError(f"{self.name}: list elements must be single characters.")
        return MjCharVec(letters)


def _refuse(name: str, value: Any) -> Any:
    raise TypeError(f"{name} cannot be a {type(value).__name__}")


def _whole(value: Any) -> int:
    return int(value.__index__() if hasattr(value, "__index__") else _refuse("a whole number", value))


@cache
def forms(kind: str) -> dict[str, Form]:
    """The attributes of a kind of element or settings that programs see, by name."""
    hidden = _INNER.get(kind, ())
    return {name: form for name, form in all_forms(kind).items() if name not in hidden}


@cache
def all_forms(kind: str) -> dict[str, Form]:
    """All attributes of a kind of element or settings, by name."""
    found = {}
    for name, word, code, length, default in _core.spec_forms().get(kind, ()):
        code = _CODES.get((kind, name), code)
        if name == "gridlayout":
            word, length = "letters", len(default)
        found[name] = Form(name, word, getattr(_enums, code, None) if code else None, length, default)
    for name, (word, length, default) in _MORE.get(kind, {}).items():
        found[name] = Form(name, word, None, length, default)
    if "name" in found:
        found["info"] = Form("info", "text", None, None, "")
    return found
