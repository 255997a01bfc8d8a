"""Parameters."""

from robohive.mujoco.sysid.parameter import *  # noqa: F403
