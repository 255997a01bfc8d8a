"""Exceptions of their own; all others are Python's, numpy's and Gymnasium's."""


class SettingError(ValueError, TypeError):
    """A keyword argument is unknown to an environment (as Python's `TypeError`), or has a wrong type or value."""


class PhysicsError(RuntimeError):
    """Physics refuses a state: numbers that are not finite, or beyond what it can simulate."""


class HardwareError(RuntimeError):
    """A device of a robot that is hardware fails or refuses, or nothing drives it.

    Attributes:
        device: Its name in the robot's config; empty where no single device is to blame.
    """

    def __init__(self, message: str, device: str = "") -> None:
        super().__init__(message)
        self.device = device


class WindowError(RuntimeError):
    """No window can be opened: there is no display, or the wheel was built without windows."""
