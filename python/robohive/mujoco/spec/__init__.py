"""Descriptions of models that programs build and edit: `MjSpec` and its elements.

| module | what |
|---|---|
| `tree`, `lists` | `MjSpec`: elements by kind, compiled, written, copied |
| `element`, `bodies`, `objects` | elements: in the tree of bodies, and in lists |
| `plugins` | instances of plugins, and elements that use one |
| `forms`, `orientation`, `settings`, `authored`, `defaults` | values of attributes, settings and which of them a text gives, default classes |
| `attach`, `references` | elements that come from other descriptions or leave; which names follow |
| `exchange`, `bind`, `archive` | to the engine and back; elements in compiled models; texts with their files |

Python holds the tree; the engine reads, compiles and writes it.
"""

from robohive.mujoco.spec.authored import MjsAuthored
from robohive.mujoco.spec.bodies import MjsBody, MjsCamera, MjsFrame, MjsGeom, MjsJoint, MjsLight, MjsSite
from robohive.mujoco.spec.defaults import MjsDefault
from robohive.mujoco.spec.element import MjsElement
from robohive.mujoco.spec.forms import MjCharVec, MjStringVec
from robohive.mujoco.spec.objects import (
    MjsActuator,
    MjsEquality,
    MjsExclude,
    MjsFlex,
    MjsHField,
    MjsKey,
    MjsMaterial,
    MjsMesh,
    MjsNumeric,
    MjsPair,
    MjsSensor,
    MjsSkin,
    MjsTendon,
    MjsTendonPath,
    MjsText,
    MjsTexture,
    MjsTuple,
    MjsWrap,
)
from robohive.mujoco.spec.orientation import MjsOrientation
from robohive.mujoco.spec.plugins import MjsPlugin
from robohive.mujoco.spec.settings import MjLROpt, MjsCompiler
from robohive.mujoco.spec.tree import MjSpec

#: Everything that a description consists of.
MjStruct = (
    MjsActuator
    | MjsAuthored
    | MjsBody
    | MjsCamera
    | MjsCompiler
    | MjsDefault
    | MjsEquality
    | MjsExclude
    | MjsFlex
    | MjsFrame
    | MjsGeom
    | MjsHField
    | MjsJoint
    | MjsKey
    | MjsLight
    | MjsMaterial
    | MjsMesh
    | MjsNumeric
    | MjsOrientation
    | MjsPair
    | MjsPlugin
    | MjsSensor
    | MjsSite
    | MjsSkin
    | MjsTendon
    | MjsText
    | MjsTexture
    | MjsTuple
    | MjsWrap
)

__all__ = [
    "MjCharVec",
    "MjLROpt",
    "MjSpec",
    "MjStringVec",
    "MjStruct",
    "MjsActuator",
    "MjsAuthored",
    "MjsBody",
    "MjsCamera",
    "MjsCompiler",
    "MjsDefault",
    "MjsElement",
    "MjsEquality",
    "MjsExclude",
    "MjsFlex",
    "MjsFrame",
    "MjsGeom",
    "MjsHField",
    "MjsJoint",
    "MjsKey",
    "MjsLight",
    "MjsMaterial",
    "MjsMesh",
    "MjsNumeric",
    "MjsOrientation",
    "MjsPair",
    "MjsPlugin",
    "MjsSensor",
    "MjsSite",
    "MjsSkin",
    "MjsTendon",
    "MjsTendonPath",
    "MjsText",
    "MjsTexture",
    "MjsTuple",
    "MjsWrap",
]
