"""Trajectories, measured and simulated."""

from robohive.mujoco.sysid.rollouts import sysid_rollout
from robohive.mujoco.sysid.sequences import ModelSequences
from robohive.mujoco.sysid.states import create_initial_state
from robohive.mujoco.sysid.trajectory import SystemTrajectory

__all__ = ["ModelSequences", "SystemTrajectory", "create_initial_state", "sysid_rollout"]
