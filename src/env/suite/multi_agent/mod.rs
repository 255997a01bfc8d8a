//! Several robots in one world, each an agent that has an action, an observation and a reward of its own ([`crate::team`]).
//!
//! Bodies with feet observe what they observe when they are alone ([`super::locomotion`]), the other body (`mate_error`, where it
//! is in the frame of the heading \[m\]), and what the task adds. A step lasts 0.02 s. Agents that cooperate share a term of the
//! reward for what they do together, and have terms of their own; the rewards of agents that compete sum up to 0.

mod pair;
pub mod push_box;
pub mod swap;
pub mod tag;
