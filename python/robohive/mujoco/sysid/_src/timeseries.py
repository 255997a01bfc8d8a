"""Signals over time."""

from robohive.mujoco.sysid.interpolation import InterpolationMethod
from robohive.mujoco.sysid.signals import SignalMappingType, SignalType, decode_signal_mapping, encode_signal_mapping
from robohive.mujoco.sysid.timeseries import TimeSeries

__all__ = [
    "InterpolationMethod",
    "SignalMappingType",
    "SignalType",
    "TimeSeries",
    "decode_signal_mapping",
    "encode_signal_mapping",
]
