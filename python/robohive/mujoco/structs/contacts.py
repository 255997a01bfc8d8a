"""Contacts: records on their own, and the contacts of a simulation, which stay up to date and may be written."""

from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robohive.mujoco.structs.lists import _List, _Record

#: Numbers of the Hessian of an elliptic cone. The engine keeps it elsewhere: zeros, which may be written.
_HESSIAN = 36


class MjContact(_Record):
    """A contact: `dist` [m], `pos` and `frame` (normal, two tangents) in the world, the two partners, and parameters.

    A partner is a `geom`, or an element (`elem`) or a vertex (`vert`) of a `flex`; what it is not is -1.
    """

    _empty = {
        **dict.fromkeys(("dist", "includemargin", "adhesion", "mu"), 0.0),
        **dict.fromkeys(("dim", "exclude", "efc_address", "geom1", "geom2"), 0),
        "pos": np.zeros(3),
        "frame": np.zeros(9),
        "H": np.zeros(_HESSIAN),
        **{name: np.zeros(size) for name, size in (("friction", 5), ("solref", 2), ("solreffriction", 2), ("solimp", 5))},
        **{name: np.zeros(2, np.int32) for name in ("geom", "flex", "elem", "vert")},
    }

    def __copy__(self) -> "MjContact":
        return MjContact({name: np.array(value) if np.ndim(value) else value for name, value in self._values().items()})

    def __deepcopy__(self, memo: dict[int, Any]) -> "MjContact":
        return self.__copy__()

    def __reduce__(self) -> tuple[Any, ...]:
        return MjContact, (self.__copy__().__dict__,)


class _Held(MjContact):
    """A contact of a simulation, by its place: what is read is the present, what is written goes into the simulation."""

    __slots__ = ("_place", "_source")

    def __init__(self, source: Callable[[], Mapping[str, NDArray[Any]]], place: int) -> None:
        object.__setattr__(self, "_source", source)
        object.__setattr__(self, "_place", place)

    def _values(self) -> dict[str, Any]:
        return {name: getattr(self, name) for name in self._empty}

    def __getattr__(self, name: str) -> Any:
        if name not in self._empty:
            raise AttributeError(f"'mujoco.MjContact' object has no attribute '{name}'")
        values = self._source()[name]
        if self._place >= len(values):
            raise IndexError(f"contact {self._place} is gone: there are {len(values)}")
        value = values[self._place]
        return value.item() if np.ndim(value) == 0 else value

    def __setattr__(self, name: str, value: Any) -> None:
        if name not in self._empty:
            raise AttributeError(f"'mujoco.MjContact' object has no attribute '{name}'")
        self._source()[name][self._place] = value


_Held.__name__ = _Held.__qualname__ = "MjContact"


def contact_arrays(gathered: dict[str, Any]) -> dict[str, NDArray[Any]]:
    """The fields of all contacts, in place: partners by column, and the Hessians."""
    if "H" not in gathered:
        count = gathered.pop("ncon").item()
        geom = gathered["geom"] = gathered["geom"].reshape(count, 2)
        gathered.update(H=np.zeros((count, _HESSIAN)), geom1=geom[:, 0], geom2=geom[:, 1])
    return gathered


class MjContactList(_List):
    """Contacts of a simulation: a sequence, and an array for each field. Both show the present contacts, and what is written
    into them reaches the simulation with the next call."""

    _record = MjContact

    def __init__(self, source: Callable[[], Mapping[str, NDArray[Any]]], places: slice | None = None) -> None:
        self._source = source
        self._places = places

    @property
    def _fields(self) -> dict[str, NDArray[Any]]:  # type: ignore[override]
        fields = self._source()
        return {name: fields[name] if self._places is None else fields[name][self._places] for name in MjContact._empty}

    @property
    def _numbers(self) -> range:
        every = range(len(self._source()["dist"]))
        return every if self._places is None else every[self._places]

    def __getattr__(self, name: str) -> NDArray[Any]:
        if name.startswith("_") or name not in MjContact._empty:
            raise AttributeError(f"'mujoco.MjContactList' object has no attribute '{name}'")
        return self._fields[name]

    def __setattr__(self, name: str, value: Any) -> None:
        if name.startswith("_"):
            super().__setattr__(name, value)
        else:
            getattr(self, name)[...] = value

    def __len__(self) -> int:
        return len(self._numbers)

    def __iter__(self) -> Iterator[Any]:
        # Programs change the simulation as they go, so that the list may end earlier.
        number = 0
        while number < len(self):
            yield self[number]
            number += 1

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice):
            numbers = self._numbers[index]
            stop = numbers.stop if numbers.stop >= 0 else None
            return MjContactList(self._source, slice(numbers.start, stop, numbers.step))
        number = int(index)
        if not -len(self) <= number < len(self):
            raise IndexError(f"index {number} is out of range: there are {len(self)}")
        return _Held(self._source, self._numbers[number])
