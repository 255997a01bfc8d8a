"""Parameters, by the names of MuJoCo's module."""

from robohive.mujoco.sysid.collection import ParameterDict
from robohive.mujoco.sysid.value import InertiaType, ModifierFn, Parameter

__all__ = ["InertiaType", "ModifierFn", "Parameter", "ParameterDict"]
