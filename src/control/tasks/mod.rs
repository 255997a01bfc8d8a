//! Adaptors of controllers to tasks, a folder for each suite and a file for each task.

pub mod arms;
pub mod classical;
pub mod claws;
pub mod deformable;
pub mod in_hand;
mod joints;
pub mod locomotion;
pub mod multi_agent;
pub mod muscles;
pub mod planner;
pub mod pose;
mod roles;
pub mod tabletop;
