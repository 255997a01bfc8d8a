"""Exceptions of their own; all others are Python's, numpy's and Gymnasium's."""


class SettingError(ValueError, TypeError):
    """A keyword argument is unknown to an environment (as Python's `TypeError`), or has a wrong type or value."""


class PhysicsError(RuntimeError):
    """Physics refuses a state: numbers that are not finite, or beyond what it can simulate."""


class HardwareError(RuntimeError):
    """A device of a robot that is hardware fails or refuses, or nothing drives it.

    Attributes:
        device: Its name in the robot's config; empty where no single device is to blame.
        kind: The kind of fault: "connection", "silence" (no answer in time), "values" (a command or a reading that is not finite),
            "refusal" (the device refuses, or is not armed), "hardware" (the device reports an error: an overload, a reflex, a pressed
            stop button), "end" (a recording has ended); empty if the interface has no driver.
    """

    def __init__(self, message: str, device: str = "", kind: str = "") -> None:
        super().__init__(message)
        self.device = device
        self.kind = kind


class WindowError(RuntimeError):
    """No window can be opened: there is no display, or the wheel was built without windows."""
