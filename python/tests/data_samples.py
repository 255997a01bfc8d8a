"""Recordings that the tests of data share."""

from pathlib import Path

import numpy as np
from robohive.data import Recorder

TRACES = Path(__file__).parents[2] / "validation" / "reference" / "traces"


def picture(step: int, size: tuple[int, int] = (32, 48)) -> np.ndarray:
    """A smooth picture that moves, which a video keeps well."""
    y, x = np.mgrid[0 : size[0], 0 : size[1]]
    channels = (128 + 60 * np.sin((x + step) / 9), 128 + 60 * np.cos((y - step) / 11), 90 + x + y)
    return np.stack(channels, axis=-1).astype(np.uint8)


def record(path: Path, trials: int = 12, pictures: bool = False) -> list[dict[str, np.ndarray]]:
    """A recording in RoboHive's layout, as the command writes it: trials of different lengths, each second one ended for good.

    Returns the rows of the trials.
    """
    rng = np.random.default_rng(7)
    out = []
    with Recorder(path, attributes={"env": "door-v1"}) as recorder:
        for number in range(trials):
            rows = 5 + number % 4
            trial = {
                "time": 0.04 * np.arange(rows),
                "observations": rng.standard_normal((rows, 6)),
                "actions": np.concatenate([rng.uniform(-1, 1, (rows - 1, 3)), np.full((1, 3), np.nan)]),
                "rewards": rng.standard_normal(rows),
                "done": np.arange(rows) == (rows - 1 if number % 2 else rows),
                "env_infos/solved": np.arange(rows) > 2,
                "env_infos/obs_dict/qp": rng.standard_normal((rows, 4)).astype(np.float32),
                "env_infos/count": np.arange(rows, dtype=np.int32),
            }
            if pictures:
                shots = np.stack([picture(step) for step in range(rows)])
                trial["env_infos/visual_dict/rgb:top_cam:32x48:2d"] = shots
            with recorder.trial() as writer:
                writer.extend(trial)
                writer.set("seed", np.uint64(100 + number))
                writer.set("config/task", "open the door")
            out.append(trial)
    return out
