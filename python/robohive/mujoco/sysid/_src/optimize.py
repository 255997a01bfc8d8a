"""The fit, and how well it knows its parameters."""

from robohive.mujoco.sysid.confidence import calculate_intervals
from robohive.mujoco.sysid.optimize import optimize

__all__ = ["calculate_intervals", "optimize"]
