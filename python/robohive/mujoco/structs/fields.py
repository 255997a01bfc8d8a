"""Attributes that come from the engine's tables of fields."""

from collections.abc import Iterable
from typing import Any


class Field:
    """An attribute that its owner looks up when it is asked for, unless the instance keeps it already."""

    __slots__ = ("name",)

    def __init__(self, name: str) -> None:
        self.name = name

    def __get__(self, owner: Any, kind: type | None = None) -> Any:
        return self if owner is None else owner._look_up(self.name)


def declare(kind: type, names: Iterable[str]) -> None:
    """Gives a class an attribute for every name that it lacks."""
    for name in names:
        if not hasattr(kind, name):
            setattr(kind, name, Field(name))
