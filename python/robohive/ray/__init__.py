"""Collection and learning beyond one machine, on a Ray cluster (needs `pip install robohive[ray]`)."""

from robohive.ray.collector import Collector
from robohive.ray.plan import LostEpisodes

__all__ = ["Collector", "LostEpisodes"]
