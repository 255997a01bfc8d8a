"""Episodes from all nodes of a Ray cluster; without one, from a local one of as many nodes as asked for.

python examples/ray_collection.py [--address auto] [--nodes N] [--episodes N]
"""

import argparse
import time

import ray
from ray.cluster_utils import Cluster
from robohive.collect import RandomPolicy
from robohive.ray import Collector


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--id", default="hive/FrankaReach-v0")
    arguments.add_argument("--episodes", type=int, default=500)
    arguments.add_argument("--address", help="of a cluster that runs, e.g. auto")
    arguments.add_argument("--nodes", type=int, default=2, help="of the local cluster")
    chosen = arguments.parse_args()

    if chosen.address:
        ray.init(address=chosen.address)
    else:
        cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 1})
        for _ in range(chosen.nodes - 1):
            cluster.add_node(num_cpus=1)
        ray.init(address=cluster.address, log_to_driver=False)
    collector = Collector(chosen.id, chosen.episodes, policy=RandomPolicy, seed=0)
    began, steps, returns = time.perf_counter(), 0, []
    for episode in collector:
        steps += episode.length
        returns.append(episode.total)
    seconds = time.perf_counter() - began
    mean = sum(returns) / len(returns)
    print(f"{len(returns)} episodes, {steps / seconds:.0f} steps/s, mean return {mean:.2f}, {collector.actors_lost} actors lost")
    ray.shutdown()


if __name__ == "__main__":
    main()
