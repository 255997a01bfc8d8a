//! In-hand manipulation: hands that turn, roll and squeeze what lies in them.
//!
//! No task names a hand. Each finds palm, fingertips and the pose that cradles a thing by the roles of the hand (`roles.toml` of its
//! folder), and its registry rows name the hand: `define = [["HAND", "allegro"]]`. A thing lies at the site `cradle`.

pub mod baoding;
mod hand;
pub mod reorient;
pub mod soft_ball;
