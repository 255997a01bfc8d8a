"""All structs, where programs look for them that know MuJoCo's own module."""

from robohive.mujoco.context import GLContext, MjrContext, MjrRect
from robohive.mujoco.data import MjData
from robohive.mujoco.lists import (
    MjContact,
    MjContactList,
    MjSolverStat,
    MjSolverStatList,
    MjTimerStat,
    MjTimerStatList,
    MjWarningStat,
    MjWarningStatList,
)
from robohive.mujoco.model import MjModel
from robohive.mujoco.options import MjOption, MjStatistic, MjVisual, MjVisualHeadlight, MjVisualRgba
from robohive.mujoco.scene import MjvGeom, MjvGLCamera, MjvPerturb, MjvScene
from robohive.mujoco.view import MjvCamera, MjvOption

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
