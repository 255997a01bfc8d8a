"""The OpenXR runtime of this machine: whether there is one, what it offers, and what of it is used."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from robohive.openxr.trouble import Trouble

#: A session without pictures, whose times are those of the system's monotonic clock.
HEADLESS = ("XR_MND_headless", "XR_KHR_convert_timespec_time")
#: A session that shows empty pictures, for runtimes that know no other.
DRAWN = ("XR_KHR_opengl_enable",)

#: Environment variable with the manifest of a runtime, and where loaders look for one without it.
MANIFEST = "XR_RUNTIME_JSON"
PLACES = ("~/.config/openxr/1/active_runtime.json", "/etc/xdg/openxr/1/active_runtime.json", "/usr/share/openxr/1/active_runtime.json")

NO_RUNTIME = (
    "no OpenXR runtime is active: start SteamVR (and set it as the OpenXR runtime in its settings), Monado or WiVRn, "
    f"or name the manifest of one by the environment variable {MANIFEST}"
)


def bindings() -> Any:
    """The module `xr`, pyopenxr.

    Raises:
        Trouble: it is not installed, or lacks a library of the system.
    """
    # What the loader would print is in our errors; a value of the user's own stays.
    os.environ.setdefault("XR_LOADER_DEBUG", "none")
    try:
        import xr
    except Exception as error:  # Beside its absence, a missing libGL shows itself as one of several exceptions.
        raise Trouble.lacks("pyopenxr", error) from error
    return xr


def manifest() -> str:
    """Where the active runtime is described, as far as can be seen."""
    named = os.environ.get(MANIFEST)
    if named:
        return f"{named} ({MANIFEST})"
    found = [str(path) for path in map(Path, map(os.path.expanduser, PLACES)) if path.exists()]
    return found[0] if found else "none found"


def extensions(xr: Any) -> list[str]:
    """Names of the extensions that the runtime has.

    Raises:
        Trouble: there is no runtime.
    """
    try:
        found = xr.enumerate_instance_extension_properties()
    except xr.XrException as error:
        raise Trouble(f"{NO_RUNTIME} ({type(error).__name__}; manifest: {manifest()})") from error
    return sorted(properties.extension_name.decode() for properties in found)


def choose(found: list[str]) -> tuple[str, ...]:
    """The extensions that a session needs: without pictures where the runtime can do that.

    Raises:
        Trouble: the runtime has neither kind of session.
    """
    for wanted in (HEADLESS, DRAWN):
        if all(name in found for name in wanted):
            return wanted
    raise Trouble(f"the runtime has neither {' with '.join(HEADLESS)} nor {DRAWN[0]}: another one is needed")


def instance(xr: Any, wanted: tuple[str, ...]) -> Any:
    """A connection to the runtime with these extensions.

    Raises:
        Trouble: the runtime refuses.
    """
    info = xr.InstanceCreateInfo(application_info=xr.ApplicationInfo(application_name="robohive"), enabled_extension_names=list(wanted))
    try:
        return xr.create_instance(info)
    except xr.XrException as error:
        raise Trouble(f"the OpenXR runtime refuses a connection ({type(error).__name__}): is its service running?") from error


def system(xr: Any, connection: Any) -> Any:
    """The headset of a runtime.

    Raises:
        Trouble: there is none.
    """
    try:
        return xr.get_system(connection)
    except xr.XrException as error:
        raise Trouble(f"the OpenXR runtime has no headset ({type(error).__name__}): connect it and switch it on") from error


def describe() -> list[str]:
    """What there is, in lines: the runtime, its headset, its extensions, and which session would be used.

    Raises:
        Trouble: there is no runtime.
    """
    xr = bindings()
    found = extensions(xr)
    connection = instance(xr, ())
    properties = xr.get_instance_properties(connection)
    lines = [f"runtime     {properties.runtime_name.decode()} {properties.runtime_version}", f"manifest    {manifest()}"]
    try:
        name = xr.get_system_properties(connection, system(xr, connection)).system_name.decode()
        lines.append(f"headset     {name}")
    except Trouble as trouble:
        lines.append(f"headset     {trouble}")
    try:
        kind = "without pictures" if choose(found) == HEADLESS else "with empty pictures, by OpenGL"
        lines.append(f"session     {kind}")
    except Trouble as trouble:
        lines.append(f"session     {trouble}")
    return lines + [f"extension   {name}" for name in found]
