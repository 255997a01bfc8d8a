"""Parameters for the inertia of a body, with bounds about what a model has."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from robohive.mujoco.spec import MjSpec
from robohive.mujoco.structs.model import MjModel
from robohive.mujoco.sysid.bodies import apply_body_inertia, theta_inertia_from_body
from robohive.mujoco.sysid.parameters.value import InertiaType, ModifierFn, Parameter

Vector = NDArray[np.float64]


def body_inertia_param(
    spec: MjSpec,
    model: MjModel,
    body_name: str,
    inertia_type: InertiaType = InertiaType.MassIpos,
    scale_rot_inertia: bool = False,
    mass_bound_mult: ArrayLike | None = None,
    ipos_bound_off: ArrayLike | None = None,
    stretch_bound_mult: ArrayLike | None = None,
    shear_bound_off: ArrayLike | None = None,
    param_name: str | None = None,
    modifier: ModifierFn | None = None,
) -> Parameter:
    """A parameter that begins at the inertia which a body has.

    Args:
        spec: the description of the model.
        model: the model, compiled.
        body_name: the body.
        inertia_type: which numbers it has: the mass, `(1,)`; mass and centre of mass, `(4,)`; `theta` of `inertia`, `(10,)`.
        scale_rot_inertia: the rotational inertia changes as the mass does; of no effect for `Pseudo`.
        mass_bound_mult: least and largest mass, over that of the model; 0.1 and 10 by default.
        ipos_bound_off: least and largest distance of the centre of mass along each axis [m]; of `Pseudo` of `theta[7:]`;
            -0.5 and 0.5 by default.
        stretch_bound_mult: of `Pseudo`: least and largest stretch along the axes, squared; 0.5 and 2 by default.
        shear_bound_off: of `Pseudo`: least and largest difference of `theta[4:7]`; -0.5 and 0.5 by default.
        param_name: its name, by default that of the body with `_inertia`.
        modifier: what writes it into a description, by default `apply_body_inertia`.

    Raises:
        ValueError: there is no such type, or the inertia of the body is not possible.
        KeyError: there is no such body.
    """
    if not isinstance(inertia_type, InertiaType):
        raise ValueError(f"{inertia_type!r} is no InertiaType; there are {', '.join(InertiaType.__members__)}")
    times = _pair(mass_bound_mult, (0.1, 10.0))
    offset = _pair(ipos_bound_off, (-0.5, 0.5))
    body = model.body(body_name)
    mass = np.array(body.mass, np.float64)
    if inertia_type is InertiaType.Pseudo:
        nominal = theta_inertia_from_body(spec, body_name)
        # alpha and the logarithms are of roots: of the mass, and of squared stretches.
        stretch = _pair(stretch_bound_mult, (0.5, 2.0))
        spans = [
            (np.log(times) / 2, 1),
            (np.log(stretch) / 2, 3),
            (_pair(shear_bound_off, (-0.5, 0.5)), 3),
            (offset, 3),
        ]
        low, high = (nominal + np.concatenate([np.full(n, span[side]) for span, n in spans]) for side in (0, 1))
    else:
        centre = np.array(body.ipos, np.float64) if inertia_type is InertiaType.MassIpos else np.empty(0)
        nominal = np.concatenate([mass, centre])
        low, high = (np.concatenate([mass * times[side], centre + offset[side]]) for side in (0, 1))

    def write(spec: MjSpec, param: Parameter) -> MjSpec:
        return apply_body_inertia(spec, body_name, param)

    param = Parameter(param_name or f"{body_name}_inertia", nominal, low, high, modifier=modifier or write)
    param.inertia_type, param.scale_rot_inertia = inertia_type, scale_rot_inertia
    return param


def _pair(given: ArrayLike | None, default: tuple[float, float]) -> Vector:
    return np.asarray(default if given is None else given, np.float64)
