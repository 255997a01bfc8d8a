"""Packages that fitting needs and that the bindings do not."""

import importlib
from typing import Any


def needed(module: str, package: str) -> Any:
    """A module of a package that may not be installed.

    Raises:
        ImportError: it is not; the message names the package.
    """
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise ImportError(
            f"mujoco.sysid needs {package}: `pip install {package}`, or `pip install robohive[sysid]` for all it uses ({error})"
        ) from error
