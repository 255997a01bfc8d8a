"""States of controllers as messages of a session by hand: those that its page for phones and headsets sends."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

#: Share of the way of a trigger or of a grip from which it counts as pressed.
PRESSED = 0.5

#: Names in the section [quest] of a mapping: grip, first and second button, stick, trigger; and what the axes begin with.
NAMES = {"right": ("RG", "A", "B", "RJ", "RTr", "right"), "left": ("LG", "X", "Y", "LJ", "LTr", "left")}


@dataclass(frozen=True)
class Controller:
    """State of a controller; this is one that is not there.

    Its position [m] and orientation (quaternion x, y, z, w) are those of its grip in a space with x to the right, y up and z
    backward. `tracked` is whether both are valid and tracked now.
    """

    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    orientation: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 1.0)
    tracked: bool = False
    #: 0 to 1, as the grip.
    trigger: float = 0.0
    squeeze: float = 0.0
    #: To the right and forward, -1 to 1.
    stick: tuple[float, float] = (0.0, 0.0)
    stick_click: bool = False
    #: A on the right controller, X on the left one.
    first: bool = False
    #: B on the right controller, Y on the left one.
    second: bool = False


def words(side: str, controller: Controller) -> list[str]:
    """What is pressed on a controller ("right" or "left"), and the places of its axes; nothing of one that is not touched."""
    grip, first, second, stick, trigger, axes = NAMES[side]
    pressed = {
        grip: controller.squeeze > PRESSED,
        first: controller.first,
        second: controller.second,
        stick: controller.stick_click,
        trigger: controller.trigger > PRESSED,
    }
    places = {"Trig": (controller.trigger,), "Grip": (controller.squeeze,), "JS": controller.stick}
    named = {name: tuple(place if math.isfinite(place) else 0.0 for place in values) for name, values in places.items()}
    return [name for name, is_pressed in pressed.items() if is_pressed] + [
        " ".join([axes + name, *(f"{place:.4f}" for place in values)]) for name, values in named.items() if name == "Trig" or any(values)
    ]


def hand(controller: Controller) -> dict[str, Any]:
    """The pose of a controller: seven numbers, position and orientation, and whether they are tracked."""
    pose = [*controller.position, *controller.orientation]
    tracked = controller.tracked and all(map(math.isfinite, pose))
    return {"pose": pose if tracked else [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], "tracked": tracked}


def message(seq: int, time: float, right: Controller, left: Controller) -> dict[str, Any]:
    """The message of two controllers.

    Args:
        seq: Its number; the session ignores messages whose number is not larger than that of an earlier one.
        time: When the controllers were there, on a clock that does not jump [s]; a message that is more than 0.15 s later than
            the fastest one is taken for lost.
    """
    buttons = words("right", right) + words("left", left)
    return {"seq": seq, "time": time, **hand(right), "left": hand(left), "buttons": buttons}
