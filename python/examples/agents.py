"""Several agents by PettingZoo's parallel API, random actions: what each observes and earns in an episode.

python examples/agents.py [ID] [--steps N]
"""

import argparse

from robohive.pettingzoo import parallel_env


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("id", nargs="?", default="hive/SpotTag-v0", help='as `robohive.ids("multi_agent")` lists them')
    arguments.add_argument("--steps", type=int, default=200)
    chosen = arguments.parse_args()

    env = parallel_env(chosen.id)
    env.reset(seed=0)
    for agent in env.agents:
        env.action_space(agent).seed(0)
        rows = ", ".join(f"{name} [{unit}] x {length}" for name, (unit, length) in env.rows(agent).items())
        print(f"{agent}: {env.action_space(agent).shape[0]} actions; observes {rows}")
    returns = dict.fromkeys(env.possible_agents, 0.0)
    for _ in range(chosen.steps):
        actions = {agent: env.action_space(agent).sample() for agent in env.agents}
        _, rewards, _, _, _ = env.step(actions)
        for agent, reward in rewards.items():
            returns[agent] += reward
        if not env.agents:
            break
    for agent, total in returns.items():
        print(f"{agent}: return {total:.3f}")
    env.close()


if __name__ == "__main__":
    main()
