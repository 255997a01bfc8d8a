"""Deformable bodies made with the bodies that move them: what `flexcomp` is in a text."""

import os
from collections.abc import Sequence
from typing import Any
from xml.sax.saxutils import quoteattr

from robohive.mujoco import _engine as _core
from robohive.mujoco.spec.bodies import MjsBody
from robohive.mujoco.spec.objects import MjsFlex

#: What equality constraints hold, and which deformations of a surface are elastic, by their codes.
_EQUALITIES = ("false", "true", "vert", "strain")
_ELASTIC = ("none", "bend", "stretch", "both")


def _attribute(name: str, value: Any) -> str:
    texts = value if isinstance(value, str) else " ".join(map(repr, value)) if isinstance(value, Sequence) else repr(value)
    return f" {name}={quoteattr(texts)}"


def _word(name: str, words: tuple[str, ...], code: int) -> str:
    if not 0 <= code < len(words):
        raise ValueError(f"{name} is one of {', '.join(f'{i} ({word})' for i, word in enumerate(words))}, not {code}")
    return words[code]


def _triple(name: str, values: Sequence[Any] | None, kind: type[Any], length: int = 3) -> tuple[Any, ...] | None:
    if values is None:
        return None
    if len(values) != length:
        raise ValueError(f"{name} must have {length} elements")
    return tuple(kind(value) for value in values)


def _text(body: MjsBody, attributes: dict[str, Any], equality: int, elastic2d: int) -> str:
    given = "".join(_attribute(name, value) for name, value in attributes.items() if value is not None)
    edge = f"<edge equality='{_word('equality', _EQUALITIES, equality)}'/>"
    elastic = f"<elasticity elastic2d='{_word('elastic2d', _ELASTIC, elastic2d)}'/>"
    made = f"<flexcomp{given}>{edge}{elastic}</flexcomp>"
    if body is not body._owner._world:
        made = f"<body name={quoteattr(body.name)}>{made}</body>"
    return f"<mujoco><worldbody>{made}</worldbody></mujoco>"


def make_flex(
    body: MjsBody,
    name: str,
    type: str | None,
    dim: int,
    dof: str | None,
    grid: dict[str, Sequence[Any] | None],
    numbers: dict[str, Any],
    codes: tuple[int, int],
    file: str | None,
) -> MjsFlex:
    """Adds a flex to the description of a body, and to the body what moves the flex.

    Raises:
        ValueError: what is wrong with the arguments; a name is taken, or the body has none.
    """
    spec = body._home()
    spec._check_open()
    attributes: dict[str, Any] = {"name": name, "type": type, "dim": int(dim), "dof": dof, **numbers}
    for key, values in grid.items():
        kind = int if key.endswith("count") else float
        attributes[key] = _triple(key, values, kind, 4 if key == "quat" else 3)
    if file is not None:
        beside = os.path.join(spec.modelfiledir, spec.meshdir, file)
        attributes["file"] = file if file in spec.assets or not os.path.exists(beside) else os.path.abspath(beside)
    text = _text(body, attributes, *codes)
    assets = {key: content.encode() if isinstance(content, str) else bytes(content) for key, content in spec.assets.items()}
    description, _ = _core.Description.of_text(text, assets)
    made = spec.__class__.__new__(spec.__class__)
    made._begin(description)
    _move(made, made._world if body is spec._world else made.body(body.name), body)
    flex: MjsFlex = spec._lists["flex"][-1]
    return flex


def _move(made: Any, holder: MjsBody, body: MjsBody) -> None:
    """Moves what a body holds, and flexes and constraints, into the description of another body."""
    spec = body._owner
    below = [one for one in holder._below() if one is not holder]
    inner = [element for one in below for kind in MjsBody.HELD[1:] for element in one._contents[kind]]
    listed = [*made._lists["flex"], *made._lists["equality"]]
    moved = [*below, *inner, *listed]
    for element in moved:
        if element.name and element.name in spec._names[element._kind]:
            raise ValueError(f"Error: repeated name '{element.name}' in {element._kind}")
    for element in moved:
        element.__dict__.update(_owner=spec, _origin=spec, _loc=None)
        spec._register(element)
    for child in holder._contents["body"]:
        child.__dict__["_parent"] = body
        body._contents["body"].append(child)
    for element in listed:
        spec._lists[element._kind].append(element)
