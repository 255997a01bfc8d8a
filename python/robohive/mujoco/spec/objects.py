"""Elements outside the tree of bodies: assets, constraints, tendons, actuators, sensors, custom data, keyframes."""

from collections.abc import Iterator, Sequence
from typing import Any

from robohive.mujoco import _engine as _core
from robohive.mujoco.enums.elements import mjtGeom, mjtWrap
from robohive.mujoco.enums.view import mjtMeshBuiltin
from robohive.mujoco.spec.element import MjsElement
from robohive.mujoco.spec.forms import all_forms
from robohive.mujoco.spec.plugins import Plugged


#: Sensors of more than one number.
_SIZES = {
    2: ("CAMPROJECTION",),
    3: (
        "ACCELEROMETER VELOCIMETER GYRO FORCE TORQUE MAGNETOMETER BALLANGVEL FRAMEPOS FRAMEXAXIS FRAMEYAXIS FRAMEZAXIS "
        "FRAMELINVEL FRAMEANGVEL FRAMELINACC FRAMEANGACC SUBTREECOM SUBTREELINVEL SUBTREEANGMOM GEOMNORMAL"
    ).split(),
    4: ("BALLQUAT", "FRAMEQUAT"),
    6: ("GEOMFROMTO",),
}
#: Numbers of the parts of a contact, and of a ray.
_CONTACT = (1, 3, 3, 1, 3, 3, 3)
_RAY = (1, 3, 3, 3, 3, 1)


class _Listed(MjsElement):
    """An element of a list of its description."""

    def _number(self) -> int:
        if self._owner is None or self._id >= 0:
            return super()._number()
        return next((i for i, other in enumerate(self._owner._lists[self._kind]) if other is self), -1)


class MjsMesh(Plugged, _Listed):
    """A triangle mesh, of a file, of arrays or computed."""

    _kind = "mesh"

    def _make(self, shape: str, *parameters: float) -> None:
        inner = self.__dict__
        inner["builtin"] = mjtMeshBuiltin[f"mjMESH_BUILTIN_{shape}"]
        inner["params"] = all_forms("mesh")["params"].accept(parameters)

    def make_sphere(self, subdivision: int) -> None:
        """Makes it an icosahedron, subdivided."""
        self._make("SPHERE", subdivision)

    def make_hemisphere(self, resolution: int) -> None:
        """Makes it a closed half ball."""
        self._make("HEMISPHERE", resolution)

    def make_cone(self, nedge: int, radius: float) -> None:
        """Makes it a cone or a frustum."""
        self._make("CONE", nedge, radius)

    def make_supersphere(self, resolution: int, e: float, n: float) -> None:
        """Makes it a superellipsoid."""
        self._make("SUPERSPHERE", resolution, e, n)

    def make_supertorus(self, resolution: int, radius: float, s: float, t: float) -> None:
        """Makes it a supertoroid."""
        self._make("SUPERTORUS", resolution, radius, s, t)

    def make_wedge(self, resolution: Sequence[int] = (0, 0), fov: Sequence[float] = (0, 0), gamma: float = 0) -> None:
        """Makes it a spherical grid of points."""
        self._make("WEDGE", *resolution, *fov, gamma)

    def make_plate(self, resolution: Sequence[int] = (0, 0)) -> None:
        """Makes it a flat grid of points."""
        self._make("PLATE", *resolution)


class MjsFlex(_Listed):
    """A deformable body: lines, triangles or tetrahedra between vertices that are fixed to bodies."""

    _kind = "flex"

    def __init__(self, owner: Any, values: dict[str, Any] | None = None) -> None:
        super().__init__(owner, values)
        # Cells of the lattice of a flexcomp that hold no element.
        self.__dict__["_empty_cells"] = list((values or {}).get("_empty_cells", ()))


class MjsSkin(_Listed):
    """A surface whose vertices follow bodies, of a file or of arrays."""

    _kind = "skin"


class MjsHField(_Listed):
    """A height field."""

    _kind = "hfield"


class MjsTexture(_Listed):
    """A texture."""

    _kind = "texture"
    _pixels = b""

    @property
    def data(self) -> bytes:
        """Pixels given by the program, row after row, `height * width * nchannel` bytes; empty where there are none."""
        return self._pixels

    @data.setter
    def data(self, pixels: bytes) -> None:
        self.__dict__["_pixels"] = bytes(pixels)


class MjsMaterial(_Listed):
    """A material."""

    _kind = "material"


class MjsPair(_Listed):
    """Two geoms that collide whatever their bits say."""

    _kind = "pair"


class MjsExclude(_Listed):
    """Two bodies that do not collide."""

    _kind = "exclude"


class MjsEquality(_Listed):
    """An equality constraint."""

    _kind = "equality"


class MjsWrap:
    """What a tendon passes."""

    def __init__(self, tendon: "MjsTendon", code: int, name: str = "", side: str = "", number: float = 0.0) -> None:
        self._tendon, self._code, self._name, self._side, self._number = tendon, code, name, side, number
        self.info = ""

    def _find(self, kind: str, name: str) -> Any:
        return self._tendon._home()._names[kind].get(name) if name else None

    @property
    def target(self) -> Any:
        """The joint, site or geom."""
        kind = {1: "joint", 3: "site", 4: "geom"}.get(self._code)
        return kind and self._find(kind, self._name)

    @property
    def sidesite(self) -> Any:
        """The site on the side that the tendon passes, None for either side."""
        return self._find("site", self._side)

    @property
    def type(self) -> mjtWrap:
        """What it is."""
        if self._code == 4:
            cylinder = getattr(self.target, "type", None) == mjtGeom.mjGEOM_CYLINDER
            return mjtWrap.mjWRAP_CYLINDER if cylinder else mjtWrap.mjWRAP_SPHERE
        return mjtWrap(self._code)

    @property
    def coef(self) -> float | None:
        """Length per position of a joint."""
        return self._number if self._code == 1 else None

    @property
    def divisor(self) -> float | None:
        """Branches of a pulley."""
        return self._number if self._code == 2 else None


class MjsTendonPath:
    """What a tendon passes, in order."""

    def __init__(self, steps: list[MjsWrap]) -> None:
        self._steps = steps

    def __getitem__(self, index: int) -> MjsWrap:
        if not 0 <= index < len(self._steps):
            raise IndexError("no element has this number")
        return self._steps[index]

    def __len__(self) -> int:
        return len(self._steps)

    def __iter__(self) -> Iterator[MjsWrap]:
        return iter(self._steps)


class MjsTendon(_Listed):
    """A tendon with its path."""

    _kind = "tendon"

    def __init__(self, owner: Any, values: dict[str, Any] | None = None) -> None:
        super().__init__(owner, values)
        self.__dict__["_steps"] = [MjsWrap(self, *step) for step in (values or {}).get("_steps", ())]

    def _duplicate(self, owner: Any, origin: Any, default: Any) -> "MjsTendon":
        other = super()._duplicate(owner, origin, default)
        steps = [MjsWrap(other, step._code, step._name, step._side, step._number) for step in self._steps]
        other.__dict__["_steps"] = steps
        return other

    @property
    def path(self) -> MjsTendonPath:
        """What the tendon passes."""
        return MjsTendonPath(self._steps)

    def _wrap(self, code: int, name: str = "", side: str = "", number: float = 0.0) -> MjsWrap:
        wrap = MjsWrap(self, code, name, side, number)
        self._steps.append(wrap)
        return wrap

    def wrap_site(self, name: str) -> MjsWrap:
        """Leads the tendon through a site."""
        return self._wrap(3, name)

    def wrap_geom(self, name: str, sidesite: str) -> MjsWrap:
        """Leads the tendon around a geom, past a site beside it when that is given."""
        return self._wrap(4, name, sidesite)

    def wrap_joint(self, name: str, coef: float) -> MjsWrap:
        """Adds the position of a joint, times a coefficient, to the length."""
        return self._wrap(1, name, number=coef)

    def wrap_pulley(self, divisor: float) -> MjsWrap:
        """Divides the tendon into branches."""
        return self._wrap(2, number=divisor)

    def default(self) -> Any:
        """The default class."""
        return self.classname


class MjsActuator(Plugged, _Listed):
    """An actuator, in general form."""

    _kind = "actuator"

    def _become(self, shortcut: str, **arguments: Any) -> None:
        """Takes gain, bias and dynamics of a shortcut of MJCF; -1 and zeros stand for what is not given."""
        given = []
        for name, value in arguments.items():
            numbers = [float(number) for number in (value if isinstance(value, Sequence) else [value])]
            if any(number != -1 for number in numbers) and (len(numbers) == 1 or any(numbers)):
                given.append((name, " ".join(map(repr, numbers))))
        shown = _core.actuator_shortcut(self.__dict__, shortcut, given)
        for name, form in all_forms("actuator").items():
            if name in shown and name != "name":
                self.__dict__[name] = form.fresh(shown[name])

    def set_to_motor(self) -> None:
        """Makes it a motor: force is control."""
        self._become("motor")
        self.gainprm[0] = 1

    def set_to_position(
        self, kp: float, kv: float = -1, dampratio: float = -1, timeconst: float = -1, inheritrange: float = False
    ) -> None:
        """Makes it a position servo."""
        self._become("position", kp=kp, kv=kv, dampratio=dampratio, timeconst=timeconst, inheritrange=inheritrange)

    def set_to_intvelocity(
        self, kp: float, kv: float = -1, dampratio: float = -1, timeconst: float = -1, inheritrange: float = False
    ) -> None:
        """Makes it a position servo whose target is integrated from velocities."""
        if timeconst != -1:
            self.dynprm[0] = timeconst
        self._become("intvelocity", kp=kp, kv=kv, dampratio=dampratio, inheritrange=inheritrange)

    def set_to_velocity(self, kv: float) -> None:
        """Makes it a velocity servo."""
        self._become("velocity", kv=kv)

    def set_to_orientation(self, kp: float, kv: float = -1, dampratio: float = -1, ctrlspec: int = 0) -> None:
        """Makes it a servo of orientations."""
        self._become("orientation", kp=kp, kv=kv, dampratio=dampratio)
        self.ctrlspec = ctrlspec

    def set_to_pid(
        self,
        kp: float,
        kv: float = -1,
        dampratio: float = -1,
        ki: float = -1,
        imax: float = -1,
        slewmax: float = -1,
        inheritrange: float = 0,
        ctrlspec: int = 0,
    ) -> None:
        """Makes it a servo with an integral part."""
        self._become(
            "pid", kp=kp, kv=kv, dampratio=dampratio, ki=ki, imax=imax, slewmax=slewmax, inheritrange=inheritrange
        )
        self.ctrlspec = ctrlspec

    def set_to_damper(self, kv: float) -> None:
        """Makes it a damper: control is its coefficient."""
        self._become("damper", kv=kv)

    def set_to_cylinder(self, timeconst: float, bias: float, area: float, diameter: float = -1) -> None:
        """Makes it a pneumatic or hydraulic cylinder."""
        size = {"area": area} if diameter < 0 else {"diameter": diameter}
        self._become("cylinder", timeconst=timeconst, **size)
        self.biasprm[0] = bias

    def set_to_muscle(
        self,
        timeconst: Sequence[float] = (-1, -1),
        tausmooth: float = 0,
        range: Sequence[float] = (-1, -1),
        force: float = -1,
        scale: float = -1,
        lmin: float = -1,
        lmax: float = -1,
        vmax: float = -1,
        fpmax: float = -1,
        fvmax: float = -1,
    ) -> None:
        """Makes it a muscle."""
        curve = {"force": force, "scale": scale, "lmin": lmin, "lmax": lmax, "vmax": vmax, "fpmax": fpmax, "fvmax": fvmax}
        self._become("muscle", timeconst=tuple(timeconst), tausmooth=tausmooth, range=tuple(range), **curve)

    def set_to_adhesion(self, gain: float) -> None:
        """Makes it an adhesive contact."""
        self._become("adhesion", gain=gain)

    def set_to_dcmotor(
        self,
        motorconst: Sequence[float],
        resistance: float,
        nominal: Sequence[float] = (0, 0, 0),
        saturation: Sequence[float] = (0, 0, 0),
        inductance: Sequence[float] = (0, 0),
        cogging: Sequence[float] = (0, 0, 0),
        controller: Sequence[float] = (0, 0, 0, 0, 0, 0),
        thermal: Sequence[float] = (0, 0, 0, 0, 0, 0),
        lugre: Sequence[float] = (0, 0, 0, 0, 0),
        ctrlspec: int = 0,
    ) -> None:
        """Makes it a motor driven by a voltage."""
        self._become(
            "dcmotor",
            motorconst=tuple(motorconst),
            resistance=resistance,
            nominal=tuple(nominal),
            saturation=tuple(saturation),
            inductance=tuple(inductance),
            cogging=tuple(cogging),
            controller=tuple(controller),
            thermal=tuple(thermal),
            lugre=tuple(lugre),
        )
        self.ctrlspec = ctrlspec


class MjsSensor(Plugged, _Listed):
    """A sensor."""

    _kind = "sensor"

    def get_data_size(self) -> int:
        """How many numbers it measures, one more for each ray or contact that it is asked for."""
        word = self.type.name.removeprefix("mjSENS_")
        if word == "USER":
            return int(self.dim)
        if word in ("CONTACT", "RANGEFINDER"):
            sizes = _CONTACT if word == "CONTACT" else _RAY
            row = sum(size for bit, size in enumerate(sizes) if self.intprm[0] >> bit & 1)
            return row * int(self.intprm[2]) if word == "CONTACT" else row
        return next((size for size, words in _SIZES.items() if word in words), 1)


class MjsNumeric(_Listed):
    """A custom array of numbers."""

    _kind = "numeric"


class MjsText(_Listed):
    """A custom text."""

    _kind = "text"


class MjsTuple(_Listed):
    """A custom list of references."""

    _kind = "tuple"


class MjsKey(_Listed):
    """A keyframe."""

    _kind = "key"

    def __init__(self, owner: Any, values: dict[str, Any] | None = None) -> None:
        super().__init__(owner, values)
        # Its numbers stand at the elements they belong to, until the next model is compiled.
        self.__dict__["_kept"] = bool((values or {}).get("_kept"))

