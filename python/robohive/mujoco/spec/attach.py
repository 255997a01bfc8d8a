"""Elements that come into a description from another one, or leave it."""

import warnings
from typing import Any

from robohive.mujoco.spec import exchange
from robohive.mujoco.spec.bodies import MjsBody, MjsFrame, MjsSite
from robohive.mujoco.spec.plugins import used_instances
from robohive.mujoco.spec.references import references, rewrite

#: Lists that come with everything attached, and those whose elements come when they refer to it.
_ASSETS = ("mesh", "hfield", "texture", "material", "numeric", "text")
_OBJECTS = ("skin", "flex", "pair", "exclude", "tendon", "equality", "actuator", "sensor", "tuple")
#: Objects of which one reference has to lead to what is attached.
_MIXED = ("pair", "exclude", "tendon", "sensor")


class _Arrival:
    """What is attached: elements of one description on their way into another, under new names."""

    def __init__(self, to: Any, source: Any, prefix: str, suffix: str) -> None:
        self.to, self.source, self.prefix, self.suffix = to, source, prefix, suffix
        #: Kinds and old names of all that comes.
        self.names: set[tuple[str, str]] = set()

    def renamed(self, name: str) -> str:
        return f"{self.prefix}{name}{self.suffix}" if name else name

    def called(self, element: Any) -> str:
        """The new name of an element. Skins keep theirs, as in MuJoCo: nothing refers to them."""
        name = _called(element)
        return name if element._kind == "skin" else self.renamed(name)

    def announce(self, elements: list[Any]) -> None:
        """Notes elements that come.

        Raises:
            ValueError: a name is taken.
        """
        for element in elements:
            name = _called(element)
            taken = self.called(element)
            if taken and taken in self.to._names[element._kind]:
                raise ValueError(f"Error: repeated name '{taken}' in {element._kind}; attach with another prefix")
            self.names.add((element._kind, name))

    def objects(self) -> list[Any]:
        """The objects that refer to what comes, and to nothing that is in neither description."""
        found = []
        for kind in _OBJECTS:
            for element in self.source._lists[kind]:
                if element._owner is self.source and self._follows(element):
                    found.append(element)
                    self.names.add((kind, element.name))
        return found

    def _follows(self, element: Any) -> bool:
        named = references(element)
        known = [one in self.names for one in named]
        elsewhere = element._kind in _MIXED and any(known)
        return all(k or (elsewhere and one[1] in self.to._names.get(one[0], ())) for k, one in zip(known, named, strict=True))

    def take(self, elements: list[Any]) -> None:
        """Makes elements part of the description."""
        for element in elements:
            old = _called(element)
            self.source._names[element._kind].pop(old, None)
            name = element.__dict__["name"] = self.called(element)
            element.__dict__["_owner"] = self.to
            if name:
                self.to._names[element._kind][name] = element
                self.source._names[element._kind][name] = element

    def redirect(self, elements: list[Any]) -> None:
        """Lets references lead to the new names."""

        def change(kind: str, name: str) -> str:
            return self.renamed(name) if (kind, name) in self.names else name

        for element in elements:
            rewrite(element, change)


def _called(element: Any) -> str:
    """The name that references to an element use: of assets without one, that of their file."""
    if element.name or element._kind not in ("mesh", "hfield", "texture"):
        return str(element.name)
    name = element.file.replace("\\", "/").rpartition("/")[2]
    return str(name.rpartition(".")[0] or name)


def _moved(to: Any, source: Any, bodies: list[MjsBody], loose: list[Any], affixes: tuple[str, str]) -> None:
    """Moves bodies with all in them, and elements and frames of the top, with all that belongs to them."""
    arrival = _Arrival(to, source, *affixes)
    below = [inner for body in bodies for inner in body._below()]
    held = [element for body in below for kind in MjsBody.HELD[1:] for element in body._contents[kind]]
    inside = [*below, *held, *loose]
    assets = [e for kind in (*_ASSETS, "key") for e in source._lists[kind] if e._owner is source]
    arrival.announce(inside + assets)
    objects = arrival.objects()
    plugins = used_instances(source, inside + assets + objects)
    arrival.announce(objects + plugins)
    _settle(to, source)
    _spread(to)
    _spread(source)
    for elements in (inside, assets + plugins, objects):
        arrival.take(elements)
        arrival.redirect(elements)
    for element in assets + plugins + objects:
        to._lists[element._kind].append(element)
    for name, origin in source._extensions.items():
        to._extensions.setdefault(name, origin)
    for name, default in source._classes.items():
        to._classes.setdefault(arrival.renamed(name), default)


def _settle(to: Any, source: Any) -> None:
    settled = exchange.settled(to, source)
    for difference in settled:
        warnings.warn(difference, stacklevel=6)


def _spread(spec: Any) -> None:
    """Gives the numbers of keyframes to the elements that they belong to."""
    if not any(not key._kept for key in spec._lists["key"]):
        return
    exchange.spread(spec)


def _source_of(to: Any, element: Any) -> tuple[Any, Any]:
    """The description that an element is taken from, and the element there: a copy where it must not move."""
    source = element._home()
    if source is not to and not to._copies:
        return source, element
    duplicate, known = exchange.duplicate(source)
    return duplicate, known[id(element)]


def _place(onto: Any) -> tuple[MjsBody, MjsFrame | None]:
    """The body and the frame that something attached to a frame or a site stands in."""
    if isinstance(onto, MjsSite):
        body: MjsBody = onto._parent
        frame = body.add_frame(onto.frame, pos=onto.pos, quat=onto.quat)
        frame.__dict__["alt"] = onto.alt.copied()
        return body, frame
    return onto._parent, onto


def attach_spec(onto: Any, child: Any, prefix: str, suffix: str) -> MjsFrame:
    """Attaches all of a description to a frame or a site; returns the frame that it stands in."""
    to = onto._home()
    if child is to:
        child = child.copy()
    elif child.parent is not None:
        raise ValueError("the description is attached already; attach a copy of it")
    elif to._copies:
        child = child.copy()
    world = child._world
    files = child._lists["mesh"] + child._lists["hfield"] + child._lists["texture"] if child.assets else []
    top = [e for kind in MjsBody.HELD if kind != "body" for e in world._contents[kind]]
    _moved(to, child, list(world._contents["body"]), top, (prefix, suffix))
    for element in files:
        element.file = element.file and affixed(element.file, prefix, suffix)
    body, frame = _place(onto)
    around = body.add_frame(frame)
    for kind in MjsBody.HELD:
        for element in world._contents[kind]:
            inner = element.__dict__
            inner["_parent"] = body
            inner["_frame"] = element._frame or around
            body._contents[kind].append(element)
    child._parent_spec(to)
    return around


def attach_body(onto: Any, body: MjsBody, prefix: str, suffix: str) -> MjsBody:
    """Attaches a body to a frame or a site; returns it."""
    to, home = onto._home(), body._home()
    own = home is to
    if body._parent is None or body is home._world:
        raise ValueError("the world cannot be attached; attach its description")
    taken: MjsBody
    source, taken = _source_of(to, body)
    if own:
        _without_assets(source)
    _moved(to, source, [taken], [], (prefix, suffix))
    into, frame = _place(onto)
    taken.__dict__.update(_parent=into, _frame=frame)
    into._contents["body"].append(taken)
    if not own:
        for name, content in source.assets.items():
            to.assets.setdefault(name, content)
    return taken


def attach_frame(onto: MjsBody, frame: MjsFrame, prefix: str, suffix: str) -> MjsFrame:
    """Attaches a frame with what stands in it to a body; returns it."""
    to = onto._home()
    own = frame._home() is to
    taken: MjsFrame
    source, taken = _source_of(to, frame)
    if own:
        _without_assets(source)
    body: MjsBody = taken._parent
    held = _within(body, taken)
    bodies = [element for element in held if isinstance(element, MjsBody)]
    loose = [element for element in held if not isinstance(element, MjsBody)]
    _moved(to, source, bodies, [*loose, taken], (prefix, suffix))
    taken.__dict__["_frame"] = None
    for element in [taken, *held]:
        element.__dict__["_parent"] = onto
        onto._contents[element._kind].append(element)
    return taken


def _without_assets(source: Any) -> None:
    """A copy of a part of its own description shows the same assets."""
    for kind in (*_ASSETS, "plugin", "key"):
        source._lists[kind].clear()
        source._names[kind].clear()


def _within(body: MjsBody, frame: MjsFrame) -> list[Any]:
    """What of a body stands in a frame, at any depth."""

    def inside(element: Any) -> bool:
        around = element._frame
        while around is not None and around is not frame:
            around = around._frame
        return around is frame

    return [e for kind in MjsBody.HELD for e in body._contents[kind] if inside(e)]


def to_frame(body: MjsBody) -> MjsFrame:
    """Replaces a body by a frame."""
    parent, spec = body._parent, body._home()
    if parent is None or body is spec._world:
        raise ValueError("the world cannot become a frame")
    frame: MjsFrame = parent.add_frame(body._frame, pos=body.pos, quat=body.quat)
    frame.__dict__["alt"] = body.alt.copied()
    parent._contents["body"].remove(body)
    for kind in MjsBody.HELD:
        for element in body._contents[kind]:
            element.__dict__.update(_parent=parent, _frame=element._frame or frame)
            parent._contents[kind].append(element)
    if body.name:
        spec._names["body"].pop(body.name, None)
    body.__dict__["_owner"] = None
    return frame


def remove(spec: Any, element: Any) -> None:
    """Takes an element out of its description; with a body goes what is in it and what refers to that."""
    if isinstance(element, (MjsBody, MjsFrame)):
        _remove_tree(spec, element)
        return
    holder = element._parent._contents if element._parent is not None else spec._lists
    holder[element._kind].remove(element)
    _forget(spec, [element])


def _remove_tree(spec: Any, element: Any) -> None:
    if element is spec._world:
        raise ValueError("the world cannot be deleted")
    _spread(spec)
    body: MjsBody = element._parent
    top = [element, *_within(body, element)] if isinstance(element, MjsFrame) else [element]
    gone: list[Any] = []
    for one in top:
        body._contents[one._kind].remove(one)
        gone.append(one)
        if isinstance(one, MjsBody):
            gone += [b for b in one._below() if b is not one]
            gone += [e for b in one._below() for kind in MjsBody.HELD if kind != "body" for e in b._contents[kind]]
    lost = _forget(spec, gone)
    for kind in _OBJECTS:
        keep = []
        for other in spec._lists[kind]:
            named = references(other)
            if any(one in lost for one in named):
                lost |= _forget(spec, [other])
            else:
                keep.append(other)
        spec._lists[kind][:] = keep


def _forget(spec: Any, elements: list[Any]) -> set[tuple[str, str]]:
    names = set()
    for element in elements:
        if element.name:
            names.add((element._kind, element.name))
            spec._names[element._kind].pop(element.name, None)
        element.__dict__["_owner"] = None
    return names


def affixed(path: str, prefix: str, suffix: str) -> str:
    """A path whose file's name has a prefix, and a suffix before its extension."""
    cut = max(path.rfind("/"), path.rfind("\\")) + 1
    name = prefix + path[cut:]
    dot = name.rfind(".")
    return path[:cut] + (name[:dot] + suffix + name[dot:] if dot >= 0 else name + suffix)
