"""Files of a fit."""

from __future__ import annotations

import logging
import os
import pathlib
import pickle
from collections.abc import Sequence
from typing import Any

from robohive.mujoco.sysid.confidence import calculate_intervals
from robohive.mujoco.sysid.model_modifier import apply_param_modifiers_spec
from robohive.mujoco.sysid.optimize import ResidualFn
from robohive.mujoco.sysid.parameters.collection import ParameterDict
from robohive.mujoco.sysid.sequences import ModelSequences

_log = logging.getLogger("absl")


def save_results(
    experiment_results_folder: str | os.PathLike[str],
    models_sequences: Sequence[ModelSequences],
    initial_params: ParameterDict,
    opt_params: ParameterDict,
    opt_result: Any,
    residual_fn: ResidualFn,
) -> None:
    """Writes a fit into a folder, which is made where it is not there.

    | file | what it is |
    |---|---|
    | `params_x_0.yaml`, `params_x_hat.yaml` | parameters before and after |
    | `results.pkl` | `opt_result` |
    | `confidence.pkl` | `cov` and `intervals` of `calculate_intervals` |
    | `NAME.xml` | each description with the parameters found |

    Raises:
        ImportError: pyyaml or scipy is not installed.
        OSError: a file cannot be written.
    """
    folder = pathlib.Path(experiment_results_folder)
    folder.mkdir(parents=True, exist_ok=True)
    _log.info("writing results to %s", folder)
    initial_params.save_to_disk(folder / "params_x_0.yaml")
    opt_params.save_to_disk(folder / "params_x_hat.yaml")
    left = residual_fn(opt_result.x, opt_params, return_pred_all=True)[0]
    covariance, intervals = calculate_intervals(left, opt_result.jac)
    pickles = {"results.pkl": opt_result, "confidence.pkl": {"cov": covariance, "intervals": intervals}}
    for name, content in pickles.items():
        (folder / name).write_bytes(pickle.dumps(content, pickle.HIGHEST_PROTOCOL))
    for sequences in models_sequences:
        apply_param_modifiers_spec(opt_params, sequences.spec).to_file(str(folder / f"{sequences.name}.xml"))
