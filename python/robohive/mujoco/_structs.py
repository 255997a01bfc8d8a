"""All structs, where programs look for them that know MuJoCo's own module."""

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
from robohive.mujoco.view import MjvCamera, MjvOption

__all__ = [
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
    "MjvCamera",
    "MjvOption",
]
