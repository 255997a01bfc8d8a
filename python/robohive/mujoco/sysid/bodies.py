"""Inertia of bodies in descriptions."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from robohive.mujoco.spec import MjSpec
from robohive.mujoco.sysid.inertia import (
    about_point,
    inertia_to_fullinertia,
    pi_from_theta,
    pseudoinertia_from_pi,
    theta_from_pseudoinertia,
)
from robohive.mujoco.sysid.parameters.value import InertiaType, Parameter

Vector = NDArray[np.float64]

#: `compiler.inertiafromgeom` that adds up geoms only where a body has no inertial of its own.
_WHERE_NONE_IS_GIVEN = 2
#: Rows and columns of `fullinertia`: xx, yy, zz, xy, xz, yz.
_FULL = (np.array([0, 1, 2, 0, 0, 1]), np.array([0, 1, 2, 1, 2, 2]))


def explicit_inertial(spec: MjSpec, body_name: str) -> Any:
    """The body, with the inertia that its geoms add up to written as an inertial of its own.

    Raises:
        ValueError: there is no such body, or the description does not compile.
    """
    body = spec.body(body_name)
    if body is None:
        raise ValueError(f"the description has no body '{body_name}'")
    spec.compiler.inertiafromgeom = _WHERE_NONE_IS_GIVEN
    compiled = spec.compile().body(body_name)
    body.explicitinertial = True
    body.fullinertia = [np.nan, 0, 0, 0, 0, 0]
    body.mass = float(compiled.mass[0])
    for name in ("inertia", "ipos", "iquat"):
        setattr(body, name, np.array(getattr(compiled, name)))
    return body


def apply_body_mass_ipos(
    spec: MjSpec,
    body_name: str,
    mass: ArrayLike | None = None,
    ipos: ArrayLike | None = None,
    rot_inertia_scale: bool = False,
) -> MjSpec:
    """Sets the mass [kg] and the centre of mass [m] of a body, and returns the description.

    Args:
        spec: where the body is.
        body_name: its name.
        mass: one number; as it is, where it is None.
        ipos: three numbers, frame of the body; as it is, where it is None.
        rot_inertia_scale: the rotational inertia changes as the mass does.

    Raises:
        ValueError: there is no such body, or these are not as many numbers.
    """
    body = explicit_inertial(spec, body_name)
    if mass is not None:
        new = _numbers("mass", mass, 1).item()
        if rot_inertia_scale:
            body.inertia = np.asarray(body.inertia) * (new / body.mass)
        body.mass = new
    if ipos is not None:
        body.ipos = _numbers("ipos", ipos, 3)
    return spec


def scale_body_inertia(spec: MjSpec, body_name: str, value: ArrayLike) -> MjSpec:
    """Multiplies the rotational inertia of a body, and returns the description.

    Raises:
        ValueError: there is no such body, or the value is not one number.
    """
    body = explicit_inertial(spec, body_name)
    body.inertia = np.asarray(body.inertia) * _numbers("the factor", value, 1)
    return spec


def pi_from_body(spec: MjSpec, body_name: str) -> Vector:
    """`pi` of a body, of thirteen numbers; see `inertia`.

    Raises:
        ValueError: there is no such body.
    """
    body = explicit_inertial(spec, body_name)
    centre = np.array(body.ipos, np.float64)
    inertia = inertia_to_fullinertia(np.array(body.iquat, np.float64), np.array(body.inertia, np.float64))
    return np.concatenate([[body.mass], body.mass * centre, about_point(inertia, body.mass, centre).ravel()])


def theta_inertia_from_body(spec: MjSpec, body_name: str) -> Vector:
    """`theta` of a body, of ten numbers; see `inertia`.

    Raises:
        ValueError: there is no such body, or no mass has its inertia.
    """
    try:
        return theta_from_pseudoinertia(pseudoinertia_from_pi(pi_from_body(spec, body_name)))
    except np.linalg.LinAlgError:
        raise ValueError(
            f"body '{body_name}' has an inertia that no distribution of mass has, or one without extent; "
            "each of its principal moments is less than the sum of the others"
        ) from None


def apply_body_theta_inertia(spec: MjSpec, body_name: str, theta: ArrayLike) -> MjSpec:
    """Sets the inertia of a body by ten numbers (see `inertia`), and returns the description.

    Raises:
        ValueError: there is no such body, or these are not ten numbers.
    """
    pi = pi_from_theta(_numbers("theta", theta, 10))
    body = explicit_inertial(spec, body_name)
    mass, centre = float(pi[0]), pi[1:4] / pi[0]
    body.mass, body.ipos = mass, centre
    body.inertia, body.iquat = np.zeros(3), [1.0, 0.0, 0.0, 0.0]
    # From the origin to the centre of mass: the same with a mass taken away.
    body.fullinertia = about_point(pi[4:].reshape(3, 3), -mass, centre)[_FULL]
    return spec


def apply_body_inertia(spec: MjSpec, name: str, param: Parameter) -> MjSpec:
    """Sets what a parameter of `body_inertia_param` says of a body, and returns the description.

    Raises:
        ValueError: it is another parameter, or there is no such body.
    """
    scales = param.scale_rot_inertia
    match param.inertia_type:
        case InertiaType.Mass:
            return apply_body_mass_ipos(spec, name, param.value, rot_inertia_scale=scales)
        case InertiaType.MassIpos:
            return apply_body_mass_ipos(spec, name, param.value[0], param.value[1:4], scales)
        case InertiaType.Pseudo:
            return apply_body_theta_inertia(spec, name, param.value)
    raise ValueError(f"parameter '{param.name}' has no inertia_type; body_inertia_param makes parameters of inertia")


def _numbers(what: str, values: ArrayLike, count: int) -> Vector:
    numbers = np.ravel(np.asarray(values, np.float64))
    if numbers.size != count:
        raise ValueError(f"{what} has {numbers.size} numbers; it needs {count}")
    return numbers
