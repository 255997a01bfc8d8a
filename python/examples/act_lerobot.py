"""LeRobot's action chunking transformer (Zhao et al. 2023) on demonstrations of a controller.

    python act_lerobot.py FOLDER [--id ID] [--demonstrations N] [--updates N] [--episodes N]

Records solved episodes as a dataset of LeRobot in FOLDER/demonstrations, unless that is there already, trains LeRobot's own
policy on it, and plays it in the environment. The policy observes numbers and no pictures.
Needs `pip install lerobot==0.4.4`; a few minutes of one core.
"""

import argparse
import time
from pathlib import Path
from typing import Any

import numpy as np
import robohive
import torch
from lerobot.configs.types import FeatureType, NormalizationMode
from lerobot.datasets.lerobot_dataset import LeRobotDataset
from lerobot.datasets.utils import dataset_to_policy_features
from lerobot.policies.act.configuration_act import ACTConfig
from lerobot.policies.act.modeling_act import ACTPolicy
from lerobot.policies.act.processor_act import make_act_pre_post_processors
from robohive.data import LeRobotWriter
from robohive.envs import RoboHiveEnv
from torch.utils.data import default_collate

# LeRobot tells apart the states of robot and environment, and its transformer wants both: an observation serves as either.
OBSERVATIONS = ("observation.state", "observation.environment_state")
BATCH = 32


def record(id: str, wanted: int, folder: Path) -> None:
    """Writes episodes that the best controller of an id has solved, of at most twice as many seeds."""
    env = robohive.make(id)
    controller = env.controller()
    kept = steps = 0
    with LeRobotWriter(folder, fps=1.0 / env.dt) as writer:
        for seed in range(2 * wanted):
            env.seed(seed)
            path = env.examine_policy(controller, horizon=env.horizon, num_episodes=1, mode="evaluation")[0]
            if env.evaluate_success([path]) == 0.0:
                continue
            observations, actions = (path[key].astype(np.float32) for key in ("observations", "actions"))
            writer.add({**dict.fromkeys(OBSERVATIONS, observations), "action": actions}, task=f"what {id} asks for")
            kept, steps = kept + 1, steps + len(actions)
            if kept == wanted:
                break
        else:
            raise SystemExit(f"{controller.name} solved {kept} of {2 * wanted} episodes of {id}; ask for fewer demonstrations")
    print(f"{folder}: {kept} episodes, {steps} steps by {controller.name}")


class Chunks:
    """A trained policy by the protocol of `RoboHiveEnv.examine_policy`: it plans a chunk of actions, and plays it."""

    def __init__(self, env: RoboHiveEnv, policy: ACTPolicy, before: Any, after: Any) -> None:
        self.env, self.policy, self.before, self.after = env, policy, before, after
        self.time = float("inf")

    def get_action(self, observation: np.ndarray) -> tuple[np.ndarray, dict[str, Any]]:
        if self.env.time < self.time:
            self.policy.reset()
        self.time = self.env.time
        batch = self.before(dict.fromkeys(OBSERVATIONS, torch.as_tensor(observation, dtype=torch.float32)))
        action = self.after(self.policy.select_action(batch)).squeeze(0).numpy()
        action = action.clip(self.env.action_space.low, self.env.action_space.high)
        return action, {"evaluation": action}


def learn(folder: Path, updates: int) -> tuple[ACTPolicy, Any, Any]:
    """Trains a small transformer on a dataset; returns it with what comes before and after it."""
    meta = LeRobotDataset("robohive/demonstrations", root=folder).meta
    features = dataset_to_policy_features(meta.features)
    config = ACTConfig(
        input_features={key: features[key] for key in OBSERVATIONS},
        output_features={key: feature for key, feature in features.items() if feature.type is FeatureType.ACTION},
        normalization_mapping={kind: NormalizationMode.MEAN_STD for kind in ("STATE", "ENV", "ACTION")},
        chunk_size=10,
        n_action_steps=5,
        dim_model=64,
        n_heads=4,
        dim_feedforward=256,
        n_encoder_layers=2,
        n_vae_encoder_layers=1,
        device="cpu",
    )
    policy = ACTPolicy(config)
    before, after = make_act_pre_post_processors(config, dataset_stats=meta.stats)
    ahead = {"action": [step / meta.fps for step in range(config.chunk_size)]}
    dataset = LeRobotDataset("robohive/demonstrations", root=folder, delta_timestamps=ahead)
    keys = (*OBSERVATIONS, "action", "action_is_pad")
    frames = default_collate([{key: frame[key] for key in keys} for frame in map(dataset.__getitem__, range(len(dataset)))])

    optimizer = torch.optim.AdamW(policy.parameters(), lr=1e-3, weight_decay=config.optimizer_weight_decay)
    schedule = torch.optim.lr_scheduler.CosineAnnealingLR(optimizer, updates)
    policy.train()
    began = time.process_time()
    for update in range(1, updates + 1):
        chosen = torch.randint(len(dataset), (BATCH,))
        loss, parts = policy(before({key: rows[chosen] for key, rows in frames.items()}))
        optimizer.zero_grad()
        loss.backward()
        torch.nn.utils.clip_grad_norm_(policy.parameters(), 10.0)
        optimizer.step()
        schedule.step()
        if update % max(1, updates // 10) == 0:
            rate = update * BATCH / (time.process_time() - began)
            print(f"update {update}: error of an action {parts['l1_loss']:.3f} of its deviation, {rate:.0f} samples a second")
    return policy, before, after


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--id", default="hive/FrankaReachRandom-v0")
    parser.add_argument("--demonstrations", type=int, default=100)
    parser.add_argument("--updates", type=int, default=3000)
    parser.add_argument("--episodes", type=int, default=50, help="episodes of the evaluation, seeded from 10,000 on")
    chosen = parser.parse_args()

    torch.manual_seed(0)
    torch.set_num_threads(1)
    demonstrations = chosen.folder / "demonstrations"
    if not demonstrations.exists():
        chosen.folder.mkdir(parents=True, exist_ok=True)
        record(chosen.id, chosen.demonstrations, demonstrations)
    env = robohive.make(chosen.id)
    policy = Chunks(env, *learn(demonstrations, chosen.updates))
    env.seed(10_000)
    paths = env.examine_policy(policy, horizon=env.horizon, num_episodes=chosen.episodes, mode="evaluation")
    print(f"{env.evaluate_success(paths):.1f} % of {chosen.episodes} episodes of {chosen.id} solved")


if __name__ == "__main__":
    main()
