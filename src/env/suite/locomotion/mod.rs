//! Locomotion: bodies with feet that stand, turn, walk to a place, and follow a velocity.
//!
//! No task names a robot. Each finds root and feet by the roles of the body (`roles.toml` of its folder), and its registry
//! rows name the arena and what stands in it: `define = [["ROBOT", "spot"], ["TOP", "body"]]`. What follows is the same for
//! all of them.
//!
//! A body that swims has no feet and does not fall; its tasks count lengths in quarters of it.
//!
//! Observed: `height` of the root over the lowest foot \[m\]; `up`, the vertical in the frame of the root (forward, left, up);
//! `velocity` \[m/s\] and `turning` \[rad/s\] in the frame of the heading; `joint_pos`, `joint_vel`; `feet`, relative to the root in
//! the frame of the heading \[m\]; `last_action`, the controls; and what the task adds. A step lasts 0.02 s, and an episode ends
//! when the body has fallen, as its roles say. Terms of the reward and their weights follow MuJoCo Playground's joystick tasks
//! (Zakka et al., "MuJoCo Playground", 2025, appendix), with a term that is 1 while the task is solved.

pub mod chase;
mod floor;
mod interval;
pub(super) mod mark;
mod push;
pub mod push_box;
pub mod stand;
pub mod turn;
pub mod velocity;
pub mod walk_to;
pub(super) mod walker;
pub mod weave;

/// Time steps of the physics in one step of the environment: 0.02 s at the arenas' 2 ms.
pub(super) const FRAME_SKIP: usize = 10;
