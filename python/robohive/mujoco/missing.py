"""Names of MuJoCo's bindings behind which there is nothing yet: they can be imported, and raise when they are used."""

from collections.abc import Callable
from typing import Any, NoReturn

_FUNCTIONS = """
mj_actuatorInputName mj_addContact mj_addM mj_checkAcc mj_checkPos mj_checkVel mj_clearCache mj_constraintUpdate
mj_defaultLROpt mj_defaultOption mj_defaultSolRefImp mj_defaultVisual mj_flex mj_getCache mj_getCacheCapacity
mj_getCacheSize mj_initCtrlHistory mj_initSensorHistory mj_invConstraint mj_invPosition mj_invVelocity mj_inverseSkip
mj_loadAllPluginLibraries mj_loadPluginLibrary mj_maxContact mj_mulM2 mj_printData mj_printFormattedData
mj_printFormattedModel mj_printFormattedScene mj_printModel mj_printScene mj_printSchema mj_projectConstraint mj_rayFlex
mj_readCtrl mj_readSensor mj_resetCtrl mj_resetDataDebug mj_saveLastXML mj_setCacheCapacity mj_setLengthRange mj_solveM2
mjd_quatIntegrate mjd_subQuat
mju_band2Dense mju_bandDiag mju_bandMulMatVec mju_boxQP mju_cholFactorBand mju_cholSolveBand mju_cholUpdate
mju_decodePyramid mju_dense2Band mju_dense2sparse mju_encodePyramid mju_getXMLDependencies mju_insertionSort
mju_insertionSortInt mju_mat2Rot mju_muscleBias mju_muscleDynamics mju_muscleGain mju_printMat mju_printMatSparse
mju_raySkin mju_springDamper mju_sqrMatTD mju_standardNormal mju_threadpool mju_warningText mju_writeLog
mju_writeNumBytes
mjr_addAux mjr_blitAux mjr_blitBuffer mjr_changeFont mjr_defaultRendererInfo mjr_drawPixels mjr_figure mjr_findRect
mjr_finish mjr_getError mjr_getRendererInfo mjr_label mjr_maxViewport mjr_overlay mjr_readPixels mjr_rectangle mjr_render
mjr_resizeOffscreen mjr_restoreBuffer mjr_setAux mjr_setBuffer mjr_text mjr_uploadHField mjr_uploadMesh
mjr_uploadTexture
mjv_addGeoms mjv_alignToCamera mjv_applyPerturbForce mjv_applyPerturbPose mjv_averageCamera mjv_camera2GLCamera
mjv_cameraFrame mjv_cameraFrustum mjv_cameraInModel mjv_cameraInRoom mjv_connector mjv_defaultFigure
mjv_frustumHeight mjv_initGeom mjv_initPerturb mjv_makeLights mjv_model2room mjv_moveCamera mjv_moveModel
mjv_movePerturb mjv_room2model mjv_select mjv_updateCamera mjv_updateScene mjv_updateSkin
from_zip to_zip
""".split()

_CLASSES = """
GLContext MjLROpt MjLogConfig MjLogMessage MjPreContact MjVfs MjrContext MjrRect MjrRendererInfo MjrVertexAttribute
MjvFigure MjvGLCamera MjvGeom MjvLight MjvPerturb MjvScene MjByteVec MjCharVec MjDoubleVec MjFloatVec MjIntVec
MjStringVec MjsActuator MjsAuthored MjsBody MjsCamera MjsCompiler MjsDefault MjsElement MjsEquality MjsExclude MjsFlex
MjsFrame MjsGeom MjsHField MjsJoint MjsKey MjsLight MjsMaterial MjsMesh MjsNumeric MjsOrientation MjsPair MjsPlugin
MjsSensor MjsSite MjsSkin MjsTendon MjsTendonPath MjsText MjsTexture MjsTuple MjsWrap
""".split()


def _function(name: str) -> Callable[..., NoReturn]:
    def missing(*args: Any, **kwargs: Any) -> NoReturn:
        raise NotImplementedError(f"robohive.mujoco has no {name}")

    missing.__name__ = missing.__qualname__ = name
    missing.__doc__ = "Not there: raises NotImplementedError."
    return missing


def _refuse(self: Any, *args: Any, **kwargs: Any) -> NoReturn:
    raise NotImplementedError(f"robohive.mujoco has no {type(self).__name__}")


for _name in _FUNCTIONS:
    globals()[_name] = _function(_name)
for _name in _CLASSES:
    globals()[_name] = type(_name, (), {"__init__": _refuse, "__doc__": "Not there: raises NotImplementedError."})

#: Names that raise when they are used.
MISSING = frozenset((*_FUNCTIONS, *_CLASSES))
__all__ = [*_FUNCTIONS, *_CLASSES]
