"""A stand-in for MuJoCo's Python bindings, on RoboHive's own engine.

    import robohive.mujoco
    robohive.mujoco.install()

    import mujoco  # is robohive.mujoco

Names, arguments, shapes and numbers are those of MuJoCo 3.12. Where something is not there, it raises
`NotImplementedError`; `MISSING` has the names. `set_instability("reset")` makes unstable simulations reset with a
warning, as MuJoCo's do, instead of raising.
"""

from robohive.mujoco import _functions, _structs, rollout
from robohive.mujoco._constants import *  # noqa: F403
from robohive.mujoco._enums import *  # noqa: F403
from robohive.mujoco._errors import FatalError, UnexpectedError
from robohive.mujoco._functions import *  # noqa: F403
from robohive.mujoco._structs import *  # noqa: F403
from robohive.mujoco.callbacks import *  # noqa: F403
from robohive.mujoco.functions.naming import mj_versionString
from robohive.mujoco.install import install, set_instability
from robohive.mujoco.missing import *  # noqa: F403
from robohive.mujoco.missing import MISSING
from robohive.mujoco.renderer import Renderer
from robohive.mujoco.spec import *  # noqa: F403
from robohive.mujoco.spec import MjSpec

from types import ModuleType as _ModuleType

import numpy as _np

from_zip = MjSpec.from_zip
to_zip = MjSpec.to_zip
MJTNUM_DTYPE = _np.float64
__version__ = mj_versionString()
#: What `from mujoco import *` imports: everything but modules of others.
__all__ = [  # pyright: ignore[reportUnsupportedDunderAll]
    _name
    for _name, _value in list(globals().items())
    if _name[0] != "_" and not (isinstance(_value, _ModuleType) and not _value.__name__.startswith("robohive.mujoco"))
]
