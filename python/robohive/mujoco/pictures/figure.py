"""Lights of a scene and figures of curves, as records: nothing here draws figures."""

import numpy as np
from numpy.typing import NDArray

from robohive.mujoco.pictures.view import _Struct

_LINES, _POINTS = 100, 1001


class MjvLight(_Struct):
    """A light of a scene."""

    def __init__(self) -> None:
        self.ambient, self.attenuation, self.diffuse, self.dir, self.pos, self.specular = (
            np.zeros(3, np.float32) for _ in range(6)
        )
        self.bulbradius = self.cutoff = self.exponent = self.intensity = self.range = self.softness = 0.0
        self.castshadow = self.headlight = self.id = self.texid = self.type = 0


class MjvFigure(_Struct):
    """Curves over two axes: `linedata` holds 1001 points, x and y by turns, of each of 100 lines."""

    def __init__(self) -> None:
        self.title = self.xlabel = self.ylabel = ""
        self.xformat, self.yformat, self.minwidth = "%.0f", "%.2g", "XXX"
        self.flg_barplot = self.flg_selection = self.flg_symmetric = 0
        self.flg_extend = self.flg_legend = 1
        self.flg_ticklabel: NDArray[np.int32] = np.ones(2, np.int32)
        self.gridsize: NDArray[np.int32] = np.full(2, 2, np.int32)
        self.gridrgb: NDArray[np.float32] = np.full(3, 0.4, np.float32)
        self.textrgb: NDArray[np.float32] = np.ones(3, np.float32)
        self.figurergba, self.panergba = (np.array([0, 0, 0, 1], np.float32) for _ in range(2))
        self.legendrgba: NDArray[np.float32] = np.array([0, 0, 0, 0.3], np.float32)
        self.range: NDArray[np.float32] = np.array([[0, 1], [0, 1]], np.float32)
        self.gridwidth, self.linewidth, self.selection = 1.0, 3.0, 0.0
        self.highlightid, self.legendoffset, self.subplot = -1, 0, 0
        self.highlight, self.xaxispixel, self.yaxispixel = (np.zeros(2, np.int32) for _ in range(3))
        self.xaxisdata, self.yaxisdata = (np.zeros(2, np.float32) for _ in range(2))
        self.linergb: NDArray[np.float32] = np.zeros((_LINES, 3), np.float32)
        self.linename: NDArray[np.bytes_] = np.zeros(_LINES, "S100")
        self.linepnt: NDArray[np.int32] = np.zeros(_LINES, np.int32)
        self.linedata: NDArray[np.float32] = np.zeros((_LINES, 2 * _POINTS), np.float32)


def mjv_defaultFigure(fig: MjvFigure) -> None:
    """Sets the values of a new figure."""
    fig.__init__()  # type: ignore[misc]
