"""MuJoCo's classic way to a picture: `mjr_render` draws a scene, `mjr_readPixels` copies what it drew.

No display, driver or GPU is asked; an OpenGL context, where a program makes one, is an empty shell.
"""

import weakref
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robohive.mujoco.enums.view import mjtDepthMap, mjtFramebuffer, mjtRndFlag
from robohive.mujoco.pictures.scene import MjvScene
from robohive.mujoco.pictures.view import _Struct
from robohive.mujoco.structs.model import MjModel


class GLContext:
    """What programs make current before they draw. Nothing here needs it."""

    def __init__(self, max_width: int, max_height: int) -> None:
        self.max_width, self.max_height = max_width, max_height

    def make_current(self) -> None:
        """Of no effect."""

    def free(self) -> None:
        """Of no effect."""


class MjrRect(_Struct):
    """A rectangle of pixels, from the lower left corner."""

    def __init__(self, left: int, bottom: int, width: int, height: int) -> None:
        self.left, self.bottom, self.width, self.height = int(left), int(bottom), int(width), int(height)


class MjrContext:
    """The picture that was drawn last, of the model's offscreen size."""

    def __init__(self, model: MjModel | None = None, fontscale: int = 150) -> None:
        self.offWidth: int = 0 if model is None else model.vis.global_.offwidth
        self.offHeight: int = 0 if model is None else model.vis.global_.offheight
        self.fontScale = int(fontscale)
        self.currentBuffer: int = mjtFramebuffer.mjFB_OFFSCREEN
        self.readDepthMap: int = mjtDepthMap.mjDEPTH_ZERONEAR
        self.windowAvailable = 0
        self._clear()
        _draw_into(self)

    def _clear(self) -> None:
        size = (self.offHeight, self.offWidth)
        self._rgb = np.zeros((*size, 3), np.uint8)
        #: 0 at the near plane, 1 at the far one.
        self._depth = np.ones(size, np.float32)

    def free(self) -> None:
        """Frees the memory."""
        self.offWidth = self.offHeight = 0
        self._clear()

    def _within(self, viewport: MjrRect) -> tuple[slice, slice]:
        """Rows and columns of a viewport, rows from below."""
        rows = slice(max(viewport.bottom, 0), min(viewport.bottom + viewport.height, self.offHeight))
        return rows, slice(max(viewport.left, 0), min(viewport.left + viewport.width, self.offWidth))


#: The context that functions without one draw into.
_present: list["weakref.ref[MjrContext]"] = []


def _draw_into(con: MjrContext) -> None:
    _present[:] = [weakref.ref(con)]


class MjrRendererInfo(_Struct):
    """Who draws."""

    def __init__(self) -> None:
        self.renderer, self.backend = "classic", ""


def mjr_getRendererInfo(info: MjrRendererInfo) -> None:
    """Who draws: by MuJoCo's names the classic renderer, and no graphics library."""
    info.__init__()  # type: ignore[misc]


def mjr_rectangle(viewport: MjrRect, r: float, g: float, b: float, a: float) -> None:
    """Fills a rectangle of the present context, over what is there where `a` is less than 1.

    Raises:
        RuntimeError: there is no context.
    """
    con = _present[0]() if _present else None
    if con is None:
        raise RuntimeError("there is no MjrContext to draw into")
    rows, columns = con._within(viewport)
    over, cover = 255.0 * np.clip([r, g, b], 0.0, 1.0), min(max(a, 0.0), 1.0)
    con._rgb[rows, columns] = np.rint(cover * over + (1.0 - cover) * con._rgb[rows, columns])


def _window_depth(distance: NDArray[np.float32], scn: MjvScene) -> NDArray[np.float64]:
    """Depth as OpenGL has it, 0 at the near plane and 1 at the far one, of distances from the camera's plane [m]."""
    near, far = scn.camera[0].frustum_near, scn.camera[0].frustum_far
    away = distance.astype(np.float64)
    if scn.camera[0].orthographic:
        return (away - near) / (far - near)
    return (1.0 / near - 1.0 / away) / (1.0 / near - 1.0 / far)


def _objects(segmentation: NDArray[np.int32], scn: MjvScene) -> NDArray[np.uint8]:
    """What `mjRND_SEGMENT` shows: the number of each geom in the scene, and one, in three bytes; or colours that differ."""
    shown = [geom for geom in scn._geoms[: scn.ngeom] if geom.segid >= 0]
    numbers = {(geom.objid, geom.objtype): geom.segid + 1 for geom in reversed(shown)}
    seen, places = np.unique(segmentation.reshape(-1, 2), axis=0, return_inverse=True)
    found = np.array([numbers.get((int(id), int(kind)), 0) for id, kind in seen], np.uint32)
    if not scn.flags[mjtRndFlag.mjRND_IDCOLOR]:
        found = np.where(found > 0, found * np.uint32(2654435761) | np.uint32(0x404040), 0)
    bytes = np.stack([found >> shift & 0xFF for shift in (0, 8, 16)], -1).astype(np.uint8)
    return bytes[places.reshape(-1)].reshape(*segmentation.shape[:2], 3)


def drawn(scn: MjvScene, size: tuple[int, int]) -> tuple[NDArray[np.uint8], NDArray[np.float32], NDArray[np.int32]]:
    """Colours, distances [m] and objects of a scene in pictures of this width and height, as its flags say.

    Raises:
        RuntimeError: the scene was never updated.
    """
    rgb, distance, objects = scn._painter.draw_all(size, scn._guests(), scn._effects())
    if scn.flags[mjtRndFlag.mjRND_SEGMENT]:
        rgb = _objects(objects, scn)
    if scn.flags[mjtRndFlag.mjRND_DEPTH]:
        # MuJoCo draws no colours then.
        rgb[...] = 0
    return rgb, distance, objects


def mjr_render(viewport: MjrRect, scn: MjvScene, con: MjrContext) -> None:
    """Draws a scene into a rectangle.

    Raises:
        RuntimeError: the scene was never updated.
    """
    rgb, distance, _ = drawn(scn, (viewport.width, viewport.height))
    depth = _window_depth(distance, scn)
    rows, columns = con._within(viewport)
    place = slice(rows.start - viewport.bottom, rows.stop - viewport.bottom), slice(
        columns.start - viewport.left, columns.stop - viewport.left
    )
    con._rgb[rows, columns] = rgb[::-1][place]
    con._depth[rows, columns] = depth[::-1][place]


def mjr_readPixels(
    rgb: NDArray[np.uint8] | None, depth: NDArray[np.float32] | None, viewport: MjrRect, con: MjrContext
) -> None:
    """Copies a rectangle, rows from below: colours (`height * width * 3`), depths (`height * width`), 0 at the near plane and
    1 at the far one, or the other way round as `con.readDepthMap` says.

    Raises:
        TypeError: an array has another size.
    """
    rows, columns = con._within(viewport)
    far_is_one = con.readDepthMap == mjtDepthMap.mjDEPTH_ZERONEAR
    drawn: list[tuple[str, NDArray[Any] | None, NDArray[Any]]] = [
        ("rgb", rgb, con._rgb[rows, columns]),
        ("depth", depth, con._depth[rows, columns] if far_is_one else 1 - con._depth[rows, columns]),
    ]
    for name, out, pixels in drawn:
        if out is None:
            continue
        wanted = viewport.height * viewport.width * (3 if name == "rgb" else 1)
        if out.size != wanted or pixels.size != wanted:
            raise TypeError(f"{name} should have {wanted} numbers, of a viewport within the context's {con.offWidth} x {con.offHeight}")
        out[...] = pixels.reshape(out.shape)


def mjr_setBuffer(framebuffer: int, con: MjrContext) -> None:
    """Makes this the context that functions without one draw into; all is drawn offscreen."""
    _draw_into(con)


def mjr_resizeOffscreen(width: int, height: int, con: MjrContext) -> None:
    """Sets the largest picture [pixels]."""
    con.offWidth, con.offHeight = int(width), int(height)
    con._clear()


def mjr_maxViewport(con: MjrContext) -> MjrRect:
    """The largest picture."""
    return MjrRect(0, 0, con.offWidth, con.offHeight)


def mjr_restoreBuffer(con: MjrContext) -> None:
    """Makes this the context that functions without one draw into: there are no auxiliary buffers to come back from."""
    _draw_into(con)


def mjr_defaultRendererInfo(info: MjrRendererInfo) -> None:
    """Sets the values of new information."""
    info.__init__()  # type: ignore[misc]


def mjr_findRect(x: int, y: int, nrect: int, rect: MjrRect) -> int:
    """0 where the pixel is in the rectangle, the only one that can be given; else, and where `nrect` is 0, -1."""
    inside = 0 <= x - rect.left < rect.width and 0 <= y - rect.bottom < rect.height
    return 0 if inside and nrect > 0 else -1


def mjr_drawPixels(
    rgb: NDArray[np.uint8] | None, depth: NDArray[np.float32] | None, viewport: MjrRect, con: MjrContext
) -> None:
    """Puts a rectangle of pixels into the picture, in the layout of `mjr_readPixels`; depths are 0 at the near plane, 1 at the far.

    Raises:
        TypeError: an array has another size than the viewport, or the viewport is not within the context.
    """
    rows, columns = con._within(viewport)
    for name, given, picture in (("rgb", rgb, con._rgb), ("depth", depth, con._depth)):
        if given is None:
            continue
        place = picture[rows, columns]
        if given.size != place.size or place.shape[:2] != (viewport.height, viewport.width):
            raise TypeError(f"{name} should be of a viewport within the context's {con.offWidth} x {con.offHeight}")
        place[...] = given.reshape(place.shape)


def mjr_finish() -> None:
    """Of no effect: drawing has ended when `mjr_render` returns."""


def mjr_getError() -> int:
    """0: there is no OpenGL that could fail."""
    return 0


def mjr_uploadHField(m: MjModel, con: MjrContext, hfieldid: int) -> None:
    """Of no effect: the next scene sees edits of height fields."""


def mjr_uploadMesh(m: MjModel, con: MjrContext, meshid: int) -> None:
    """Of no effect: the next scene sees edits of meshes."""


def mjr_uploadTexture(m: MjModel, con: MjrContext, texid: int) -> None:
    """Of no effect: the next scene sees edits of textures."""
