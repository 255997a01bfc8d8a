"""Collection and learning beyond one machine, on a Ray cluster (needs `pip install robohive[ray]`)."""

from robohive.ray.collector import Collector
from robohive.ray.plan import LostEpisodes
from robohive.ray.train import train

__all__ = ["Collector", "LostEpisodes", "train"]
