"""Files of a fit."""

from robohive.mujoco.sysid.results import save_results

__all__ = ["save_results"]
