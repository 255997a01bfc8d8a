"""Elements of a description by kind: found by name, listed, added."""

from collections.abc import Callable
from typing import Any

from robohive.mujoco.spec.bodies import MjsBody
from robohive.mujoco.spec.defaults import KINDS as DEFAULTS
from robohive.mujoco.spec.exchange import LISTED

_PLURALS = {"body": "bodies", "mesh": "meshes", "equality": "equalities", "flex": "flexes"}
#: Elements that go by the name of their file when they have none.
_FILES = ("mesh", "skin", "hfield", "texture")


class Lists:
    """What descriptions offer for every kind of element."""

    _world: MjsBody
    _lists: dict[str, list[Any]]
    _names: dict[str, dict[str, Any]]

    def _all(self, kind: str) -> list[Any]:
        """All elements of a kind in the order of their ids."""
        if kind == "body":
            return list(self._world._below())
        return list(self._lists[kind]) if kind in self._lists else self._world._all(kind)


def _finder(kind: str) -> Callable[[Lists, str], Any]:
    def find(self: Lists, name: str) -> Any:
        found = self._names[kind].get(name)
        if found is None and kind in _FILES:
            unnamed = (element for element in self._lists[kind] if not element.name)
            found = next((element for element in unnamed if _stem(element.file) == name), None)
        return found

    find.__name__ = kind
    find.__doc__ = f"The {kind} of this name, None when there is none."
    return find


def _stem(path: str) -> str:
    name = path.replace("\\", "/").rpartition("/")[2]
    return name.rpartition(".")[0] or name


def _adder(kind: type[Any]) -> Callable[..., Any]:
    def add_by_default(self: Any, default: Any = None, **attributes: Any) -> Any:
        return self._append(kind, default, attributes)

    def add_plain(self: Any, **attributes: Any) -> Any:
        return self._append(kind, None, attributes)

    add: Callable[..., Any] = add_by_default if kind._kind in DEFAULTS else add_plain
    add.__name__ = f"add_{kind._kind}"
    add.__doc__ = f"Adds a {kind._kind}; attributes can be given by name."
    return add


def _listing(kind: str) -> property:
    def listed(self: Lists) -> list[Any]:
        return self._all(kind)

    return property(listed, doc=f"All elements of the kind {kind}, in the order of their ids.")


for _kind in (*MjsBody.HELD, *LISTED):
    setattr(Lists, _kind, _finder(_kind))
    setattr(Lists, _PLURALS.get(_kind, f"{_kind}s"), _listing(_kind))
for _type in LISTED.values():
    setattr(Lists, f"add_{_type._kind}", _adder(_type))
