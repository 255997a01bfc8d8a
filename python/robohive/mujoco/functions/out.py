"""Arguments of functions with MuJoCo's signatures: arrays that results are written into, and vectors of numbers."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Vector = NDArray[np.float64]


def vector(values: ArrayLike, name: str, size: int | None = None) -> Vector:
    """The numbers as a contiguous array of one axis.

    Raises:
        TypeError: these are no numbers, or not `size` of them.
    """
    array = np.ascontiguousarray(values, np.float64)
    if array.ndim == 2 and 1 in array.shape:
        array = array.ravel()
    if array.ndim != 1 or (size is not None and array.size != size):
        raise TypeError(f"{name} should be a vector of {size if size is not None else 'any'} numbers, not of shape {array.shape}")
    return array


def destination(array: Any, name: str, shape: str, rows: tuple[int, ...], dtype: Any = np.float64) -> None:
    """Refuses an array that results of shape `rows` cannot be written into; `shape` says so in a message.

    Raises:
        TypeError: it is no writable array of that type, or has another shape.
    """
    if not isinstance(array, np.ndarray) or array.dtype != dtype:
        raise TypeError(f"{name} should be a numpy array of type {np.dtype(dtype).name}")
    fits = array.size == rows[0] if len(rows) == 1 and array.ndim <= 2 else array.shape == rows
    if not fits:
        raise TypeError(f"{name} must have {shape}")
    if not array.flags.writeable:
        raise TypeError(f"{name} is read-only")


def write(array: Any, values: ArrayLike) -> None:
    """Overwrites an array, whatever its shape; of a subclass, without what that adds to writing."""
    np.ndarray.__setitem__(array, ..., np.asarray(values).reshape(array.shape))
