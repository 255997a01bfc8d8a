"""Puts the stand-in where programs look for MuJoCo."""

import importlib
import sys

#: Modules that programs import by their full names.
_MODULES = (
    "_constants",
    "_enums",
    "_errors",
    "_functions",
    "_specs",
    "_structs",
    "minimize",
    "msh2obj",
    "rollout",
    "sysid",
    "viewer",
)
#: Those that bring an OpenGL context, of which nothing is needed here.
_CONTEXTS = ("_render", "egl", "gl_context", "glfw", "osmesa")


def install() -> None:
    """Makes `import mujoco` import this package, in this process.

    Raises:
        ImportError: MuJoCo's own bindings have been imported already.
    """
    here = "robohive.mujoco"
    own = sys.modules[here]
    present = sys.modules.get("mujoco")
    if present is own:
        return
    if present is not None:
        raise ImportError("mujoco has been imported already; call robohive.mujoco.install() before")
    sys.modules["mujoco"] = own
    for name in _MODULES:
        sys.modules[f"mujoco.{name}"] = importlib.import_module(f"{here}.{name}")
    for name in _CONTEXTS:
        sys.modules[f"mujoco.{name}"] = importlib.import_module(f"{here}.pictures.context")


def set_instability(what: str) -> str:
    """What an unstable simulation does: `"raise"` a `FatalError` (the default), or `"reset"` with a count in
    `data.warning`, as MuJoCo does. Returns what was set before.

    Raises:
        ValueError: it is neither.
    """
    from robohive.mujoco import _engine as _core

    if what not in ("raise", "reset"):
        raise ValueError(f"an unstable simulation can raise or reset, not {what!r}")
    return "reset" if _core.set_resets(what == "reset") else "raise"
