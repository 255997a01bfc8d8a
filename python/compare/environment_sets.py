"""Environments of other packages that are played on MuJoCo and on the stand-in."""

import importlib.util
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class EnvironmentSet:
    """Environments of one origin: where they are from, and what a reader of the comparison must know."""

    title: str
    packages: tuple[str, ...]
    ids: Callable[[], list[str]]
    """Ids in the order of the table, as `make` takes them."""
    folders: tuple[str, ...]
    """Folders in the packages whose uses of MuJoCo's names are counted."""
    note: str = ""

    def sources(self) -> list[Path]:
        """These folders, where they are installed."""
        return [_installed(folder) for folder in self.folders]


def _installed(folder: str) -> Path:
    package, *rest = folder.split("/")
    spec = importlib.util.find_spec(package)
    if spec is None or spec.origin is None:
        raise SystemExit(f"{package} is not installed: pip install {package}")
    return Path(spec.origin).parent.joinpath(*rest)


def _gymnasium_ids() -> list[str]:
    walkers = (
        "Ant Humanoid HumanoidStandup HalfCheetah Hopper Walker2d Swimmer Reacher Pusher InvertedPendulum "
        "InvertedDoublePendulum"
    )
    robots = (
        "FetchReach-v4 FetchPush-v4 FetchSlide-v4 FetchPickAndPlace-v4 "
        "HandReach-v3 HandManipulateBlock-v1 HandManipulateBlockRotateZ-v1 HandManipulateBlockRotateXYZ-v1 "
        "HandManipulateBlock_BooleanTouchSensors-v1 HandManipulateBlock_ContinuousTouchSensors-v1 HandManipulateEgg-v1 "
        "HandManipulateEggRotate-v1 HandManipulateEgg_ContinuousTouchSensors-v1 HandManipulatePen-v1 "
        "HandManipulatePenRotate-v1 HandManipulatePen_BooleanTouchSensors-v1 "
        "PointMaze_UMaze-v3 PointMaze_Open-v3 PointMaze_Medium-v3 PointMaze_Large-v3 PointMaze_Open_Diverse_GR-v3 "
        "AntMaze_UMaze-v5 AntMaze_Open-v5 AntMaze_Medium-v5 AntMaze_Large-v5 AntMaze_Medium_Diverse_GR-v5"
    )
    return [f"{name}-v5" for name in walkers.split()] + robots.split()


def _metaworld_ids() -> list[str]:
    import metaworld

    return [f"Meta-World/{name}" for name in metaworld.ALL_V3_ENVIRONMENTS]


SETS = {
    "gymnasium": EnvironmentSet(
        "Gymnasium's environments",
        ("gymnasium", "gymnasium-robotics"),
        _gymnasium_ids,
        ("gymnasium/envs/mujoco", "gymnasium_robotics"),
        "Gymnasium-Robotics' Fetch and hand environments do not start on MuJoCo 3.12's bindings, whose enumerations are "
        "not equal to numpy's integers; for this comparison they were replaced by integers on both sides.",
    ),
    "metaworld": EnvironmentSet(
        "Meta-World's tasks",
        ("metaworld", "gymnasium"),
        _metaworld_ids,
        ("metaworld",),
        "A task is `Meta-World/MT1` of its name with seed 0; each reset draws one of its 50 goals.",
    ),
}


def make(name: str):
    """The environment of an id of any set."""
    import gymnasium

    if name.startswith("Meta-World/"):
        import metaworld  # noqa: F401, registers its ids

        return gymnasium.make("Meta-World/MT1", env_name=name.removeprefix("Meta-World/"), seed=0)
    if importlib.util.find_spec("gymnasium_robotics"):
        import gymnasium_robotics

        gymnasium.register_envs(gymnasium_robotics)
    return gymnasium.make(name)
