"""Elements by name: `model.body("arm").mass`, `data.sensor("force").data`."""

from collections.abc import Callable
from typing import Any

import numpy as np

from robohive.mujoco.enums.elements import mjtObj

#: Kinds of elements by the name of the accessor: prefix of the model's arrays, size, type.
_KINDS = {
    "body": ("body", "nbody", mjtObj.mjOBJ_BODY),
    "joint": ("jnt", "njnt", mjtObj.mjOBJ_JOINT),
    "geom": ("geom", "ngeom", mjtObj.mjOBJ_GEOM),
    "site": ("site", "nsite", mjtObj.mjOBJ_SITE),
    "camera": ("cam", "ncam", mjtObj.mjOBJ_CAMERA),
    "light": ("light", "nlight", mjtObj.mjOBJ_LIGHT),
    "mesh": ("mesh", "nmesh", mjtObj.mjOBJ_MESH),
    "skin": ("skin", "nskin", mjtObj.mjOBJ_SKIN),
    "hfield": ("hfield", "nhfield", mjtObj.mjOBJ_HFIELD),
    "texture": ("tex", "ntex", mjtObj.mjOBJ_TEXTURE),
    "material": ("mat", "nmat", mjtObj.mjOBJ_MATERIAL),
    "pair": ("pair", "npair", mjtObj.mjOBJ_PAIR),
    "exclude": ("exclude", "nexclude", mjtObj.mjOBJ_EXCLUDE),
    "equality": ("eq", "neq", mjtObj.mjOBJ_EQUALITY),
    "tendon": ("tendon", "ntendon", mjtObj.mjOBJ_TENDON),
    "actuator": ("actuator", "nactuator", mjtObj.mjOBJ_ACTUATOR),
    "sensor": ("sensor", "nsensor", mjtObj.mjOBJ_SENSOR),
    "numeric": ("numeric", "nnumeric", mjtObj.mjOBJ_NUMERIC),
    "text": ("text", "ntext", mjtObj.mjOBJ_TEXT),
    "tuple": ("tuple", "ntuple", mjtObj.mjOBJ_TUPLE),
    "keyframe": ("key", "nkey", mjtObj.mjOBJ_KEY),
}

#: What a simulation says of an element: attribute and array, a row of which is the element's.
_DATA = {
    "body": {
        name: name
        for name in "cacc cfrc_ext cfrc_int cinert crb cvel subtree_angmom subtree_com subtree_linvel xfrc_applied ximat "
        "xipos xmat xpos xquat".split()
    },
    "geom": {"xpos": "geom_xpos", "xmat": "geom_xmat"},
    "site": {"xpos": "site_xpos", "xmat": "site_xmat"},
    "camera": {"xpos": "cam_xpos", "xmat": "cam_xmat"},
    "light": {"xpos": "light_xpos", "xdir": "light_xdir"},
    "tendon": {"length": "ten_length", "velocity": "ten_velocity"},
    "joint": {"xanchor": "xanchor", "xaxis": "xaxis"},
}
#: Arrays of which a joint has a row for each of its degrees of freedom.
_OF_DOFS = (
    "cdof cdof_dot qLDiagInv qacc qacc_smooth qacc_warmstart qfrc_actuator qfrc_applied qfrc_bias qfrc_constraint "
    "qfrc_inverse qfrc_passive qfrc_smooth qvel"
).split()


class _View:
    """One element; its attributes are views of the arrays of the model or the simulation."""

    __slots__ = ("__weakref__", "_kind", "_owner", "id", "name")
    _OF = ""

    def __init__(self, owner: Any, kind: str, number: int, name: str) -> None:
        for field, value in (("_owner", owner), ("_kind", kind), ("id", number), ("name", name)):
            object.__setattr__(self, field, value)

    def _find(self, field: str) -> Any:
        raise NotImplementedError

    def _fields(self) -> list[str]:
        raise NotImplementedError

    def __getattr__(self, field: str) -> Any:
        if field.startswith("_"):
            raise AttributeError(f"'{type(self).__name__}' object has no attribute '{field}'")
        known = self._owner._slices.get((self._kind, self.id, field))
        if known is not None:
            return known
        found = self._find(field)
        if found is None:
            raise AttributeError(f"'{self._shown()}' object has no attribute '{field}'")
        if isinstance(found, np.ndarray) and found.base is not None:
            # A part of an array that stays; others are computed each time.
            self._owner._slices[self._kind, self.id, field] = found
        return found

    def _shown(self) -> str:
        """MuJoCo's name for the type of views of this kind of element."""
        return f"_Mj{self._OF}{self._kind.capitalize()}Views"

    def __setattr__(self, field: str, value: Any) -> None:
        getattr(self, field)[...] = value

    def __dir__(self) -> list[str]:
        return sorted({*self._fields(), "id", "name"})

    def __repr__(self) -> str:
        rows = (f"  {field}: {getattr(self, field)!r}" for field in sorted(dir(self)))
        return "\n".join((f"<{self._shown()}", *rows, ">"))


def _rows(array: Any, number: int) -> Any:
    """Row `number`; of an array of scalars, an array of one."""
    return array[number : number + 1] if array.ndim == 1 else array[number]


def _span(model: Any, number: int, address: str, count: str) -> slice:
    start = int(getattr(model, address)[number])
    return slice(max(start, 0), max(start, 0) + int(getattr(model, count)[number]))


def _dofs(model: Any, joint: int) -> slice:
    start = int(model.jnt_dofadr[joint])
    return slice(start, start + (6, 3, 1, 1)[model.jnt_type[joint]])


def _positions(model: Any, joint: int) -> slice:
    start = int(model.jnt_qposadr[joint])
    return slice(start, start + (7, 4, 1, 1)[model.jnt_type[joint]])


class ModelView(_View):
    """What a model says of an element."""

    __slots__ = ()
    _OF = "Model"

    def _find(self, field: str) -> Any:
        model, prefix = self._owner, _KINDS[self._kind][0]
        special = self._special(field)
        if special is not None:
            return special
        full = f"{prefix}_{field}"
        if full in model._shapes or full == f"{prefix}_plugin":
            array = getattr(model, full)
            if self._kind == "actuator" and len(array) != model.nactuator:
                where = ("ctrladr", "ctrlnum") if len(array) == model.nu else ("outadr", "outnum")
                span = _span(model, self.id, *(f"actuator_{name}" for name in where))
                return array[span.start] if array.ndim > 1 and span.stop - span.start == 1 else array[span]
            return _rows(array, self.id)
        return None

    def _special(self, field: str) -> Any:
        model, number = self._owner, self.id
        match self._kind, field:
            case "joint", "qpos0" | "qpos_spring":
                return getattr(model, field)[_positions(model, number)]
            case "joint", _ if f"jnt_{field}" not in model._shapes and f"dof_{field}" in model._shapes:
                return getattr(model, f"dof_{field}")[_dofs(model, number)]
            case "numeric", "data":
                return model.numeric_data[_span(model, number, "numeric_adr", "numeric_size")]
            case "text", "data":
                span = _span(model, number, "text_adr", "text_size")
                return model.text_data[span]
            case "tuple", "objid" | "objtype" | "objprm":
                return getattr(model, f"tuple_{field}")[_span(model, number, "tuple_adr", "tuple_size")]
            case "hfield", "data":
                start = int(model.hfield_adr[number])
                rows, columns = int(model.hfield_nrow[number]), int(model.hfield_ncol[number])
                return model.hfield_data[start : start + rows * columns].reshape(rows, columns)
            case "texture", "data":
                start = int(model.tex_adr[number])
                shape = [int(getattr(model, f"tex_{name}")[number]) for name in ("height", "width", "nchannel")]
                return model.tex_data[start : start + shape[0] * shape[1] * shape[2]].reshape(shape)
            case "keyframe", "mpos" | "mquat":
                return getattr(model, f"key_{field}")[number]
        return None

    def _fields(self) -> list[str]:
        shapes, prefix = self._owner._shapes, _KINDS[self._kind][0]
        prefixes = (prefix, "dof") if self._kind == "joint" else (prefix,)
        fields = [name.partition("_")[2] for name in shapes if name.partition("_")[0] in prefixes]
        return fields + ["qpos0", "qpos_spring"] * (self._kind == "joint")


class DataView(_View):
    """What a simulation says of an element."""

    __slots__ = ()
    _OF = "Data"

    def _find(self, field: str) -> Any:
        data, number, model = self._owner, self.id, self._owner.model
        array = _DATA.get(self._kind, {}).get(field)
        if array is not None:
            return _rows(getattr(data, array), number)
        match self._kind, field:
            case "joint", "qpos":
                return data.qpos[_positions(model, number)]
            case "joint", _ if field in _OF_DOFS:
                return getattr(data, field)[_dofs(model, number)]
            case "sensor", "data":
                return data.sensordata[_span(model, number, "sensor_adr", "sensor_dim")]
            case "actuator", "ctrl":
                return data.ctrl[_span(model, number, "actuator_ctrladr", "actuator_ctrlnum")]
            case "actuator", "force" | "length" | "velocity":
                return getattr(data, f"actuator_{field}")[_span(model, number, "actuator_outadr", "actuator_outnum")]
            case "actuator", "moment":
                return self._moment()
            case "tendon", "J":
                return self._tendon_jacobian()
        return None

    def _moment(self) -> Any:
        """Moment arms of an actuator's first output over all degrees of freedom."""
        data, model = self._owner, self._owner.model
        output = int(model.actuator_outadr[self.id])
        return _dense(data.actuator_moment, data.moment_colind, data.moment_rowadr[output], data.moment_rownnz[output], model.nv)

    def _tendon_jacobian(self) -> Any:
        data, model = self._owner, self._owner.model
        start, count = model.ten_J_rowadr[self.id], model.ten_J_rownnz[self.id]
        return _dense(data.ten_J, model.ten_J_colind, start, count, model.nv)

    def _fields(self) -> list[str]:
        more = {
            "joint": ["qpos", *_OF_DOFS],
            "sensor": ["data"],
            "actuator": ["ctrl", "force", "length", "moment", "velocity"],
            "tendon": ["J"],
        }
        return [*_DATA.get(self._kind, {}), *more.get(self._kind, [])]


def _dense(values: Any, columns: Any, start: int, count: int, width: int) -> Any:
    row = np.zeros(width)
    row[columns[start : start + count]] = values[start : start + count]
    row.flags.writeable = False
    return row


def _locate(model: Any, kind: str, key: Any) -> tuple[int, str]:
    """Id and name of an element by name or id.

    Raises:
        KeyError: there is no such name; the message lists those that there are.
        IndexError: there is no such id.
    """
    _, size, code = _KINDS[kind]
    count = getattr(model, size)
    if isinstance(key, str):
        number = model._id(code, key)
        if number < 0:
            names = sorted(filter(None, (model._name(code, i) for i in range(count))))
            raise KeyError(f"Invalid name '{key}'. Valid names: {names}")
        return number, key
    try:
        number = key.__index__()
    except AttributeError:
        raise TypeError(f"{kind}() takes a name or an id, not a {type(key).__name__}") from None
    if not 0 <= number < count:
        raise IndexError(f"Invalid index {number}. Valid indices from 0 to {count - 1}")
    return number, model._name(code, number)


def _accessor(kind: str, view: type[_View]) -> Callable[..., Any]:
    def find(self: Any, name: str | int = "") -> Any:
        model = self if view is ModelView else self.model
        number, own_name = _locate(model, kind, name)
        found = self._views.get((kind, number))
        if found is None:
            found = self._views[kind, number] = view(self, kind, number, own_name)
        return found

    find.__name__ = kind
    find.__doc__ = f"The {kind} of this name or id."
    return find


class ModelElements:
    """Accessors of a model, `body("name")` and so on."""

    body = _accessor("body", ModelView)
    joint = _accessor("joint", ModelView)
    geom = _accessor("geom", ModelView)
    site = _accessor("site", ModelView)
    camera = _accessor("camera", ModelView)
    light = _accessor("light", ModelView)
    mesh = _accessor("mesh", ModelView)
    skin = _accessor("skin", ModelView)
    hfield = _accessor("hfield", ModelView)
    texture = _accessor("texture", ModelView)
    material = _accessor("material", ModelView)
    pair = _accessor("pair", ModelView)
    exclude = _accessor("exclude", ModelView)
    equality = _accessor("equality", ModelView)
    tendon = _accessor("tendon", ModelView)
    actuator = _accessor("actuator", ModelView)
    sensor = _accessor("sensor", ModelView)
    numeric = _accessor("numeric", ModelView)
    text = _accessor("text", ModelView)
    tuple = _accessor("tuple", ModelView)
    keyframe = _accessor("keyframe", ModelView)
    jnt = joint
    cam = camera
    tex = texture
    mat = material
    eq = equality
    ten = tendon
    key = keyframe


class DataElements:
    """Accessors of a simulation, `body("name")` and so on."""

    body = _accessor("body", DataView)
    geom = _accessor("geom", DataView)
    site = _accessor("site", DataView)
    camera = _accessor("camera", DataView)
    light = _accessor("light", DataView)
    tendon = _accessor("tendon", DataView)
    joint = _accessor("joint", DataView)
    sensor = _accessor("sensor", DataView)
    actuator = _accessor("actuator", DataView)
    jnt = joint
    cam = camera
    ten = tendon
