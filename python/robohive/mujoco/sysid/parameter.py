"""Parameters, by the names of MuJoCo's module."""

from robohive.mujoco.sysid.parameters.collection import ParameterDict
from robohive.mujoco.sysid.parameters.value import InertiaType, ModifierFn, Parameter

__all__ = ["InertiaType", "ModifierFn", "Parameter", "ParameterDict"]
