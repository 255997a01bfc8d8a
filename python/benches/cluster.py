#!/usr/bin/env python3
"""What a Ray cluster of several nodes on this machine collects, beside one process, and what is left of a collection whose
nodes are killed.

    python python/benches/cluster.py [--id ID] [--episodes N] [--kills N] [--nodes 1 2 4] [--write FILE]

Needs the package robohive and ray. All nodes are processes of this machine with one processor each, so more nodes than
cores cannot be faster; the episodes of every run are compared with those of one process, bit by bit.
"""

import argparse
import hashlib
import os
import random
import time

os.environ["RAY_ENABLE_WINDOWS_OR_OSX_CLUSTER"] = "0"  # Nodes talk by the loopback address.

import numpy as np
import ray
from ray.cluster_utils import Cluster
from robohive.collect import RandomPolicy, collect
from robohive.ray import Collector
from vectors import replace

ENVS = 16


def mark(episode):
    """Number and hash of an episode."""
    parts = (episode.observations, episode.actions, episode.rewards)
    return episode.index, hashlib.sha256(b"".join(np.ascontiguousarray(p).tobytes() for p in parts)).hexdigest()


def drain(episodes, each=lambda count: None):
    """Marks of all episodes, steps, and seconds from the first request to the last arrival."""
    began, steps, marks = time.perf_counter(), 0, []
    for episode in episodes:
        steps += episode.length
        marks.append(mark(episode))
        each(len(marks))
    return marks, steps, time.perf_counter() - began


def on_cluster(chosen, nodes, kills):
    """A collection on `nodes` nodes of which `kills` die at even intervals, each replaced by another."""
    cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 0})
    for _ in range(nodes):
        cluster.add_node(num_cpus=1)
    ray.init(address=cluster.address, log_to_driver=False)
    dice = random.Random(0)
    at = {round((k + 0.5) * chosen.episodes / kills) for k in range(kills)}

    def kill(count):
        if count in at:
            victim = dice.choice(sorted(cluster.worker_nodes, key=lambda node: node.unique_id))
            cluster.remove_node(victim, allow_graceful=False)
            cluster.add_node(num_cpus=1)

    collector = Collector(chosen.id, chosen.episodes, policy=RandomPolicy, seed=0, envs_per_actor=ENVS)
    try:
        return *drain(collector, kill), collector
    finally:
        ray.shutdown()
        cluster.shutdown()


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--id", default="hive/ElbowPose-v0")
    arguments.add_argument("--episodes", type=int, default=10_000)
    arguments.add_argument("--kills", type=int, default=20)
    arguments.add_argument("--nodes", type=int, nargs="+", default=[1, 2, 4])
    arguments.add_argument("--write", help="file whose table is replaced")
    chosen = arguments.parse_args()

    lines = [
        "| run | steps/s | beside one process, one thread | actors lost | units run again | episodes | same set |",
        "|---|---|---|---|---|---|---|",
    ]
    print("\n".join(lines), flush=True)
    expected, base = None, None

    def report(name, marks, steps, seconds, lost=("", "")):
        nonlocal expected, base
        expected = expected or sorted(marks)
        base = base or steps / seconds
        same = "yes" if sorted(marks) == expected else "NO"
        rate = steps / seconds
        row = f"| {name} | {rate:.0f} | {rate / base:.2f} | {lost[0]} | {lost[1]} | {len(marks)} | {same} |"
        lines.append(row)
        print(row, flush=True)

    for threads in (1, os.cpu_count()):
        episodes = collect(
            chosen.id, chosen.episodes, policy=RandomPolicy, seed=0, num_envs=ENVS * threads, threads=threads
        )
        report(f"one process, {threads} thread{'s' * (threads > 1)}", *drain(episodes))
    for nodes in chosen.nodes:
        *result, _ = on_cluster(chosen, nodes, 0)
        report(f"{nodes} node{'s' * (nodes > 1)}", *result)
    *result, collector = on_cluster(chosen, 2, chosen.kills)
    report(f"2 nodes, {chosen.kills} kills", *result, (collector.actors_lost, collector.units_lost))
    if chosen.write:
        replace(chosen.write, "ray", lines)


if __name__ == "__main__":
    main()
