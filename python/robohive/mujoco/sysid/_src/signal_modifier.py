"""Gains, biases, delays and distances of signals."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from robohive.mujoco.sysid.signal_modifier import *  # noqa: F403
from robohive.mujoco.sysid.signal_modifier import column_delays, read_at
from robohive.mujoco.sysid.timeseries import TimeSeries

_build_per_column_delays = column_delays


def _apply_resample_and_delay_columnwise(
    ts: TimeSeries, times: NDArray[np.float64], delays: Sequence[float]
) -> NDArray[np.float64]:
    """Columns of a series, each at times of its own, interpolated one by one."""
    return read_at(ts, times, delays, [[column] for column in range(len(delays))])
