"""Names of MuJoCo's bindings behind which there is nothing: they can be imported, and raise with a reason when they are used."""

from collections.abc import Callable
from typing import Any, NoReturn

#: Why, by name.
REASONS = {
    "mj_defaultSolRefImp": "MuJoCo's own ends the process, since it takes numbers for arrays; MjOption() has the defaults",
    "mj_loadAllPluginLibraries": "plugins in C cannot run on this engine; MuJoCo's own are there without a library",
    "mj_loadPluginLibrary": "plugins in C cannot run on this engine; MuJoCo's own are there without a library",
    "mj_projectConstraint": "the engine keeps the inverse inertia of constraints in a factored form; efc_diagA has its diagonal",
    "mj_rayFlex": "rays do not meet flexes; mj_ray and mj_multiRay meet geoms",
    "mj_setLengthRange": "MjSpec.compile sets the length ranges of all actuators, with compiler.LRopt",
    "mju_raySkin": "MuJoCo's own takes numbers for arrays, so that no program can call it",
    "mjr_addAux": "there are no auxiliary buffers; a second MjrContext holds a second picture",
    "mjr_blitAux": "there are no auxiliary buffers; a second MjrContext holds a second picture",
    "mjr_blitBuffer": "there is one buffer, of which mjr_readPixels copies and into which mjr_drawPixels puts",
    "mjr_figure": "figures are not drawn; matplotlib draws the same lines",
    "mjr_setAux": "there are no auxiliary buffers; a second MjrContext holds a second picture",
    "mjv_addGeoms": "mjv_updateScene takes in a scene as a whole; its catmask chooses among categories",
    "mjv_makeLights": "mjv_updateScene takes in a scene as a whole, with its lights",
    "mjv_updateCamera": "mjv_updateScene takes in a scene as a whole, with its camera; mjv_camera2GLCamera computes one alone",
    "mjv_updateSkin": "mjv_updateScene takes in a scene as a whole, with its skins",
}


def _function(name: str) -> Callable[..., NoReturn]:
    def missing(*args: Any, **kwargs: Any) -> NoReturn:
        raise NotImplementedError(f"robohive.mujoco has no {name}: {REASONS[name]}")

    missing.__name__ = missing.__qualname__ = name
    missing.__doc__ = f"Not there: {REASONS[name]}. Raises NotImplementedError."
    return missing


globals().update({name: _function(name) for name in REASONS})

#: Names that raise when they are used.
MISSING = frozenset(REASONS)
