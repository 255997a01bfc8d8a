"""What may lie between a simulated signal and a measured one: gains, biases, delays; and how their distance is measured."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from robohive.mujoco.enums.elements import mjtObj
from robohive.mujoco.functions.naming import mj_name2id
from robohive.mujoco.structs.model import MjModel
from robohive.mujoco.sysid.parameters.value import Parameter
from robohive.mujoco.sysid.timeseries import TimeSeries

Vector = NDArray[np.float64]


def get_sensor_indices(model: MjModel, sensor_name: str | Sequence[str], sort: bool = False) -> list[int]:
    """Places of sensors in `sensordata`, sensor after sensor, or in increasing order.

    Raises:
        ValueError: the model has no such sensor.
    """
    names = [sensor_name] if isinstance(sensor_name, str) else sensor_name
    places = [place for name in names for place in _places(model, name)]
    return sorted(places) if sort else places


def _places(model: MjModel, name: str) -> range:
    sensor = mj_name2id(model, mjtObj.mjOBJ_SENSOR, name)
    if sensor < 0:
        raise ValueError(f"the model has no sensor '{name}'")
    start = int(model.sensor_adr[sensor])
    return range(start, start + int(model.sensor_dim[sensor]))


def apply_bias(ts: TimeSeries, sensor_name: str, bias: Parameter) -> TimeSeries:
    """The series with the parameter's value added to a sensor's columns."""
    data = ts.data.copy()
    data[..., ts.get_indices(sensor_name)[1]] += bias.value
    return TimeSeries(ts.times, data, ts.signal_mapping)


def apply_gain(ts: TimeSeries, sensor_name: str, gain: Parameter) -> TimeSeries:
    """The series with a sensor's columns times the parameter's value."""
    data = ts.data.copy()
    data[..., ts.get_indices(sensor_name)[1]] *= gain.value
    return TimeSeries(ts.times, data, ts.signal_mapping)


def apply_delay(ts: TimeSeries, sensor_name: str, delay: Parameter) -> TimeSeries:
    """The series with a sensor's columns later by the parameter's value [s]."""
    columns = ts.get_indices(sensor_name)[1]
    data = ts.data.copy()
    data[:, columns] = TimeSeries(ts.times, ts.data[:, columns]).interpolate(ts.times - delay.value)
    return TimeSeries(ts.times, data, ts.signal_mapping)


def apply_time_window(ts: TimeSeries, min_t: float, max_t: float) -> TimeSeries:
    """Samples from one time to another, both included [s].

    Raises:
        ValueError: there are none.
    """
    inside = slice(np.searchsorted(ts.times, min_t, side="left"), np.searchsorted(ts.times, max_t, side="right"))
    return TimeSeries(ts.times[inside], ts.data[inside], ts.signal_mapping)


def apply_delayed_ts_window(ts: TimeSeries, ts_delayed: TimeSeries, min_delay: float, max_delay: float) -> TimeSeries:
    """Samples at times that another series has whatever its delay.

    Args:
        ts: what is cut.
        ts_delayed: the other series.
        min_delay: least delay, which may be negative [s].
        max_delay: largest delay [s].

    Raises:
        ValueError: delays are in the wrong order, or no sample is left.
    """
    if min_delay > max_delay:
        raise ValueError(f"the least delay, {min_delay} s, is larger than the largest, {max_delay} s")
    return apply_time_window(ts, ts_delayed.times[0] - min_delay, ts_delayed.times[-1] - max_delay)


def column_delays(
    ts: TimeSeries, default_delay: float, sensor_delays: Mapping[str, float] | None, predicted_data: bool
) -> list[float]:
    """By how much later each column is read; earlier, for predictions that come late."""
    delays = [default_delay] * ts.data.shape[1]
    for name, delay in (sensor_delays or {}).items():
        for column in ts.get_indices(name)[1]:
            delays[int(column)] = delay
    return [-delay for delay in delays] if predicted_data else delays


def read_at(ts: TimeSeries, times: Vector, delays: Sequence[float], groups: Iterable[Sequence[int]]) -> Vector:
    """Columns of a series, each at times of its own.

    Args:
        ts: `(n, columns)`.
        times: `(m,)` [s].
        delays: what is added to the times for each column [s].
        groups: columns that share a delay, and are interpolated together.

    Returns:
        `(m, columns)`.
    """
    out = np.empty((len(times), len(delays)))
    for group in groups:
        columns = list(group)
        out[:, columns] = TimeSeries(ts.times, ts.data[:, columns]).interpolate(times + delays[columns[0]])
    return out


def apply_resample_and_delay(
    ts: TimeSeries,
    times: Vector,
    default_delay: float,
    sensor_delays: Mapping[str, float] | None = None,
    predicted_data: bool = True,
) -> TimeSeries:
    """The series at other times, sensors delayed.

    Args:
        ts: `(n, columns)`.
        times: `(m,)` [s].
        default_delay: of columns without a delay of their own [s].
        sensor_delays: by names of sensors [s].
        predicted_data: signals come later by their delays; else they are read so much later.
    """
    delays = column_delays(ts, default_delay, sensor_delays, predicted_data)
    groups: dict[float, list[int]] = {}
    for column, delay in enumerate(delays):
        groups.setdefault(delay, []).append(column)
    return TimeSeries(times, read_at(ts, times, delays, groups.values()), ts.signal_mapping)


def prepare_sensor_weights(sensor_weights: Mapping[str, float] | Vector, n_sensors: int, model: MjModel) -> Vector:
    """A weight for each of the columns of `sensordata`, `(n_sensors,)`; 1 for sensors without one.

    Raises:
        ValueError: an array has another shape, or the model has no such sensor.
    """
    if isinstance(sensor_weights, np.ndarray):
        if sensor_weights.shape != (n_sensors,):
            raise ValueError(f"sensor_weights have the shape {sensor_weights.shape} instead of ({n_sensors},)")
        return sensor_weights
    weights = np.ones(n_sensors)
    for name, weight in sensor_weights.items():
        weights[get_sensor_indices(model, name)] = weight
    return weights


def weighted_diff(
    predicted_data: Vector,
    measured_data: Vector,
    model: MjModel | None = None,
    sensor_weights: Mapping[str, float] | Vector | None = None,
) -> Vector:
    """What was measured without what was predicted, times weights of sensors; all `(n, columns)`.

    Raises:
        ValueError: there are weights and no model.
    """
    difference = measured_data - predicted_data
    if sensor_weights is None:
        return difference
    if model is None:
        raise ValueError("sensor_weights name sensors of a model: pass the model too")
    return np.asarray(difference * prepare_sensor_weights(sensor_weights, difference.shape[-1], model))


def normalize_residual(residual: Vector, measured_data: Vector) -> Vector:
    """Each column over the length of what was measured there, times the root of 2, so that sensors of different units count
    alike. Columns in which nothing but zeros was measured stay as they are."""
    length = np.linalg.norm(measured_data, axis=0)
    return np.asarray(residual * (np.sqrt(2.0) / np.where(length > 0, length, np.sqrt(2.0))))
