"""Exceptions of their own; all others are Python's, numpy's and Gymnasium's."""


class SettingError(ValueError, TypeError):
    """A keyword argument is unknown to an environment (as Python's `TypeError`), or has a wrong type or value."""


class PhysicsError(RuntimeError):
    """Physics refuses a state: numbers that are not finite, or beyond what it can simulate."""


class WindowError(RuntimeError):
    """No window can be opened: there is no display, or the wheel was built without windows."""
