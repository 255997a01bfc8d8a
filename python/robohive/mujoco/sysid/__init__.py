"""System identification: parameters of a description are fitted to measured trajectories, by the names of `mujoco.sysid`.

    params = sysid.ParameterDict()
    params.add(sysid.Parameter("armature", 0.1, 0.0, 1.0,
                               modifier=lambda spec, p: setattr(spec.joint("elbow"), "armature", p.value[0])))
    measured = sysid.ModelSequences("arm", spec, "first", initial_state, control, sensordata)
    found, result = sysid.optimize(params, sysid.build_residual_fn(models_sequences=[measured]))

Needs `pip install robohive[sysid]`: scipy for the fit, pyyaml for files of parameters; the report needs nothing more.
"""

from robohive.mujoco.sysid import model_modifier, parameter, signal_modifier
from robohive.mujoco.sysid.confidence import calculate_intervals
from robohive.mujoco.sysid.model_modifier import (
    apply_body_inertia,
    apply_dgain,
    apply_param_modifiers,
    apply_param_modifiers_spec,
    apply_pdgain,
    apply_pgain,
    body_inertia_param,
    remove_visuals,
)
from robohive.mujoco.sysid.observed import construct_ts_from_defaults
from robohive.mujoco.sysid.optimize import optimize
from robohive.mujoco.sysid.parameter import InertiaType, Parameter, ParameterDict
from robohive.mujoco.sysid.rendering import render_rollout
from robohive.mujoco.sysid.report.defaults import default_report
from robohive.mujoco.sysid.residual import (
    BuildModelFn,
    CustomRolloutFn,
    ModifyResidualFn,
    build_residual_fn,
    model_residual,
    residual,
)
from robohive.mujoco.sysid.results import save_results
from robohive.mujoco.sysid.rollouts import sysid_rollout
from robohive.mujoco.sysid.sequences import ModelSequences
from robohive.mujoco.sysid.signal_modifier import (
    apply_bias,
    apply_delay,
    apply_delayed_ts_window,
    apply_gain,
    apply_resample_and_delay,
    get_sensor_indices,
    normalize_residual,
    weighted_diff,
)
from robohive.mujoco.sysid.signal_transform import SignalTransform
from robohive.mujoco.sysid.signals import SignalType
from robohive.mujoco.sysid.states import create_initial_state
from robohive.mujoco.sysid.timeseries import TimeSeries
from robohive.mujoco.sysid.trajectory import SystemTrajectory

__all__ = [
    "BuildModelFn",
    "CustomRolloutFn",
    "InertiaType",
    "ModelSequences",
    "ModifyResidualFn",
    "Parameter",
    "ParameterDict",
    "SignalTransform",
    "SignalType",
    "SystemTrajectory",
    "TimeSeries",
    "apply_bias",
    "apply_body_inertia",
    "apply_delay",
    "apply_delayed_ts_window",
    "apply_dgain",
    "apply_gain",
    "apply_param_modifiers",
    "apply_param_modifiers_spec",
    "apply_pdgain",
    "apply_pgain",
    "apply_resample_and_delay",
    "body_inertia_param",
    "build_residual_fn",
    "calculate_intervals",
    "construct_ts_from_defaults",
    "create_initial_state",
    "default_report",
    "get_sensor_indices",
    "model_modifier",
    "model_residual",
    "normalize_residual",
    "optimize",
    "parameter",
    "remove_visuals",
    "render_rollout",
    "residual",
    "save_results",
    "signal_modifier",
    "sysid_rollout",
    "weighted_diff",
]
