"""Paths of episodes, as RoboHive's `examine_policy` returns them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np


def stack(infos: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Dictionaries of one kind as a dictionary of arrays with time as the first axis; what has no array stays a list."""
    return {key: _column([info[key] for info in infos]) for key in infos[0]}


def _column(values: list[Any]) -> Any:
    if isinstance(values[0], Mapping):
        return stack(values)
    return np.array(values)


def truncate(paths: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Cuts every path behind the step that ended it, and writes `terminated`."""
    for path in paths:
        ended = np.flatnonzero(path["done"])
        path["terminated"] = bool(ended.size)
        if ended.size:
            steps = int(ended[0]) + 1
            for key, values in path.items():
                if isinstance(values, np.ndarray):
                    path[key] = values[:steps]
                elif isinstance(values, Mapping):
                    path[key] = _cut(values, steps)
    return paths


def _cut(columns: Mapping[str, Any], steps: int) -> dict[str, Any]:
    return {
        key: _cut(values, steps) if isinstance(values, Mapping) else values[:steps]
        for key, values in columns.items()
    }


def success(
    paths: Sequence[Mapping[str, Any]], horizon: int, share: bool, logger: Any, successful_steps: int
) -> float:
    """Percentage of successful paths; see `RoboHiveEnv.evaluate_success`.

    Raises:
        ValueError: there are no paths.
    """
    if not paths:
        raise ValueError("there are no paths to evaluate")
    solved = np.array([np.sum(np.asarray(path["env_infos"]["solved"], dtype=float)) for path in paths])
    percentage = 100.0 * float(np.mean(solved / horizon if share else solved > successful_steps))
    if logger is not None:
        infos = [path["env_infos"] for path in paths]
        logger.log_kv("rwd_sparse", np.mean([np.mean(info["rwd_sparse"]) for info in infos]))
        logger.log_kv("rwd_dense", np.mean([np.sum(info["rwd_dense"]) / horizon for info in infos]))
        logger.log_kv("success_percentage", percentage)
    return percentage
