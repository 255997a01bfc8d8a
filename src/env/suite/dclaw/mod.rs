//! ROBEL's D'Claw: three fingers of three joints that take a pose, turn a valve, or keep it turning.
//!
//! RoboHive's paper lists these tasks and its models contain the robot, but the original registers none of them. Rewards,
//! scores, distributions of what is drawn and lengths of episodes come from ROBEL (`robel/dclaw/`: `base_env.py`,
//! `pose.py`, `turn.py`, `screw.py`, `__init__.py` of <https://github.com/google-research/robel>, Apache-2.0; Ahn et al.,
//! "ROBEL: Robotics Benchmarks for Learning with Low-Cost Robots", CoRL 2019). A task is `solved` where ROBEL's score
//! `success` is true, the sparse reward is its score `points`, and no task ends an episode before its length.
//!
//! Three things are RoboHive's: weights stand beside the terms of the reward instead of in them; actions are positions over the
//! ranges of the actuators, where ROBEL bounds the joints more closely (a middle joint to 60 degrees) and commands at most
//! 120 degrees a second; an episode is a success by RoboHive's count of solved steps. ROBEL's variants that draw dynamics and
//! noise, and its scores of safety, are not here.
//!
//! The joint of the valve is limited to a turn each way, which a screw can reach whose mark starts far from zero.

mod claw;
pub(super) mod pose;
pub(super) mod screw;
pub(super) mod turn;
mod valve;
