"""Registration as soon as Gymnasium is there, in whichever order the two packages are imported."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType


class After(MetaPathFinder):
    """Calls a function once after a module was imported for the first time.

    Importing Gymnasium here instead would cost every import of this package its 100 ms, and would make it a requirement.
    """

    def __init__(self, module: str, call: Callable[[], None]) -> None:
        self._module = module
        self._call = call

    def find_spec(
        self, name: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Lets the other finders find the module, and wraps its execution."""
        if name != self._module:
            return None
        others = (finder for finder in sys.meta_path if finder is not self)
        found = (finder.find_spec(name, path, target) for finder in others)
        spec = next((spec for spec in found if spec is not None), None)
        if spec is not None and spec.loader is not None:
            execute = spec.loader.exec_module

            def exec_module(module: ModuleType) -> None:
                execute(module)
                if self in sys.meta_path:
                    sys.meta_path.remove(self)
                    self._call()

            spec.loader.exec_module = exec_module  # type: ignore[method-assign]
        return spec


def after(module: str, call: Callable[[], None]) -> None:
    """Calls `call` now where the module is imported, otherwise after its first import."""
    if sys.modules.get(module) is not None:
        call()
    else:
        sys.meta_path.insert(0, After(module, call))
