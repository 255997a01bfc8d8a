//! The loop of a session: devices in, ticks in time, files out.

use super::arguments::{ControlName, Teleop};
use super::device::DeviceChoice;
use super::ears::{Listening, ListeningClock};
use super::files::{self, Files};
use super::leading::{connect, leading, read};
use super::phone;
use super::reach::Reach;
use super::report::{Report, keys};
use crate::failure::Failure;
use crate::input::library::Source;
use crate::input::policy::policy;
use crate::interrupt::Interrupt;
use crate::output::keep_input;
use crate::pictures::film::Film;
use crate::pictures::subject::camera_of;
use crate::terminal::{complain, note, redraw, show};
use ::teleop::devices::{Opened, Terminal};
use ::teleop::{Control, Leading, Mapping, Mark, Plan, Sample, Session, TeleopError, Ticked};
use env::{Env, Hardware};
use protocol::adb;
use render::Painters;
use std::env::VarError;
use std::sync::Arc;

/// Time between two updates of the status line [s].
const LINE: f64 = 0.1;

impl From<TeleopError> for Failure {
    fn from(error: TeleopError) -> Self {
        match error {
            TeleopError::Mapping { .. } | TeleopError::Control { .. } | TeleopError::Policy(_) => {
                Failure::usage(error)
            }
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
    files::check(a)?;
    let policy = a.policy.as_deref().map(|name| policy(name, Some(&source.id))).transpose()?;
    let painters = a.film.painters(a.visual)?;
    let interrupt = Interrupt::listen().map_err(Failure::new)?;
    // A signal ends the motion of a robot to where an episode begins, which then fails.
    let ended = |failure: Failure| Failure { code: interrupt.code().unwrap_or(failure.code), ..failure };
    let listening = Listening::new();
    let env = make(a, source, &listening, painters.clone())?;
    let live = env.is_live();
    if live {
        // The device is opened before anything moves.
        open(a, &mapping, &listening)?;
    }
    let control = match a.control {
        ControlName::Hand if mapping.led.is_none() => Control::Hand,
        ControlName::Base if mapping.led.is_none() => Control::Base,
        _ => Control::Joints,
    };
    let plan = Plan {
        seed: a.seed,
        episodes: a.episodes,
        horizon: a.horizon,
        solved_for: a.solved_for,
        images: a.visual,
    };
    let session = Session::new(env, control, &mapping, plan);
    let mut session = session.map_err(|error| ended(error.into()))?;
    if let Some(policy) = &policy {
        session = session.with_policy(policy)?;
    }
    if !live {
        open(a, &mapping, &listening)?;
    }
    let files = Files::open(a, source, &mut session)?;
    let env = session.env();
    let mut film = a.film.film(&env.scene().model, &camera_of(env), env.dt(), &*painters)?;
    note(&format!("{} drives {}; {}", listening.ears().name(), source.id, keys(a.mapping.is_some())));
    let mut desk = Desk {
        session,
        mapping,
        began: 0.0,
        listening,
        paced: live && !a.live.rehearse,
        files,
        report: Report::default(),
    };
    let outcome = desk.run(&interrupt, film.as_mut());
    // The status line ends, and the terminal is restored, before anything else is printed.
    redraw("");
    desk.report.seconds = desk.now() - desk.began;
    let let_go = desk.listening.ears().close();
    // Files first: standard output may be closed.
    let recorded = desk.files.take().map(Files::close).transpose()?;
    let finished = film.map(Film::finish).transpose()?.flatten();
    desk.report.show(&source.id, desk.session.counts());
    if let Some(finished) = finished {
        show!("video        {finished}");
    }
    if let Some(closed) = recorded {
        closed.show();
    }
    outcome.map_err(ended)?;
    let_go?;
    match interrupt.code() {
        None => Ok(()),
        Some(code) => Err(Failure { code, ..Failure::new("interrupted; finished episodes are kept") }),
    }
}

fn mapping(a: &Teleop) -> Result<Mapping, Failure> {
    let mut mapping = match &a.mapping {
        None => Mapping::default(),
        Some(path) => {
            let (text, named) = read(path)?;
            Mapping::from_toml(&text, &named)?
        }
    };
    mapping.led = leading(a)?;
    if let Some(site) = &a.site {
        mapping.arm.sites = vec![site.clone()];
    }
    if let Some(site) = &a.left_site {
        mapping.arm.left_sites = vec![site.clone()];
    }
    Ok(mapping)
}

/// The environment, whose robot may be hardware: its control periods then pass while the person is heard.
fn make(
    a: &Teleop,
    source: &Source,
    listening: &Listening,
    painters: Arc<dyn Painters>,
) -> Result<Env, Failure> {
    // Where the robot is simulated, --arm applies to the leader.
    let led = matches!(a.device, DeviceChoice::Leader(_)) && a.live.hardware.is_none();
    let mut hardware = if led { None } else { a.live.hardware(&source.id, &source.making)? };
    if let Some(Hardware { clock, ready, .. }) = hardware.as_mut().filter(|_| !a.live.rehearse) {
        let listening = listening.clone();
        *clock = Arc::new(move || Box::new(ListeningClock(listening.clone())));
        *ready = Arc::new(|_| {
            note(
                "the robot is at the start of an episode, and rests until you move it: put everything in place",
            );
            Ok(())
        });
    }
    source.make_on(hardware, painters)
}

/// Opens the device, and the keyboard beside it where there is a terminal.
fn open(a: &Teleop, mapping: &Mapping, listening: &Listening) -> Result<(), Failure> {
    let path = a.path.as_deref();
    let device = match &a.device {
        DeviceChoice::Keyboard if path.is_some() => {
            return Err(Failure::usage(
                "--path does not apply to the keyboard: choose another device with --device",
            ));
        }
        DeviceChoice::Keyboard => {
            listening.ears().terminal = Some(Terminal::open()?);
            return Ok(());
        }
        DeviceChoice::Leader(_) if path.is_some() => {
            return Err(Failure::usage(
                "--path does not apply to a leader arm: name its config by --device leader:FILE",
            ));
        }
        DeviceChoice::Leader(file) => {
            let Some(Leading::Arm(config)) = &mapping.led else { return Ok(()) };
            let arm = connect(a, config, file)?;
            let mut ears = listening.ears();
            (ears.leader, ears.terminal) = (Some(arm), Some(Terminal::open()?));
            return Ok(());
        }
        DeviceChoice::Glove(_) if path.is_some() => {
            return Err(Failure::usage(
                "--path does not apply to a glove: name its serial port by --device glove:PORT",
            ));
        }
        DeviceChoice::Phone(_) | DeviceChoice::OpenXr(_) if path.is_some() => {
            return Err(Failure::usage(format!("--path does not apply to {}: remove it", a.device)));
        }
        DeviceChoice::Phone(reach) => {
            let page = phone::serve(*reach)?;
            let then = match &page.fingerprint {
                None => "after `adb reverse` of its port".to_owned(),
                Some(fingerprint) => {
                    format!("whose self-signed certificate has the SHA-256 fingerprint {fingerprint}")
                }
            };
            note(&format!("open {} on the phone or headset, {then}", page.address));
            Opened::of(::teleop::Device::Quest, page.lines).called("the page")
        }
        DeviceChoice::OpenXr(port) => {
            let page = phone::serve(Reach::Loopback(*port))?;
            note(&format!("run `python -m robohive.openxr {}` beside the headset's runtime", page.address));
            Opened::of(::teleop::Device::Quest, page.lines).called("the OpenXR headset")
        }
        DeviceChoice::Glove(port) => Opened::glove(port)?,
        DeviceChoice::Gamepad => Opened::gamepad(path, &mapping.ends)?,
        DeviceChoice::SpaceMouse => Opened::space_mouse(path)?,
        DeviceChoice::Quest(None) if path.is_some() => Opened::quest(path)?,
        DeviceChoice::Quest(_) if path.is_some() => {
            return Err(Failure::usage(
                "--path names a pipe and quest:HOST:PORT a server: give only one of them",
            ));
        }
        DeviceChoice::Quest(address) => {
            let local = || format!("127.0.0.1:{}", adb::PORT);
            // Chooses among several headsets, as for adb.
            let serial = match std::env::var("ANDROID_SERIAL") {
                Ok(serial) => Some(serial),
                Err(VarError::NotPresent) => None,
                Err(error) => return Err(Failure::usage(format!("ANDROID_SERIAL: {error}"))),
            };
            Opened::quest_at(&address.clone().unwrap_or_else(local), serial.as_deref())?
        }
    };
    let mut ears = listening.ears();
    (ears.device, ears.terminal) = (Some(device), Terminal::open().ok());
    Ok(())
}

/// A running session with its input and output.
struct Desk {
    session: Session,
    mapping: Mapping,
    listening: Listening,
    /// Whether the robot's clock times the ticks, and reads the input in the meantime.
    paced: bool,
    files: Option<Files>,
    report: Report,
    /// Time at which it began, on the clock of the ears [s].
    began: f64,
}

impl Desk {
    fn now(&self) -> f64 {
        self.listening.ears().now()
    }

    /// Tick after tick, until a person or a signal ends it.
    fn run(&mut self, interrupt: &Interrupt, mut film: Option<&mut Film>) -> Result<(), Failure> {
        self.began = self.now();
        let (mut due, mut shown, mut filmed) = (self.began + self.session.period(), f64::NEG_INFINITY, 0.0);
        self.film(&mut film, filmed)?;
        while interrupt.code().is_none() {
            let Some(sample) = self.listen(due)? else { return Ok(()) };
            let before = self.session.steps();
            let input = self.mapping.read(&sample);
            let ticked = self.session.tick(&input)?;
            self.report.applied(self.now(), ticked.stepped);
            self.report.acted(ticked.by_hand);
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
            if now - shown >= LINE || ticked.finished.is_some() || ticked.impossible.is_some() {
                redraw(&self.line(&ticked, input.motion.led.is_some()));
                shown = now;
            }
            if ticked.over {
                return Ok(());
            }
            due = if self.paced { now } else { self.report.next(due, now, self.session.period()) };
        }
        Ok(())
    }

    /// The input that is held at `due` [s]; `None` after its end.
    fn listen(&mut self, due: f64) -> Result<Option<Sample>, Failure> {
        let mut ears = self.listening.ears();
        ears.listen(due);
        ears.came().into_iter().for_each(|came| self.report.came(came));
        let there = ears.outcome()?;
        Ok(there.then(|| ears.sample()))
    }

    /// Writes an episode that is finished.
    fn write(&mut self, ticked: &Ticked) -> Result<(), Failure> {
        self.report.discarded += usize::from(ticked.discarded);
        if let Some(fault) = &ticked.fault {
            redraw("");
            let then = if ticked.discarded {
                "the episode was thrown away"
            } else {
                "the session went back by one step"
            };
            complain(&format!("physics refused the step, and {then}: {fault}"));
        }
        if let (Some(finished), Some(files)) = (&ticked.finished, &mut self.files) {
            files.add(&finished.kept)?;
        }
        Ok(())
    }

    fn film(&self, film: &mut Option<&mut Film>, time: f64) -> Result<(), Failure> {
        let scene = self.session.env().scene();
        film.as_mut().map_or(Ok(()), |film| film.show(&scene.model, &scene.data, time))
    }

    /// How it goes; `led` where what leads joints says where they are.
    fn line(&self, ticked: &Ticked, led: bool) -> String {
        let silent = match &self.mapping.led {
            Some(Leading::Glove(calibration)) if !led => {
                format!(
                    "  the glove does not say what the {} sensors of its calibration measure",
                    calibration.sensors()
                )
            }
            Some(Leading::Arm(_)) if !led => "  the leader says nothing".to_owned(),
            _ => String::new(),
        };
        let refused = match ticked.refused {
            Some(::teleop::Reached::Nowhere) => "  out of reach",
            Some(::teleop::Reached::Far) => "  too far ahead",
            Some(::teleop::Reached::Apart) => {
                "  the leader is too far from the robot's position: move it closer"
            }
            _ => "",
        };
        let impossible = match ticked.impossible {
            Some(Mark::Policy) => "  no policy to return control to: start with --policy",
            Some(Mark::Slow) => "  hardware has no slow motion",
            Some(_) => "  hardware cannot go back in time",
            None => "",
        };
        format!("{}  {} dropped{refused}{impossible}{silent}", self.session.line(), self.report.dropped)
    }
}
