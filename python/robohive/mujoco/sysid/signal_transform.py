"""Delays, gains and biases of sensors by patterns of their names, which are fitted with the model."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fnmatch import fnmatch
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robohive.mujoco.structs.model import MjModel
from robohive.mujoco.sysid import signal_modifier
from robohive.mujoco.sysid.parameters.collection import ParameterDict
from robohive.mujoco.sysid.parameters.value import Parameter
from robohive.mujoco.sysid.timeseries import TimeSeries

Vector = NDArray[np.float64]
_TARGETS = ("predicted", "measured", "both")


@dataclass(frozen=True)
class _Rule:
    """A parameter for sensors whose names match a pattern."""

    pattern: str
    param: Parameter
    target: str = "predicted"

    def __post_init__(self) -> None:
        if self.target not in _TARGETS:
            raise ValueError(f"target must be one of {', '.join(_TARGETS)}, not {self.target!r}")

    def value(self, params: ParameterDict) -> Vector:
        """The value in the parameters at hand, which may be copies of those of the rule."""
        return params[self.param.name].value

    def sensors(self, names: Iterable[str]) -> Iterator[str]:
        """Those it is for."""
        return (name for name in names if fnmatch(name, self.pattern))


class SignalTransform:
    """How simulated signals become comparable with measured ones. Pass its `apply` as `modify_residual` to
    `build_residual_fn`.

    Patterns are of `fnmatch`: `"*_pos"`. Of several delays for a sensor the last counts; gains come before biases.

    Example:
        >>> transform = SignalTransform()  # doctest: +SKIP
        >>> transform.delay("*_pos", params["delay"])  # doctest: +SKIP
        >>> residual_fn = build_residual_fn(models_sequences=[data], modify_residual=transform.apply)  # doctest: +SKIP
    """

    def __init__(self, normalize: bool = True) -> None:
        self.normalize = normalize
        self._delays: list[_Rule] = []
        self._gains: list[_Rule] = []
        self._biases: list[_Rule] = []
        self._enabled_sensors: list[str] | None = None
        self._sensor_weights: Mapping[str, float] | None = None

    def delay(self, pattern: str, param: Parameter) -> None:
        """Simulated signals come later by the parameter [s]."""
        self._delays.append(_Rule(pattern, param))

    def gain(self, pattern: str, param: Parameter, target: str = "both") -> None:
        """Signals are multiplied by the parameter.

        Raises:
            ValueError: the target is not `predicted`, `measured` or `both`.
        """
        self._gains.append(_Rule(pattern, param, target))

    def bias(self, pattern: str, param: Parameter, target: str = "both") -> None:
        """The parameter is added to signals.

        Raises:
            ValueError: the target is not `predicted`, `measured` or `both`.
        """
        self._biases.append(_Rule(pattern, param, target))

    def enable_sensors(self, sensor_names: Sequence[str]) -> None:
        """Residuals are of these sensors only."""
        self._enabled_sensors = list(sensor_names)

    def set_sensor_weights(self, weights: Mapping[str, float]) -> None:
        """Differences are multiplied by weights; 1 for sensors without one."""
        self._sensor_weights = weights

    def apply(
        self,
        params: ParameterDict,
        sensordata_predicted: TimeSeries,
        sensordata_measured: TimeSeries,
        model: MjModel,
        return_pred_all: bool,
        state: Vector | None = None,
        sensor_weights: Mapping[str, float] | None = None,
    ) -> tuple[Vector, TimeSeries, TimeSeries]:
        """The residual, at those measured times that the simulation covers with every delay within the bounds.

        Args:
            params: values at hand.
            sensordata_predicted: all sensors, simulated.
            sensordata_measured: all sensors, measured.
            model: whose sensors these are.
            return_pred_all: all sensors come back, also where only some are enabled.
            state: not used.
            sensor_weights: in the place of those that were set.

        Returns:
            The residual `(n, columns)`, and what was predicted and measured at its times.
        """
        measured = signal_modifier.apply_delayed_ts_window(
            sensordata_measured, sensordata_predicted, *self._compute_delay_bounds()
        )
        delays = self._resolve_delays(list(sensordata_predicted.signal_mapping or {}), params)
        predicted = signal_modifier.apply_resample_and_delay(sensordata_predicted, measured.times, 0.0, delays)
        predicted = self._apply_gains_biases(predicted, "predicted", params)
        measured = self._apply_gains_biases(measured, "measured", params)
        weights = sensor_weights or self._sensor_weights
        residual = signal_modifier.weighted_diff(predicted.data, measured.data, model, weights)
        if self.normalize:
            residual = signal_modifier.normalize_residual(residual, measured.data)
        if return_pred_all or self._enabled_sensors is None:
            return residual, predicted, measured
        columns = signal_modifier.get_sensor_indices(model, self._enabled_sensors)
        kept = TimeSeries(predicted.times, predicted.data[:, columns])
        return residual[:, columns], kept, TimeSeries(measured.times, measured.data[:, columns])

    def _resolve_delays(self, sensor_names: Sequence[str], params: ParameterDict) -> dict[str, float]:
        """Delays by names of sensors [s]."""
        return {name: float(rule.value(params)[0]) for rule in self._delays for name in rule.sensors(sensor_names)}

    def _compute_delay_bounds(self) -> tuple[float, float]:
        """The least and the largest delay that parameters may have [s]."""
        params = [rule.param for rule in self._delays]
        low = min((float(param.min_value[0]) for param in params), default=0.0)
        return low, max((float(param.max_value[0]) for param in params), default=0.0)

    def _matching(self, rules: Iterable[_Rule], label: str, names: Iterable[str]) -> Iterator[tuple[str, _Rule]]:
        names = list(names)
        return ((name, rule) for rule in rules if rule.target in (label, "both") for name in rule.sensors(names))

    def _apply_gains_biases(self, ts: TimeSeries, target_label: str, params: ParameterDict) -> TimeSeries:
        """The series with gains and biases for `predicted` or `measured` signals."""
        data, names = ts.data.copy(), ts.signal_mapping or {}
        for name, rule in self._matching(self._gains, target_label, names):
            data[..., ts.get_indices(name)[1]] *= rule.value(params)
        for name, rule in self._matching(self._biases, target_label, names):
            data[..., ts.get_indices(name)[1]] += rule.value(params)
        return TimeSeries(ts.times, data, ts.signal_mapping)

    def _apply_gains_biases_reference(self, ts: TimeSeries, target_label: str, params: ParameterDict) -> TimeSeries:
        """The same, one sensor after the other by the functions for single sensors."""
        names: Any = ts.signal_mapping or {}
        for name, rule in self._matching(self._gains, target_label, names):
            ts = signal_modifier.apply_gain(ts, name, params[rule.param.name])
        for name, rule in self._matching(self._biases, target_label, names):
            ts = signal_modifier.apply_bias(ts, name, params[rule.param.name])
        return ts
