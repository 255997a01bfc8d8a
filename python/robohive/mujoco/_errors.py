"""Exceptions of the stand-in."""

from robohive.mujoco import _engine as _core

FatalError = _core.FatalError
UnexpectedError = _core.UnexpectedError

__all__ = ["FatalError", "UnexpectedError"]
