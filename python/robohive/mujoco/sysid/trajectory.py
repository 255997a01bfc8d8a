"""What a system was told and what it did."""

from __future__ import annotations

import dataclasses
import logging
import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robohive.mujoco.enums.elements import mjtSensor
from robohive.mujoco.enums.physics import mjtState
from robohive.mujoco.functions.algebra import mj_stateSize
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.model import MjModel
from robohive.mujoco.sysid.timeseries import TimeSeries

Vector = NDArray[np.float64]

_log = logging.getLogger("absl")
#: Sensors by what `get_sensordata_slice` calls them.
_SLICES = {
    "joint_pos": mjtSensor.mjSENS_JOINTPOS,
    "joint_vel": mjtSensor.mjSENS_JOINTVEL,
    "joint_torque": mjtSensor.mjSENS_JOINTACTFRC,
}


@dataclasses.dataclass(frozen=True)
class SystemTrajectory:
    """A trajectory, measured or simulated.

    Attributes:
        model: of the system.
        control: `(n, nu)`.
        sensordata: `(n, nsensordata)`; in the order of its signals where these are named.
        initial_state: of signature `mjSTATE_FULLPHYSICS`, `(nstate,)`.
        state: `(n, nstate)`; None of a real system.
    """

    model: MjModel
    control: TimeSeries
    sensordata: TimeSeries
    initial_state: Vector
    state: TimeSeries | None

    def __len__(self) -> int:
        return len(self.sensordata)

    @property
    def sensordim(self) -> int:
        """`nsensordata` of the model."""
        return int(self.model.nsensordata)

    def replace(self, **kwargs: Any) -> SystemTrajectory:
        """A copy with other attributes."""
        return dataclasses.replace(self, **kwargs)

    def get_sensordata_slice(self, sensor: str = "joint_pos") -> Vector:
        """Readings of all sensors of a kind: `joint_pos`, `joint_vel` or `joint_torque`, `(n, columns)`.

        Raises:
            ValueError: there is no such kind, or the model has no sensor of it.
        """
        if sensor not in _SLICES:
            raise ValueError(f"there is no kind of sensors {sensor!r}; there are {', '.join(_SLICES)}")
        chosen = np.flatnonzero(np.asarray(self.model.sensor_type) == int(_SLICES[sensor]))
        if not chosen.size:
            raise ValueError(f"the model has no sensor of the kind {sensor}")
        starts, widths = self.model.sensor_adr[chosen], self.model.sensor_dim[chosen]
        columns = np.concatenate([np.arange(start, start + width) for start, width in zip(starts, widths, strict=True)])
        return self.sensordata.data[:, columns]

    def save_to_disk(self, path: str | os.PathLike[str]) -> None:
        """Writes a `.npz` archive, without the model."""
        parts = {"control": self.control, "sensordata": self.sensordata, "state": self.state}
        arrays = {"initial_state": self.initial_state}
        for name, series in parts.items():
            arrays |= {} if series is None else series.arrays(f"{name}_")
        np.savez(path, **arrays)  # type: ignore[arg-type]

    @classmethod
    def load_from_disk(
        cls, path: str | os.PathLike[str], model: MjModel, allow_missing_sensors: bool = False
    ) -> SystemTrajectory:
        """Reads a `.npz` archive.

        Raises:
            KeyError: it is no archive of a trajectory.
            ValueError: it is one of another model; see `check_compatible`.
        """
        with np.load(path, allow_pickle=False) as archive:
            control, sensordata = (TimeSeries.of_arrays(archive, f"{name}_") for name in ("control", "sensordata"))
            state = TimeSeries.of_arrays(archive, "state_") if "state_times" in archive else None
            found = cls(model, control, sensordata, archive["initial_state"], state)
        found.check_compatible(allow_missing_sensors)
        return found

    def check_compatible(self, allow_missing_sensors: bool = False) -> None:
        """Compares widths with those of the model; of sensors, a warning does where they may be missing.

        Raises:
            ValueError: one differs.
        """
        nstate = mj_stateSize(self.model, mjtState.mjSTATE_FULLPHYSICS)
        widths = [
            ("Sensor data", self.sensordata.data.shape[1], self.model.nsensordata),
            ("Control", self.control.data.shape[1], self.model.nu),
            ("Initial state", len(self.initial_state), nstate),
        ]
        if self.state is not None:
            widths.append(("State", self.state.data.shape[1], nstate))
        for what, has, needs in widths:
            if has == needs:
                continue
            text = f"{what} dimension {has} is not that of the model, {needs}"
            if what != "Sensor data" or not allow_missing_sensors:
                raise ValueError(text)
            _log.warning("%s", text)

    def split(self, chunk_size: int) -> list[SystemTrajectory]:
        """Pieces of `chunk_size` samples, one after the other; what is left at the end is dropped.

        Raises:
            ValueError: there are no states, in which pieces would begin, or the size is not positive.
        """
        if self.state is None:
            raise ValueError("a trajectory without states cannot be split: its pieces begin in unknown states")
        if chunk_size < 1:
            raise ValueError(f"pieces have one sample at least, not {chunk_size}")
        starts = range(0, len(self) - chunk_size + 1, chunk_size)
        states = self.state.data
        return [
            SystemTrajectory(
                self.model,
                _piece(self.control, start, chunk_size),
                _piece(self.sensordata, start, chunk_size),
                states[start - 1] if start else self.initial_state,
                _piece(self.state, start, chunk_size),
            )
            for start in starts
        ]

    def render(
        self, height: int = 240, width: int = 320, camera: str | int = -1, fps: int = 30
    ) -> list[NDArray[np.uint8]]:
        """Pictures of the states, each `(height, width, 3)`.

        Raises:
            ValueError: there are no states.
        """
        from robohive.mujoco.sysid.rendering import render_rollout

        if self.state is None:
            raise ValueError("a trajectory without states has no pictures")
        data = MjData(self.model)
        return render_rollout(self.model, data, self.state.data[np.newaxis], fps, camera, width, height)


def _piece(series: TimeSeries, start: int, count: int) -> TimeSeries:
    piece = slice(start, start + count)
    return TimeSeries(series.times[piece], series.data[piece], series.signal_mapping)
