//! `sim`: let a model move.

use crate::failure::{Failure, unwritable};
use crate::input::loading::{load, start};
use crate::input::solver::SolverArgument;
use crate::input::source::ModelSource;
use crate::interrupt::Interrupt;
use crate::models::MAX_STEPS;
use crate::output::{archive_file, check_place};
use crate::pictures::film::{Film, FilmArguments};
use crate::pictures::subject::FREE;
use crate::terminal::show;
use clap::{Args, ValueHint};
use indicatif::{ProgressBar, ProgressStyle};
use physics::math::Legible;
use physics::model::Enable;
use physics::{Data, Model, Mover, StepError, forward};
use record::StateRecording;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Simulate a model under the controls of a keyframe, or none
#[derive(Args)]
#[command(
    after_help = "A row of the trajectory holds a state, the controls in force from then on, and the sensor \
readings and energy; the first is the initial state. It is written while the model moves, in bounded \
memory, to FILE.npz.part/NAME.npy, of which FILE.npz is made at the end. Ctrl-C and instability end a run early: FILE.npz then holds \
all rows so far, the last one, if its step failed, with sensor readings and energy NaN. Of a process that is killed \
remains FILE.npz.part, whose arrays numpy can load.

A video has at most 50 frames for each simulated second unless --fps says otherwise; it, too, is complete after Ctrl-C.

Examples:
  robohive sim assets/pile/pile.xml --seconds 2
  robohive sim assets/franka/franka_table.xml --keyframe ready --out run.npz
  robohive sim assets/pile/pile.xml --seconds 1 --video pile.gif --size 160x120 --fps 20
  python -c \"import numpy; print(numpy.load('run.npz')['qpos'].shape)\""
)]
pub struct Sim {
    /// The model
    #[command(flatten)]
    pub model: ModelSource,
    /// Simulated time [s]
    #[arg(long, default_value_t = 1.0, allow_negative_numbers = true)]
    pub seconds: f64,
    /// Start from this keyframe, by name or number (default: the first, if any)
    #[arg(long)]
    pub keyframe: Option<String>,
    /// Write time, qpos, qvel, act, ctrl, mocap_pos, mocap_quat, sensordata and energy of the initial state and of every step to
    /// this numpy archive
    #[arg(long, value_name = "FILE.npz", value_hint = ValueHint::FilePath, value_parser = archive_file)]
    pub out: Option<PathBuf>,
    /// What moves it
    #[command(flatten)]
    pub solver: SolverArgument,
    /// No progress on standard error
    #[arg(long, short)]
    pub quiet: bool,
    /// Its video
    #[command(flatten)]
    pub film: FilmArguments,
}

/// Runs the command.
pub fn run(a: &Sim) -> Result<(), Failure> {
    let painters = a.film.painters(false)?;
    a.out.as_deref().map_or(Ok(()), check_place)?;
    let mut m = load(&a.model.path, &a.model.reading)?;
    // Every step then computes the energy of the state that it starts from.
    m.options_mut().enableflags.set(Enable::ENERGY, true);
    let mut d = start(&m, a.keyframe.as_deref())?;
    let mut mover = a.solver.engine()?.start(&m).map_err(Failure::usage)?;
    let steps = number_of_steps(a.seconds, m.opt.timestep)?;
    let mut recording = a.out.as_deref().map(|path| Recording::create(path, &d)).transpose()?;
    let mut pictures = a.film.film(&m, FREE, m.opt.timestep, &*painters)?.map(|film| Pictures::new(film, &d));
    let bar = if a.quiet || a.film.previews() { ProgressBar::hidden() } else { progress(steps) };
    let run = advance((&m, &mut mover), &mut d, steps, (recording.as_mut(), pictures.as_mut()), &bar)?;
    bar.finish_and_clear();
    show_summary(&m, &d, &run);
    let finished = pictures.map(|pictures| pictures.film.finish()).transpose()?.flatten();
    if let Some(finished) = finished {
        show!("video        {finished}");
    }
    let kept = match (&a.out, recording) {
        (Some(path), Some(recording)) => {
            let rows = recording.finish().map_err(unwritable(path))?;
            show!("written      {}, {rows} states", path.display());
            format!("; {} holds the motion up to there", path.display())
        }
        _ => String::new(),
    };
    match run.end {
        End::Completed => Ok(()),
        End::Interrupted(code) => {
            Err(Failure { code, ..Failure::new(format!("interrupted at {:.6} s{kept}", d.state.time)) })
        }
        End::Failed(error) => Err(Failure::new(format!("at {:.6} s: {error}{kept}", d.state.time))),
    }
}

/// Steps that fill a duration.
fn number_of_steps(seconds: f64, timestep: f64) -> Result<u64, Failure> {
    let steps = (seconds / timestep).ceil();
    if (0.0..=MAX_STEPS as f64).contains(&steps) {
        return Ok(steps as u64);
    }
    Err(Failure::usage(format!(
        "--seconds {} asks for {} steps of {} s; 0 to {MAX_STEPS} can be run",
        Legible(seconds),
        Legible(steps),
        Legible(timestep)
    )))
}

/// What happened.
struct Run {
    steps: u64,
    seconds: f64,
    most_contacts: usize,
    /// Energy and contacts of the last state, unless its step failed.
    last: Option<Box<Data>>,
    end: End,
}

enum End {
    /// All steps were taken.
    Completed,
    /// A signal came; the exit code.
    Interrupted(u8),
    /// A state could not be stepped.
    Failed(StepError),
}

/// Takes the steps until a signal comes, and one more aside, which checks and measures the last state.
fn advance(
    (m, mover): (&Model, &mut Mover),
    d: &mut Data,
    steps: u64,
    (mut recording, mut pictures): (Option<&mut Recording<'_>>, Option<&mut Pictures>),
    bar: &ProgressBar,
) -> Result<Run, Failure> {
    // Without a file to complete, signals end the process at once.
    let writes = recording.is_some() || pictures.is_some();
    let interrupt = writes.then(Interrupt::listen).transpose().map_err(Failure::new)?;
    let began = Instant::now();
    let mut run = Run { steps: 0, seconds: 0.0, most_contacts: 0, last: None, end: End::Completed };
    loop {
        let asked = interrupt.as_ref().and_then(Interrupt::code);
        let stops = asked.is_some() || run.steps == steps;
        if stops {
            run.seconds = began.elapsed().as_secs_f64();
            run.end = asked.map_or(End::Completed, End::Interrupted);
            run.last = Some(Box::new(d.clone()));
        }
        let stepped = run.last.as_deref_mut().unwrap_or(d);
        if let Some(recording) = &mut recording {
            recording.state(stepped)?;
        }
        if let Some(pictures) = &mut pictures {
            pictures.state(m, stepped)?;
        }
        let outcome = mover.step(m, stepped);
        if let Some(recording) = &mut recording {
            recording.measurements(stepped, outcome.is_ok())?;
        }
        if let Err(error) = outcome {
            run.seconds = began.elapsed().as_secs_f64();
            return Ok(Run { last: None, end: End::Failed(error), ..run });
        }
        run.most_contacts = run.most_contacts.max(stepped.con.contact.len());
        if stops {
            return Ok(run);
        }
        run.steps += 1;
        bar.inc(1);
    }
}

fn show_summary(m: &Model, d: &Data, run: &Run) {
    let steps = run.steps as f64;
    show!("model        {}", m.name);
    show!("time         {:.6} s after {} steps of {} s", d.state.time, run.steps, m.opt.timestep);
    if run.steps > 0 {
        let real_time = steps * m.opt.timestep / run.seconds;
        show!("speed        {:.0} steps/s, {real_time:.1} x real time", steps / run.seconds);
    }
    if let Some(last) = &run.last {
        show!("energy       potential {:.6} J, kinetic {:.6} J", last.energy[0], last.energy[1]);
        show!("contacts     {} now, {} at most", last.con.contact.len(), run.most_contacts);
    } else {
        show!("contacts     {} at most", run.most_contacts);
    }
}

/// A bar that fits the terminal.
fn progress(steps: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{wide_bar} {pos}/{len} steps, {eta} left")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(steps).with_style(style)
}

/// A video of the motion.
struct Pictures {
    film: Film,
    /// The state that is drawn. It is evaluated apart from the simulation, so that a video does not change the motion.
    posed: Data,
    began: f64,
}

impl Pictures {
    fn new(mut film: Film, d: &Data) -> Self {
        film.begin();
        Pictures { film, posed: d.clone(), began: d.state.time }
    }

    /// Shows a state. One that physics refuses is left out: its step fails next.
    fn state(&mut self, m: &Model, d: &Data) -> Result<(), Failure> {
        let time = d.state.time - self.began;
        if !self.film.is_due(time) {
            return Ok(());
        }
        self.posed.state.clone_from(&d.state);
        match forward(m, &mut self.posed) {
            Ok(()) => self.film.show(m, &self.posed, time),
            Err(_) => Ok(()),
        }
    }
}

/// The trajectory that is being written, and where to.
struct Recording<'a> {
    states: StateRecording,
    path: &'a Path,
}

impl<'a> Recording<'a> {
    fn create(path: &'a Path, d: &Data) -> Result<Self, Failure> {
        let states = StateRecording::create(path, d).map_err(unwritable(path))?;
        Ok(Recording { states, path })
    }

    fn state(&mut self, d: &Data) -> Result<(), Failure> {
        self.states.state(d).map_err(unwritable(self.path))
    }

    fn measurements(&mut self, d: &Data, measured: bool) -> Result<(), Failure> {
        self.states.measurements(d, measured).map_err(unwritable(self.path))
    }

    fn finish(self) -> std::io::Result<u64> {
        self.states.finish()
    }
}
