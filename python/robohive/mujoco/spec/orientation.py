"""Orientations given in another way than by a quaternion."""

from typing import Any

import numpy as np

from robohive.mujoco.enums.view import mjtOrientation

#: Ways by their codes, with the numbers that each takes.
WAYS = {"axisangle": 4, "xyaxes": 6, "zaxis": 3, "euler": 3}


class MjsOrientation:
    """An orientation by axis and angle, two axes, the z axis, or Euler angles; `type` says which of them holds.

    Angles are in the unit of the compiler's settings.
    """

    __slots__ = ("axisangle", "euler", "type", "xyaxes", "zaxis")

    def __init__(self) -> None:
        self.type = mjtOrientation.mjORIENTATION_QUAT
        for name, length in WAYS.items():
            object.__setattr__(self, name, np.zeros(length))

    def __setattr__(self, name: str, value: Any) -> None:
        if name == "type":
            object.__setattr__(self, name, mjtOrientation(int(value)))
            return
        if name not in WAYS:
            raise AttributeError(f"'mujoco.MjsOrientation' object has no attribute '{name}'")
        getattr(self, name)[:] = value

    def set(self, name: str, numbers: Any, shown: str) -> None:
        """Makes this an orientation of another way; `shown` is what messages call it.

        Raises:
            ValueError: there are too few or too many numbers.
        """
        values = np.array(numbers, float).ravel()
        if len(values) != WAYS[name]:
            raise ValueError(f"{shown} should be a list/array of size {WAYS[name]}.")
        getattr(self, name)[:] = values
        self.type = getattr(mjtOrientation, f"mjORIENTATION_{name.upper()}")

    def take(self, code: int, numbers: Any) -> None:
        """Becomes what the engine says."""
        if code:
            self.set(list(WAYS)[code - 1], numbers, "orientation")

    def copied(self) -> "MjsOrientation":
        """A copy."""
        other = MjsOrientation()
        other.type = self.type
        for name in WAYS:
            getattr(other, name)[:] = getattr(self, name)
        return other
