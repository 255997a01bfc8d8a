"""Meshes of MuJoCo's binary format (MSH) as Wavefront OBJ: `python -m robohive.mujoco.msh2obj FOLDER_OR_FILE…`.

A file holds four 32-bit integers, the numbers of vertices, normals, texture coordinates and faces, then these: vectors of 32-bit
floating-point numbers, and three 32-bit integers for each face (MuJoCo documentation, XML reference, "mesh", attribute `file`).
"""

import argparse
import sys
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray


def _sections(content: bytes, name: str) -> list[NDArray[Any]]:
    """Vertices, normals, texture coordinates and faces, one in each row.

    Raises:
        ValueError: the file is shorter or longer than its numbers say.
    """
    counts = np.frombuffer(content[:16], "<i4").tolist() if len(content) >= 16 else [-1] * 4
    sizes = [4 * count * width for count, width in zip(counts, (3, 3, 2, 3), strict=True)]
    if min(counts) < 0 or len(content) != 16 + sum(sizes):
        raise ValueError(f"{name} is no MSH file: it has {len(content)} bytes, and its head announces {counts}")
    sections, start = [], 16
    for size, width, kind in zip(sizes, (3, 3, 2, 3), ("<f4", "<f4", "<f4", "<i4"), strict=True):
        sections.append(np.frombuffer(content[start : start + size], kind).reshape(-1, width))
        start += size
    return sections


def msh_to_obj(msh_file: Path) -> str:
    """The text of an OBJ file with the mesh of an MSH file.

    Raises:
        ValueError: it is no MSH file.
    """
    points, normals, coordinates, faces = _sections(Path(msh_file).read_bytes(), str(msh_file))
    lines = []
    for word, rows in (("v", points), ("vt", coordinates), ("vn", normals)):
        if word == "vt" and len(rows):
            # Images begin at the bottom in OBJ, at the top in MSH.
            rows = np.stack([rows[:, 0], 1 - rows[:, 1]], 1)
        lines += [" ".join((word, *(repr(float(x)) for x in row))) for row in rows]
    texture, normal = len(coordinates) == len(points), len(normals) == len(points)
    for face in faces + 1:
        corners = (f"{i}/{i if texture else ''}/{i}" if normal else f"{i}/{i}" if texture else f"{i}" for i in face)
        lines.append(" ".join(("f", *corners)))
    return "\n".join((*lines, ""))


def main() -> None:
    """Writes an OBJ file beside each MSH file."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("paths", nargs="+", type=Path, metavar="FOLDER_OR_FILE")
    for path in parser.parse_args().paths:
        for file in sorted(path.rglob("*.msh")) if path.is_dir() else [path]:
            to = file.with_suffix(".obj")
            if to.exists():
                sys.exit(f"{to} is there already; move it away")
            to.write_text(msh_to_obj(file), encoding="ascii")
            print(to)


if __name__ == "__main__":
    main()
