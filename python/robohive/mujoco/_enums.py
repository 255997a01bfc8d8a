"""All enumerations, where programs look for them that know MuJoCo's own module."""

from robohive.mujoco.enums_elements import *  # noqa: F403
from robohive.mujoco.enums_physics import *  # noqa: F403
from robohive.mujoco.enums_view import *  # noqa: F403
