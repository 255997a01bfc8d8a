//! RoboHive.
