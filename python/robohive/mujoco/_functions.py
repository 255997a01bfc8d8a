"""All functions, where programs look for them that know MuJoCo's own module."""

from robohive.mujoco import _engine as _core
from robohive.mujoco.algebra import *  # noqa: F403
from robohive.mujoco.naming import *  # noqa: F403
from robohive.mujoco.query import *  # noqa: F403
from robohive.mujoco.rotation import *  # noqa: F403
from robohive.mujoco.stages import *  # noqa: F403
from robohive.mujoco.vectors import *  # noqa: F403
from robohive.mujoco.view import mjv_defaultCamera, mjv_defaultFreeCamera, mjv_defaultOption, mjv_defaultPerturb

mj_step = _core.mj_step
mj_step1 = _core.mj_step1
mj_step2 = _core.mj_step2
mj_forward = _core.mj_forward
mj_forwardSkip = _core.mj_forwardSkip
mj_inverse = _core.mj_inverse
mj_resetData = _core.mj_resetData
mj_resetDataKeyframe = _core.mj_resetDataKeyframe
