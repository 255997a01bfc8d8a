"""What parameters change in a description."""

from robohive.mujoco.sysid.bodies import explicit_inertial
from robohive.mujoco.sysid.model_modifier import *  # noqa: F403

_infer_inertial = explicit_inertial
