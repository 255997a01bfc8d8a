"""Models, simulations and scenes as text: every number by the name of its array, a line for each row."""

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from robohive.mujoco.pictures.scene import MjvScene
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.model import MjModel

#: How numbers are written where nothing is said.
_FORMAT = "% -9.2g"


def _formatter(float_format: str) -> Callable[[Any], str]:
    """Writes one number.

    Raises:
        ValueError: the format is none of a single number in the style of printf.
    """
    try:
        float_format % 1.0
    except (TypeError, ValueError) as error:
        raise ValueError(f"{float_format!r} is no format of one number, such as '%.3f': {error}") from None
    return lambda x: float_format % x if isinstance(x, float | np.floating) else str(x)


def _block(name: str, value: Any, number: Callable[[Any], str]) -> Iterable[str]:
    if not isinstance(value, np.ndarray) or value.ndim == 0:
        yield f"{name:24} {number(value)}"
    elif value.size:
        yield name
        for row in value.reshape(len(value), -1).tolist():
            yield "  " + " ".join(map(number, row))
        yield ""


def _numbers(owner: Any) -> Iterable[tuple[str, Any]]:
    """Counts first, then arrays, by name."""
    named = [(name, getattr(owner, name)) for name in sorted(dir(owner)) if not name.startswith("_")]
    plain = [(name, value) for name, value in named if isinstance(value, int | float | np.number) and not isinstance(value, bool)]
    return [*plain, *((name, value) for name, value in named if isinstance(value, np.ndarray))]


def _write(filename: str, blocks: Iterable[tuple[str, Any]], float_format: str) -> None:
    number = _formatter(float_format)
    with open(filename, "w", encoding="utf-8") as out:
        out.writelines(f"{line}\n" for name, value in blocks for line in _block(name, value, number))


def mj_printFormattedModel(m: MjModel, filename: str, float_format: str) -> None:
    """Writes a model to a text file, each number in a format of printf's style.

    Raises:
        OSError: the file cannot be written.
        ValueError: `float_format` is no such format.
    """
    groups = (("opt", m.opt), ("stat", m.stat), *((f"vis.{name}", getattr(m.vis, name)) for name in ("global_", "quality", "map", "scale")))
    settings = ((f"{group}.{name}", value) for group, owner in groups for name, value in _numbers(owner))
    _write(filename, [*settings, *_numbers(m)], float_format)


def mj_printModel(m: MjModel, filename: str) -> None:
    """Writes a model to a text file."""
    mj_printFormattedModel(m, filename, _FORMAT)


def mj_printFormattedData(m: MjModel, d: MjData, filename: str, float_format: str) -> None:
    """Writes a simulation to a text file, each number in a format of printf's style.

    Raises:
        OSError: the file cannot be written.
        ValueError: `float_format` is no such format.
    """
    contacts = ((f"contact.{name}", getattr(d.contact, name)) for name in ("dist", "pos", "frame", "geom", "dim"))
    _write(filename, [*_numbers(d), *contacts], float_format)


def mj_printData(m: MjModel, d: MjData, filename: str) -> None:
    """Writes a simulation to a text file."""
    mj_printFormattedData(m, d, filename, _FORMAT)


def mj_printFormattedScene(s: MjvScene, filename: str, float_format: str) -> None:
    """Writes the geoms and cameras of a scene to a text file, each number in a format of printf's style.

    Raises:
        OSError: the file cannot be written.
        ValueError: `float_format` is no such format.
    """
    blocks: list[tuple[str, Any]] = [("ngeom", s.ngeom), ("flags", np.asarray(s.flags))]
    kinds = (("camera", s.camera), ("geom", [s.geoms[i] for i in range(s.ngeom)]))
    for kind, items in kinds:
        for i, item in enumerate(items):
            blocks += [(f"{kind}[{i}].{name}", value) for name, value in _numbers(item)]
    _write(filename, blocks, float_format)


def mj_printScene(s: MjvScene, filename: str) -> None:
    """Writes the geoms and cameras of a scene to a text file."""
    mj_printFormattedScene(s, filename, _FORMAT)
