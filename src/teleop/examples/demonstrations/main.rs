//! Demonstrations by a scripted person, who sees the scene as it is drawn and speaks in the bytes of devices over a socket: reaching,
//! pushing, picking and holding up, on the Franka at its table. `cargo run --release -p robohive-teleop --example demonstrations -- [EPISODES]`
//! prints a row for each task and device, 20 episodes without a number. Time is virtual: a tick is a tick.

use std::error::Error;

#[cfg(unix)]
mod person;
#[cfg(unix)]
mod scene;
#[cfg(unix)]
mod speaker;
#[cfg(unix)]
mod trial;

#[cfg(unix)]
fn main() -> Result<(), Box<dyn Error>> {
    let episodes = std::env::args().nth(1).map_or(Ok(20), |number| number.parse())?;
    println!(
        "| task | device | episodes | succeeded | replayed to the bit | ticks of 0.08 s, median | most |"
    );
    println!("|---|---|---|---|---|---|---|");
    for task in scene::TASKS {
        for speaker in [speaker::Speaker::Keys, speaker::Speaker::Pad] {
            println!("{}", trial::demonstrate(task, speaker, episodes, &env::Options::default())?);
        }
    }
    Ok(())
}

#[cfg(not(unix))]
fn main() -> Result<(), Box<dyn Error>> {
    Err("sockets need Unix".into())
}
