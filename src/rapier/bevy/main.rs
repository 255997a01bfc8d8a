//! A Bevy program without a window that simulates with rapier, and a quadruped out of MJCF in it: it trots through crates.
//!
//! ```sh
//! cargo run -p robohive-bevy
//! ```
//!
//! The program owns rapier's sets, as programs in Bevy do. A plugin steps them in `FixedUpdate`, and copies the poses of
//! colliders into `Transform`s. The robot is a component beside them, whose systems run around rapier's step. The exit
//! status says whether it walked and pushed the crates.

mod judge;
mod physics;
mod quadruped;

use bevy_app::ScheduleRunnerPlugin;
use bevy_app::prelude::*;
use bevy_time::{Fixed, Time, TimePlugin, TimeUpdateStrategy};
use bevy_transform::TransformPlugin;
use physics::STEP;
use std::time::Duration;

fn main() -> AppExit {
    App::new()
        // As fast as the machine allows: every update of the program is a step of the simulation.
        .add_plugins((ScheduleRunnerPlugin::run_loop(Duration::ZERO), TimePlugin, TransformPlugin))
        .insert_resource(TimeUpdateStrategy::ManualDuration(STEP))
        .insert_resource(Time::<Fixed>::from_duration(STEP))
        .add_plugins((physics::RapierPlugin, quadruped::QuadrupedPlugin, judge::JudgePlugin))
        .run()
}
