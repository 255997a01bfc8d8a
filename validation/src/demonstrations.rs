//! Recorded demonstrations, replayed: how far the last state is from the recorded one.
//!
//! The demonstrations belong to Rajeswaran et al. (2018), whose repository `hand_dapg` keeps them as pickles in
//! `dapg/demonstrations`: trajectories of human hands in virtual reality, made with MuJoCo 1.5. Each gives its first state,
//! its actions, and what was observed before every action.

use dataset::pickle::{Pickle, Value};
use env::{Compat, Env, Folder, Options, WorldState};
use std::fmt::Write;
use std::path::Path;

/// The environment.
const ID: &str = "door-v1";
/// The body whose place each trajectory gives.
const FRAME: &str = "frame";
/// What the recorded observations consist of.
const ROWS: [&str; 7] =
    ["hand_jnt", "latch_pos", "door_pos", "palm_pos", "handle_pos", "reach_err", "door_open"];
/// Upper ends of the histogram's bins \[rad\].
const BINS: [f64; 6] = [0.003, 0.01, 0.03, 0.1, 0.3, 1.0];

/// A replayed trajectory.
#[derive(Clone, Debug)]
pub struct Replay {
    /// Actions replayed.
    pub steps: usize,
    /// Differences of the last observation: largest of the joints of the hand \[rad\].
    pub hand: f64,
    /// Angle of the door \[rad\].
    pub door: f64,
    /// Place of the palm \[m\].
    pub palm: f64,
    /// The door's angle at the end \[rad\]: recorded, and ours.
    pub angles: [f64; 2],
}

struct Trajectory {
    qpos: Vec<f64>,
    qvel: Vec<f64>,
    frame: Vec<f64>,
    /// One row a step.
    actions: Vec<Vec<f64>>,
    /// What was observed before the last action.
    last: Vec<f64>,
}

fn trajectory(value: Value<'_>) -> Result<Trajectory, String> {
    let array = |from: Value<'_>, name: &str| {
        let value = from.get(name).ok_or_else(|| format!("it has no {name}"))?;
        value.array().map_err(|error| format!("{name}: {error}"))
    };
    let start = value.get("init_state_dict").ok_or("it has no init_state_dict")?;
    let numbers = |name: &str| Ok::<_, String>(array(start, name)?.values.to_f64());
    let rows = |name: &str| {
        let array = array(value, name)?;
        let width = array.shape.get(1).copied().filter(|&width| width > 0 && array.rows() > 0);
        let width = width.ok_or_else(|| format!("{name} is no table of numbers"))?;
        Ok::<_, String>(array.values.to_f64().chunks(width).map(<[f64]>::to_vec).collect::<Vec<_>>())
    };
    let (actions, mut observations) = (rows("actions")?, rows("observations")?);
    if actions.len() != observations.len() {
        return Err(format!("it has {} actions and {} observations", actions.len(), observations.len()));
    }
    Ok(Trajectory {
        qpos: numbers("qpos")?,
        qvel: numbers("qvel")?,
        frame: numbers("door_body_pos")?,
        actions,
        last: observations.pop().unwrap_or_default(),
    })
}

/// Replays all demonstrations of a file.
///
/// # Errors
/// A model or the file cannot be read, or physics refuses a step.
pub fn replay(assets: &Path, file: &Path) -> Result<Vec<Replay>, String> {
    let bytes = std::fs::read(file).map_err(|error| format!("{}: {error}", file.display()))?;
    let pickle = Pickle::parse(&bytes).map_err(|error| format!("{}: {error}", file.display()))?;
    let options = Options::default().with_compat(Compat::RoboHive07);
    let mut env = Env::make(ID, &Folder::new(assets), &options).map_err(|error| error.to_string())?;
    let each = |(k, value)| {
        let wrong = |error| format!("{}, trajectory {k}: {error}", file.display());
        one(&mut env, &trajectory(value).map_err(wrong)?).map_err(wrong)
    };
    pickle.root().items().enumerate().map(each).collect()
}

fn one(env: &mut Env, trajectory: &Trajectory) -> Result<Replay, String> {
    env.reset(Some(0)).map_err(|error| error.to_string())?;
    let frame = env.scene().body(FRAME).map_err(|error| error.to_string())?.index();
    let mut places = env.scene().model.body_pos.as_flattened().to_vec();
    places[3 * frame..3 * frame + 3]
        .copy_from_slice(trajectory.frame.get(..3).ok_or("door_body_pos has not 3 values")?);
    let start = WorldState {
        qpos: Some(trajectory.qpos.clone()),
        qvel: Some(trajectory.qvel.clone()),
        body_pos: Some(places),
        ..env.world()
    };
    env.set_world(&start).map_err(|error| error.to_string())?;
    let before = trajectory.actions.len() - 1;
    for action in &trajectory.actions[..before] {
        let step = env.step(action).map_err(|error| error.to_string())?;
        if let Some(fault) = step.fault {
            return Err(fault.to_string());
        }
    }
    let parts: Vec<_> = ROWS.iter().filter_map(|row| env.rows().get(row)).collect();
    if parts.concat().len() != trajectory.last.len() {
        return Err(format!("its observations have {} values", trajectory.last.len()));
    }
    let mut rest = trajectory.last.as_slice();
    let mut difference = |row: usize| {
        let (recorded, others) = rest.split_at(parts[row].len());
        rest = others;
        recorded.iter().zip(parts[row]).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
    };
    let [hand, _, door, palm] = [0, 1, 2, 3].map(&mut difference);
    let angle = parts[0].len() + 1;
    Ok(Replay { steps: before, hand, door, palm, angles: [trajectory.last[angle], parts[2][0]] })
}

/// The trajectories, and the histogram of how far their last states are from the recorded ones.
pub fn render(replays: &[Replay]) -> String {
    let mut text = String::from(
        "| trajectory | steps | hand [rad] | door [rad] | palm [m] | door recorded | door replayed |\n\
         |---|---|---|---|---|---|---|\n",
    );
    for (k, replay) in replays.iter().enumerate() {
        let Replay { steps, hand, door, palm, angles: [recorded, ours] } = replay;
        let _ = writeln!(
            text,
            "| {k} | {steps} | {hand:.4} | {door:.4} | {palm:.4} | {recorded:.3} | {ours:.3} |"
        );
    }
    text.push_str("\n| difference up to [rad] | hand | door |\n|---|---|---|\n");
    let mut low = 0.0;
    for high in BINS.into_iter().chain([f64::INFINITY]) {
        let within = |value: &dyn Fn(&Replay) -> f64| {
            replays.iter().filter(|&replay| value(replay) >= low && value(replay) < high).count()
        };
        let (hand, door) = (within(&|replay| replay.hand), within(&|replay| replay.door));
        let _ = writeln!(text, "| {high} | {hand} | {door} |");
        low = high;
    }
    text
}
