"""Simulated trajectories, under the controls of measured ones."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from robohive.mujoco.rollout import rollout
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.model import MjModel
from robohive.mujoco.sysid.signals import (
    SignalMappingType,
    activation_signals,
    control_signals,
    joint_signals,
    sensor_signals,
)
from robohive.mujoco.sysid.timeseries import TimeSeries
from robohive.mujoco.sysid.trajectory import SystemTrajectory

Vector = NDArray[np.float64]


def state_signals(model: MjModel) -> SignalMappingType:
    """Columns of `(qpos, qvel, act)`."""
    positions, velocities = joint_signals(model)
    return positions | velocities | activation_signals(model)


def sysid_rollout(
    models: MjModel | Sequence[MjModel],
    datas: MjData | Sequence[MjData],
    control_signal: TimeSeries | Sequence[TimeSeries],
    initial_states: Vector | Sequence[Vector],
    rollout_signal_mapping: SignalMappingType | None = None,
    rollout_state_mapping: SignalMappingType | None = None,
    ctrl_mapping: SignalMappingType | None = None,
) -> list[SystemTrajectory]:
    """Simulates trajectories on threads.

    Of `n` controls `n - 1` are applied: a log has as many readings as controls, the first of them in the initial state, so
    that nothing was measured after the last.

    Args:
        models: one for all, or one for each.
        datas: one for each thread.
        control_signal: one for all or one for each, all of the same number of samples; each is one step.
        initial_states: `(nstate,)` for all, or one for each; of signature `mjSTATE_FULLPHYSICS`.
        rollout_signal_mapping: columns of `sensordata`, those of the first model by default.
        rollout_state_mapping: columns of states without the time, likewise.
        ctrl_mapping: columns of controls, likewise.

    Returns:
        The trajectories, with states, from the first step on.

    Raises:
        ValueError: shapes contradict each other.
        FatalError: a trajectory is unstable.
    """
    first = models if isinstance(models, MjModel) else models[0]
    sensors = rollout_signal_mapping or sensor_signals(first)
    states = rollout_state_mapping or state_signals(first)
    controls = ctrl_mapping or control_signals(first)
    given = [control_signal] if isinstance(control_signal, TimeSeries) else list(control_signal)
    lengths = {len(series) for series in given}
    if len(lengths) != 1:
        raise ValueError(f"controls have {sorted(lengths)} samples; trajectories of one call have as many")
    applied = np.stack([series.data[:-1] for series in given])
    starts = np.atleast_2d(np.asarray(initial_states, np.float64))
    state, sensordata = rollout(models, datas, starts, applied)

    def of(values: Sequence[TimeSeries] | Vector | Sequence[MjModel], i: int) -> int:
        return i if len(values) > 1 else 0

    found = []
    for i in range(len(state)):
        times = state[i, :, 0]
        told = given[of(given, i)]
        model = models if isinstance(models, MjModel) else models[of(models, i)]
        control = TimeSeries(told.times[:-1], told.data[:-1], controls)
        readings = TimeSeries(times, sensordata[i], sensors)
        start = starts[of(starts, i)]
        found.append(SystemTrajectory(model, control, readings, start, TimeSeries(times, state[i], states)))
    return found
