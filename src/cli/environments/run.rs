//! `run`: play episodes of an environment.

use crate::failure::Failure;
use crate::input::actor::{Actor, ActorArguments};
use crate::input::library::Source;
use crate::interrupt::Interrupt;
use crate::output::{check_place, keep_input, note_unmapped, recording_file};
use crate::pictures::film::{Film, FilmArguments};
use crate::pictures::subject::camera_of;
use crate::recordings::names::{LayoutName, PrecisionName};
use crate::robots::live::Live;
use crate::terminal::{note, show, show_json};
use clap::{Args, ValueHint};
use dataset::trace::is_npz;
use env::Env;
use env::episode::{Summary, evaluate};
use indicatif::{ProgressBar, ProgressStyle};
use record::Recording;
use serde_json::json;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Play episodes of an environment and print returns, success and speed
#[derive(Args)]
#[command(
    after_help = "The episode of index k is seeded with SEED + k, so every episode can be played again by itself.

--record writes every episode in the schema of RoboHive's logger, TrialN/ for episode N: time, observations, actions, \
rewards, done, and env_infos/ with time, rwd_dense, rwd_sparse, solved, done, obs_dict/*, proprio_dict/*, rwd_dict/* and \
state/*; with --visual also visual_dict/*, an image of each visual key. An episode of h steps has h+1 rows: row t holds a state and the action taken in it, the last row the last state \
and a NaN action. seed is the seed of the reset. Attributes of an HDF5 file name the environment, its settings, the \
policy and the first seed; numpy archives (.npz) hold no attributes.

Rows are written as the episode runs. An HDF5 file can be read at any moment and holds every episode that was finished, \
whatever ends the process; a numpy archive is complete when the command ends, also by Ctrl-C. `robohive data replay` \
plays a recording again.

--video shows one episode after the other, each from the state of its reset, in simulated time: at most 50 frames a second unless --fps says otherwise. The file has its name when the command ends, also by Ctrl-C.

--controller lets a program for this very task act, which sees the state of the simulation and does not learn. It shows that a \
task can be solved, and how; the line `success` is then what the controller reaches.

--hardware runs the same task on devices: each step is sent to them and waits for its control period, and the model mirrors what \
they measure. Nothing moves without --arm; --rehearse puts simulated devices behind the real drivers.

Examples:
  robohive run hive/FrankaReach-v0
  robohive run hive/FrankaReach-v0 --policy best
  robohive run hive/FrankaReach-v0 --policy zero --episodes 20 --seed 7
  robohive run hive/FrankaReach-v0 --controller list
  robohive run hive/FrankaReach-v0 --controller reach --episodes 20
  robohive run hive/FrankaReach-v0 --set max_episode_steps=20 --json
  robohive run hive/FrankaReach-v0 --record reach.h5
  robohive run hive/FrankaReach-v0 --episodes 1 --video reach.mp4 --camera front
  robohive run hive/FrankaReach_v2d-v0 --episodes 2 --record reach.h5 --visual
  robohive run hive/QuadrupedWalk-v0 --arm --rehearse --hardware assets/quadruped/servos.toml"
)]
pub struct Run {
    /// The environment
    #[command(flatten)]
    source: Source,
    /// Who acts
    #[command(flatten)]
    actor: ActorArguments,
    /// Episodes to play
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u32).range(1..))]
    episodes: u32,
    /// Seed of the first episode
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    seed: u64,
    /// Record every episode in this file, .h5 or .hdf5 (HDF5), or .npz; replaces it
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, value_parser = recording_file)]
    record: Option<PathBuf>,
    /// Names of the recorded rows
    #[arg(long, default_value = "robohive", requires = "record")]
    layout: LayoutName,
    /// Precision of the recorded numbers; that of RoboHive's own files is reduced
    #[arg(long, default_value = "full", requires = "record")]
    precision: PrecisionName,
    /// Record the images of the visual keys too, which takes their drawing
    #[arg(long, requires = "record")]
    visual: bool,
    /// Print a line for every episode; where it is recorded, when the file holds it
    #[arg(long, conflicts_with = "json")]
    each: bool,
    /// Print one JSON object instead
    #[arg(long)]
    json: bool,
    /// Show no progress
    #[arg(long, short)]
    quiet: bool,
    /// Its video
    #[command(flatten)]
    film: FilmArguments,
    /// Its robot
    #[command(flatten)]
    live: Live,
}

/// Runs the command.
pub fn run(a: &Run) -> Result<(), Failure> {
    if let Some(record) = &a.record {
        check_place(record)?;
        keep_input(Path::new(&a.actor.policy), record)?;
    }
    let policy = a.actor.policy(&a.source.id)?;
    let painters = a.film.painters(a.visual)?;
    let hardware = a.live.hardware(&a.source.id, &a.source.making)?;
    let mut env = a.source.make_on(hardware, painters.clone())?;
    let Some(mut actor) = a.actor.actor(policy, &env)? else { return Ok(()) };
    let mut recording = a.record.as_ref().map(|_| open_recording(a, &env)).transpose()?;
    let mut film = a.film.film(&env.scene().model, &camera_of(&env), env.dt(), &*painters)?;
    let hidden = a.quiet || a.json || a.film.previews();
    let bar = if hidden { ProgressBar::hidden() } else { progress(a.episodes) };
    let interrupt = Interrupt::listen().map_err(Failure::new)?;
    let mut episodes = Vec::new();
    let began = Instant::now();
    for index in 0..a.episodes {
        let seed = a.seed.wrapping_add(u64::from(index));
        let witnesses = Witnesses { recording: recording.as_mut(), film: film.as_mut() };
        let Some(episode) = play(&mut env, &mut actor, seed, witnesses, &interrupt)? else {
            break;
        };
        bar.set_message(format!("return {:.2}, {} solved", episode.reward, episode.solved));
        bar.inc(1);
        if a.each {
            bar.suspend(|| show_episode(seed, &episode));
        }
        episodes.push(episode);
    }
    let seconds = began.elapsed().as_secs_f64();
    bar.finish_and_clear();
    show_result(a, &env, &episodes, seconds);
    let finished = film.map(Film::finish).transpose()?.flatten();
    if let Some(finished) = finished.filter(|_| !a.json) {
        show!("video        {finished}");
    }
    let kept = recording.map(|recording| close_recording(recording, a.json)).transpose()?;
    match interrupt.code().filter(|_| episodes.len() < a.episodes as usize) {
        None => Ok(()),
        Some(code) => {
            let message = format!("interrupted in episode {}{}", episodes.len(), kept.unwrap_or_default());
            Err(Failure { code, ..Failure::new(message) })
        }
    }
}

/// Makes the file of `--record`.
fn open_recording(a: &Run, env: &Env) -> Result<Recording, Failure> {
    let path = a.record.as_deref().ok_or_else(|| Failure::usage("--record is needed"))?;
    let settings = a.source.making.changes()?.to_string();
    let (compat, seed, name) = (a.source.making.compat.to_string(), a.seed.to_string(), a.actor.name(env));
    let attributes = [
        (record::ID, &a.source.id[..]),
        (record::COMPAT, &compat),
        (record::SETTINGS, settings.trim_end()),
        ("policy", &name),
        ("seed", &seed),
    ];
    let recording = Recording::create(path, a.layout.into(), a.precision.into(), &attributes)?;
    Ok(if a.visual { recording.with_images() } else { recording })
}

/// Completes the file, and says what it holds.
fn close_recording(recording: Recording, json: bool) -> Result<String, Failure> {
    let (path, episodes, unmapped) = recording.close()?;
    note_unmapped(&unmapped);
    if !json {
        let hint = if is_npz(&path) { "; numpy archives name no environment" } else { "" };
        show!("recorded     {episodes} episodes in {}{hint}", path.display());
    }
    Ok(format!("; {} holds the {episodes} episodes before it", path.display()))
}

/// What keeps what happens in an episode.
struct Witnesses<'a> {
    recording: Option<&'a mut Recording>,
    film: Option<&'a mut Film>,
}

/// Plays one episode; `None` if a signal ends it, which is then not recorded.
fn play(
    env: &mut Env,
    actor: &mut Actor,
    seed: u64,
    witnesses: Witnesses<'_>,
    interrupt: &Interrupt,
) -> Result<Option<Summary>, Failure> {
    let mut action = vec![0.0; env.action_len()];
    let mut episode = Summary::default();
    let Witnesses { recording, mut film } = witnesses;
    let mut record = recording.map(|recording| recording.begin(seed)).transpose()?;
    if let Err(error) = env.reset(Some(seed)) {
        // A signal ends the motion of a robot to where an episode begins.
        return if interrupt.code().is_some() { Ok(None) } else { Err(Failure::new(error)) };
    }
    actor.begin(env, seed)?;
    if let Some(film) = &mut film {
        film.begin();
        film.show(&env.scene().model, &env.scene().data, 0.0)?;
    }
    while !episode.terminated && !episode.truncated {
        if interrupt.code().is_some() {
            return Ok(None);
        }
        actor.act(env, &mut action)?;
        if let Some(record) = &mut record {
            record.row(env, &action)?;
        }
        let step = env.step(&action).map_err(Failure::new)?;
        episode.add(env, &step);
        if let Some(film) = film.as_mut().filter(|_| step.fault.is_none()) {
            film.show(&env.scene().model, &env.scene().data, env.steps() as f64 * env.dt())?;
        }
        if let Some(fault) = &step.fault {
            note(&format!("seed {seed}, step {}: {fault}", episode.steps));
        }
    }
    record.map(|record| record.finish(env)).transpose()?;
    Ok(Some(episode))
}

fn show_episode(seed: u64, episode: &Summary) {
    let Summary { steps, reward, solved, .. } = episode;
    show!("seed {seed}: {steps} steps, return {reward:.3}, {solved} solved");
}

fn show_result(a: &Run, env: &Env, episodes: &[Summary], seconds: f64) {
    let result = evaluate(episodes, env.success());
    let steps: usize = episodes.iter().map(|episode| episode.steps).sum();
    let faults = episodes.iter().filter(|episode| episode.faulty).count();
    let speed = steps as f64 / seconds.max(1e-9);
    let returns = || episodes.iter().map(|episode| episode.reward);
    if a.json {
        show_json(&json!({
            "id": a.source.id, "policy": a.actor.name(env), "seed": a.seed, "episodes": episodes.len(), "steps": steps,
            "success_percentage": result.success_percentage, "return": result.reward, "rwd_dense": result.rwd_dense,
            "rwd_sparse": result.rwd_sparse, "returns": returns().collect::<Vec<_>>(), "faults": faults,
            "steps_per_second": speed,
        }));
        return;
    }
    let (low, high) =
        returns().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    show!("{}: {} episodes, {steps} steps, {}", a.source.id, episodes.len(), a.actor.described(env));
    if episodes.is_empty() {
        return;
    }
    show!("success      {:.1} %", result.success_percentage);
    show!("return       {:.3} (from {low:.3} to {high:.3})", result.reward);
    show!("sparse       {:.4} a step", result.rwd_sparse);
    let realtime = speed * env.dt();
    show!("speed        {speed:.0} env steps a second, {realtime:.1} times real time");
    if faults > 0 {
        show!("faults       {faults} episodes ended with a step that physics refused");
    }
}

fn progress(episodes: u32) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} episodes, {eta} left, {msg}");
    ProgressBar::new(u64::from(episodes)).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
