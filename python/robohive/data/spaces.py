"""Gymnasium's spaces as the JSON that Minari keeps of them."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

from robohive.data.errors import DataError


def _bounds(space: Any) -> dict[str, Any]:
    low, high = space.low.tolist(), space.high.tolist()
    return {"dtype": str(space.dtype), "shape": list(space.shape), "low": low, "high": high}


def _several(space: Any) -> dict[str, Any]:
    return {"dtype": str(space.dtype), "nvec": space.nvec.tolist(), "start": space.start.tolist()}


def _binary(space: Any) -> dict[str, Any]:
    return {"n": list(space.n) if isinstance(space.n, tuple) else int(space.n)}


def _text(space: Any) -> dict[str, Any]:
    return {"max_length": space.max_length, "min_length": space.min_length, "charset": space.characters}


# Entries of each kind of space, but its name.
_KINDS: dict[str, Callable[[Any], dict[str, Any]]] = {
    "Box": _bounds,
    "Discrete": lambda space: {"dtype": "int64", "start": int(space.start), "n": int(space.n)},
    "MultiDiscrete": _several,
    "MultiBinary": _binary,
    "Text": _text,
    "Dict": lambda space: {"subspaces": {key: _entries(inner) for key, inner in space.spaces.items()}},
    "Tuple": lambda space: {"subspaces": [_entries(inner) for inner in space.spaces]},
}


def _entries(space: Any) -> dict[str, Any]:
    name = type(space).__name__
    if name not in _KINDS:
        raise DataError(f"Minari has no form for a space of type {name}: use one of {', '.join(_KINDS)}")
    return {"type": name, **_KINDS[name](space)}


def space_to_json(space: Any) -> str:
    """The JSON of a space.

    Raises:
        DataError: Minari cannot keep a space of this kind.
    """
    return json.dumps(_entries(space))
