"""Signals over time."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from robohive.mujoco.structs.model import MjModel
from robohive.mujoco.sysid.interpolation import InterpolationMethod, interpolated
from robohive.mujoco.sysid.signals import (
    SignalMappingType,
    SignalName,
    SignalType,
    activation_signals,
    control_signals,
    decode_signal_mapping,
    encode_signal_mapping,
    joint_signals,
    named_signals,
    sensor_signals,
)

Vector = NDArray[np.float64]
_OBSERVED = {SignalType.MjSensor, SignalType.MjStateQPos, SignalType.MjStateQVel, SignalType.MjStateAct}


@dataclass(frozen=True)
class TimeSeries:
    """Samples of signals.

    Attributes:
        times: `(n,)`, strictly increasing [s].
        data: `(n, …)`, in most cases `(n, columns)`.
        signal_mapping: which columns are which signal.

    Raises:
        ValueError: times are no increasing vector, or not as many as samples.
    """

    times: Vector
    data: Vector
    signal_mapping: SignalMappingType | None = None

    def __post_init__(self) -> None:
        times = self.times
        if times.size == 0:
            raise ValueError("Empty: a time series has one sample at least")
        if times.ndim != 1:
            raise ValueError(f"times are 1D, not of the shape {times.shape}")
        if len(times) != len(self.data):
            raise ValueError(f"Length: there are {len(times)} times and {len(self.data)} samples")
        late = np.flatnonzero(np.diff(times) <= 0)
        if late.size:
            at = int(late[0])
            raise ValueError(
                f"times must be strictly increasing: sample {at + 1} at {times[at + 1]:g} s does not follow {times[at]:g} s"
            )

    def __len__(self) -> int:
        return len(self.data)

    @staticmethod
    def compute_all_sensor_mapping(model: MjModel) -> SignalMappingType:
        """Columns of all sensors, in the order of `sensordata`."""
        return sensor_signals(model)

    @staticmethod
    def compute_all_control_mapping(model: MjModel) -> SignalMappingType:
        """Columns of all controls."""
        return control_signals(model)

    @staticmethod
    def compute_all_state_mappings(
        model: MjModel,
    ) -> tuple[SignalMappingType, SignalMappingType, SignalMappingType, SignalMappingType]:
        """Columns of positions, velocities and activations in `(qpos, qvel, act)`, and of controls in `ctrl`."""
        return *joint_signals(model), activation_signals(model), control_signals(model)

    @classmethod
    def from_custom_map(
        cls, times: Vector, data: Vector, signals: Sequence[str | tuple[str, int, SignalType]]
    ) -> TimeSeries:
        """A series of signals that no model has, which need a residual of one's own.

        Args:
            times: `(n,)` [s].
            data: `(n, columns)`.
            signals: names of signals of one column, or names, numbers of columns and types, from left to right.

        Raises:
            ValueError: these are not all the columns.
        """
        _check_columns(data, None)
        mapping: SignalMappingType = {}
        start = 0
        for signal in signals:
            name, width, kind = (signal, 1, SignalType.CustomObs) if isinstance(signal, str) else signal
            if width <= 0:
                raise ValueError(f"signal '{name}' has {width} columns; it needs one at least")
            mapping[name] = (kind, np.arange(start, start + width))
            start += width
        _check_columns(data, start)
        return cls(times, data, mapping)

    @classmethod
    def from_names(
        cls, times: Vector, data: Vector, model: MjModel, names: Sequence[SignalName] | None = None
    ) -> TimeSeries:
        """A series of what a model observes: sensors, positions, velocities, activations.

        Args:
            times: `(n,)` [s].
            data: `(n, columns)`.
            model: where names are looked up.
            names: from left to right; all sensors, in the order of `sensordata`, where it is None.

        Raises:
            ValueError: the model has no such signal, or these are not all the columns.
        """
        if names is None:
            _check_columns(data, model.nsensordata)
            return cls(times, data, sensor_signals(model))
        return cls._named(times, data, named_signals(model, names, _OBSERVED))

    @classmethod
    def from_control_names(
        cls, times: Vector, data: Vector, model: MjModel, names: Sequence[SignalName] | None = None
    ) -> TimeSeries:
        """A series of controls.

        Args:
            times: `(n,)` [s].
            data: `(n, columns)`.
            model: where names are looked up.
            names: of actuators, from left to right; all of them where it is None.

        Raises:
            ValueError: the model has no such actuator, or these are not all the columns.
        """
        if names is None:
            _check_columns(data, model.nu)
            return cls(times, data, control_signals(model))
        return cls._named(times, data, named_signals(model, names, {SignalType.MjCtrl}))

    @classmethod
    def _named(cls, times: Vector, data: Vector, mapping: SignalMappingType) -> TimeSeries:
        _check_columns(data, sum(len(columns) for _, columns in mapping.values()))
        return cls(times, data, mapping)

    @classmethod
    def create(
        cls, times: Vector, data: Vector, signal_mapping: Mapping[str, tuple[SignalType, ArrayLike]]
    ) -> TimeSeries:
        """A series with columns given as numbers, lists or arrays."""
        return cls(times, data, {name: (kind, np.atleast_1d(at)) for name, (kind, at) in signal_mapping.items()})

    def get_indices(self, obs_name: str) -> tuple[SignalType, NDArray[np.int64]]:
        """Type and columns of a signal.

        Raises:
            ValueError: there is no such signal.
        """
        mapping = self.signal_mapping or {}
        if obs_name not in mapping:
            raise ValueError(f"there is no signal '{obs_name}'; there are: {', '.join(mapping) or 'none with a name'}")
        return mapping[obs_name]

    @classmethod
    def slice_by_name(cls, ts: TimeSeries, enabled_sensors: Sequence[str]) -> TimeSeries:
        """Some signals of a series, which keep the order of their columns.

        Raises:
            ValueError: there is no such signal.
        """
        if not ts.signal_mapping:
            return ts
        kept = {name: ts.get_indices(name) for name in enabled_sensors}
        wanted = {int(column) for _, columns in kept.values() for column in columns}
        columns = [int(c) for _, own in ts.signal_mapping.values() for c in own if int(c) in wanted]
        place = {column: i for i, column in enumerate(columns)}
        mapping = {name: (kind, np.array([place[int(c)] for c in own], np.int64)) for name, (kind, own) in kept.items()}
        return cls(ts.times, ts.data[..., columns], mapping)

    def arrays(self, prefix: str = "") -> dict[str, NDArray[Any]]:
        """What an archive holds of the series."""
        arrays: dict[str, NDArray[Any]] = {f"{prefix}times": self.times, f"{prefix}data": self.data}
        if self.signal_mapping:
            arrays[f"{prefix}signal_mapping"] = np.asarray(encode_signal_mapping(self.signal_mapping))
        return arrays

    @classmethod
    def of_arrays(cls, archive: Mapping[str, NDArray[Any]], prefix: str = "") -> TimeSeries:
        """Reads what `arrays` put into an archive.

        Raises:
            KeyError: it is not there.
        """
        mapping = archive.get(f"{prefix}signal_mapping")
        signals = None if mapping is None else decode_signal_mapping(str(mapping))
        return cls(archive[f"{prefix}times"], archive[f"{prefix}data"], signals)

    def save_to_disk(self, path: str | os.PathLike[str]) -> None:
        """Writes a `.npz` archive."""
        np.savez(path, **self.arrays())  # type: ignore[arg-type]

    @classmethod
    def load_from_disk(cls, path: str | os.PathLike[str]) -> TimeSeries:
        """Reads a `.npz` archive."""
        with np.load(path, allow_pickle=False) as archive:
            return cls.of_arrays(archive)

    def save_to_csv(self, path: str | os.PathLike[str]) -> None:
        """Writes times and columns as text, separated by commas."""
        np.savetxt(path, np.column_stack([self.times, self.data]), delimiter=",")

    def interpolate(self, t: ArrayLike, method: InterpolationMethod = "linear") -> Vector:
        """Values at other times; beyond its ends those of the ends.

        Args:
            t: a time or `(m,)` times [s].
            method: `linear`, `zoh`, `quadratic`, `cubic` or `quintic`.

        Returns:
            `(m, …)`.
        """
        return interpolated(self.times, self.data, np.atleast_1d(np.asarray(t, np.float64)), method)

    def get(self, t: ArrayLike, method: InterpolationMethod = "linear") -> tuple[Vector, Vector]:
        """Times as an array, and values at them, as of `interpolate`; without the first axis for a single time."""
        at = np.asarray(t)
        values = self.interpolate(at, method)
        return at, values if at.ndim else values[0]

    def resample(
        self,
        new_times: Vector | None = None,
        target_dt: float | None = None,
        method: InterpolationMethod = "linear",
    ) -> TimeSeries:
        """The series at other times.

        Args:
            new_times: `(m,)`, strictly increasing [s].
            target_dt: without `new_times`: equal steps of at most this length, from the first sample to the last [s].
            method: of interpolation.

        Raises:
            ValueError: neither is given, or they are no such times.
        """
        times = new_times
        if times is None:
            if target_dt is None or not target_dt > 0:
                raise ValueError(f"resampling takes new_times or a positive target_dt, not {target_dt}")
            first, last = self.times[0], self.times[-1]
            times = np.asarray(np.linspace(first, last, int(np.ceil((last - first) / target_dt)) + 1))
        elif times.ndim != 1 or (np.diff(times) <= 0).any():
            raise ValueError("new_times are a vector of strictly increasing times")
        return TimeSeries(times, self.interpolate(times, method), self.signal_mapping)

    def remove_from_beginning(self, time_to_remove_s: float) -> TimeSeries:
        """What comes at or after a time, which becomes time 0 with its first sample.

        Raises:
            ValueError: the time is negative or after the last sample.
        """
        if not 0 <= time_to_remove_s <= self.times[-1]:
            raise ValueError(f"what is removed is between 0 and {self.times[-1]:g} s, not {time_to_remove_s:g} s")
        start = int(np.searchsorted(self.times, time_to_remove_s))
        return TimeSeries(self.times[start:] - self.times[start], self.data[start:], self.signal_mapping)

    def dt_statistics(self) -> dict[str, float]:
        """Mean, median, standard deviation, least and largest of the steps between samples [s].

        Raises:
            ValueError: there is one sample only.
        """
        steps = np.diff(self.times)
        if steps.size == 0:
            raise ValueError("steps need two samples at least")
        measures = {"mean": np.mean, "median": np.median, "std": np.std, "min": np.min, "max": np.max}
        return {name: float(measure(steps)) for name, measure in measures.items()}  # type: ignore[operator]

    def __repr__(self) -> str:
        spread = f", {np.min(self.data):.3g} to {np.max(self.data):.3g}" if self.data.size else ""
        names = ", ".join(self.signal_mapping or {}) or "none named"
        return f"TimeSeries({self.times[0]:.6g} to {self.times[-1]:.6g} s, {self.data.shape}{spread}, signals: {names})"


def _check_columns(data: Vector, count: int | None) -> None:
    """Raises a `ValueError` for data that are not `(n, count)`."""
    if data.ndim != 2:
        raise ValueError(f"data are 2-dimensional, times by columns, not of the shape {data.shape}")
    if count is not None and data.shape[1] != count:
        raise ValueError(f"signals have {count} columns together, data have {data.shape[1]}")
