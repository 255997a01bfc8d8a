//! Episodes of the suite `hive` under both solvers, by scripts that solve them.

use crate::elbow::Elbow;
use crate::person::Person;
use crate::scene::Task;
use crate::speaker::TICK;
use crate::steer::towards_target;
use env::episode::{Summary, evaluate};
use env::{Env, Options, OwnModels};
use robohive_rapier::engine;
use robohive_teleop::{Control, Mapping, Motion, Pilot};
use std::error::Error;

/// The environments, and what acts in each.
const HIVE: [(&str, Script); 4] = [
    ("hive/FrankaReach-v0", Script::Hand),
    ("hive/FrankaReach_v2d-v0", Script::Hand),
    ("hive/ElbowPose-v0", Script::Muscles),
    ("hive/QuadrupedWalk-v0", Script::Base),
];

/// A script.
#[derive(Clone, Copy)]
enum Script {
    /// The person of the demonstrations moves the hand, by inverse kinematics.
    Hand,
    /// Feedback of the elbow's angle excites its muscles.
    Muscles,
    /// The person steers, and the robot trots.
    Base,
}

impl Script {
    fn name(self) -> &'static str {
        match self {
            Script::Hand => "hand to the target, inverse kinematics",
            Script::Muscles => "feedback to muscles",
            Script::Base => "trot, steered to the target",
        }
    }
}

/// A script in an environment.
enum Player {
    Hand(Pilot),
    Muscles(Elbow),
    Base(Pilot),
}

impl Player {
    fn new(script: Script, env: &Env) -> Result<Self, Box<dyn Error>> {
        let pilot = |control| Pilot::new(env, control, &Mapping::default());
        Ok(match script {
            Script::Hand => Player::Hand(pilot(Control::Hand)?),
            Script::Muscles => Player::Muscles(Elbow::new(env)),
            Script::Base => Player::Base(pilot(Control::Base)?),
        })
    }

    fn act(&mut self, env: &mut Env) -> Result<Vec<f64>, Box<dyn Error>> {
        let mut motion = Motion::default();
        match self {
            Player::Muscles(elbow) => return Ok(elbow.act(env)),
            Player::Hand(_) => {
                // The hand is behind what it is told: at the target it is told no more.
                let wish = Person::default().wish(env, Task::Reach);
                let part = if wish.done { 0.0 } else { 1.0 / TICK };
                motion.arms[0].along[..3].copy_from_slice(&wish.by.map(|way| part * way));
            }
            Player::Base(_) => motion.base = towards_target(env),
        }
        let (Player::Hand(pilot) | Player::Base(pilot)) = self else { return Ok(Vec::new()) };
        Ok(pilot.act(env, &motion)?.0.to_vec())
    }
}

/// Our own solver, and rapier.
pub fn solvers() -> [Options; 2] {
    [Options::default(), Options::default().with_engine(engine(robohive_rapier::Options::default()))]
}

/// Success of episodes of seeds 0, 1 and so on \[%\], and steps until the first solved state, the median.
fn play(
    id: &str,
    script: Script,
    episodes: usize,
    options: &Options,
) -> Result<(f64, usize), Box<dyn Error>> {
    let mut env = Env::make(id, &OwnModels, options)?;
    let (mut played, mut first) = (Vec::new(), Vec::new());
    for seed in 0..episodes {
        env.reset(Some(seed as u64))?;
        let mut player = Player::new(script, &env)?;
        let mut summary = Summary::default();
        let mut until = usize::MAX;
        while !summary.terminated && !summary.truncated {
            let action = player.act(&mut env)?;
            let step = env.step(&action)?;
            summary.add(&env, &step);
            if summary.solved > 0 {
                until = until.min(summary.steps);
            }
        }
        first.push(until);
        played.push(summary);
    }
    first.sort_unstable();
    Ok((evaluate(&played, env.success()).success_percentage, first[first.len() / 2]))
}

/// Prints a row for each environment.
///
/// # Errors
/// An environment refuses.
pub fn table(episodes: usize) -> Result<(), Box<dyn Error>> {
    println!(
        "| environment | script | success: own, rapier | first solved after steps, median |\n|---|---|---|---|"
    );
    for (id, script) in HIVE {
        let [own, other] = solvers().map(|options| play(id, script, episodes, &options));
        let ((own, first), (other, other_first)) = (own?, other?);
        println!("| {id} | {} | {own:.0} %, {other:.0} % | {first}, {other_first} |", script.name());
    }
    Ok(())
}
