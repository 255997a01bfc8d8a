"""Pixels that a program gives to a texture, on their way into the engine: a picture file in memory."""

import struct
import zlib
from typing import Any

import numpy as np

from robohive.mujoco.enums.view import mjtTexture

#: Kinds of pixels of the PNG format, by their number of channels.
_COLOURS = {1: 0, 3: 2, 4: 6}


def as_png(width: int, height: int, channels: int, pixels: bytes) -> bytes:
    """Pixels, row after row, as a PNG file (W3C, Portable Network Graphics, second edition)."""

    def chunk(kind: bytes, content: bytes) -> bytes:
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    head = struct.pack(">IIBBBBB", width, height, 8, _COLOURS[channels], 0, 0, 0)
    length = width * channels
    rows = b"".join(b"\0" + pixels[at : at + length] for at in range(0, height * length, length))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows, 1)) + chunk(b"IEND", b"")


def settings(texture: Any) -> dict[str, Any]:
    """The name of the file of a texture's pixels, and how its faces lie in it: below each other, or one for all."""
    name = f"pixels of texture {texture.name or id(texture)}.png".replace("/", "_").replace("\\", "_")
    if texture.type == mjtTexture.mjTEXTURE_2D or texture.height != 6 * texture.width:
        return {"file": name}
    return {"file": name, "gridsize": np.array([6, 1], np.int32), "gridlayout": "RLUDFB......"}


def file_of(texture: Any) -> bytes:
    """The file of a texture's pixels.

    Raises:
        ValueError: their number is not that of the texture's size.
    """
    width, height, channels = texture.width, texture.height, texture.nchannel
    wanted, given = width * height * channels, len(texture._pixels)
    if channels not in _COLOURS or given != wanted or not given:
        raise ValueError(
            f"Error: texture '{texture.name}': {given} bytes of data for {width} x {height} pixels of {channels} channels (1, 3 or 4)"
        )
    return as_png(width, height, channels, texture._pixels)
