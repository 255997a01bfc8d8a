"""Names and ids, names of types, versions, files of models."""

import html
from typing import Any

import numpy as np

from robohive.mujoco import _engine as _core
from robohive.mujoco._constants import mjVERSION_HEADER
from robohive.mujoco.enums.elements import mjtObj
from robohive.mujoco.last import last_loaded
from robohive.mujoco.structs.model import MjModel


def mj_name2id(m: MjModel, type: int, name: str | bytes) -> int:
    """Id of the element of a type (`mjtObj`) called `name`, -1 for none."""
    return m._id(int(type), name.decode() if isinstance(name, bytes) else name)


def mj_id2name(m: MjModel, type: int, id: int) -> str | None:
    """Name of an element, None when it has none or does not exist."""
    return m._name(int(type), id) or None


def mju_type2Str(type: int) -> str | None:
    """The word of MJCF for a type of object."""
    try:
        kind = mjtObj(int(type))
    except ValueError:
        return None
    return kind.name.removeprefix("mjOBJ_").lower() if kind.name.startswith("mjOBJ_") and kind else None


def mju_str2Type(str: str | bytes) -> int:
    """The type of object for a word of MJCF, 0 for none."""
    word = str.decode() if isinstance(str, bytes) else str
    return int(getattr(mjtObj, f"mjOBJ_{word.upper()}", 0))


def mj_version() -> int:
    """The version of MuJoCo that is followed, as one number."""
    return mjVERSION_HEADER


def mj_versionString() -> str:
    """mj_versionString() -> str

Return the current version of MuJoCo as a null-terminated string.
"""
    return f"{mjVERSION_HEADER // 1_000_000}.{mjVERSION_HEADER // 1000 % 1000}.{mjVERSION_HEADER % 1000}"


def mj_isSparse(m: MjModel) -> int:
    """1 where constraint matrices are sparse."""
    return int(m.opt.jacobian == 1 or (m.opt.jacobian == 2 and m.nv >= 60))


def mj_isPyramidal(m: MjModel) -> int:
    """1 with pyramidal friction cones."""
    return int(m.opt.cone == 0)


def mj_isDual(m: MjModel) -> int:
    """1 where the solver works with forces."""
    return int(m.opt.solver == 0 or m.opt.noslip_iterations > 0)


def mj_sizeModel(m: MjModel) -> int:
    """Bytes that `mj_saveModel` writes."""
    return len(m._to_bytes())


def mj_saveModel(m: MjModel, filename: str | None = None, buffer: Any = None) -> None:
    """Writes a compiled model, in the format of `robohive compile`, into a file or a buffer of bytes.

    Raises:
        ValueError: the buffer is too small.
    """
    content = m._to_bytes()
    if buffer is not None:
        if buffer.size < len(content):
            raise ValueError(f"the buffer has {buffer.size} bytes, the model {len(content)}")
        buffer.ravel()[: len(content)] = np.frombuffer(content, np.uint8)
    elif filename is not None:
        with open(filename, "wb") as file:
            file.write(content)


def mju_getXMLDependencies(filename: str) -> list[str]:
    """Paths of all files that the model of a file is made of, that file first.

    Raises:
        ValueError: the model is wrong; the message says where.
    """
    return _core.dependencies(filename)


def mj_printSchema(flg_html: bool, flg_pad: bool) -> str:
    """The format that the engine reads: every element and attribute with its meaning, as text or HTML; with `flg_pad`
    HTML keeps the indentation."""
    text = _core.schema()
    if not flg_html:
        return text
    lines = [html.escape(line) for line in text.splitlines()]
    if flg_pad:
        lines = ["&nbsp;" * (len(line) - len(line.lstrip())) + line.lstrip() for line in lines]
    return "<br>\n".join(lines)


def mj_saveLastXML(filename: str, m: MjModel) -> None:
    """Writes the description that was loaded last as MJCF, with the numbers of `m`, a model of the same elements. Warns of arrays that
    were written and that no description holds.

    Raises:
        FatalError: none was loaded, or `m` is a model of other elements.
    """
    from robohive.mujoco.spec.taken_back import take_back
    from robohive.mujoco.spec.tree import MjSpec

    last = last_loaded()
    if last is None:
        raise _core.FatalError("mj_saveLastXML: no XML was loaded")
    spec = MjSpec.from_string(last.source, assets=last.files) if last.is_text else MjSpec.from_file(last.source, assets=last.files)
    take_back(spec, m)
    spec.to_file(filename)
