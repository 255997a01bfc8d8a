"""Default classes: what new elements start from."""

from typing import TYPE_CHECKING, Any

from robohive.mujoco.spec.bodies import MjsCamera, MjsGeom, MjsJoint, MjsLight, MjsSite
from robohive.mujoco.spec.element import MjsElement
from robohive.mujoco.spec.objects import MjsActuator, MjsEquality, MjsMaterial, MjsMesh, MjsPair, MjsTendon

if TYPE_CHECKING:
    from robohive.mujoco.spec.tree import MjSpec

#: Kinds of elements that have defaults.
KINDS: dict[str, type[MjsElement]] = {
    kind._kind: kind
    for kind in (
        MjsJoint,
        MjsGeom,
        MjsSite,
        MjsCamera,
        MjsLight,
        MjsMesh,
        MjsMaterial,
        MjsPair,
        MjsEquality,
        MjsTendon,
        MjsActuator,
    )
}


class MjsDefault:
    """A default class: one element of each kind that has defaults, as `default.geom`.

    Elements take its values when they are added; what is changed here later does not change them.
    """

    joint: MjsJoint
    geom: MjsGeom
    site: MjsSite
    camera: MjsCamera
    light: MjsLight
    mesh: MjsMesh
    material: MjsMaterial
    pair: MjsPair
    equality: MjsEquality
    tendon: MjsTendon
    actuator: MjsActuator

    def __init__(self, owner: "MjSpec", name: str, parent: "MjsDefault | None", values: dict[str, Any] | None = None) -> None:
        inner = self.__dict__
        inner.update(name=name, parent=parent, _owner=owner)
        for kind, element in KINDS.items():
            if parent is not None and values is None:
                inner[kind] = getattr(parent, kind)._duplicate(None, owner, self)
            else:
                made = inner[kind] = element(None, (values or {}).get(kind))
                made.__dict__.update(_origin=owner, _class=self)

    def __setattr__(self, name: str, value: Any) -> None:
        if name != "name":
            raise AttributeError(f"'mujoco.MjsDefault' attribute '{name}' cannot be set")
        self._owner._rename_class(self, value)

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any: ...
