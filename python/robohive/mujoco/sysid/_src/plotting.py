"""Pictures of trajectories."""

from robohive.mujoco.sysid.rendering import render_rollout

__all__ = ["render_rollout"]
