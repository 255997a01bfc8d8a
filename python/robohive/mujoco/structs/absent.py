"""Fields that the engine has no room for. All are read-only."""

from collections.abc import Callable
from typing import Any

import numpy as np

#: Sizes that are always zero.
SIZES: tuple[str, ...] = ()

#: Arrays of a model without rows: by type, each with its columns.
_MODEL: dict[str, str] = {}

#: Arrays of a simulation without rows.
_DATA = {"uint64": "plugin_data"}

#: What depends on the model: no bounding volume is marked.
_MARKS: dict[str, Callable[[Any], Any]] = {"bvh_active": lambda m: np.zeros(m.nbvh, bool)}

#: Copies of what the model has.
_COPIES: dict[str, Callable[[Any], Any]] = {"plugin": lambda m: np.array(m.plugin)}


def _parse(table: dict[str, str]) -> dict[str, tuple[str, tuple[int, ...]]]:
    """Type and columns by name."""
    rows = ((dtype, *entry.partition(":")) for dtype, entries in table.items() for entry in entries.split())
    return {name: (dtype, (int(columns),) if columns else ()) for dtype, name, _, columns in rows}


_MODEL_SHAPES, _DATA_SHAPES = _parse(_MODEL), _parse(_DATA)
MODEL_NAMES = tuple(_MODEL_SHAPES)
DATA_NAMES = (*_DATA_SHAPES, *_MARKS, *_COPIES)


def of_model(name: str, sizes: dict[str, int]) -> Any:
    """The array of a model called `name`, None when it is not among these."""
    return _without_rows(_MODEL_SHAPES, name)


def of_data(name: str, model: Any) -> Any:
    """The array or count of a simulation called `name`, None when it is not among these."""
    if name in _MARKS:
        return _fixed(_MARKS[name](model))
    if name in _COPIES:
        return _fixed(_COPIES[name](model))
    return _without_rows(_DATA_SHAPES, name)


def _without_rows(shapes: dict[str, tuple[str, tuple[int, ...]]], name: str) -> Any:
    if name not in shapes:
        return None
    dtype, columns = shapes[name]
    return _fixed(np.zeros((0, *columns), dtype))


def _fixed(values: Any) -> Any:
    if isinstance(values, np.ndarray):
        values.flags.writeable = False
    return values
