"""Arrays on their way to and from the extension module: dtype, shape and bytes."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[Any]
Packed = tuple[str, tuple[int, ...], bytes]


def pack(values: npt.ArrayLike) -> Packed:
    """Dtype, shape and little-endian bytes of an array."""
    array = np.asarray(values)
    if array.dtype.byteorder == ">":
        array = array.astype(array.dtype.newbyteorder("<"))
    return array.dtype.name, array.shape, array.tobytes()


def unpack(packed: tuple[str, tuple[int, ...], bytearray]) -> Array:
    """The array of dtype, shape and bytes. It owns its memory."""
    dtype, shape, data = packed
    return np.frombuffer(data, dtype=dtype).reshape(shape)
