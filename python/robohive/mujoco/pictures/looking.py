"""What a picture shows, as the engine takes it."""

from typing import Any

from robohive.mujoco.enums.view import mjtCamera, mjtVisFlag
from robohive.mujoco.pictures.view import MjvCamera, MjvOption
from robohive.mujoco.structs.model import MjModel

_GROUPS = ("geom", "site", "joint", "tendon", "actuator", "skin", "flex")


def checked(model: MjModel, number: int) -> int:
    """The number of a camera.

    Raises:
        ValueError: the model has no such camera.
    """
    if not 0 <= number < model.ncam:
        raise ValueError(f"camera {number} is out of range: the free one is -1, those of the model end at {model.ncam - 1}")
    return int(number)


def look_of(model: MjModel, camera: MjvCamera, option: MjvOption) -> dict[str, Any]:
    """Camera and visible elements; everything else as a new scene has it.

    Raises:
        ValueError: the model has no such camera.
    """
    fixed = camera.type == mjtCamera.mjCAMERA_FIXED
    shown = [flag.name.removeprefix("mjVIS_") for flag in mjtVisFlag if flag < len(option.flags) and option.flags[flag]]
    return {
        "camera": checked(model, camera.fixedcamid) if fixed else None,
        "free": None if fixed else free_camera(camera),
        "groups": [[bool(x) for x in getattr(option, f"{kind}group")] for kind in _GROUPS],
        "shown": shown,
        "categories": [True, True, True],
        "label": int(option.label),
        "frame": int(option.frame),
        "bvh_depth": int(option.bvh_depth),
        "flex_layer": int(option.flex_layer),
        "selection": None,
    }


def free_camera(camera: MjvCamera) -> dict[str, Any]:
    """A camera that is none of the model, as the engine takes it."""
    tracked = camera.trackbodyid if camera.type == mjtCamera.mjCAMERA_TRACKING else None
    names = ("distance", "azimuth", "elevation")
    return {
        "lookat": camera.lookat,
        "track": tracked,
        **{name: float(getattr(camera, name)) for name in names},
        "orthographic": bool(camera.orthographic),
    }
