"""What parameters change in a description, by the names of MuJoCo's module."""

from __future__ import annotations

from robohive.mujoco.enums.elements import mjtGeom
from robohive.mujoco.spec import MjSpec
from robohive.mujoco.structs.model import MjModel
from robohive.mujoco.sysid.actuators import (
    apply_dgain,
    apply_pdgain,
    apply_pgain,
    get_actuator_pd_gains,
    is_position_actuator,
)
from robohive.mujoco.sysid.bodies import (
    apply_body_inertia,
    apply_body_mass_ipos,
    apply_body_theta_inertia,
    pi_from_body,
    scale_body_inertia,
    theta_inertia_from_body,
)
from robohive.mujoco.sysid.inertia import (
    cholesky_decompose_upper,
    inertia_to_fullinertia,
    pi_from_theta,
    pseudoinertia_from_pi,
    skew,
    theta_from_pseudoinertia,
)
from robohive.mujoco.sysid.inertia_parameter import body_inertia_param
from robohive.mujoco.sysid.parameters.collection import ParameterDict

__all__ = [
    "apply_body_inertia",
    "apply_body_mass_ipos",
    "apply_body_theta_inertia",
    "apply_dgain",
    "apply_param_modifiers",
    "apply_param_modifiers_spec",
    "apply_pdgain",
    "apply_pgain",
    "body_inertia_param",
    "cholesky_decompose_upper",
    "get_actuator_pd_gains",
    "inertia_to_fullinertia",
    "is_position_actuator",
    "pi_from_body",
    "pi_from_theta",
    "pseudoinertia_from_pi",
    "remove_visuals",
    "scale_body_inertia",
    "skew",
    "theta_from_pseudoinertia",
    "theta_inertia_from_body",
]


def apply_param_modifiers_spec(params: ParameterDict, spec: MjSpec) -> MjSpec:
    """Writes the parameters that are not frozen into a description, and returns it."""
    for param in params.values():
        if not param.frozen:
            param.apply_modifier(spec)
    return spec


def apply_param_modifiers(params: ParameterDict, spec: MjSpec) -> MjModel:
    """Writes the parameters that are not frozen into a description, and compiles it.

    Raises:
        ValueError: what is wrong with the description then.
    """
    return apply_param_modifiers_spec(params, spec).compile()


def remove_visuals(in_spec: MjSpec) -> MjSpec:
    """A copy without what only pictures need, which compiles faster: geoms that touch nothing, their meshes, materials,
    textures.

    Raises:
        ValueError: the description does not compile without them.
    """
    spec = in_spec.copy()
    seen = [geom for geom in spec.worldbody.find_all("geom") if not (geom.contype or geom.conaffinity)]
    meshes = {geom.meshname for geom in seen if geom.type == mjtGeom.mjGEOM_MESH} - {""}
    for geom in seen:
        spec.delete(geom)
    kept = {geom.meshname for geom in spec.worldbody.find_all("geom")}
    for mesh in list(spec.meshes):
        if mesh.name in meshes - kept:
            spec.delete(mesh)
    for element in [*spec.materials, *spec.textures]:
        spec.delete(element)
    spec.compile()
    return spec
