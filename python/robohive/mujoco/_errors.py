"""Exceptions of the stand-in."""

from robohive._core import mujoco as _core

FatalError = _core.FatalError
UnexpectedError = _core.UnexpectedError

__all__ = ["FatalError", "UnexpectedError"]
