"""What enumerations have in common: members that stand for whole numbers, and compare as MuJoCo's do."""

from enum import IntEnum
from typing import Any

import numpy as np


class Numbered(IntEnum):
    """An enumeration of MuJoCo's.

    A member equals itself and Python's whole number that it stands for, but neither a float nor a number or an array of
    numpy on its right, nor a member of another enumeration. With numpy on the left, numpy decides, and takes the number.
    Programs depend on that: `np.int32(1) == mjtObj.mjOBJ_BODY` holds, `mjtObj.mjOBJ_BODY == np.int32(1)` does not. Other
    than MuJoCo's, members are whole numbers of Python's and can be ordered.
    """

    def __eq__(self, other: object) -> Any:
        if isinstance(other, Numbered):
            return self is other
        if isinstance(other, int):
            return int.__eq__(self, other)
        return False if isinstance(other, float | np.generic | np.ndarray) else NotImplemented

    def __ne__(self, other: object) -> Any:
        equal = self.__eq__(other)
        return equal if equal is NotImplemented else not equal

    __hash__ = IntEnum.__hash__

    def __str__(self) -> str:
        return f"{type(self).__name__}.{self.name}"

    def __format__(self, format_spec: str) -> str:
        return format(int(self), format_spec) if format_spec else str(self)
