"""Simulated observations in the columns of measured ones."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from robohive.mujoco.sysid.signals import SignalType
from robohive.mujoco.sysid.timeseries import TimeSeries


def construct_ts_from_defaults(
    state_ts: TimeSeries,
    pred_sensordata: TimeSeries,
    measured_sensordata: TimeSeries,
    enabled_observations: Sequence[tuple[str, SignalType]] | None = None,
) -> tuple[TimeSeries, TimeSeries]:
    """What was measured, and the same signals of a simulation.

    Args:
        state_ts: states without the time, `(n, nq + nv + na)`.
        pred_sensordata: all sensors, `(n, nsensordata)`.
        measured_sensordata: sensors, positions, velocities and activations, each with its columns.
        enabled_observations: which of them, all where it is None or empty.

    Returns:
        Measured, simulated; with the same columns.

    Raises:
        ValueError: a signal is missing, of another type than said, or one that no model has.
    """
    signals = measured_sensordata.signal_mapping
    if signals is None:
        raise ValueError("measured signals have no names; make the series by TimeSeries.from_names")
    wanted = list(enabled_observations or [(name, kind) for name, (kind, _) in signals.items()])
    for name, said in wanted:
        if name not in signals:
            raise ValueError(f"signal '{name}' is missing in what was measured; there are: {', '.join(signals)}")
        if signals[name][0] is not said:
            raise ValueError(f"signal '{name}' is of the type {signals[name][0].name}, not {said.name}")
    measured = TimeSeries.slice_by_name(measured_sensordata, [name for name, _ in wanted])
    columns = measured.signal_mapping or {}
    data = np.zeros((len(pred_sensordata), measured.data.shape[1]))
    for name, kind in wanted:
        data[:, columns[name][1]] = _simulated(name, kind, state_ts, pred_sensordata, measured_sensordata)
    return measured, TimeSeries(pred_sensordata.times, data, columns)


def _simulated(
    name: str, kind: SignalType, states: TimeSeries, sensors: TimeSeries, measured: TimeSeries
) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    """The columns of one signal."""
    if kind is SignalType.MjSensor:
        # By name, so that logs may have sensors in an order of their own.
        source = sensors.signal_mapping or {}
        return sensors.data[:, source[name][1] if name in source else measured.get_indices(name)[1]]
    if kind in (SignalType.CustomObs, SignalType.MjCtrl):
        raise ValueError(
            f"signal '{name}' is of the type {kind.name}, which a simulation does not have: pass a modify_residual that compares it"
        )
    return states.data[:, states.get_indices(name)[1]]
