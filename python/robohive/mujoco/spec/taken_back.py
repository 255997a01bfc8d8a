"""Numbers of a model that a program wrote, taken back into the description that the model was compiled of."""

import warnings
from collections.abc import Iterator
from typing import Any

import numpy as np

from robohive.mujoco._errors import FatalError
from robohive.mujoco.enums.elements import mjtGeom, mjtJoint
from robohive.mujoco.enums.view import mjtOrientation
from robohive.mujoco.functions.rotation import mju_mulPose, mju_negPose

#: Attributes of each kind of element, and the beginning of the names of their arrays.
_ROWS = {
    "joint": ("jnt", "range margin"),
    "geom": ("geom", "size friction solref solimp rgba solmix margin gap surfacevel adhesion"),
    "site": ("site", "size rgba"),
    "camera": ("cam", "fovy ipd resolution intrinsic"),
    "light": ("light", "attenuation cutoff exponent ambient diffuse specular"),
    "material": ("mat", "texrepeat emission specular shininess reflectance rgba"),
    "pair": ("pair", "solref solreffriction solimp margin gap adhesion friction"),
    "equality": ("eq", "data solref solimp"),
    "tendon": ("tendon", "range actfrcrange rgba width margin armature frictionloss"),
    "actuator": ("actuator", "dynprm gainprm biasprm ctrlrange forcerange actrange lengthrange gear armature cranklength"),
    "sensor": ("sensor", "cutoff noise"),
    "key": ("key", "time qpos qvel act mpos mquat ctrl"),
}
#: The same for poses in bodies.
_PLACES = {
    "body": ("body", "pos quat"),
    "joint": ("jnt", "pos axis"),
    "geom": ("geom", "pos quat"),
    "site": ("site", "pos quat"),
    "camera": ("cam", "pos quat"),
    "light": ("light", "pos dir"),
}
#: Attributes whose arrays have other names.
_OTHERS = {
    "joint": {
        "solref_limit": "jnt_solref",
        "solimp_limit": "jnt_solimp",
        "solref_friction": "dof_solref",
        "solimp_friction": "dof_solimp",
        "armature": "dof_armature",
        "frictionloss": "dof_frictionloss",
    },
    "tendon": {
        "solref_limit": "tendon_solref_lim",
        "solimp_limit": "tendon_solimp_lim",
        "solref_friction": "tendon_solref_fri",
        "solimp_friction": "tendon_solimp_fri",
    },
}
#: Polynomials: an attribute, the array of its first coefficient, that of the others.
_POLYNOMIALS = {
    "joint": [("stiffness", "jnt_stiffness", "jnt_stiffnesspoly"), ("damping", "dof_damping", "dof_dampingpoly")],
    "tendon": [
        ("stiffness", "tendon_stiffness", "tendon_stiffnesspoly"),
        ("damping", "tendon_damping", "tendon_dampingpoly"),
    ],
    "actuator": [("damping", "actuator_damping", "actuator_dampingpoly")],
}
#: Addresses of the rows of arrays that are not numbered as their elements are.
_ADDRESSES = {
    "dof": "jnt_dofadr",
    "actuator_ctrlrange": "actuator_ctrladr",
    "actuator_lengthrange": "actuator_outadr",
    "actuator_gear": "actuator_outadr",
}


class _Change:
    """A model, and what was compiled of its description."""

    def __init__(self, model: Any, base: Any) -> None:
        self.model, self.base = model, base

    def row(self, array: str, element: int) -> Any:
        """A copy of the model's row of an element."""
        return np.array(getattr(self.model, array)[self._place(array, element)])

    def of(self, array: str, element: int) -> Any:
        """The same where it differs."""
        new = self.row(array, element)
        return None if np.array_equal(new, getattr(self.base, array)[self._place(array, element)], equal_nan=True) else new

    def _place(self, array: str, element: int) -> int:
        address = _ADDRESSES.get(array) or _ADDRESSES.get(array.partition("_")[0])
        return element if address is None else int(getattr(self.model, address)[element])


def _rows(change: _Change, spec: Any) -> None:
    for kind, (prefix, names) in _ROWS.items():
        arrays = {name: f"{prefix}_{name}" for name in names.split()} | _OTHERS.get(kind, {})
        for number, element in enumerate(spec._all(kind)):
            for attribute, array in arrays.items():
                row = change.of(array, number)
                if row is not None:
                    _set(element, attribute, row)
            for attribute, first, others in _POLYNOMIALS.get(kind, ()):
                if change.of(first, number) is not None or change.of(others, number) is not None:
                    setattr(element, attribute, [change.row(first, number), *change.row(others, number)])
            _user(change, element, prefix, number)


def _user(change: _Change, element: Any, prefix: str, number: int) -> None:
    name = f"{prefix}_user"
    if hasattr(change.model, name) and getattr(change.model, name).shape[-1]:
        row = change.of(name, number)
        if row is not None:
            element.userdata = row.tolist()


def _set(element: Any, attribute: str, row: Any) -> None:
    """Sets an attribute to numbers of a model, in the unit of the description."""
    turns = element._kind == "joint" and element.type in (mjtJoint.mjJNT_HINGE, mjtJoint.mjJNT_BALL)
    if turns and attribute in ("range", "ref", "springref") and element.compiler.degree:
        row = np.degrees(row)
    setattr(element, attribute, row.ravel().tolist() if row.ndim else row.item())


def _joints(change: _Change, spec: Any) -> None:
    """Reference positions of hinges and slides."""
    model, base = change.model, change.base
    for number, joint in enumerate(spec._all("joint")):
        if joint.type not in (mjtJoint.mjJNT_HINGE, mjtJoint.mjJNT_SLIDE):
            continue
        place = int(model.jnt_qposadr[number])
        for attribute, array in (("ref", "qpos0"), ("springref", "qpos_spring")):
            new = getattr(model, array)[place]
            if new != getattr(base, array)[place]:
                _set(joint, attribute, np.array(new))


def _places(change: _Change, spec: Any) -> None:
    """Poses in bodies. A frame around an element is in them, and so are the ends that a geom or a site reaches to."""
    for kind, (prefix, names) in _PLACES.items():
        for number, element in enumerate(spec._all(kind)):
            stretched = kind in ("geom", "site") and not np.isnan(element.fromto[0])
            arrays = {name: f"{prefix}_{name}" for name in [*names.split(), *(["size"] if stretched else [])]}
            # The world stays where it is.
            world = kind == "body" and number == 0
            if world or all(change.of(array, number) is None for array in arrays.values()):
                continue
            rows = {name: change.row(array, number) for name, array in arrays.items()}
            if kind == "geom":
                rows["pos"], rows["quat"] = _before_mesh(change, number, rows["pos"], rows["quat"])
            element.__dict__["_frame"] = None
            if "quat" in rows:
                element.alt.type = mjtOrientation.mjORIENTATION_QUAT
            if stretched:
                element.fromto[0] = np.nan
            for name, row in rows.items():
                setattr(element, name, row.tolist())


def _before_mesh(change: _Change, number: int, pos: Any, quat: Any) -> tuple[Any, Any]:
    """A geom's pose without that of its mesh, with which the compiler moves it."""
    model = change.base
    mesh = int(model.geom_dataid[number])
    if int(model.geom_type[number]) not in (mjtGeom.mjGEOM_MESH, mjtGeom.mjGEOM_SDF) or mesh < 0:
        return pos, quat
    back, turned, moved, whole = np.zeros(3), np.zeros(4), np.zeros(3), np.zeros(4)
    mju_negPose(back, turned, model.mesh_pos[mesh], model.mesh_quat[mesh])
    mju_mulPose(moved, whole, pos, quat, back, turned)
    return moved, whole


def _bodies(change: _Change, spec: Any) -> None:
    """Masses: what geoms added up to is written as inertials where it was changed."""
    for number, body in enumerate(spec._all("body")):
        _user(change, body, "body", number)
        names = ("ipos", "iquat", "mass", "inertia")
        if all(change.of(f"body_{name}", number) is None for name in names):
            continue
        body.ialt.type = mjtOrientation.mjORIENTATION_QUAT
        body.fullinertia = [np.nan, 0, 0, 0, 0, 0]
        body.explicitinertial = True
        for name in names:
            row = change.row(f"body_{name}", number)
            setattr(body, name, row.tolist() if row.ndim else row.item())


def _values(change: _Change, spec: Any) -> None:
    """Numbers of `numeric`, `tuple` and `hfield`."""
    model, base = change.model, change.base
    for kind, attribute, array, sizes in (
        ("numeric", "data", "numeric_data", model.numeric_size),
        ("tuple", "objprm", "tuple_objprm", model.tuple_size),
        ("hfield", "userdata", "hfield_data", model.hfield_nrow * model.hfield_ncol),
    ):
        for number, element in enumerate(spec._all(kind)):
            first = int(getattr(model, f"{kind}_adr")[number])
            rows = slice(first, first + int(sizes[number]))
            new = getattr(model, array)[rows]
            if not np.array_equal(new, getattr(base, array)[rows]) and (kind != "hfield" or len(element.userdata)):
                setattr(element, attribute, new.tolist())


def _settings(change: _Change, spec: Any) -> None:
    """Options and statistics; what is seen is taken over group by group."""
    model, base = change.model, change.base
    for part, target in ((model.opt, spec.option), (model.stat, spec.stat)):
        twin = base.opt if part is model.opt else base.stat
        for name in _fields(target):
            if hasattr(part, name) and not np.array_equal(getattr(part, name), getattr(twin, name)):
                setattr(target, name, getattr(part, name))
    for group in ("global_", "quality", "headlight", "map", "scale", "rgba"):
        ours, twin, target = (getattr(visual, group) for visual in (model.vis, base.vis, spec.visual))
        for name in _fields(target):
            if hasattr(ours, name) and not np.array_equal(getattr(ours, name), getattr(twin, name)):
                setattr(target, name, getattr(ours, name))


def _fields(part: Any) -> Iterator[str]:
    return (name for name in dir(part) if not name.startswith("_") and not callable(getattr(part, name)))


def _alike(a: Any, b: Any) -> bool:
    """Whether two arrays of models agree, but for rounding."""
    if isinstance(a, np.ndarray) and a.dtype.kind == "f":
        return bool(np.allclose(a, b, rtol=1e-9, atol=1e-12, equal_nan=True))
    return bool(np.array_equal(a, b))


def take_back(spec: Any, model: Any) -> None:
    """Takes the numbers of a model that were written after compilation into the description that it was compiled of.

    Warns of arrays that were written and that the description does not get, such as those that are computed.

    Raises:
        FatalError: the model was compiled of another description.
    """
    base = spec.compile()
    if base.names != model.names or base.signature != model.signature:
        raise FatalError("the model was compiled of another description than the one that was loaded last")
    change = _Change(model, base)
    _settings(change, spec)
    _bodies(change, spec)
    _rows(change, spec)
    _joints(change, spec)
    _places(change, spec)
    _values(change, spec)
    again = spec.compile()
    written = [name for name in model._shapes if not _alike(getattr(base, name), getattr(model, name))]
    left = [name for name in written if not _alike(getattr(again, name), getattr(model, name))]
    if left:
        warnings.warn(f"these arrays were written, and the text does not get them: {', '.join(left)}", stacklevel=3)
