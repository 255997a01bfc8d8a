"""All functions, where programs look for them that know MuJoCo's own module."""

from robohive.mujoco import _engine as _core
from robohive.mujoco.functions.algebra import *  # noqa: F403
from robohive.mujoco.functions.banded import *  # noqa: F403
from robohive.mujoco.functions.bookkeeping import *  # noqa: F403
from robohive.mujoco.functions.box import *  # noqa: F403
from robohive.mujoco.functions.defaults import *  # noqa: F403
from robohive.mujoco.functions.history import *  # noqa: F403
from robohive.mujoco.functions.inertia import *  # noqa: F403
from robohive.mujoco.functions.naming import *  # noqa: F403
from robohive.mujoco.functions.parts import *  # noqa: F403
from robohive.mujoco.functions.printing import *  # noqa: F403
from robohive.mujoco.functions.query import *  # noqa: F403
from robohive.mujoco.functions.room import _realloc_con_efc, _realloc_island
from robohive.mujoco.functions.rotation import *  # noqa: F403
from robohive.mujoco.functions.scalars import *  # noqa: F403
from robohive.mujoco.functions.slopes import *  # noqa: F403
from robohive.mujoco.functions.stages import *  # noqa: F403
from robohive.mujoco.functions.vectors import *  # noqa: F403
from robohive.mujoco.log import mju_writeLog
from robohive.mujoco.pictures.context import (
    mjr_defaultRendererInfo,
    mjr_drawPixels,
    mjr_findRect,
    mjr_finish,
    mjr_getError,
    mjr_getRendererInfo,
    mjr_maxViewport,
    mjr_readPixels,
    mjr_rectangle,
    mjr_render,
    mjr_resizeOffscreen,
    mjr_restoreBuffer,
    mjr_setBuffer,
    mjr_uploadHField,
    mjr_uploadMesh,
    mjr_uploadTexture,
)
from robohive.mujoco.pictures.figure import mjv_defaultFigure
from robohive.mujoco.pictures.frames import (
    mjv_alignToCamera,
    mjv_averageCamera,
    mjv_camera2GLCamera,
    mjv_cameraFrame,
    mjv_cameraFrustum,
    mjv_cameraInModel,
    mjv_cameraInRoom,
    mjv_connector,
    mjv_frustumHeight,
    mjv_model2room,
    mjv_moveModel,
    mjv_room2model,
)
from robohive.mujoco.pictures.moving import mjv_moveCamera, mjv_select
from robohive.mujoco.pictures.overlay import mjr_changeFont, mjr_label, mjr_overlay, mjr_text
from robohive.mujoco.pictures.pulling import mjv_applyPerturbForce, mjv_applyPerturbPose, mjv_initPerturb, mjv_movePerturb
from robohive.mujoco.pictures.scene import mjv_defaultPerturb, mjv_initGeom, mjv_updateScene
from robohive.mujoco.pictures.view import mjv_defaultCamera, mjv_defaultFreeCamera, mjv_defaultOption

mj_step = _core.mj_step
mj_step1 = _core.mj_step1
mj_step2 = _core.mj_step2
mj_forward = _core.mj_forward
mj_forwardSkip = _core.mj_forwardSkip
mj_inverse = _core.mj_inverse
mj_resetData = _core.mj_resetData
mj_resetDataKeyframe = _core.mj_resetDataKeyframe
