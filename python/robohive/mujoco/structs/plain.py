"""Records that MuJoCo's own C code fills in, and lists that only it makes."""

from typing import Any

import numpy as np

from robohive.mujoco.pictures.view import _Struct


class MjPreContact(_Struct):
    """A contact before its parameters: distance [m], middle, normal and tangent (3 each, world)."""

    def __init__(self) -> None:
        self.dist = 0.0
        self.pos, self.normal, self.tangent = (np.zeros(3) for _ in range(3))


class MjLogMessage(_Struct):
    """A message of the engine: level, topic, and where it comes from."""

    def __init__(self) -> None:
        self.level = self.topic = self.line = 0
        self.timestamp = False
        self.subject = ""
        self.body: str | None = None
        self.file: str | None = None
        self.func: str | None = None


class MjrVertexAttribute(_Struct):
    """What a number of a vertex is for, and its type."""

    def __init__(self, usage: int = 0, type: int = 0) -> None:
        self.usage, self.type = int(usage), int(type)


class _Made:
    """A list that functions of the engine return; programs make none."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        raise TypeError(f"{type(self).__name__} is made by the engine only")

    def __len__(self) -> int:
        return 0


class MjByteVec(_Made):
    """Bytes of a description."""


class MjDoubleVec(_Made):
    """Numbers of a description, in double precision."""


class MjFloatVec(_Made):
    """Numbers of a description, in single precision."""


class MjIntVec(_Made):
    """Whole numbers of a description."""
