"""How far simulated trajectories are from measured ones."""

from __future__ import annotations

import copy
import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from robohive.mujoco.spec import MjSpec
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.model import MjModel
from robohive.mujoco.sysid import signal_modifier
from robohive.mujoco.sysid.model_modifier import apply_param_modifiers
from robohive.mujoco.sysid.observed import construct_ts_from_defaults
from robohive.mujoco.sysid.parameters.collection import ParameterDict
from robohive.mujoco.sysid.rollouts import state_signals, sysid_rollout
from robohive.mujoco.sysid.sequences import ModelSequences
from robohive.mujoco.sysid.signals import SignalType, control_signals, sensor_signals
from robohive.mujoco.sysid.timeseries import TimeSeries
from robohive.mujoco.sysid.trajectory import SystemTrajectory

Vector = NDArray[np.float64]
#: Writes parameters into a description, and compiles it.
BuildModelFn: TypeAlias = Callable[[ParameterDict, MjSpec], MjModel]
#: In the place of `sysid_rollout`; called with its arguments by name, and with `param_dicts`, one for each point.
CustomRolloutFn: TypeAlias = Callable[..., Sequence[SystemTrajectory]]
#: Called with parameters, predicted and measured sensors, model, `return_pred_all` and `state`, the states with times;
#: returns the residual `(n, columns)`, and both series as they were compared.
ModifyResidualFn: TypeAlias = Callable[..., tuple[Vector, TimeSeries, TimeSeries]]
Observations: TypeAlias = Sequence[tuple[str, SignalType]]
#: Residuals, what was predicted, what was measured.
Compared: TypeAlias = tuple[Any, list[Any], list[Any]]

_THREADS = os.cpu_count() or 1


def model_residual(
    x: Vector,
    params: ParameterDict,
    build_model: Callable[[ParameterDict], MjModel],
    traj_measured: SystemTrajectory | Sequence[SystemTrajectory],
    modify_residual: ModifyResidualFn | None = None,
    custom_rollout: CustomRolloutFn | None = None,
    n_threads: int = _THREADS,
    return_pred_all: bool = False,
    resample_true: bool = True,
    sensor_weights: Mapping[str, float] | None = None,
    enabled_observations: Observations = (),
) -> Compared:
    """The residual of one description at one point or at several at once.

    Args:
        x: a point `(nx,)`, or points as columns `(nx, k)`.
        params: whose values become those of a point.
        build_model: the model of values.
        traj_measured: what was measured, all of one number of samples.
        modify_residual: compares; by default signals of the same name are compared at the measured times that the
            simulation covers, each column over its length (`signal_modifier.normalize_residual`).
        custom_rollout: simulates, in the place of `sysid_rollout`.
        n_threads: threads.
        return_pred_all: passed to `modify_residual`.
        resample_true: controls are taken at the steps of the model; else each sample is a step, and what was measured is
            compared from the second sample on without interpolation.
        sensor_weights: weights by names of sensors.
        enabled_observations: signals that are compared, with their types; all by default.

    Returns:
        The residual `(nr,)`, or `(nr, k)` of `k` points, and series predicted and measured, trajectory by trajectory.

    Raises:
        ValueError: series do not fit together, or a model cannot be built.
        FatalError: a simulation is unstable.
    """
    measured = [traj_measured] if isinstance(traj_measured, SystemTrajectory) else list(traj_measured)
    points = np.reshape(x, (len(x), -1)).T
    compare = _Comparison(modify_residual, return_pred_all, resample_true, sensor_weights, enabled_observations)
    simulated = _simulate(points, params, build_model, measured, custom_rollout, n_threads, resample_true)
    rows, predictions, records = [], [], []
    for i, trajectory in enumerate(simulated):
        params.update_from_vector(points[i // len(measured)])
        residual, predicted, record = compare(params, trajectory, measured[i % len(measured)].sensordata)
        if predicted.signal_mapping != record.signal_mapping and not _same(predicted, record):
            raise ValueError(
                "predicted and measured signals have other columns; modify_residual returns both series with the same signals"
            )
        rows.append(residual.ravel())
        predictions.append(predicted)
        records.append(record)
    columns = np.reshape(np.concatenate(rows), (len(points), -1)).T
    return columns if np.ndim(x) > 1 else columns[:, 0], predictions, records


def _same(a: TimeSeries, b: TimeSeries) -> bool:
    """Whether series have the same signals in the same columns."""
    first, second = a.signal_mapping or {}, b.signal_mapping or {}
    if first.keys() != second.keys():
        return False
    return all(kind is second[name][0] and np.array_equal(at, second[name][1]) for name, (kind, at) in first.items())


def _simulate(
    points: Vector,
    params: ParameterDict,
    build_model: Callable[[ParameterDict], MjModel],
    measured: Sequence[SystemTrajectory],
    custom_rollout: CustomRolloutFn | None,
    n_threads: int,
    resample: bool,
) -> Sequence[SystemTrajectory]:
    """All trajectories of the first point, then those of the next, in one call."""
    built, dicts = [], []
    for point in points:
        params.update_from_vector(point)
        built.append(build_model(params))
        if custom_rollout is not None:
            dicts.append(copy.deepcopy(params))
    first = built[0]
    step = float(first.opt.timestep)
    controls = [known.control.resample(target_dt=step) if resample else known.control for known in measured]
    plan: dict[str, Any] = {
        "models": [model for model in built for _ in measured],
        "datas": [MjData(first) for _ in range(n_threads)],
        "control_signal": controls * len(built),
        "initial_states": [known.initial_state for known in measured] * len(built),
        "rollout_signal_mapping": sensor_signals(first),
        "rollout_state_mapping": state_signals(first),
        "ctrl_mapping": control_signals(first),
    }
    if custom_rollout is not None:
        return custom_rollout(**plan, param_dicts=dicts)
    return sysid_rollout(**plan)


class _Comparison:
    """How a simulated trajectory is compared with a measured one."""

    def __init__(
        self,
        modify: ModifyResidualFn | None,
        return_all: bool,
        resample: bool,
        weights: Mapping[str, float] | None,
        observations: Observations,
    ) -> None:
        self._modify, self._all, self._resample = modify, return_all, resample
        self._weights, self._observations = weights, observations

    def __call__(
        self, params: ParameterDict, simulated: SystemTrajectory, measured: TimeSeries
    ) -> tuple[Vector, TimeSeries, TimeSeries]:
        """The residual, and both series as they were compared."""
        if simulated.state is None:
            raise ValueError("custom_rollout returns trajectories with states")
        states = simulated.state.data
        if self._modify is not None:
            return self._modify(params, simulated.sensordata, measured, simulated.model, self._all, state=states)
        without_time = TimeSeries(states[:, 0], states[:, 1:], state_signals(simulated.model))
        measured, predicted = construct_ts_from_defaults(
            without_time, simulated.sensordata, measured, self._observations
        )
        if self._resample:
            measured = signal_modifier.apply_delayed_ts_window(measured, predicted, 0.0, 0.0)
            predicted = predicted.resample(measured.times)
        else:
            measured = TimeSeries(measured.times[1:], measured.data[1:], measured.signal_mapping)
        difference = signal_modifier.weighted_diff(predicted.data, measured.data, simulated.model, self._weights)
        return signal_modifier.normalize_residual(difference, measured.data), predicted, measured


def residual(
    x: Vector,
    params: ParameterDict,
    models_sequences: Sequence[ModelSequences],
    build_model: BuildModelFn = apply_param_modifiers,
    modify_residual: ModifyResidualFn | None = None,
    custom_rollout: CustomRolloutFn | None = None,
    n_threads: int = _THREADS,
    return_pred_all: bool = False,
    resample_true: bool = True,
    sensor_weights: Mapping[str, float] | None = None,
    enabled_observations: Observations = (),
) -> Compared:
    """The residuals of all trajectories of all descriptions.

    Args:
        x: a point `(nx,)`, or points as columns `(nx, k)`.
        params: whose values become those of a point.
        models_sequences: descriptions, and what was measured.
        build_model: the model of values and a description.
        modify_residual: see `model_residual`, as for the others.
        custom_rollout: simulates.
        n_threads: threads.
        return_pred_all: passed to `modify_residual`.
        resample_true: controls are taken at the steps of the model.
        sensor_weights: weights by names of sensors.
        enabled_observations: signals that are compared.

    Returns:
        Three lists with an item for each trajectory: residuals `(nr,)` or `(nr, k)`; lists of predicted series; lists of
        measured ones.
    """
    found: Compared = ([], [], [])
    for sequences in models_sequences:
        spec = sequences.spec
        for measured in sequences.measured_rollout:
            parts = model_residual(
                x,
                params,
                lambda values, spec=spec: build_model(values, spec),  # type: ignore[misc]
                measured,
                modify_residual=modify_residual,
                custom_rollout=custom_rollout,
                n_threads=n_threads,
                return_pred_all=return_pred_all,
                resample_true=resample_true,
                sensor_weights=sensor_weights,
                enabled_observations=enabled_observations,
            )
            for kept, part in zip(found, parts, strict=True):
                kept.append(part)
    return found


def build_residual_fn(**captured_kwargs: Any) -> Callable[..., Compared]:
    """What `optimize` minimises: `residual` with arguments given once, but for the point and the parameters.

    Example:
        >>> fit = optimize(params, build_residual_fn(models_sequences=[measured]))  # doctest: +SKIP
    """

    def residual_of(x: Vector, params: ParameterDict, **kwargs: Any) -> Compared:
        return residual(x, params, **captured_kwargs, **kwargs)

    return residual_of
