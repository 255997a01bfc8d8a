"""What delays read: recorded controls and sensor readings.

A buffer of `n` samples holds the time of the last due reading, the place of the newest sample, `n` times and `n` rows of values.
"""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from robohive.mujoco import _engine as _core
from robohive.mujoco.functions.out import Vector, destination, vector, write
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.model import MjModel

#: Times of samples are further apart [s].
_APART = 1e-15


def _check(id: int, count: int, kind: str) -> None:
    if not 0 <= id < count:
        raise _core.FatalError(f"invalid {kind} id {id}")


def mj_readCtrl(m: MjModel, d: MjData, id: int, time: float, interp: int) -> float:
    """The control of actuator `id` as it arrives at `time` [s]: held (`interp` 0), interpolated linearly (1) or by a cubic
    (2), or as the model says (-1); without a history, the present one."""
    _check(id, m.nactuator, "actuator")
    past = _core.recall(m, d, (False, id), time, interp)
    return float(d.ctrl[m.actuator_ctrladr[id]]) if past is None else float(past[0])


def mj_readSensor(m: MjModel, d: MjData, id: int, time: float, result: Vector, interp: int) -> Vector:
    """The reading of sensor `id` as it arrives at `time` [s], into `result`; see `mj_readCtrl`."""
    _check(id, m.nsensor, "sensor")
    size = int(m.sensor_dim[id])
    destination(result, "result", "the size of the sensor", (size,))
    past = _core.recall(m, d, (True, id), time, interp)
    start = int(m.sensor_adr[id])
    write(result, d.sensordata[start : start + size] if past is None else past)
    return result


def _start(d: MjData, first: int, times: ArrayLike | None, values: Any, user: float | None) -> None:
    """Overwrites the buffer at `first`."""
    count = len(values)
    moments = d.history[first + 2 : first + 2 + count]
    if times is not None:
        moments = vector(times, "times", count)
    if (np.diff(moments) < _APART).any():
        raise _core.FatalError("times must be strictly increasing")
    if user is not None:
        d.history[first] = user
    d.history[first + 1] = count - 1
    d.history[first + 2 : first + 2 + count] = moments
    d.history[first + 2 + count : first + 2 + count + values.size] = values.ravel()


def mj_initCtrlHistory(m: MjModel, d: MjData, id: int, times: ArrayLike | None, values: ArrayLike) -> None:
    """Fills the history of an actuator: `values` at `times` [s], rising; None keeps the times.

    Raises:
        FatalError: the actuator keeps no history, or times do not rise.
        TypeError: there are not as many as samples.
    """
    _check(id, m.nactuator, "actuator")
    count = int(m.actuator_history[id, 0])
    if count == 0:
        raise _core.FatalError(f"actuator {id} has no history buffer")
    _start(d, int(m.actuator_historyadr[id]), times, vector(values, "values", count), None)


def mj_initSensorHistory(
    m: MjModel, d: MjData, id: int, times: ArrayLike | None, values: ArrayLike, phase: float
) -> None:
    """Fills the history of a sensor: a row of `values` for each of `times` [s]; `phase` is the time of the last due reading.

    Raises:
        FatalError: the sensor keeps no history, or times do not rise.
        TypeError: there are not as many as samples.
    """
    _check(id, m.nsensor, "sensor")
    count, size = int(m.sensor_history[id, 0]), int(m.sensor_dim[id])
    if count == 0:
        raise _core.FatalError(f"sensor {id} has no history buffer")
    rows = np.asarray(values, np.float64)
    if rows.shape != (count, size):
        raise TypeError(f"values should have shape ({count}, {size}), not {rows.shape}")
    _start(d, int(m.sensor_historyadr[id]), times, rows, phase)
