"""Warnings, timers and solver statistics: sequences of records that also show each field as one array."""

import copy
from collections.abc import Iterator, Mapping
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray


class _Record:
    """One element of a list, its fields as attributes; without values, zeros."""

    _empty: ClassVar[Mapping[str, Any]] = {}

    def __init__(self, values: Mapping[str, Any] | None = None) -> None:
        self.__dict__.update(copy.deepcopy(self._empty) if values is None else values)

    def _values(self) -> dict[str, Any]:
        return vars(self)

    def __repr__(self) -> str:
        rows = (f"  {name}: {value!r}" for name, value in sorted(self._values().items()))
        return "\n".join((f"<{type(self).__name__}", *rows, ">"))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, _Record):
            return NotImplemented
        mine, theirs = self._values(), other._values()
        return mine.keys() == theirs.keys() and all(np.array_equal(mine[name], theirs[name]) for name in mine)

    __hash__ = None  # type: ignore[assignment]


class _List:
    """A list of records of which the fields are kept, each as one read-only array."""

    _record: ClassVar[type[_Record]]

    def __init__(self, fields: Mapping[str, NDArray[Any]]) -> None:
        for array in fields.values():
            array.flags.writeable = False
        self._fields = dict(fields)
        self._length = len(next(iter(fields.values())))

    def __getattr__(self, name: str) -> NDArray[Any]:
        fields: Mapping[str, NDArray[Any]] = self.__dict__.get("_fields", {})
        if name not in fields:
            raise AttributeError(f"'mujoco.{type(self).__name__}' object has no attribute '{name}'")
        return fields[name]

    def __dir__(self) -> list[str]:
        return sorted(self._fields)

    def __len__(self) -> int:
        return self._length

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice):
            return type(self)._of({name: values[index] for name, values in self._fields.items()})
        number = int(index)
        if not -self._length <= number < self._length:
            raise IndexError(f"index {number} is out of range: there are {self._length}")
        return self._record({name: _scalar(values[number]) for name, values in self._fields.items()})

    def __iter__(self) -> Iterator[Any]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        rows = (f"  {name}: {values!r}" for name, values in sorted(self._fields.items()))
        return "\n".join((f"<{type(self).__name__}", *rows, ">"))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, _List) or self._fields.keys() != other._fields.keys():
            return NotImplemented
        return all(np.array_equal(values, other._fields[name]) for name, values in self._fields.items())

    __hash__ = None  # type: ignore[assignment]

    @classmethod
    def _of(cls, fields: Mapping[str, NDArray[Any]]) -> Any:
        made = cls.__new__(cls)
        _List.__init__(made, fields)
        return made


def _scalar(value: Any) -> Any:
    return value.item() if np.ndim(value) == 0 else value


class MjWarningStat(_Record):
    """How often a warning was given, and at which place last. What is written into one of a simulation changes the simulation."""

    _arrays: Mapping[str, NDArray[np.int32]]
    __slots__ = ("_arrays",)
    _empty = {"lastinfo": 0, "number": 0}

    def __init__(self, arrays: Mapping[str, NDArray[np.int32]] | None = None, kind: int = 0) -> None:
        super().__init__(None if arrays is None else {name: values[kind].item() for name, values in arrays.items()})
        own = {name: values[kind : kind + 1] for name, values in (arrays or {}).items()}
        object.__setattr__(self, "_arrays", own)

    def __setattr__(self, name: str, value: Any) -> None:
        if name not in self._empty:
            raise AttributeError(f"'mujoco.MjWarningStat' object has no attribute '{name}'")
        self.__dict__[name] = int(value)
        if name in self._arrays:
            self._arrays[name][0] = value


class MjWarningStatList(_List):
    """Warnings by `mjtWarning`: the arrays of a simulation, which later calls keep up to date."""

    _record = MjWarningStat

    def __init__(self, lastinfo: NDArray[np.int32], number: NDArray[np.int32]) -> None:
        self._fields = {"lastinfo": lastinfo, "number": number}
        self._length = len(number)

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice):
            return MjWarningStatList(self.lastinfo[index], self.number[index])
        return MjWarningStat(self._fields, range(self._length)[int(index)])


class MjTimerStat(_Record):
    """A timer: what calls took [s], and how many there were."""

    _empty = {"duration": 0.0, "number": 0}


class MjTimerStatList(_List):
    """Timers by `mjtTimer` when the simulation was asked."""

    _record = MjTimerStat

    def __init__(self, duration: NDArray[np.float64], number: NDArray[np.int32]) -> None:
        super().__init__({"duration": duration, "number": number})


class MjSolverStat(_Record):
    """One iteration of the constraint solver."""

    _empty = {
        **dict.fromkeys(("improvement", "gradient", "lineslope"), 0.0),
        **dict.fromkeys(("nactive", "nchange", "neval", "nupdate"), 0),
    }


class MjSolverStatList(_List):
    """Iterations of the solver, 200 places for each of 20 islands."""

    _record = MjSolverStat
    _ISLANDS, _ITERATIONS = 20, 200

    def __init__(self, statistics: dict[str, list[Any]]) -> None:
        counts = statistics["solver_niter"]
        fields = {}
        for name in ("improvement", "gradient", "lineslope", "nactive", "nchange", "neval", "nupdate"):
            values = statistics[name]
            whole = np.zeros((self._ISLANDS, self._ITERATIONS), np.int32 if name[0] == "n" else np.float64)
            start = 0
            for island, count in enumerate(map(int, counts[: self._ISLANDS])):
                kept = min(count, self._ITERATIONS)
                whole[island, :kept] = values[start : start + kept]
                start += count
            fields[name] = whole.ravel()
        super().__init__(fields)
