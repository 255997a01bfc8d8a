//! Gymnasium's locomotion tasks, version 5: Ant, Humanoid, Walker2d, HalfCheetah and Hopper.
//!
//! Observations, rewards, ends of episodes, settings and distributions of first states are those that Gymnasium documents
//! (<https://gymnasium.farama.org/environments/mujoco/>). Its models are not part of this project: the setting `model_path`
//! names one, `gymnasium/envs/mujoco/assets/ant.xml` of an installed package for example. Controls reach the actuators as
//! they are given, and a step is the frame skip's number of physics steps with no forward pass after them
//! ([`crate::task::Timing::Plain`]), so that what is observed of bodies and forces is of one time step before.

pub(super) mod ant;
pub(super) mod humanoid;
pub(super) mod planar;
mod progress;
mod start;
