//! A policy moves an arm to a point; its episodes are recorded in HDF5 and filmed.

use robohive::dataset::trace::{Layout, Precision, Recorder, TraceReader};
use robohive::env::Options;
use robohive::physics::elements::SiteId;
use robohive::render::picture::Channels;
use robohive::video::Frame;
use robohive::{Env, OwnModels, Picture, VideoWriter};
use std::error::Error;
use std::path::Path;

/// An arm whose fingertips are to reach a point that every reset draws.
const ID: &str = "hive/FrankaReach-v0";
/// Columns and rows of a frame.
const SIZE: [usize; 2] = [160, 120];
/// How far a joint is sent for a metre of error and a metre of lever \[rad/m²\].
const GAIN: f64 = 3.0;

type Outcome<T> = Result<T, Box<dyn Error>>;

/// Moves the fingertips towards the target: every joint turns as its lever on them demands (the transpose of the
/// Jacobian).
struct Reacher {
    tip: SiteId,
    torques: Vec<f64>,
}

impl Reacher {
    fn new(env: &Env) -> Outcome<Self> {
        let model = &env.scene().model;
        let tip = model.site("grasp").ok_or("the arm has no site between its fingers")?;
        Ok(Reacher { tip, torques: vec![0.0; model.nv] })
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) {
        let (model, data) = (&env.scene().model, &env.scene().data);
        let error = &env.rows()["reach_err"];
        self.torques.fill(0.0);
        let jacobian = data.jacobian(model, self.tip);
        jacobian.add_wrench([error[0], error[1], error[2]], [0.0; 3], &mut self.torques);
        for ((action, joint), torque) in action.iter_mut().zip(model.joints()).zip(&self.torques) {
            let [low, high] = model.joint(joint).range().unwrap_or([-1.0, 1.0]);
            let wanted = data.joint(joint).qpos()[0] + GAIN * torque;
            *action = (2.0 * wanted - low - high) / (high - low);
        }
    }
}

/// Plays and records one episode; the distance that is left \[m\].
fn play(env: &mut Env, seed: u64, recorder: &mut Recorder, film: &mut VideoWriter) -> Outcome<f64> {
    let mut policy = Reacher::new(env)?;
    let mut trial = recorder.begin(&format!("Trial{seed}"))?;
    let (mut action, mut picture) = (vec![0.0; env.action_len()], Picture::new(SIZE[0], SIZE[1]));
    env.reset(Some(seed))?;
    loop {
        policy.act(env, &mut action);
        let step = env.step(&action)?;
        for (row, values) in env.rows().iter() {
            trial.push(&format!("env_infos/obs_dict/{}", row.name()), &[values.len()], values)?;
        }
        trial.push("actions", &[action.len()], &action)?;
        trial.push("rewards", &[], &[step.reward])?;
        env.draw("front", Channels::RGB, &mut picture)?;
        film.push(&Frame::new(SIZE[0] as u32, SIZE[1] as u32, &picture.rgb)?)?;
        if step.terminated || step.truncated {
            trial.finish()?;
            return Ok(env.rows()["reach_err"].iter().map(|x| x * x).sum::<f64>().sqrt());
        }
    }
}

/// Plays two episodes into a folder, and reads the recording again.
fn record(folder: &Path) -> Outcome<()> {
    let (file, clip) = (folder.join("reach.h5"), folder.join("reach.mp4"));
    let options = Options::default().with_changes("max_episode_steps = 20".parse()?);
    let mut env = Env::make(ID, &OwnModels, &options)?;
    let mut recorder = Recorder::create_with(&file, Layout::RoboHive, Precision::Full, &[("env", ID)])?;
    let mut film = VideoWriter::create(&clip, (SIZE[0] as u32, SIZE[1] as u32), 1.0 / env.dt())?;
    for seed in 0..2 {
        let left = play(&mut env, seed, &mut recorder, &mut film)?;
        assert!(left < 0.1, "episode {seed} ends {left:.3} m from its target");
    }
    recorder.close()?;
    film.finish()?;

    let trace = TraceReader::open(&file)?;
    let rewards = trace.read(&trace.entry("Trial1", "rewards")?)?.values.to_f64();
    assert!(rewards.len() == 20 && rewards[19] > rewards[0], "the reward grows: {rewards:?}");
    assert!(std::fs::metadata(&clip)?.len() > 1000, "the clip shows something");
    Ok(())
}

/// Rolls the policy out, records and films it.
pub fn main() -> Outcome<()> {
    let folder = std::env::temp_dir().join(format!("robohive-record-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    let outcome = record(&folder);
    std::fs::remove_dir_all(&folder)?;
    outcome
}
