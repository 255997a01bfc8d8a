//! Tasks under our own solver and under rapier, by the same scripts: all environments of the suite `hive`, and what a person does by
//! hand on the Franka at its table.
//!
//! ```sh
//! cargo run --release -p robohive-rapier --example tasks -- [EPISODES]
//! ```
//!
//! prints the tables of `validation/results/rapier.md`, of 20 episodes without a number.

use std::error::Error;

#[cfg(unix)]
mod elbow;
#[cfg(unix)]
#[path = "../../../teleop/examples/demonstrations/person.rs"]
mod person;
#[cfg(unix)]
mod play;
#[cfg(unix)]
#[path = "../../../teleop/examples/demonstrations/scene.rs"]
mod scene;
#[cfg(unix)]
#[path = "../../../teleop/examples/demonstrations/speaker.rs"]
mod speaker;
#[cfg(unix)]
#[path = "../../../teleop/examples/demonstrations/steer.rs"]
mod steer;
#[cfg(unix)]
#[path = "../../../teleop/examples/demonstrations/trial.rs"]
mod trial;

#[cfg(unix)]
fn main() -> Result<(), Box<dyn Error>> {
    let episodes: usize = std::env::args().nth(1).map_or(Ok(20), |number| number.parse())?;
    if episodes == 0 {
        return Err("EPISODES is at least 1".into());
    }
    play::table(episodes)?;
    println!("\n| task | device | succeeded: own, rapier | replayed to the bit | ticks, median |");
    println!("|---|---|---|---|---|");
    for task in scene::TASKS {
        for speaker in [speaker::Speaker::Keys, speaker::Speaker::Pad] {
            let [own, other] =
                play::solvers().map(|options| trial::demonstrate(task, speaker, episodes, &options));
            let (own, other) = (own?, other?);
            println!(
                "| {} | {} | {}, {} | {}, {} | {}, {} |",
                task.name(),
                speaker.name(),
                own.succeeded,
                other.succeeded,
                own.replayed,
                other.replayed,
                own.ticks()[0],
                other.ticks()[0]
            );
        }
    }
    Ok(())
}

#[cfg(not(unix))]
fn main() -> Result<(), Box<dyn Error>> {
    Err("sockets need Unix".into())
}
