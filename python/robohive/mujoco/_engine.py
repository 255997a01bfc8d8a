"""The part of the extension module that the stand-in calls; `_engine.pyi` has its types."""

from typing import Any

from robohive import _core


def __getattr__(name: str) -> Any:
    return getattr(_core.mujoco, name)
