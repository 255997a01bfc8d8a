"""Names of MuJoCo's bindings behind which there is nothing yet: they can be imported, and raise when they are used."""

from collections.abc import Callable
from typing import Any, NoReturn


def _function(name: str) -> Callable[..., NoReturn]:
    def missing(*args: Any, **kwargs: Any) -> NoReturn:
        raise NotImplementedError(f"robohive.mujoco has no {name}")

    missing.__name__ = missing.__qualname__ = name
    missing.__doc__ = "Not there: raises NotImplementedError."
    return missing


class _Missing:
    """Not there: raises NotImplementedError."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        raise NotImplementedError(f"robohive.mujoco has no {type(self).__name__}")


def _class(name: str) -> Any:
    return type(name, (_Missing,), {"__doc__": _Missing.__doc__})


mj_clearCache = _function("mj_clearCache")
mj_defaultSolRefImp = _function("mj_defaultSolRefImp")
mj_getCache = _function("mj_getCache")
mj_getCacheCapacity = _function("mj_getCacheCapacity")
mj_getCacheSize = _function("mj_getCacheSize")
mj_loadAllPluginLibraries = _function("mj_loadAllPluginLibraries")
mj_loadPluginLibrary = _function("mj_loadPluginLibrary")
mj_projectConstraint = _function("mj_projectConstraint")
mj_rayFlex = _function("mj_rayFlex")
mj_setCacheCapacity = _function("mj_setCacheCapacity")
mj_setLengthRange = _function("mj_setLengthRange")
mju_raySkin = _function("mju_raySkin")
mju_threadpool = _function("mju_threadpool")
mjr_addAux = _function("mjr_addAux")
mjr_blitAux = _function("mjr_blitAux")
mjr_blitBuffer = _function("mjr_blitBuffer")
mjr_changeFont = _function("mjr_changeFont")
mjr_defaultRendererInfo = _function("mjr_defaultRendererInfo")
mjr_drawPixels = _function("mjr_drawPixels")
mjr_figure = _function("mjr_figure")
mjr_findRect = _function("mjr_findRect")
mjr_restoreBuffer = _function("mjr_restoreBuffer")
mjr_setAux = _function("mjr_setAux")
mjr_text = _function("mjr_text")
mjv_addGeoms = _function("mjv_addGeoms")
mjv_alignToCamera = _function("mjv_alignToCamera")
mjv_applyPerturbForce = _function("mjv_applyPerturbForce")
mjv_applyPerturbPose = _function("mjv_applyPerturbPose")
mjv_averageCamera = _function("mjv_averageCamera")
mjv_camera2GLCamera = _function("mjv_camera2GLCamera")
mjv_cameraFrame = _function("mjv_cameraFrame")
mjv_cameraFrustum = _function("mjv_cameraFrustum")
mjv_cameraInModel = _function("mjv_cameraInModel")
mjv_cameraInRoom = _function("mjv_cameraInRoom")
mjv_connector = _function("mjv_connector")
mjv_frustumHeight = _function("mjv_frustumHeight")
mjv_initPerturb = _function("mjv_initPerturb")
mjv_makeLights = _function("mjv_makeLights")
mjv_model2room = _function("mjv_model2room")
mjv_moveModel = _function("mjv_moveModel")
mjv_movePerturb = _function("mjv_movePerturb")
mjv_room2model = _function("mjv_room2model")
mjv_updateCamera = _function("mjv_updateCamera")
mjv_updateSkin = _function("mjv_updateSkin")
MjLogMessage = _class("MjLogMessage")
MjPreContact = _class("MjPreContact")
MjrVertexAttribute = _class("MjrVertexAttribute")
MjByteVec = _class("MjByteVec")
MjDoubleVec = _class("MjDoubleVec")
MjFloatVec = _class("MjFloatVec")
MjIntVec = _class("MjIntVec")

#: Names that raise when they are used.
MISSING = frozenset(name for name in globals() if name.startswith(("mj", "Mj", "GL")))
