"""All enumerations, where programs look for them that know MuJoCo's own module."""

from robohive.mujoco.enums.elements import *  # noqa: F403
from robohive.mujoco.enums.physics import *  # noqa: F403
from robohive.mujoco.enums.view import *  # noqa: F403
