"""Descriptions on their way into the engine and back."""

from typing import Any

from robohive.mujoco import _engine as _core
from robohive.mujoco.spec import authored, pixels
from robohive.mujoco.spec.bodies import MjsBody, MjsCamera, MjsFrame, MjsGeom, MjsJoint, MjsLight, MjsSite
from robohive.mujoco.spec.objects import (
    MjsActuator,
    MjsEquality,
    MjsExclude,
    MjsFlex,
    MjsHField,
    MjsKey,
    MjsMaterial,
    MjsMesh,
    MjsNumeric,
    MjsPair,
    MjsSensor,
    MjsSkin,
    MjsTendon,
    MjsText,
    MjsTexture,
    MjsTuple,
)
from robohive.mujoco.spec.plugins import MjsPlugin, own_instances

#: Elements of the tree, and those of lists, by kind.
POSED: dict[str, type[Any]] = {k._kind: k for k in (MjsJoint, MjsGeom, MjsSite, MjsCamera, MjsLight)}
LISTED: dict[str, type[Any]] = {
    k._kind: k
    for k in (
        MjsPlugin,
        MjsMesh,
        MjsSkin,
        MjsHField,
        MjsTexture,
        MjsMaterial,
        MjsPair,
        MjsExclude,
        MjsFlex,
        MjsEquality,
        MjsTendon,
        MjsActuator,
        MjsSensor,
        MjsNumeric,
        MjsText,
        MjsTuple,
        MjsKey,
    )
}
_NOWHERE = 2**32 - 1


def _place_of(row: Any) -> tuple[int, int] | None:
    return None if row[3] == _NOWHERE else (row[3], row[4])


def _connect(spec: Any) -> None:
    """Elements that use plugins share the attributes of their instances."""
    holders = [*spec._lists["mesh"], *spec._lists["actuator"], *spec._lists["sensor"]]
    holders += [*spec._world._below(), *spec._world._all("geom")]
    for element in holders:
        used = element.__dict__["_plugin"]
        if used is not None and used.name:
            used.__dict__["_instance"] = spec._names["plugin"].get(used.name)
    spec._lists["plugin"] += own_instances(holders)


def fill(spec: Any, rows: dict[str, list[Any]]) -> None:
    """Makes elements of what the engine read."""

    def made(kind: type[Any], row: Any) -> Any:
        element = kind(spec, row[0])
        element.__dict__["_loc"] = _place_of(row)
        spec._register(element)
        return element

    bodies = [made(MjsBody, row) for row in rows.get("body", ())]
    frames = [made(MjsFrame, row) for row in rows.get("frame", ())]

    def place(element: Any, row: Any) -> None:
        body = bodies[max(row[1], 0)]
        element.__dict__.update(_parent=body, _frame=frames[row[2]] if row[2] >= 0 else None)
        body._contents[element._kind].append(element)

    spec.__dict__["_world"] = bodies[0]
    spec._world.__dict__.update(name="world", _parent=bodies[0])
    spec._names["body"]["world"] = bodies[0]
    for body, row in zip(bodies[1:], rows["body"][1:], strict=True):
        place(body, row)
    for frame, row in zip(frames, rows.get("frame", ()), strict=True):
        place(frame, row)
    for kind, element in POSED.items():
        for row in rows.get(kind, ()):
            place(made(element, row), row)
    for kind, element in LISTED.items():
        spec._lists[kind].extend(made(element, row) for row in rows.get(kind, ()))
    spec._extensions.update((row[0]["name"], (spec, _place_of(row))) for row in rows.get("extension", ()))
    _connect(spec)
    kept = [key for key in spec._lists["key"] if key._kept]
    for kind, elements in (("body", bodies), ("actuator", spec._lists["actuator"]), ("joint", spec._world._all("joint"))):
        for element, row in zip(elements, rows.get(kind, ()), strict=True):
            element.__dict__["_shares"] = [(kept[key], part, values) for key, part, values in row[0]["_shares"]]


class Tree:
    """A description as the engine takes it: elements by kind, their origins, general settings, options."""

    def __init__(self, spec: Any, elements: bool = True) -> None:
        self._origins = [spec]
        self._kept = {id(key): i for i, key in enumerate(key for key in spec._lists["key"] if key._kept)}
        self.bodies = list(spec._world._below())
        self.rows: dict[str, list[Any]] = {}
        #: Files of textures whose pixels the program gave, by their names.
        self.pictures: dict[str, bytes] = {}
        #: The numbers of these textures.
        self.drawn: list[int] = []
        if elements:
            self._gather(spec)

    def _gather(self, spec: Any) -> None:
        numbers = {id(body): i for i, body in enumerate(self.bodies)}
        frames = self._frames()
        places = {id(frame): i for i, frame in enumerate(frames)}

        def row(element: Any) -> Any:
            parent = numbers.get(id(element._parent), -1) if element is not spec._world else -1
            frame = places.get(id(element._frame), -1)
            return self._values(element), parent, frame, self._origin(element._origin), element._loc

        self.rows = {"body": [row(body) for body in self.bodies], "frame": [row(frame) for frame in frames]}
        for kind in POSED:
            self.rows[kind] = [row(e) for body in self.bodies for e in body._contents[kind]]
        for kind in LISTED:
            self.rows[kind] = [row(element) for element in spec._lists[kind]]
        self.drawn = [number for number, texture in enumerate(spec._lists["texture"]) if texture.data]
        # One without a name is declared where it is used.
        self.rows["plugin"] = [row(plugin) for plugin in spec._lists["plugin"] if plugin.name]
        self.rows["extension"] = [
            ({"name": name}, -1, -1, self._origin(origin), place) for name, (origin, place) in spec._extensions.items()
        ]

    def _frames(self) -> list[Any]:
        """All frames, those around others first."""
        ordered: dict[int, Any] = {}

        def add(frame: Any) -> None:
            if id(frame) not in ordered:
                if frame._frame is not None:
                    add(frame._frame)
                ordered[id(frame)] = frame

        for body in self.bodies:
            for frame in body._contents["frame"]:
                add(frame)
        return list(ordered.values())

    def _origin(self, spec: Any) -> int:
        for number, other in enumerate(self._origins):
            if other is spec:
                return number
        self._origins.append(spec)
        return len(self._origins) - 1

    def _values(self, element: Any) -> dict[str, Any]:
        values: dict[str, Any] = element.__dict__
        shares = values["_shares"]
        if values.get("_plugin") is not None:
            values = {**values, "_plugin": element.plugin.row(element)}
        elif element._kind == "plugin":
            values = {**values, "_config": list(values["_config"].items())}
        if element._kind == "texture":
            values = {**values, "gridlayout": "".join(values["gridlayout"])}
            if element.data:
                values.update(pixels.settings(element))
                self.pictures[values["file"]] = pixels.file_of(element)
        elif element._kind == "tendon":
            steps = [(step._code, step._name, step._side, step._number) for step in values["_steps"]]
            values = {**values, "_steps": steps}
        if shares:
            known = [(self._kept[id(key)], part, given) for key, part, given in shares if id(key) in self._kept]
            values = {**values, "_shares": known}
        return values

    def parts(self) -> Any:
        """The tree for the engine."""
        spec = self._origins[0]
        origins = [(one._description, _settings(one)) for one in self._origins]
        general = {**spec._sizes, **spec.stat.__dict__, "modelname": spec.modelname}
        return self.rows, origins, general, _options(spec)


def _settings(spec: Any) -> dict[str, Any]:
    inner = spec.compiler.__dict__
    return {**inner, "eulerseq": "".join(inner["eulerseq"]).encode()}


def _options(spec: Any) -> dict[str, dict[str, list[float]]]:
    groups = {"opt": spec.option}
    groups.update((f"vis.{name.strip('_')}", group) for name, group in vars(spec.visual).items())
    return {group: {name: _flat(value) for name, value in own.__dict__["_own"].items()} for group, own in groups.items()}


def _flat(value: Any) -> list[float]:
    return [float(number) for number in value] if hasattr(value, "__len__") else [float(value)]


def take_options(spec: Any, options: dict[str, dict[str, list[float]]]) -> None:
    """Sets options and visual settings to those that the engine has."""
    for group, settings in options.items():
        head, _, part = group.partition(".")
        own = spec.option if head == "opt" else getattr(spec.visual, "global_" if part == "global" else part)
        for name, numbers in settings.items():
            if name in own._fields:
                setattr(own, name, numbers if len(numbers) != 1 or own._fields[name] is list else numbers[0])


def settled(to: Any, source: Any) -> list[str]:
    """Settles the settings in which a description differs from one that takes it; returns the differences."""
    given = [authored.shown(to.authored), authored.shown(source.authored)]
    options, sizes, differences = _core.Description.settle(Tree(to, False).parts(), Tree(source, False).parts(), given)
    take_options(to, options)
    to._sizes.update(sizes)
    return differences


def spread(spec: Any) -> None:
    """Gives the numbers of keyframes to the elements that they belong to."""
    tree = Tree(spec)
    shares = _core.Description.spread(tree.parts())
    joints = [joint for body in tree.bodies for joint in body._contents["joint"]]
    keys = spec._lists["key"]
    # The engine appends keyframes that it spreads to those that were spread before.
    ordered = [key for key in keys if key._kept] + [key for key in keys if not key._kept]
    while len(ordered) < spec._sizes["nkey"]:
        ordered.append(MjsKey(spec))
    spec._sizes["nkey"] = 0
    for elements, given in zip((tree.bodies, joints, spec._lists["actuator"]), shares, strict=True):
        for element, own in zip(elements, given, strict=True):
            element.__dict__["_shares"] = [(ordered[key], part, values) for key, part, values in own]
    for key in ordered:
        key.__dict__["_kept"] = True
    keys[:] = ordered


def duplicate(spec: Any) -> tuple[Any, dict[int, Any]]:
    """A copy of a description, and its elements by the identity of the original ones."""
    other = type(spec)()
    known: dict[int, Any] = {}
    classes: dict[int, Any] = {}
    other._copy_settings(spec, classes)

    def copied(element: Any) -> Any:
        # What came from another description keeps that one's settings.
        origin = other if element._origin is spec else element._origin
        twin = element._duplicate(other, origin, classes.get(id(element._class), element._class))
        known[id(element)] = twin
        other._register(twin)
        return twin

    bodies = list(spec._world._below())
    for body in bodies:
        copied(body)
    for body in bodies:
        for kind in MjsBody.HELD[1:]:
            for element in body._contents[kind]:
                copied(element)
    for body in bodies:
        for kind in MjsBody.HELD:
            for element in body._contents[kind]:
                twin, parent = known[id(element)], known[id(body)]
                twin.__dict__.update(_parent=parent, _frame=known.get(id(element._frame)))
                parent._contents[kind].append(twin)
    world = other.__dict__["_world"] = known[id(spec._world)]
    world.__dict__["_parent"] = world
    for kind, elements in spec._lists.items():
        other._lists[kind] = [copied(element) for element in elements]
    for twin in known.values():
        used = twin.__dict__.get("_plugin")
        if used is not None:
            used.__dict__["_instance"] = known.get(id(used._instance))
        shares = [(known[id(key)], part, list(values)) for key, part, values in twin._shares if id(key) in known]
        twin.__dict__["_shares"] = shares
    return other, known
