"""Which elements name which."""

from collections.abc import Callable
from typing import Any

from robohive.mujoco.enums.elements import mjtEq, mjtObj, mjtTrn

#: What a reference becomes: given the kind of what is named, and its name.
Rewrite = Callable[[str, str], str]

_FIXED = {
    "geom": {"material": "material", "hfieldname": "hfield", "meshname": "mesh"},
    "site": {"material": "material"},
    "camera": {"targetbody": "body"},
    "light": {"targetbody": "body", "texture": "texture"},
    "mesh": {"material": "material"},
    "tendon": {"material": "material"},
    "flex": {"material": "material"},
    "skin": {"material": "material"},
    "pair": {"geomname1": "geom", "geomname2": "geom"},
    "exclude": {"bodyname1": "body", "bodyname2": "body"},
    "actuator": {"refsite": "site", "slidersite": "site"},
}
#: Attributes whose kind another attribute says.
_TYPED = {
    "equality": {"name1": "objtype", "name2": "objtype"},
    "sensor": {"objname": "objtype", "refname": "reftype"},
}
#: Equalities whose type says what they couple.
_COUPLED = {mjtEq.mjEQ_JOINT: "joint", mjtEq.mjEQ_TENDON: "tendon"}
_WRAPPED = {1: "joint", 3: "site", 4: "geom"}
_DRIVEN = {
    mjtTrn.mjTRN_JOINT: "joint",
    mjtTrn.mjTRN_JOINTINPARENT: "joint",
    mjtTrn.mjTRN_TENDON: "tendon",
    mjtTrn.mjTRN_BODY: "body",
}
#: Looks and plugins, without which an element is what it was.
LOOKS = ("material", "texture", "plugin")
#: Lists of names of bodies.
_BODIES = {"flex": ("vertbody", "nodebody"), "skin": ("bodyname",)}


def _kind_of(objtype: int) -> str:
    word = mjtObj(int(objtype)).name.removeprefix("mjOBJ_").lower()
    return {"xbody": "body"}.get(word, word)


def rewrite(element: Any, change: Rewrite) -> None:
    """Calls `change` for every name that an element refers to, and takes what it returns."""
    inner, kind = element.__dict__, element._kind
    named = dict(_FIXED.get(kind, {}))
    named.update({name: _kind_of(inner[typed]) for name, typed in _TYPED.get(kind, {}).items()})
    if kind == "equality" and inner["type"] in _COUPLED:
        named = dict.fromkeys(named, _COUPLED[inner["type"]])
    if kind == "actuator":
        named["target"] = _DRIVEN.get(inner["trntype"], "site")
    for name, of in named.items():
        if inner[name]:
            inner[name] = change(of, inner[name])
    for name in _BODIES.get(kind, ()):
        names = inner[name]
        names[:] = [change("body", body) for body in names]
    used = inner.get("_plugin")
    if used is not None and used.name:
        used.name = change("plugin", used.name)
    if kind == "material":
        textures = inner["textures"]
        textures[:] = [text and change("texture", text) for text in textures]
    if kind == "tuple":
        inner["objname"][:] = [change(_kind_of(t), text) for t, text in zip(inner["objtype"], inner["objname"], strict=True)]
    for step in inner.get("_steps", ()):
        if step._code in _WRAPPED:
            step._name = change(_WRAPPED[step._code], step._name)
        if step._side:
            step._side = change("site", step._side)


def references(element: Any) -> list[tuple[str, str]]:
    """Kind and name of everything that an element refers to, looks and plugins left out."""
    found: list[tuple[str, str]] = []

    def note(kind: str, name: str) -> str:
        found.append((kind, name))
        return name

    rewrite(element, note)
    return [(kind, name) for kind, name in found if kind not in LOOKS]
