"""Which inputs of which controllers are meant: actions, and the paths that are suggested for them."""

from __future__ import annotations

#: Actions by their names, with their types in OpenXR.
ACTIONS = {
    "grip": "POSE_INPUT",
    "trigger": "FLOAT_INPUT",
    "squeeze": "FLOAT_INPUT",
    "stick": "VECTOR2F_INPUT",
    "stick_click": "BOOLEAN_INPUT",
    "first": "BOOLEAN_INPUT",
    "second": "BOOLEAN_INPUT",
}

#: Both hands, and the inputs of the right and of the left one where they differ.
PROFILES: dict[str, dict[str, str | tuple[str, str]]] = {
    "oculus/touch_controller": {
        "grip": "grip/pose",
        "trigger": "trigger/value",
        "squeeze": "squeeze/value",
        "stick": "thumbstick",
        "stick_click": "thumbstick/click",
        "first": ("a/click", "x/click"),
        "second": ("b/click", "y/click"),
    },
    "valve/index_controller": {
        "grip": "grip/pose",
        "trigger": "trigger/value",
        "squeeze": "squeeze/value",
        "stick": "thumbstick",
        "stick_click": "thumbstick/click",
        "first": "a/click",
        "second": "b/click",
    },
    # One button beside the trackpad: nothing ends a session, and a press of the left trackpad pauses.
    "htc/vive_controller": {
        "grip": "grip/pose",
        "trigger": "trigger/value",
        "squeeze": "squeeze/click",
        "stick": "trackpad",
        "stick_click": ("trackpad/click", ""),
        "first": "menu/click",
        "second": ("", "trackpad/click"),
    },
    # Two buttons: the gripper stays as it is.
    "khr/simple_controller": {
        "grip": "grip/pose",
        "squeeze": "select/click",
        "first": "menu/click",
    },
}


def suggested(profile: str) -> list[tuple[str, str]]:
    """The actions of an interaction profile with the full paths of their inputs."""
    rows = []
    for action, inputs in PROFILES[profile].items():
        for hand, path in zip(("right", "left"), (inputs, inputs) if isinstance(inputs, str) else inputs):
            if path:
                rows.append((action, f"/user/hand/{hand}/input/{path}"))
    return rows
