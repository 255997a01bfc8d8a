"""Delays, gains and biases by patterns."""

from robohive.mujoco.sysid.signal_transform import SignalTransform

__all__ = ["SignalTransform"]
