"""Recordings of episodes: HDF5 files in the layouts of RoboHive and RoboSet, and numpy archives with the same names."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import TracebackType
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from robohive import _core
from robohive.data._arrays import Array, pack, unpack
from robohive.data.episode import Episode
from robohive.data.errors import DataError

StrPath = str | os.PathLike[str]
Layout = Literal["robohive", "roboset"]
Precision = Literal["full", "reduced"]


class Dataset:
    """An array of a trial, which is read when it is asked for.

    ``dataset[...]`` and ``numpy.asarray(dataset)`` read it; a slice without a step, as in ``dataset[10:20]``, reads these rows alone.
    """

    def __init__(self, file: _core.Trace, trial: str, key: str, kind: str, shape: tuple[int, ...]):
        self._file = file
        self._trial = trial
        self.key = key
        """Name inside of the trial, as in ``env_infos/solved``."""
        self.kind = kind
        """Name of numpy's dtype, ``"text"``, or what the file calls a type that is not read."""
        self.shape = shape
        """Lengths of the axes; empty for a scalar."""

    @property
    def dtype(self) -> np.dtype[Any]:
        """Type of the elements; ``object`` for texts.

        Raises:
            DataError: elements of this type are not read.
        """
        if self.kind == "text":
            return np.dtype(object)
        try:
            return np.dtype(self.kind)
        except TypeError:
            raise DataError(f"{self._trial}/{self.key}: elements of type {self.kind} are not read") from None

    def __len__(self) -> int:
        if not self.shape:
            raise TypeError("a scalar has no length")
        return self.shape[0]

    def read(self) -> Array:
        """All of it: numbers, or an array of texts.

        Raises:
            DataError: the file is damaged, or elements of this type are not read.
        """
        if self.dtype == np.dtype(object):
            texts = np.array(self._file.texts(self._trial, self.key), dtype=object)
            return texts.reshape(self.shape)
        return unpack(self._file.read(self._trial, self.key, None))

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice) and index.step in (None, 1) and self.shape and self.kind != "text":
            start, stop, _ = index.indices(self.shape[0])
            return unpack(self._file.read(self._trial, self.key, (start, max(start, stop))))
        return self.read()[index]

    def __array__(self, dtype: npt.DTypeLike | None = None, copy: bool | None = None) -> Array:
        if copy is False:
            raise ValueError("reading a file makes a copy")
        return self.read().astype(self.dtype if dtype is None else dtype, copy=False)

    def __repr__(self) -> str:
        return f"<{self.kind} {self.shape} {self._trial}/{self.key}>"


class Trial(Mapping[str, Dataset]):
    """A trial: a mapping from names such as ``env_infos/solved`` to :class:`Dataset`."""

    def __init__(self, file: _core.Trace, path: Path, name: str):
        self._file = file
        self._path = path
        self.name = name
        entries = file.entries(name)
        self._entries = {key: Dataset(file, name, key, kind, tuple(shape)) for key, kind, shape in entries}

    @property
    def layout(self) -> str | None:
        """``"RoboHive"``, ``"RoboSet"``, or nothing for another layout."""
        return self._file.layout(self.name)

    @property
    def integers(self) -> dict[str, int]:
        """Integers that are attributes of the trial's group, such as Minari's ``seed``."""
        return dict(self._file.integers(self.name))

    def episode(self) -> Episode:
        """The transitions of the trial.

        Row ``t`` of RoboHive's layout holds the state at ``t``, the reward for being in it and the action that is taken in it;
        step ``t`` of the episode has the reward of row ``t + 1``.

        Raises:
            DataError: the trial is not in RoboHive's layout, has no step, or lacks a name.
        """
        parts = self._file.episode(self.name)
        return Episode(
            observations=unpack(parts["observations"]),
            actions=unpack(parts["actions"]),
            rewards=unpack(parts["rewards"]),
            terminations=unpack(parts["terminations"]),
            truncations=unpack(parts["truncations"]),
            infos={key: unpack(packed) for key, packed in parts["infos"].items()},
            seed=parts["seed"],
        )

    def __getitem__(self, key: str) -> Dataset:
        try:
            return self._entries[key]
        except KeyError:
            raise KeyError(f"{self._path}: no {self.name}/{key}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._entries)

    def __len__(self) -> int:
        return len(self._entries)

    def __repr__(self) -> str:
        return f"<trial {self.name} of {self._path}, {len(self)} datasets>"


class Recording(Mapping[str, Trial]):
    """A recording: a mapping from names of trials to :class:`Trial`; ``Trial2`` stands before ``Trial10``."""

    def __init__(self, path: StrPath):
        self.path = Path(path)
        self._file = _core.Trace(self.path)
        self._names = self._file.trials()

    @property
    def attributes(self) -> dict[str, str]:
        """Texts that describe the file, such as ``env``, the id of the environment."""
        return dict(self._file.attributes())

    def episodes(self) -> Iterator[Episode]:
        """The transitions of one trial after another; see :meth:`Trial.episode`."""
        return (trial.episode() for trial in self.values())

    def __getitem__(self, name: str) -> Trial:
        if name not in self._names:
            raise KeyError(f"{self.path}: no trial {name!r}")
        return Trial(self._file, self.path, name)

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __repr__(self) -> str:
        return f"<recording {self.path}, {len(self)} trials>"


def open(path: StrPath) -> Recording:
    """Opens a recording; nothing but its list of trials is read.

    Raises:
        FileNotFoundError: there is no such file.
        DataError: the file is neither HDF5 nor a numpy archive, or damaged.
    """
    return Recording(path)


class TrialWriter:
    """A trial that is being written; :meth:`Recorder.trial` makes it."""

    def __init__(self) -> None:
        # Blocks of rows of each name.
        self._rows: dict[str, list[Array]] = {}
        self._values: dict[str, Array] = {}
        self._texts: dict[str, Array] = {}

    def append(self, row: Mapping[str, npt.ArrayLike]) -> None:
        """Adds a row: of every name a number or an array, of the same shape and dtype in all rows.

        Raises:
            DataError: names, shapes or dtypes are not those of the row before.
        """
        self.extend({key: np.array(value)[None] for key, value in row.items()})

    def extend(self, rows: Mapping[str, npt.ArrayLike]) -> None:
        """Adds rows: of every name an array whose first axis counts rows.

        Raises:
            DataError: names, shapes or dtypes are not those of the rows before, or numbers of rows differ.
        """
        blocks = {key: np.array(value) for key, value in rows.items()}
        if self._rows and blocks.keys() != self._rows.keys():
            different = sorted(blocks.keys() ^ self._rows.keys())
            raise DataError(f"rows with other names than the rows before: {', '.join(different)}")
        lengths = {len(block) if block.ndim else -1 for block in blocks.values()}
        if len(lengths) > 1 or -1 in lengths:
            raise DataError(f"arrays with one number of rows are needed: {({k: b.shape for k, b in blocks.items()})}")
        for key, block in blocks.items():
            first = self._rows.get(key, [block])[0]
            if (first.shape[1:], first.dtype) != (block.shape[1:], block.dtype):
                before = f"{first.dtype} {first.shape[1:]}"
                raise DataError(f"{key}: a row of {block.dtype} {block.shape[1:]} follows rows of {before}")
        for key, block in blocks.items():
            self._rows.setdefault(key, []).append(block)

    def set(self, key: str, value: npt.ArrayLike) -> None:
        """Sets a dataset that has no rows: a number, an array, a text or an array of texts."""
        array = np.asarray(value)
        if array.dtype.kind in "UO":
            self._texts[key] = array
        else:
            self._values[key] = array

    def write(self, file: _core.TraceWriter, name: str) -> None:
        """Writes the trial to a file under a name."""
        rows = [(key, pack(np.concatenate(blocks))) for key, blocks in self._rows.items()]
        values = [(key, pack(array)) for key, array in self._values.items()]
        texts = [
            (key, list(array.shape), [str(text) for text in array.ravel()])
            for key, array in self._texts.items()
        ]
        file.write(name, rows, values, texts)


class Recorder:
    """Writes a recording. An HDF5 file can be read at every moment and holds the trials that were finished, whatever ends the
    process.

    Example:
        >>> with Recorder("trials.h5", attributes={"env": "door-v1"}) as recorder:  # doctest: +SKIP
        ...     with recorder.trial() as trial:
        ...         trial.append({"time": 0.0, "observations": obs, "actions": act, "rewards": 0.0, "done": False})
    """

    def __init__(
        self,
        path: StrPath,
        *,
        layout: Layout = "robohive",
        precision: Precision = "full",
        attributes: Mapping[str, str] | None = None,
        append: bool = False,
        overwrite: bool = False,
    ):
        """Makes a file.

        Args:
            path: ``.npz`` is a numpy archive, anything else HDF5.
            layout: rows are given under RoboHive's names; in RoboSet's layout they are kept under its own.
            precision: all bits, or as RoboHive's own recordings: uint8, int8, float16.
            attributes: texts that describe the file.
            append: go on with a file that was made by a recorder.
            overwrite: replace a file that exists.

        Raises:
            FileExistsError: the file exists.
            DataError: the file cannot be written, or another process is writing it.
        """
        self.path = Path(path)
        if self.path.exists() and not (append or overwrite):
            raise FileExistsError(f"{self.path}: the file exists: overwrite=True replaces it")
        described = [(str(key), str(text)) for key, text in (attributes or {}).items()]
        self._file = _core.TraceWriter(self.path, layout, precision, described, append)
        self._count = len(_core.Trace(self.path).trials()) if append else 0

    def trial(self, name: str | None = None) -> _OpenTrial:
        """A context whose :class:`TrialWriter` becomes a trial when it ends; after an exception it does not.

        Args:
            name: ``Trial0``, ``Trial1`` … if nothing is said.
        """
        return _OpenTrial(self, name)

    def add(self, episode: Episode, name: str | None = None) -> None:
        """Writes an episode as a trial in RoboHive's layout.

        Raises:
            DataError: its observations are not one array, or parts have wrong lengths.
        """
        with self.trial(name) as trial:
            rows = episode.to_rows()
            trial.extend(rows)
            if episode.seed is not None:
                trial.set("seed", np.int64(episode.seed))

    @property
    def unmapped(self) -> list[str]:
        """Names of rows that had no place in the layout and were not kept."""
        return self._file.unmapped()

    def close(self) -> None:
        """Completes the file, and waits until the disk has it."""
        self._file.close()

    def _write(self, trial: TrialWriter, name: str | None) -> None:
        trial.write(self._file, f"Trial{self._count}" if name is None else name)
        self._count += 1

    def __enter__(self) -> Recorder:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


class _OpenTrial:
    """The context of a trial that is being written."""

    def __init__(self, recorder: Recorder, name: str | None):
        self._recorder = recorder
        self._name = name
        self._trial = TrialWriter()

    def __enter__(self) -> TrialWriter:
        return self._trial

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if kind is None:
            self._recorder._write(self._trial, self._name)


@dataclass(frozen=True)
class Converted:
    """What came of a conversion."""

    trials: int
    """Trials that were written."""
    dropped: dict[str, str]
    """What has no place in the output, and why."""


def convert(
    source: StrPath,
    target: StrPath,
    *,
    layout: Layout | None = None,
    precision: Precision = "full",
    overwrite: bool = False,
) -> Converted:
    """Writes a recording in another layout, format or precision; the ending of ``target`` says whether it is HDF5 or ``.npz``.

    Raises:
        FileNotFoundError: there is no ``source``.
        FileExistsError: ``target`` exists.
        DataError: ``source`` is damaged, or a number does not fit the precision.
    """
    if Path(target).exists() and (not overwrite or os.path.samefile(source, target)):
        raise FileExistsError(f"{target}: the file exists: overwrite=True replaces another one")
    trials, dropped = _core.convert_trace(Path(source), Path(target), layout, precision)
    return Converted(trials, dict(dropped))


@dataclass(frozen=True)
class Repaired:
    """What came of a repair."""

    saved: list[str]
    """Trials that were saved."""
    lost: dict[str, str] = field(default_factory=dict)
    """Trials that are lost, and why."""
    dropped: dict[str, str] = field(default_factory=dict)
    """Datasets of saved trials that could not be written, and why."""
    damage: str | None = None
    """What was wrong with the file as a whole, if anything."""
    unused: int = 0
    """Bytes of an episode that was never finished."""


def repair(source: StrPath, target: StrPath) -> Repaired:
    """Writes the trials of a damaged HDF5 file that are readable to a new file.

    Raises:
        FileNotFoundError: there is no ``source``.
        FileExistsError: ``target`` exists.
        DataError: nothing of it is readable.
    """
    if Path(target).exists():
        raise FileExistsError(f"{target}: the file exists")
    report = _core.repair_trace(Path(source), Path(target))
    return Repaired(
        saved=report["saved"],
        lost=dict(report["lost"]),
        dropped=dict(report["dropped"]),
        damage=report["damage"],
        unused=report["unused"],
    )
