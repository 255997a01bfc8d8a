//! Several robots in one world, each an agent that has an action, an observation and a reward of its own ([`crate::team`]).
//!
//! Bodies with feet observe what they observe when they are alone ([`super::locomotion`]), the other body (`mate_error`, where it
//! is in the frame of the heading \[m\]), and what the task adds. Arms observe `joint_pos` and `joint_vel` of arm and fingers, and in the
//! frame of their base \[m\] `tool`, the way from the tool to that of the other arm (`mate_error`) and to their grip of the load
//! (`grip_error`), and from the load to its target (`target_error`); `hold` is 1 while two parts of the hand touch the load.
//! A step lasts 0.02 s. Agents that cooperate share a term of the reward for what they do together, and have terms of their own; the rewards of agents that compete sum up to 0.

mod arms;
pub mod carry_tray;
pub mod hand_over;
pub mod hand_pass;
mod limb;
mod pair;
mod part;
pub mod pass_ball;
pub mod push_box;
pub mod swap;
pub mod tag;
