"""Scenes as MuJoCo's programs fill them: geoms, cameras, perturbations, and the functions that work on them."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from robohive.mujoco import _engine as _core
from robohive.mujoco.enums.elements import mjtGeom, mjtObj
from robohive.mujoco.enums.view import mjtCatBit, mjtRndFlag
from robohive.mujoco.pictures.looking import look_of
from robohive.mujoco.pictures.view import MjvCamera, MjvOption, _Struct
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.model import MjModel
from robohive.whole_numbers import whole

#: Which number of a round shape's size goes along each axis.
_ROUND = {
    int(mjtGeom.mjGEOM_SPHERE): [0, 0, 0],
    int(mjtGeom.mjGEOM_CAPSULE): [0, 0, 1],
    int(mjtGeom.mjGEOM_CYLINDER): [0, 0, 1],
}
_LOOK = ("emission", "specular", "shininess", "reflectance")
#: Flags that change what is drawn, in the engine's order.
_EFFECTS = tuple(
    mjtRndFlag[f"mjRND_{name}"]
    for name in ("SHADOW", "REFLECTION", "SKYBOX", "HAZE", "FOG", "WIREFRAME", "ADDITIVE", "CULL_FACE")
)


class MjvGeom(_Struct):
    """Something to draw, world frame; lengths in metres, `mat` a rotation matrix (3 x 3).

    The geoms that `mjv_updateScene` makes are read-only; those behind them are the program's own.
    """

    type: int
    pos: NDArray[np.float32]
    mat: NDArray[np.float32]
    size: NDArray[np.float32]
    rgba: NDArray[np.float32]

    def __init__(self) -> None:
        self.type = mjtGeom.mjGEOM_NONE
        self.dataid = self.matid = self.texid = -1
        self.objtype = self.objid = self.category = self.segid = 0
        self.texcoord = self.texuniform = self.transparent = 0
        self.size = np.full(3, 0.1, np.float32)
        self.pos = np.zeros(3, np.float32)
        self.mat = np.eye(3, dtype=np.float32)
        self.rgba = np.array([0.5, 0.5, 0.5, 1.0], np.float32)
        self.texrepeat = np.zeros(2, np.float32)
        self.emission = self.reflectance = self.camdist = self.modelrbound = 0.0
        self.specular = self.shininess = 0.5
        self.label = ""

    def __setattr__(self, name: str, value: Any) -> None:
        if self.__dict__.get("_fixed"):
            raise AttributeError("geoms of the model are read-only in a scene: edit the model, and update the scene")
        array = self.__dict__.get(name)
        if isinstance(array, np.ndarray):
            array[...] = np.reshape(value, array.shape)
        else:
            self.__dict__[name] = value

    def _guest(self) -> dict[str, Any]:
        """As the engine takes it."""
        numbers = {name: getattr(self, name) for name in ("type", "dataid", "objtype", "objid")}
        rows = {name: np.ravel(getattr(self, name)).tolist() for name in ("size", "pos", "mat", "rgba")}
        label = self.label.decode(errors="replace") if isinstance(self.label, bytes) else str(self.label)
        return {**numbers, **rows, "look": [float(getattr(self, name)) for name in _LOOK], "label": label}


def _of_model(rows: Mapping[str, Any], index: int) -> MjvGeom:
    """A geom that `mjv_updateScene` made."""
    geom = MjvGeom()
    for name in ("type", "dataid", "objtype", "objid", "matid", "category"):
        setattr(geom, name, int(rows[name][index]))
    for name in ("size", "pos", "mat", "rgba"):
        setattr(geom, name, rows[name][index])
        getattr(geom, name).flags.writeable = False
    for name, value in zip(_LOOK, rows["look"][index], strict=True):
        setattr(geom, name, float(value))
    geom.modelrbound = float(rows["rbound"][index, 0]) if geom.objtype == mjtObj.mjOBJ_GEOM else 0.0
    geom.segid = -1 if rows["unlisted"][index] else index
    geom.transparent = int(geom.rgba[3] < 1)
    geom.label = rows["label"][index]
    geom.__dict__["_fixed"] = True
    return geom


class _Geoms(Sequence[MjvGeom]):
    """The geoms of a scene, made when they are asked for."""

    def __init__(self, count: int) -> None:
        self._count = count
        self._made: dict[int, MjvGeom] = {}
        self._rows: Mapping[str, Any] | None = None

    def _start(self, rows: Mapping[str, Any]) -> None:
        self._made, self._rows = {}, rows

    def __len__(self) -> int:
        return self._count

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice):
            return tuple(self[k] for k in range(*index.indices(self._count)))
        if not -self._count <= index < self._count:
            raise IndexError(f"geom {index} of a scene with room for {self._count}")
        index = int(index) % self._count
        if index not in self._made:
            own = self._rows is not None and index < len(self._rows["type"])
            self._made[index] = _of_model(self._rows or {}, index) if own else MjvGeom()
        return self._made[index]

    def __iter__(self) -> Iterator[MjvGeom]:
        return (self[index] for index in range(self._count))


class MjvGLCamera(_Struct):
    """Where a picture is taken from, world frame; lengths in metres."""

    def __init__(self) -> None:
        self.pos, self.forward, self.up = (np.zeros(3, np.float32) for _ in range(3))
        self.frustum_center = self.frustum_width = self.frustum_bottom = self.frustum_top = 0.0
        self.frustum_near = self.frustum_far = 0.0
        self.orthographic = 0


class MjvPerturb(_Struct):
    """A body selected, and where it is pulled to."""

    def __init__(self) -> None:
        self.select = self.active = self.active2 = 0
        self.flexselect = self.skinselect = -1
        self.refpos, self.refselpos, self.localpos = (np.zeros(3) for _ in range(3))
        self.refquat = np.array([1.0, 0.0, 0.0, 0.0])
        self.localmass, self.scale = 0.0, 1.0


class MjvScene:
    """What there is to draw of a simulation, and geoms that a program adds behind: `geoms[ngeom]`, then `ngeom += 1`.

    `flags` are read by `mjr_render`.
    """

    def __init__(self, model: MjModel | None = None, maxgeom: int = 0) -> None:
        """A scene of a model, with room for `maxgeom` geoms."""
        self._model, self._painter = model, _core.Painter(1, 1)
        self.maxgeom = whole("maxgeom", maxgeom)
        self._geoms = _Geoms(self.maxgeom)
        self._own = self._count = self.nlight = self.nflex = self.nskin = 0
        #: What was looked at last is not read from the engine yet.
        self._unread = False
        self.flags: NDArray[np.uint8] = np.zeros(mjtRndFlag.mjNRNDFLAG, np.uint8)
        for name in ("SHADOW", "REFLECTION", "SKYBOX", "HAZE", "CULL_FACE"):
            self.flags[mjtRndFlag[f"mjRND_{name}"]] = 1
        self._cameras = (MjvGLCamera(), MjvGLCamera())
        self.enabletransform = self.stereo = self.framewidth = self.status = 0
        self.framergb: NDArray[np.float32] = np.zeros(3, np.float32)
        self.translate: NDArray[np.float32] = np.zeros(3, np.float32)
        self.rotate: NDArray[np.float32] = np.array([1, 0, 0, 0], np.float32)
        self.scale = 1.0

    @property
    def geoms(self) -> Sequence[MjvGeom]:
        """All `maxgeom` geoms; those of the model come first."""
        self._read()
        return self._geoms

    @property
    def ngeom(self) -> int:
        """How many of them are drawn."""
        self._read()
        return self._count

    @ngeom.setter
    def ngeom(self, count: int) -> None:
        self._read()
        self._count = int(count)

    @property
    def camera(self) -> tuple[MjvGLCamera, MjvGLCamera]:
        """Where the picture is taken from, once for each eye."""
        self._read()
        return self._cameras

    def _look(self, m: MjModel, d: MjData, look: dict[str, Any]) -> None:
        """Takes in what is seen; geoms and cameras are read when they are asked for."""
        self._painter.look(m, d, look)
        self._model, self._unread = m, True

    def _effects(self) -> list[bool]:
        """The flags that the engine draws with."""
        return [bool(self.flags[flag]) for flag in _EFFECTS]

    def _read(self) -> None:
        if not self._unread or self._model is None:
            return
        self._unread = False
        rows, view = self._painter.items()
        # Planes by their number among the planes of the model.
        planes = np.cumsum(self._model.geom_type == mjtGeom.mjGEOM_PLANE) - 1
        flat = rows["type"] == mjtGeom.mjGEOM_PLANE
        rows["dataid"][flat] = planes[rows["objid"][flat]]
        self._geoms._start(rows)
        self._count = self._own = min(len(rows["type"]), self.maxgeom)
        for camera in self._cameras:
            vars(camera).update(
                {name: np.array(value, np.float32) if isinstance(value, list) else value for name, value in view.items()}
            )

    def _guests(self) -> list[dict[str, Any]]:
        """What the program added."""
        if self._unread:
            return []
        return [self._geoms[index]._guest() for index in range(self._own, self._count)]


def mjv_updateScene(
    m: MjModel, d: MjData, opt: MjvOption, pert: MjvPerturb | None, cam: MjvCamera, catmask: int, scn: MjvScene
) -> None:
    """Takes in what is seen of a simulation, whose poses must have been computed.

    Raises:
        ValueError: there is no such camera, or no such body as `pert` selects.
    """
    bits = (mjtCatBit.mjCAT_STATIC, mjtCatBit.mjCAT_DYNAMIC, mjtCatBit.mjCAT_DECOR)
    look = look_of(m, cam, opt)
    look["categories"] = [bool(int(catmask) & bit) for bit in bits]
    if pert is not None and pert.select > 0:
        look["selection"] = _selection(m, pert)
    scn._look(m, d, look)


def _selection(m: MjModel, pert: MjvPerturb) -> dict[str, Any]:
    """A selected body as the engine takes it.

    Raises:
        ValueError: the model has no such body.
    """
    if pert.select >= m.nbody:
        raise ValueError(f"body {pert.select} is out of range: the model has {m.nbody}")
    return {
        "body": int(pert.select),
        "point": pert.localpos,
        "active": int(pert.active),
        "active2": int(pert.active2),
        "target": pert.refselpos,
        "orientation": pert.refquat,
    }


def mjv_initGeom(
    geom: MjvGeom,
    type: int,
    size: ArrayLike | None = None,
    pos: ArrayLike | None = None,
    mat: ArrayLike | None = None,
    rgba: ArrayLike | None = None,
) -> None:
    """Sets a geom: `size` and `pos` (3) [m], `mat` (9), `rgba` (4); what is not given, to its default.

    Of a sphere `size` is the radius, of capsules and cylinders radius and half length; what follows does not count.
    """
    geom.__init__()  # type: ignore[misc]
    geom.type = int(type)
    if size is not None and geom.type in _ROUND:
        size = np.ravel(size)[_ROUND[geom.type]]
    for name, value in {"size": size, "pos": pos, "mat": mat, "rgba": rgba}.items():
        if value is not None:
            setattr(geom, name, value)


def mjv_defaultPerturb(pert: MjvPerturb) -> None:
    """Sets the values of a new perturbation."""
    pert.__init__()  # type: ignore[misc]
