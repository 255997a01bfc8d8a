"""Bodies, frames, and what stands in them."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, ClassVar

from robohive.mujoco.enums.elements import mjtJoint, mjtObj
from robohive.mujoco.spec.element import MjsElement
from robohive.mujoco.spec.plugins import Plugged

if TYPE_CHECKING:
    from typing_extensions import Self

    from robohive.mujoco.spec.defaults import MjsDefault
    from robohive.mujoco.spec.objects import MjsFlex

_FOUND = "body.find_all supports the types: body, frame, geom, site, joint, light, camera."


class _InBody(MjsElement):
    """An element that stands in a body, and perhaps in a frame of it."""

    @property
    def parent(self) -> "MjsBody | None":
        """The body that it stands in; the world stands in itself."""
        body: MjsBody | None = self._parent
        return body

    @property
    def frame(self) -> "MjsFrame | None":
        """The innermost frame that it stands in."""
        frame: MjsFrame | None = self._frame
        return frame

    def set_frame(self, frame: "MjsFrame") -> None:
        """Puts it into a frame of its body.

        Raises:
            ValueError: the frame stands in another body, or in itself.
        """
        if frame.parent is not self.parent:
            raise ValueError("the frame stands in another body than the element")
        outer: MjsFrame | None = frame
        while outer is not None:
            if outer is self:
                raise ValueError("a frame cannot stand in itself")
            outer = outer.frame
        self.__dict__["_frame"] = frame


class MjsJoint(_InBody):
    """A joint of a body with its parent."""

    _kind = "joint"


class MjsGeom(Plugged, _InBody):
    """A shape fixed to a body."""

    _kind = "geom"
    _turns = {"alt": ""}


class MjsCamera(_InBody):
    """A camera."""

    _kind = "camera"
    _turns = {"alt": ""}


class MjsLight(_InBody):
    """A light."""

    _kind = "light"


class _Attaching(_InBody):
    """Where bodies can be attached."""

    def attach_body(self, body: "MjsBody", prefix: str | None = None, suffix: str | None = None) -> "MjsBody":
        """Attaches a body, of this or another description, with all that belongs to it; returns it.

        Names get the prefix and suffix. A body of another description moves, a body of this one is copied.
        """
        from robohive.mujoco.spec.attach import attach_body

        return attach_body(self, body, prefix or "", suffix or "")


class MjsSite(_Attaching):
    """A point with a frame and a shape, without mass or contact."""

    _kind = "site"
    _turns = {"alt": ""}


class _Holding(MjsElement):
    """Where elements are added."""

    def _place(self) -> "tuple[MjsBody, MjsFrame | None]":
        raise NotImplementedError

    def _add(self, kind: type[Any], default: "MjsDefault | None", arguments: dict[str, Any], frame: Any = None) -> Any:
        spec = self._home()
        spec._check_open()
        body, around = self._place()
        made = spec._made(kind, default)
        made.__dict__.update(_parent=body, _frame=frame or around)
        made._fill(arguments)
        body._contents[kind._kind].append(made)
        return made

    def add_body(self, default: "MjsDefault | None" = None, **attributes: Any) -> "MjsBody":
        """Adds a body."""
        body: MjsBody = self._add(MjsBody, default, attributes)
        return body

    def add_frame(self, default: "MjsFrame | None" = None, **attributes: Any) -> "MjsFrame":
        """Adds a frame, inside of the frame `default` when that is given."""
        frame: MjsFrame = self._add(MjsFrame, None, attributes, default)
        return frame

    def add_joint(self, default: "MjsDefault | None" = None, **attributes: Any) -> MjsJoint:
        """Adds a joint."""
        joint: MjsJoint = self._add(MjsJoint, default, attributes)
        return joint

    def add_freejoint(self, **attributes: Any) -> MjsJoint:
        """Adds a free joint; `align`, `group` and `name` can be given."""
        for name in attributes:
            if name not in ("align", "group", "name"):
                raise TypeError(f"Invalid {name} keyword argument. Valid options are: align, group, name.")
        spec = self._home()
        spec._check_open()
        body, frame = self._place()
        joint = MjsJoint(spec)
        joint.__dict__.update(_parent=body, _frame=frame, type=mjtJoint.mjJNT_FREE)
        if "align" in attributes:
            attributes["align"] = int(attributes["align"])
        joint._fill(attributes)
        body._contents["joint"].append(joint)
        return joint

    def add_geom(self, default: "MjsDefault | None" = None, **attributes: Any) -> MjsGeom:
        """Adds a geom."""
        geom: MjsGeom = self._add(MjsGeom, default, attributes)
        return geom

    def add_site(self, default: "MjsDefault | None" = None, **attributes: Any) -> MjsSite:
        """Adds a site."""
        site: MjsSite = self._add(MjsSite, default, attributes)
        return site

    def add_camera(self, default: "MjsDefault | None" = None, **attributes: Any) -> MjsCamera:
        """Adds a camera."""
        camera: MjsCamera = self._add(MjsCamera, default, attributes)
        return camera

    def add_light(self, default: "MjsDefault | None" = None, **attributes: Any) -> MjsLight:
        """Adds a light."""
        light: MjsLight = self._add(MjsLight, default, attributes)
        return light


class MjsFrame(_Holding, _Attaching):
    """A coordinate frame without inertia or degrees of freedom."""

    _kind = "frame"
    _turns = {"alt": ""}

    def _place(self) -> "tuple[MjsBody, MjsFrame | None]":
        return self._parent, self


class MjsBody(Plugged, _Holding, _InBody):
    """A body with what is fixed to it."""

    _kind = "body"
    _turns = {"alt": "", "ialt": "i"}
    #: What bodies hold, in the order of `find_all`.
    HELD: ClassVar[tuple[str, ...]] = ("body", "frame", "joint", "geom", "site", "camera", "light")

    def __init__(self, owner: Any, values: dict[str, Any] | None = None) -> None:
        super().__init__(owner, values)
        self.__dict__["_contents"] = {kind: [] for kind in self.HELD}

    def _place(self) -> "tuple[MjsBody, MjsFrame | None]":
        return self, None

    def _duplicate(self, owner: Any, origin: Any, default: Any) -> "Self":
        other = super()._duplicate(owner, origin, default)
        other.__dict__["_contents"] = {kind: [] for kind in self.HELD}
        return other

    def _below(self) -> "Iterator[MjsBody]":
        """This body and all below, in the order of ids."""
        pending = [self]
        while pending:
            body = pending.pop()
            yield body
            pending.extend(reversed(body._contents["body"]))

    def _all(self, kind: str) -> list[Any]:
        return [found for body in self._below() for found in body._contents[kind]]

    def find_all(self, objtype: mjtObj | str) -> list[Any]:
        """All elements of a type in this body and below it.

        Raises:
            ValueError: bodies do not hold elements of that type.
        """
        if isinstance(objtype, str):
            word = objtype
        else:
            word = mjtObj(objtype).name.removeprefix("mjOBJ_").lower()
        if word not in self.HELD:
            raise ValueError(_FOUND)
        return list(self._below())[1:] if word == "body" else self._all(word)

    def find_child(self, name: str) -> "MjsBody | None":
        """The body of a name below this one."""
        return next((body for body in self.find_all("body") if body.name == name), None)

    def attach_frame(self, frame: MjsFrame, prefix: str | None = None, suffix: str | None = None) -> MjsFrame:
        """Attaches a frame, of this or another description, with what stands in it; returns it."""
        from robohive.mujoco.spec.attach import attach_frame

        return attach_frame(self, frame, prefix or "", suffix or "")

    def to_frame(self) -> MjsFrame:
        """Replaces this body by a frame in its parent, which takes over what the body holds."""
        from robohive.mujoco.spec.attach import to_frame

        return to_frame(self)

    def make_flex(
        self,
        name: str,
        type: str | None = None,
        dim: int = 3,
        dof: str | None = None,
        count: "Sequence[int] | None" = None,
        cellcount: "Sequence[int] | None" = None,
        spacing: "Sequence[float] | None" = None,
        scale: "Sequence[float] | None" = None,
        radius: float = 0.0,
        mass: float = 1.0,
        inertiabox: float = 0.005,
        equality: int = 0,
        rigid: int = 0,
        flatskin: int = 0,
        elastic2d: int = 0,
        pos: "Sequence[float] | None" = None,
        quat: "Sequence[float] | None" = None,
        origin: "Sequence[float] | None" = None,
        file: str | None = None,
        vfs: None = None,
    ) -> "MjsFlex":
        """Adds a flex of a shape, and to this body the bodies, joints and constraints that it needs, as `flexcomp` does in a text.

        Lengths are metres, `mass` is that of all bodies made [kg]. `equality` is 0, or 1 for edges, 2 for vertices, 3 for
        strains; `elastic2d` is 0, or 1 for bending, 2 for stretching, 3 for both.

        Raises:
            ValueError: what is wrong with the arguments; a name is taken, or this body has none.
        """
        from robohive.mujoco.spec.deform import make_flex

        if vfs is not None:
            raise NotImplementedError("files in memory are given as spec.assets")
        grid = {"count": count, "cellcount": cellcount, "spacing": spacing, "scale": scale}
        grid |= {"pos": pos, "quat": quat, "origin": origin}
        positive = {key: number for key, number in (("mass", mass), ("inertiabox", inertiabox)) if number > 0}
        numbers: dict[str, Any] = {"radius": float(radius), **{key: float(number) for key, number in positive.items()}}
        numbers |= {"rigid": "true" if rigid else "false", "flatskin": "true" if flatskin else "false"}
        return make_flex(self, name, type, dim, dof, grid, numbers, (equality, elastic2d), file)


def _listing(kind: str, plural: str) -> None:
    def held(self: MjsBody) -> list[Any]:
        return list(self._contents[kind])

    def first(self: MjsBody) -> Any:
        return next(iter(self._contents[kind]), None)

    def following(self: MjsBody, child: Any) -> Any:
        found = self._contents[kind]
        place = next(i for i, other in enumerate(found) if other is child)
        return found[place + 1] if place + 1 < len(found) else None

    held.__doc__ = f"What stands in this body itself: {plural}."
    first.__doc__ = f"The first of the {plural} of this body."
    following.__doc__ = f"The next of the {plural} of this body."
    setattr(MjsBody, plural, property(held))
    setattr(MjsBody, f"first_{kind}", first)
    setattr(MjsBody, f"next_{kind}", following)


for _kind in MjsBody.HELD:
    _listing(_kind, "bodies" if _kind == "body" else f"{_kind}s")
