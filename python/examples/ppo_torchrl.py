"""Proximal policy optimisation by TorchRL's collector and losses on an environment of RoboHive.

python examples/ppo_torchrl.py [--id ID] [--frames N]

Prints the mean return of the episodes that ended, and the steps a second of collecting and learning, after every tenth update.
"""

import argparse
import time

import robohive  # noqa: F401
import torch
from tensordict.nn import TensorDictModule
from torch import nn
from torchrl.collectors import Collector
from torchrl.envs import Compose, DoubleToFloat, GymEnv, ObservationNorm, RewardSum, TransformedEnv
from torchrl.modules import NormalParamExtractor, ProbabilisticActor, TanhNormal, ValueOperator
from torchrl.objectives import ClipPPOLoss
from torchrl.objectives.value import GAE

BATCH, MINIBATCH, EPOCHS = 1000, 250, 8


def network(*outside: nn.Module, outputs: int) -> nn.Sequential:
    """Two hidden layers of 64, as in `ppo.py`."""
    return nn.Sequential(nn.LazyLinear(64), nn.Tanh(), nn.LazyLinear(64), nn.Tanh(), nn.LazyLinear(outputs), *outside)


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--id", default="hive/FrankaReach-v0")
    arguments.add_argument("--frames", type=int, default=200_000)
    chosen = arguments.parse_args()

    torch.manual_seed(0)
    normalised = ObservationNorm(in_keys=["observation"], standard_normal=True)
    env = TransformedEnv(GymEnv(chosen.id), Compose(DoubleToFloat(in_keys=["observation"]), normalised, RewardSum()))
    normalised.init_stats(1000)
    parameters = network(NormalParamExtractor(), outputs=2 * env.action_spec.shape[-1])
    policy = ProbabilisticActor(
        TensorDictModule(parameters, in_keys=["observation"], out_keys=["loc", "scale"]),
        in_keys=["loc", "scale"],
        spec=env.action_spec,
        distribution_class=TanhNormal,
        return_log_prob=True,
    )
    value = ValueOperator(network(outputs=1), in_keys=["observation"])
    start = env.reset()
    policy(start), value(start)
    advantages = GAE(gamma=0.95, lmbda=0.95, value_network=value, average_gae=True)
    losses = ClipPPOLoss(policy, value, entropy_coeff=0.0)
    optimizer = torch.optim.Adam(losses.parameters(), lr=1e-3)

    collector = Collector(
        env, policy, frames_per_batch=BATCH, total_frames=chosen.frames, auto_register_policy_transforms=True
    )
    began, returns = time.process_time(), []
    for update, batch in enumerate(collector, 1):
        with torch.no_grad():
            advantages(batch)
        rows = batch.reshape(-1)
        for _ in range(EPOCHS):
            for part in torch.randperm(len(rows)).split(MINIBATCH):
                found = losses(rows[part])
                loss = found["loss_objective"] + found["loss_critic"]
                optimizer.zero_grad()
                loss.backward()
                nn.utils.clip_grad_norm_(losses.parameters(), 0.5)
                optimizer.step()
        collector.update_policy_weights_()
        returns += batch["next", "episode_reward"][batch["next", "done"]].tolist()
        if (update % 10 == 0 or update * BATCH >= chosen.frames) and returns:
            rate = update * BATCH / (time.process_time() - began)
            print(f"update {update}: mean return {sum(returns) / len(returns):.2f}, {rate:.0f} steps/s", flush=True)
            returns = []
    collector.shutdown()


if __name__ == "__main__":
    main()
