//! The loop of a session: devices in, ticks in time, files out.

use super::arguments::{ControlName, DeviceName, Teleop};
use super::report::{Report, keys};
use crate::failure::Failure;
use crate::input::library::Source;
use crate::interrupt::Interrupt;
use crate::output::{check_place, keep_input};
use crate::pictures::film::Film;
use crate::pictures::subject::camera_of;
use crate::terminal::{complain, listed, note, redraw, show};
use ::teleop::devices::{Opened, Terminal, wait};
use ::teleop::{Control, Event, Held, Mapping, Plan, Session, TeleopError, Ticked};
use record::Recording;
use std::os::fd::{AsFd, BorrowedFd};
use std::time::Instant;

/// Time between two looks of the line that says how it goes [s].
const LINE: f64 = 0.1;

impl From<TeleopError> for Failure {
    fn from(error: TeleopError) -> Self {
        match error {
            TeleopError::Mapping { .. } | TeleopError::Control { .. } => Failure::usage(error),
            error => Failure::new(error),
        }
    }
}

/// Runs a session from beginning to end.
pub fn drive(a: &Teleop, source: &Source) -> Result<(), Failure> {
    let mapping = mapping(a)?;
    for (out, input) in a.record.iter().zip(a.mapping.as_ref()) {
        keep_input(input, out)?;
    }
    a.record.as_deref().map(check_place).transpose()?;
    let painters = a.film.painters(a.visual)?;
    let env = source.make_with(painters.clone())?;
    let control = match a.control {
        ControlName::Hand => Control::Hand,
        ControlName::Joints => Control::Joints,
    };
    let plan = Plan {
        seed: a.seed,
        episodes: a.episodes,
        horizon: a.horizon,
        solved_for: a.solved_for,
        images: a.visual,
    };
    let session = Session::new(env, control, &mapping, plan)?;
    let interrupt = Interrupt::listen().map_err(Failure::new)?;
    let (device, terminal) = open(a, &mapping)?;
    let env = session.env();
    let mut film = a.film.film(&env.scene().model, &camera_of(env), env.dt(), &*painters)?;
    let recording = a.record.as_ref().map(|_| open_recording(a, source)).transpose()?;
    note(&format!(
        "{} drives {}; {}",
        device.as_ref().map_or("the keyboard", Opened::name),
        source.id,
        keys(a.mapping.is_some())
    ));
    let mut desk = Desk {
        session,
        mapping,
        held: Held::default(),
        device,
        terminal,
        recording,
        report: Report::default(),
        began: Instant::now(),
    };
    let outcome = desk.run(&interrupt, film.as_mut());
    // The line ends, and the terminal is as it was, before anything else is said.
    redraw("");
    drop(desk.terminal.take());
    desk.report.seconds = desk.began.elapsed().as_secs_f64();
    // Files first: whoever looked on may be gone.
    let recorded = desk.recording.take().map(Recording::close).transpose()?;
    let finished = film.map(Film::finish).transpose()?.flatten();
    desk.report.show(&source.id, desk.session.counts());
    if let Some(finished) = finished {
        show!("video        {finished}");
    }
    if let Some((path, episodes, unmapped)) = recorded {
        if !unmapped.is_empty() {
            note(&format!("not recorded, for want of a place in the layout: {}", listed(&unmapped, 8)));
        }
        show!("recorded     {episodes} episodes in {}", path.display());
    }
    outcome?;
    match interrupt.code() {
        None => Ok(()),
        Some(code) => Err(Failure { code, ..Failure::new("interrupted; finished episodes are kept") }),
    }
}

fn mapping(a: &Teleop) -> Result<Mapping, Failure> {
    let mut mapping = match &a.mapping {
        None => Mapping::default(),
        Some(path) => {
            let named = path.display().to_string();
            let text =
                std::fs::read_to_string(path).map_err(|error| Failure::usage(format!("{named}: {error}")))?;
            Mapping::from_toml(&text, &named)?
        }
    };
    if let Some(site) = &a.site {
        mapping.arm.sites = vec![site.clone()];
    }
    Ok(mapping)
}

/// Opens what drives, and the keyboard beside it where there is a terminal.
fn open(a: &Teleop, mapping: &Mapping) -> Result<(Option<Opened>, Option<Terminal>), Failure> {
    let path = a.path.as_deref();
    let device = match a.device {
        DeviceName::Keyboard if path.is_some() => {
            return Err(Failure::usage(
                "--path names the file of another device than the keyboard: add --device",
            ));
        }
        DeviceName::Keyboard => return Ok((None, Some(Terminal::open()?))),
        DeviceName::Gamepad => Opened::gamepad(path, &mapping.ends)?,
        DeviceName::Spacemouse => Opened::space_mouse(path)?,
        DeviceName::Quest => Opened::quest(path)?,
    };
    Ok((Some(device), Terminal::open().ok()))
}

/// Makes the file of `--record`.
fn open_recording(a: &Teleop, source: &Source) -> Result<Recording, Failure> {
    let path = a.record.as_deref().ok_or_else(|| Failure::usage("--record is needed"))?;
    let settings = source.making.changes()?.to_string();
    let (compat, seed) = (source.making.compat.to_string(), a.seed.to_string());
    let device = format!("{:?}", a.device).to_lowercase();
    let attributes = [
        (record::ID, &source.id[..]),
        (record::COMPAT, &compat),
        (record::SETTINGS, settings.trim_end()),
        ("policy", "teleop"),
        ("device", &device),
        ("seed", &seed),
    ];
    Ok(Recording::create(path, a.layout.into(), a.precision.into(), &attributes)?)
}

/// All that takes part in a session.
struct Desk {
    session: Session,
    mapping: Mapping,
    held: Held,
    device: Option<Opened>,
    terminal: Option<Terminal>,
    recording: Option<Recording>,
    report: Report,
    began: Instant,
}

impl Desk {
    fn now(&self) -> f64 {
        self.began.elapsed().as_secs_f64()
    }

    /// Tick after tick, until a person or a signal ends it.
    fn run(&mut self, interrupt: &Interrupt, mut film: Option<&mut Film>) -> Result<(), Failure> {
        self.began = Instant::now();
        let (mut due, mut shown, mut filmed) = (self.session.period(), f64::NEG_INFINITY, 0.0);
        self.film(&mut film, filmed)?;
        while interrupt.code().is_none() {
            if !self.listen(due)? {
                return Ok(());
            }
            let before = self.session.steps();
            let now = self.now();
            let input = self.mapping.read(&self.held.sample(now));
            let ticked = self.session.tick(&input)?;
            self.report.applied(self.now(), ticked.stepped);
            self.write(&ticked)?;
            if ticked.stepped
                || ticked.discarded
                || ticked.finished.is_some()
                || self.session.steps() != before
            {
                filmed += self.session.env().dt();
                self.film(&mut film, filmed)?;
            }
            let now = self.now();
            if now - shown >= LINE || ticked.finished.is_some() {
                redraw(&self.line(&ticked));
                shown = now;
            }
            if ticked.over {
                return Ok(());
            }
            due = self.report.next(due, now, self.session.period());
        }
        Ok(())
    }

    /// Takes what devices say until `due` [s]; false where the last of them is gone.
    fn listen(&mut self, due: f64) -> Result<bool, Failure> {
        loop {
            let files: Vec<BorrowedFd<'_>> =
                self.terminal.iter().map(AsFd::as_fd).chain(self.device.iter().map(AsFd::as_fd)).collect();
            let ready = wait(&files, due - self.now()).map_err(Failure::new)?;
            let (now, mut ready) = (self.now(), ready.into_iter());
            let mut events: Vec<Event> = Vec::new();
            if let Some(terminal) = &mut self.terminal {
                let there = terminal.read(ready.next().unwrap_or(false), now, &mut events);
                self.held.tells_releases(terminal.tells_releases());
                if !there && self.device.is_none() {
                    return Ok(false);
                }
                if !there {
                    self.terminal = None;
                }
            }
            if ready.next().unwrap_or(false)
                && let Some(device) = &mut self.device
            {
                device.read(&mut events)?;
            }
            for event in events {
                self.held.apply(event, now);
                self.report.came(now);
            }
            if now >= due {
                return Ok(true);
            }
        }
    }

    /// Writes an episode that is finished.
    fn write(&mut self, ticked: &Ticked) -> Result<(), Failure> {
        self.report.discarded += usize::from(ticked.discarded);
        if let Some(fault) = &ticked.fault {
            redraw("");
            complain(&format!("physics refused the step, and the session went back by it: {fault}"));
        }
        if let (Some(finished), Some(recording)) = (&ticked.finished, &mut self.recording) {
            recording.add(&finished.kept)?;
        }
        Ok(())
    }

    fn film(&self, film: &mut Option<&mut Film>, time: f64) -> Result<(), Failure> {
        let scene = self.session.env().scene();
        film.as_mut().map_or(Ok(()), |film| film.show(&scene.model, &scene.data, time))
    }

    /// How it goes.
    fn line(&self, ticked: &Ticked) -> String {
        let refused = match ticked.refused {
            Some(::teleop::Reached::Nowhere) => "  out of reach",
            Some(::teleop::Reached::Far) => "  too far ahead",
            _ => "",
        };
        format!("{}  {} dropped{refused}", self.session.line(), self.report.dropped)
    }
}
