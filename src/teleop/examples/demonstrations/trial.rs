//! Episodes of a task by a device: driven, recorded, replayed, counted.

use super::person::Person;
use super::scene::Task;
use super::speaker::{Line, Speaker};
use dataset::trace::{Layout, Precision, TraceReader};
use env::{Env, Options};
use record::{Recorded, Recording};
use robohive_teleop::{Control, Held, Mapping, Mark, Plan, Session};
use std::error::Error;
use std::fmt;
use std::path::{Path, PathBuf};

/// Ticks after which a person gives up.
const PATIENCE: usize = 400;

/// What came of the episodes of a task.
#[derive(Debug)]
pub struct Outcome {
    task: &'static str,
    device: &'static str,
    /// Episodes, those of them that succeeded, and those whose replay ends solved in the state that was recorded.
    pub episodes: usize,
    pub succeeded: usize,
    pub replayed: usize,
    ticks: Vec<usize>,
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Outcome { task, device, episodes, succeeded, replayed, .. } = self;
        let [middle, most] = self.ticks();
        write!(f, "| {task} | {device} | {episodes} | {succeeded} | {replayed} | {middle} | {most} |")
    }
}

impl Outcome {
    /// Ticks of an episode: the median, and the most.
    pub fn ticks(&self) -> [usize; 2] {
        [self.ticks[self.ticks.len() / 2], self.ticks[self.ticks.len() - 1]]
    }
}

/// Drives episodes of seeds 0, 1 and so on, and counts.
///
/// # Errors
/// The environment, the socket or the file refuse.
pub fn demonstrate(
    task: Task,
    speaker: Speaker,
    episodes: usize,
    options: &Options,
) -> Result<Outcome, Box<dyn Error>> {
    let mut mapping = Mapping::default();
    let plan = Plan { episodes, horizon: PATIENCE, ..Plan::default() };
    let mut session = Session::new(task.env(options)?, Control::Hand, &mapping, plan)?;
    let (mut line, mut held) = (Line::new(speaker)?, Held::default());
    held.tells_releases(true);
    let path = file(task, speaker);
    let mut file = Recording::create(&path, Layout::RoboHive, Precision::Full, &[])?;
    let (mut person, mut ticks, mut now) = (Person::default(), Vec::new(), 0.0);
    loop {
        now += session.env().dt();
        for event in line.say(&person.wish(session.env(), task), now)? {
            held.apply(event, now);
        }
        let mut input = mapping.read(&held.sample(now));
        // Who has nothing to say waits with time going on.
        if session.is_paused() && input.marks.is_empty() && !input.motion.moves() {
            input.marks.push(Mark::Pause);
        }
        let ticked = session.tick(&input)?;
        if let Some(finished) = ticked.finished {
            file.add(&finished.kept)?;
            ticks.push(finished.steps);
            person = Person::default();
        }
        if ticked.over {
            break;
        }
    }
    file.close()?;
    let succeeded = session.counts().1;
    let replayed = replay(task.env(options)?, &path, episodes)?;
    std::fs::remove_file(&path)?;
    ticks.sort_unstable();
    Ok(Outcome { task: task.name(), device: speaker.name(), episodes, succeeded, replayed, ticks })
}

fn file(task: Task, speaker: Speaker) -> PathBuf {
    let name = format!("robohive-{}-{task:?}-{speaker:?}.h5", std::process::id());
    std::env::temp_dir().join(name)
}

/// How many recorded episodes end solved when their actions are taken once more, in the observation that was recorded.
fn replay(mut env: Env, path: &Path, episodes: usize) -> Result<usize, Box<dyn Error>> {
    let trace = TraceReader::open(path)?;
    let mut alike = 0;
    for episode in 0..episodes {
        let recorded = Recorded::read(&trace, &format!("Trial{episode}"))?;
        env.reset(recorded.seed)?;
        for action in (0..).map_while(|row| recorded.actions.row(row)).filter(|row| row[0].is_finite()) {
            env.step(action)?;
        }
        let last = recorded.observations.as_ref().and_then(|rows| rows.last());
        alike += usize::from(env.verdict().solved && Some(env.observation()) == last);
    }
    Ok(alike)
}
