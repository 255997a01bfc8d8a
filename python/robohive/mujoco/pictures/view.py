"""What a picture shows: cameras and options of the view."""

import operator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robohive.mujoco.enums.view import mjtCamera, mjtFrame, mjtLabel, mjtVisFlag

#: Flags that are set to begin with.
_SHOWN = ("TEXTURE", "STATIC", "TENDON", "RANGEFINDER", "SKIN", "FLEXEDGE", "FLEXSKIN", "PERTOBJ")


class _Struct:
    """Fields as attributes, compared and shown as such."""

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        mine, theirs = vars(self), vars(other)
        return all(np.array_equal(mine[name], theirs[name]) for name in mine)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        rows = (f"  {name}: {value!r}" for name, value in sorted(vars(self).items()))
        return "\n".join((f"<{type(self).__name__}", *rows, ">"))


class MjvCamera(_Struct):
    """An abstract camera: one of the model (`type` fixed, `fixedcamid`), or a free one that looks at a point."""

    def __init__(self) -> None:
        self.type: int = mjtCamera.mjCAMERA_FREE
        self.fixedcamid = -1
        self.trackbodyid = -1
        self.lookat: NDArray[np.float64] = np.zeros(3)
        self.distance = 2.0
        self.azimuth = 90.0
        self.elevation = -45.0
        self.orthographic = 0

    def __setattr__(self, name: str, value: Any) -> None:
        if name in ("fixedcamid", "trackbodyid", "type", "orthographic"):
            try:
                value = value if isinstance(value, int) else operator.index(value)
            except TypeError:
                raise TypeError(f"MjvCamera.{name} is an integer, not {value!r}") from None
        super().__setattr__(name, value)


class MjvOption(_Struct):
    """What is visible: groups of elements, kinds of elements and decorations."""

    def __init__(self) -> None:
        shown = np.array([1, 1, 1, 0, 0, 0], np.uint8)
        self.label: int = mjtLabel.mjLABEL_NONE
        self.frame: int = mjtFrame.mjFRAME_NONE
        self.geomgroup, self.sitegroup, self.jointgroup = (shown.copy() for _ in range(3))
        self.tendongroup, self.actuatorgroup = shown.copy(), shown.copy()
        self.flexgroup, self.skingroup = shown.copy(), shown.copy()
        self.flags: NDArray[np.uint8] = np.zeros(mjtVisFlag.mjNVISFLAG, np.uint8)
        for name in _SHOWN:
            flag: Any = mjtVisFlag.__members__.get(f"mjVIS_{name}")
            if flag is not None:
                self.flags[flag] = 1
        self.bvh_depth = 1
        self.flex_layer = 0


def mjv_defaultCamera(cam: MjvCamera) -> None:
    """Sets the values of a new camera."""
    cam.__init__()  # type: ignore[misc]


def mjv_defaultOption(opt: MjvOption) -> None:
    """Sets the values of new options."""
    opt.__init__()  # type: ignore[misc]


def mjv_defaultFreeCamera(m: Any, cam: MjvCamera) -> None:
    """The free camera that a model starts with: it looks at the middle of the model."""
    cam.type = mjtCamera.mjCAMERA_FREE
    cam.fixedcamid = -1
    cam.lookat[:] = m.stat.center
    cam.distance = 1.5 * m.stat.extent
    cam.azimuth = m.vis.global_.azimuth
    cam.elevation = m.vis.global_.elevation
    cam.orthographic = m.vis.global_.orthographic
