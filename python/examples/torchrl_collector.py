"""A collector of TorchRL over an environment of RoboHive.

python examples/torchrl_collector.py [--id ID] [--frames N]
"""

import argparse

import robohive  # noqa: F401
import torch
from tensordict.nn import TensorDictModule
from torch import nn
from torchrl.collectors import SyncDataCollector
from torchrl.envs import GymEnv, RewardSum, TransformedEnv
from torchrl.modules import NormalParamExtractor, ProbabilisticActor, TanhNormal


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--id", default="hive/FrankaReach-v0")
    arguments.add_argument("--frames", type=int, default=2000)
    chosen = arguments.parse_args()

    torch.manual_seed(0)
    env = TransformedEnv(GymEnv(chosen.id), RewardSum())
    actions = env.action_spec.shape[-1]
    network = nn.Sequential(nn.LazyLinear(64), nn.Tanh(), nn.Linear(64, 2 * actions), NormalParamExtractor())
    policy = ProbabilisticActor(
        TensorDictModule(network, in_keys=["observation"], out_keys=["loc", "scale"]),
        in_keys=["loc", "scale"],
        spec=env.action_spec,
        distribution_class=TanhNormal,
    )
    policy(env.reset())
    collector = SyncDataCollector(env, policy, frames_per_batch=500, total_frames=chosen.frames)
    for batch in collector:
        ended = batch["next", "done"].squeeze(-1)
        returns = batch["next", "episode_reward"].squeeze(-1)[ended]
        print(f"{batch.numel()} frames, {int(ended.sum())} episodes, mean return {returns.mean():.2f}")
    collector.shutdown()


if __name__ == "__main__":
    main()
