"""The report of a fit: parameters with their intervals, correlations, the course of the fit, signals before and after."""

from __future__ import annotations

import html
import os
import pathlib
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robohive.mujoco.sysid.confidence import calculate_intervals
from robohive.mujoco.sysid.model_modifier import apply_param_modifiers
from robohive.mujoco.sysid.optimize import ResidualFn
from robohive.mujoco.sysid.parameters.collection import ParameterDict
from robohive.mujoco.sysid.parameters.comparison import at_bound
from robohive.mujoco.sysid.report.builder import ReportBuilder, Section, table
from robohive.mujoco.sysid.report.plots import curves
from robohive.mujoco.sysid.residual import BuildModelFn
from robohive.mujoco.sysid.sequences import ModelSequences
from robohive.mujoco.sysid.timeseries import TimeSeries

Vector = NDArray[np.float64]


def default_report(
    models_sequences: Sequence[ModelSequences],
    initial_params: ParameterDict,
    opt_params: ParameterDict,
    residual_fn: ResidualFn,
    opt_result: Any,
    title: str = "SysID",
    save_path: str | os.PathLike[str] | None = None,
    build_model: BuildModelFn | None = apply_param_modifiers,
    generate_videos: bool = True,
) -> ReportBuilder:
    """Makes a report, and writes it as `report.html` into the folder `save_path` where one is given.

    Args:
        models_sequences: descriptions, and what was measured.
        initial_params: parameters before.
        opt_params: parameters after.
        residual_fn: what was minimised.
        opt_result: of `optimize`.
        title: of the page.
        save_path: a folder, which is made where it is not there.
        build_model: accepted; there are no videos for which models would be built.
        generate_videos: accepted; the page has curves and no videos, which `render_rollout` gives the pictures for.

    Raises:
        ImportError: scipy is not installed.
        OSError: a file cannot be written.
    """
    before = residual_fn(initial_params.as_vector(), initial_params.copy(), return_pred_all=True)
    left, after, measured = residual_fn(opt_params.as_vector(), opt_params, return_pred_all=True)
    covariance, intervals = calculate_intervals(left, opt_result.jac)
    names = opt_params.get_non_frozen_parameter_names()
    report = ReportBuilder(title)
    report.add_section(Section("Fit", _summary(before[0], left)))
    report.add_section(Section("Parameters", _parameters(names, initial_params, opt_params, intervals)))
    report.add_section(Section("Correlations", _correlations(names, covariance)))
    extras = opt_result.get("extras") or {}
    if extras.get("objective"):
        report.add_section(Section("Course of the fit", _course(names, extras)))
    labels = [(sequences, i) for sequences in models_sequences for i in range(len(sequences.sequence_name))]
    parts = zip(labels, before[1], after, measured, strict=True)
    for (sequences, i), first, last, record in parts:
        label = f"{sequences.name}: {sequences.sequence_name[i]}"
        series = {"measured": record[0], "before": first[0], "after": last[0]}
        report.add_section(Section(f"Signals of {label}", _signals(series)))
        report.add_section(Section(f"Controls of {label}", _signals({"control": sequences.control[i]})))
    if save_path is not None:
        folder = pathlib.Path(save_path)
        folder.mkdir(parents=True, exist_ok=True)
        report.save(folder / "report.html")
    return report


def _length(parts: Sequence[Vector]) -> tuple[float, int]:
    """The root of the mean square, and how many residuals there are."""
    numbers = np.concatenate([np.ravel(part) for part in parts])
    return float(np.sqrt(np.mean(numbers**2))), numbers.size


def _summary(before: Sequence[Vector], after: Sequence[Vector]) -> str:
    (first, count), (last, _) = _length(before), _length(after)
    return f"<p>{count} residuals; root of their mean square {first:.4g} before, {last:.4g} after.</p>"


def _parameters(names: list[str], initial: ParameterDict, found: ParameterDict, intervals: Vector) -> str:
    low, high = found.get_bounds()
    columns = (initial.as_vector(), initial.as_nominal_vector(), found.as_vector(), low, high)
    rows, marked = [], []
    for i, name in enumerate(names):
        half = intervals[i] if i < len(intervals) else np.nan
        rows.append(
            [name, *(f"{column[i]:.5g}" for column in columns), f"± {half:.2g}" if np.isfinite(half) else "unknown"]
        )
        marked.append(at_bound(columns[2][i], low[i], high[i]) or not np.isfinite(half))
    text = table(("parameter", "before", "nominal", "after", "lower", "upper", "95 % interval"), rows, marked)
    if any(marked):
        text += "<p>Highlighted: at a bound, or not to be told from what was measured.</p>"
    return text


def _correlations(names: list[str], covariance: Vector) -> str:
    """Correlations, those of which nine parts in ten are common highlighted by their row."""
    if covariance.size == 0:
        return "<p>no Jacobian was kept</p>"
    deviation = np.sqrt(np.diagonal(covariance))
    correlation = covariance / np.outer(deviation, deviation)
    rows = [[name, *(f"{value:.2f}" for value in row)] for name, row in zip(names, correlation, strict=True)]
    marked = [bool((np.abs(np.delete(row, i)) > 0.9).any()) for i, row in enumerate(correlation)]
    note = "<p>Highlighted: a parameter that is hard to tell from another (above 0.9).</p>" if any(marked) else ""
    return table(["", *names], rows, marked) + note


def _course(names: list[str], extras: dict[str, Any]) -> str:
    objective = np.array([float(np.squeeze(value)) for value in extras["objective"]])
    candidates = np.array([np.ravel(point) for point in extras["candidate"]])
    numbers = np.arange(len(objective), dtype=float)
    plots = [curves({"objective": (numbers, objective)}, "iteration", logarithmic=True)]
    plots += [curves({name: (numbers, candidates[:, i])}, "iteration") for i, name in enumerate(names)]
    return "".join(plots)


def _signals(series: dict[str, TimeSeries]) -> str:
    """A plot for each column that is in all series."""
    first = next(iter(series.values()))
    labels = {int(c): name for name, (_, columns) in (first.signal_mapping or {}).items() for c in columns}
    plots = []
    for column in range(first.data.shape[1]):
        shown = {name: (one.times, one.data[:, column]) for name, one in series.items() if column < one.data.shape[1]}
        plots.append(f"<h3>{html.escape(labels.get(column, f'column {column}'))}</h3>{curves(shown, 'time [s]')}")
    return "".join(plots)
