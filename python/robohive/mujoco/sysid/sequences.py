"""Measured trajectories of a system, and the description that is fitted to them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from robohive.mujoco.spec import MjSpec
from robohive.mujoco.sysid.timeseries import TimeSeries
from robohive.mujoco.sysid.trajectory import SystemTrajectory

Vector = NDArray[np.float64]
T = TypeVar("T")


class ModelSequences:
    """One description and the trajectories that were measured on what it describes.

    Attributes:
        name: names the file of the identified model.
        spec: the description, into which parameters are written.
        gt_model: the model as it was given.
        sequence_name: names of the trajectories.
        measured_rollout: the trajectories.
    """

    def __init__(
        self,
        name: str,
        spec: MjSpec,
        sequence_name: str | Sequence[str],
        initial_state: Vector | Sequence[Vector],
        control: TimeSeries | Sequence[TimeSeries],
        sensordata: TimeSeries | Sequence[TimeSeries],
        allow_missing_sensors: bool = False,
    ) -> None:
        """One trajectory, or as many as there are names.

        Raises:
            ValueError: there are not as many of each, or one is of another model (`SystemTrajectory.check_compatible`).
        """
        self.name, self.spec, self.allow_missing_sensors = name, spec, allow_missing_sensors
        self.gt_model = spec.compile()
        self.sequence_name: list[str] = _listed(sequence_name, str)
        self.initial_state: list[Vector] = _listed(initial_state, np.ndarray)
        self.control: list[TimeSeries] = _listed(control, TimeSeries)
        self.sensordata: list[TimeSeries] = _listed(sensordata, TimeSeries)
        lists = (self.initial_state, self.control, self.sensordata)
        if len({len(values) for values in lists}) != 1:
            starts, told, read = (len(values) for values in lists)
            counts = f"{starts} initial states, {told} controls and {read} sensordata"
            raise ValueError(f"'{name}': there are {counts}; each trajectory has one of each")
        self.measured_rollout = [
            SystemTrajectory(self.gt_model, controls, sensors, start, None)
            for start, controls, sensors in zip(*lists, strict=True)
        ]
        for measured in self.measured_rollout:
            measured.check_compatible(allow_missing_sensors)

    def __getitem__(self, key: int | slice) -> ModelSequences:
        """Some of the trajectories, with the same description."""
        return ModelSequences(
            self.name,
            self.spec,
            self.sequence_name[key],
            self.initial_state[key],
            self.control[key],
            self.sensordata[key],
            self.allow_missing_sensors,
        )


def _listed(values: T | Sequence[T], single: type) -> list[T]:
    return [values] if isinstance(values, single) else list(values)  # type: ignore[list-item, arg-type]
