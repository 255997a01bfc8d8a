"""All structs, where programs look for them that know MuJoCo's own module."""

from robohive.mujoco.pictures.context import GLContext, MjrContext, MjrRect, MjrRendererInfo
from robohive.mujoco.pictures.figure import MjvFigure, MjvLight
from robohive.mujoco.pictures.scene import MjvGeom, MjvGLCamera, MjvPerturb, MjvScene
from robohive.mujoco.pictures.view import MjvCamera, MjvOption
from robohive.mujoco.log import MjLogConfig
from robohive.mujoco.structs.contacts import MjContact, MjContactList
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.lists import (
    MjSolverStat,
    MjSolverStatList,
    MjTimerStat,
    MjTimerStatList,
    MjWarningStat,
    MjWarningStatList,
)
from robohive.mujoco.structs.model import MjModel
from robohive.mujoco.structs.options import MjOption, MjStatistic, MjVisual, MjVisualHeadlight, MjVisualRgba
from robohive.mujoco.structs.plain import (
    MjByteVec,
    MjDoubleVec,
    MjFloatVec,
    MjIntVec,
    MjLogMessage,
    MjPreContact,
    MjrVertexAttribute,
)
from robohive.mujoco.vfs import MjVfs

__all__ = [
    "MjByteVec",
    "MjDoubleVec",
    "MjFloatVec",
    "MjIntVec",
    "MjLogMessage",
    "MjPreContact",
    "MjrVertexAttribute",
    "GLContext",
    "MjContact",
    "MjContactList",
    "MjData",
    "MjLogConfig",
    "MjModel",
    "MjOption",
    "MjSolverStat",
    "MjSolverStatList",
    "MjStatistic",
    "MjTimerStat",
    "MjTimerStatList",
    "MjVfs",
    "MjVisual",
    "MjVisualHeadlight",
    "MjVisualRgba",
    "MjWarningStat",
    "MjWarningStatList",
    "MjrContext",
    "MjrRect",
    "MjrRendererInfo",
    "MjvCamera",
    "MjvFigure",
    "MjvGLCamera",
    "MjvGeom",
    "MjvLight",
    "MjvOption",
    "MjvPerturb",
    "MjvScene",
]
