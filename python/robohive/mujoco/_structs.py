"""All structs, where programs look for them that know MuJoCo's own module."""

from robohive.mujoco.pictures.context import GLContext, MjrContext, MjrRect
from robohive.mujoco.pictures.scene import MjvGeom, MjvGLCamera, MjvPerturb, MjvScene
from robohive.mujoco.pictures.view import MjvCamera, MjvOption
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.lists import (
    MjContact,
    MjContactList,
    MjSolverStat,
    MjSolverStatList,
    MjTimerStat,
    MjTimerStatList,
    MjWarningStat,
    MjWarningStatList,
)
from robohive.mujoco.structs.model import MjModel
from robohive.mujoco.structs.options import MjOption, MjStatistic, MjVisual, MjVisualHeadlight, MjVisualRgba

__all__ = [
    "GLContext",
    "MjContact",
    "MjContactList",
    "MjData",
    "MjModel",
    "MjOption",
    "MjSolverStat",
    "MjSolverStatList",
    "MjStatistic",
    "MjTimerStat",
    "MjTimerStatList",
    "MjVisual",
    "MjVisualHeadlight",
    "MjVisualRgba",
    "MjWarningStat",
    "MjWarningStatList",
    "MjrContext",
    "MjrRect",
    "MjvCamera",
    "MjvGLCamera",
    "MjvGeom",
    "MjvOption",
    "MjvPerturb",
    "MjvScene",
]
