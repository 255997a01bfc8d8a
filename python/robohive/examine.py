"""Episodes of a policy."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

from robohive import _core
from robohive.paths import stack
from robohive.whole_numbers import whole

if TYPE_CHECKING:
    from robohive.envs import RoboHiveEnv


class Policy(Protocol):
    """What acts: mjrl's protocol."""

    def get_action(self, observation: NDArray[np.float64]) -> tuple[NDArray[Any], dict[str, Any]]:
        """An action, and a dictionary whose `evaluation` is the action without exploration."""
        ...


def examine_policy(
    env: RoboHiveEnv,
    policy: Policy,
    *,
    horizon: int,
    num_episodes: int,
    mode: str,
    render: str | None,
    camera: str,
    frame_size: tuple[int, int],
    video: str,
) -> list[dict[str, Any]]:
    """Plays episodes; see `RoboHiveEnv.examine_policy`."""
    if mode not in ("exploration", "evaluation"):
        raise ValueError(f"mode is exploration or evaluation, not {mode}")
    if render not in (None, "None", "none", "offscreen", "onscreen"):
        raise ValueError(f"render is onscreen, offscreen or None, not {render}")
    horizon = whole("horizon", horizon, 1)
    paths = []
    for episode in range(whole("num_episodes", num_episodes)):
        frames: list[NDArray[np.uint8]] | None = [] if render == "offscreen" else None
        path = _episode(env, policy, horizon, mode == "exploration", camera, frame_size, frames, render == "onscreen")
        if frames:
            _core.write_video(f"{video}{episode}.mp4", np.stack(frames), 1.0 / env.dt)
        paths.append(path)
    return paths


def _episode(
    env: RoboHiveEnv,
    policy: Policy,
    horizon: int,
    explores: bool,
    camera: str,
    frame_size: tuple[int, int],
    frames: list[NDArray[np.uint8]] | None,
    shows: bool,
) -> dict[str, Any]:
    observation, _ = env.reset()
    observations: list[NDArray[np.float64]] = []
    actions: list[NDArray[Any]] = []
    rewards: list[float] = []
    infos: list[dict[str, Any]] = []
    done = False
    while len(rewards) < horizon and not done:
        action, details = policy.get_action(observation)
        action = action if explores else details["evaluation"]
        following, reward, done, _, info = env.step(action)
        if shows:
            env.mj_render()
        if frames is not None:
            frames.append(env.sim.renderer.render_offscreen(*frame_size, camera_id=camera))
        observations.append(observation)
        actions.append(action)
        rewards.append(reward)
        infos.append({**info, "proprio_dict": info["proprio_dict"] or {}})
        observation = following
    return {
        "observations": np.array(observations),
        "actions": np.array(actions),
        "rewards": np.array(rewards),
        "env_infos": stack(infos),
        "terminated": done,
    }
