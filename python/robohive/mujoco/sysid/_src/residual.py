"""Distances of simulated and measured trajectories."""

from robohive.mujoco.sysid.observed import construct_ts_from_defaults
from robohive.mujoco.sysid.residual import (
    BuildModelFn,
    CustomRolloutFn,
    ModifyResidualFn,
    build_residual_fn,
    model_residual,
    residual,
)

__all__ = [
    "BuildModelFn",
    "CustomRolloutFn",
    "ModifyResidualFn",
    "build_residual_fn",
    "construct_ts_from_defaults",
    "model_residual",
    "residual",
]
