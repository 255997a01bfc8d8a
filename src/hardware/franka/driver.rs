//! The driver of an arm.

use super::generator::Generator;
use super::hand::Hand;
use super::link::Link;
use super::settings::{Quantity, Settings, Target};
use crate::driver::Driver;
use crate::port::Sockets;
use crate::safety::limits::Limits;
use crate::safety::watchdog::Timeouts;
use protocol::franka::{
    ArmLimits, CYCLE, Command, Controller, FER, Generator as Commanded, JOINTS, MISSED_CYCLES, Mode, Move,
    MoveEnd, Outcome, Setpoint, State, TORQUE, TORQUE_RATE, Version, describe_errors, field,
};
use robot::{DeviceConfig, Fault};
use std::sync::Arc;

/// How often the loop looks for a state \[s\].
const PERIOD: f64 = 0.25e-3;
/// Silence that is worth a line in the record \[s\].
const WARN: f64 = 3e-3;
/// Silence after which the motion comes to rest \[s\].
const HOLD: f64 = 10e-3;
/// Silence after which the arm is commanded to stop \[s\].
const STOP: f64 = 20e-3;
/// Stiffness \[N m/rad\] and damping \[N m s/rad\].
const STIFFNESS: [f64; JOINTS] = [40.0, 30.0, 50.0, 25.0, 35.0, 25.0, 10.0];
const DAMPING: [f64; JOINTS] = [4.0, 6.0, 5.0, 5.0, 3.0, 2.0, 1.0];
/// Share of the largest torque, and of its largest change, that is used.
const MARGIN: f64 = 0.98;

/// A motion that the arm has been asked for.
struct Motion {
    /// Number of its request.
    id: u32,
    generator: Generator,
    torque: [f64; JOINTS],
    /// The arm has been told that the motion is at its end.
    finished: bool,
    /// Least distance outside of the box since it began, along each axis \[m\].
    outside: [f64; 3],
}

impl Motion {
    /// Halts where the next cycle would have it come to rest outside of the box. Where it would come to rest now was looked at a
    /// cycle ago.
    fn keep_inside(&mut self, settings: &Settings) -> Result<(), Fault> {
        let Some(workspace) = settings.workspace.filter(|_| !settings.direct) else { return Ok(()) };
        let here = workspace.beyond(&self.generator.commanded());
        self.outside = std::array::from_fn(|axis| self.outside[axis].min(here[axis]));
        let mut next = self.generator.clone();
        next.step();
        let rest = next.rest();
        if workspace.allows(&self.outside, &rest) {
            return Ok(());
        }
        self.generator.halt();
        Err(workspace.refusal("the way to where it is commanded would have", &rest))
    }
}

/// An arm, with its hand if it has one, see [the module](super).
pub struct Franka {
    settings: Settings,
    sockets: Arc<dyn Sockets>,
    link: Option<Link>,
    hand: Option<Hand>,
    motion: Option<Motion>,
    resetting: bool,
    /// Request to stop that was sent.
    stopping: Option<u32>,
    warned: bool,
    /// It is on its way to its safe state.
    halted: bool,
    note: Option<String>,
}

impl Franka {
    /// The driver of a device; nothing is opened yet.
    ///
    /// # Errors
    /// What the config lacks or says wrongly.
    pub fn new(config: &DeviceConfig, sockets: Arc<dyn Sockets>) -> Result<Franka, Fault> {
        Ok(Franka {
            settings: Settings::new(config)?,
            sockets,
            link: None,
            hand: None,
            motion: None,
            resetting: false,
            stopping: None,
            warned: false,
            halted: false,
            note: None,
        })
    }

    fn link(&mut self) -> Result<&mut Link, Fault> {
        self.link.as_mut().ok_or(Fault::NotConnected)
    }

    /// Why the arm does not do what it was asked for, as its state says.
    fn trouble(state: &State) -> Fault {
        Fault::Hardware(match state.mode {
            Mode::UserStopped => "its stop button is pressed; release it and reset".to_owned(),
            Mode::Reflex => format!(
                "a reflex stopped it: {}; a reset recovers from it",
                describe_errors(state.errors | state.reflex)
            ),
            mode => format!("it has left its motion and is in mode {mode:?}"),
        })
    }

    /// Makes the arm ready to be moved: out of an error, with thresholds of collisions.
    fn recover(&mut self) -> Result<(), Fault> {
        let [torque, force] = self.settings.collision;
        let link = self.link()?;
        link.wait_until("says its state", |link| link.state.mode != Mode::Recovering)?;
        if link.state.mode == Mode::UserStopped {
            return Err(Franka::trouble(&link.state));
        }
        if link.state.mode == Mode::Reflex {
            let answer = link.ask(Command::AutomaticErrorRecovery, &[])?;
            match Outcome::of_recovery(answer, link.version) {
                Outcome::Done => {}
                other => {
                    return Err(Fault::Hardware(format!(
                        "its recovery from an error failed: it {}",
                        other.describe()
                    )));
                }
            }
        }
        link.wait_until("is idle", |link| link.state.mode == Mode::Idle)?;
        let torques = torque.to_le_bytes().repeat(4 * JOINTS);
        let forces = force.to_le_bytes().repeat(4 * 6);
        let answer = link.ask(Command::SetCollisionBehavior, &[torques, forces].concat())?;
        match Outcome::of_setter(answer) {
            Outcome::Done => Ok(()),
            other => Err(Fault::Refused(format!(
                "its thresholds of collisions cannot be set: it {}",
                other.describe()
            ))),
        }
    }

    /// Begins a motion where the arm was last commanded to be.
    fn begin(&mut self) -> Result<(), Fault> {
        let Settings { impedance, direct, .. } = self.settings;
        let link = self.link()?;
        let (controller, commanded) = match (impedance, link.version) {
            (false, _) => (Controller::JointImpedance, Commanded::JointPosition),
            // Version 5 wants velocities beside torques; they do not count.
            (true, Version::V5) => (Controller::External, Commanded::JointVelocity),
            (true, Version::V10) => (Controller::External, Commanded::None),
        };
        let version = link.version;
        let id = link.request(Command::Move, &Move::new(controller, commanded).encode(version))?;
        match MoveEnd::of(link.wait_reply(id, "answers a request to move")?, version) {
            MoveEnd::Started => {}
            other => return Err(Fault::Refused(format!("its motion {}", other.describe()))),
        }
        let begun = commanded.number() as u8 + 1;
        link.wait_until("moves", |link| match link.state.mode {
            Mode::Move => link.state.generator == begun,
            Mode::Reflex | Mode::UserStopped => true,
            _ => false,
        })?;
        if link.state.mode != Mode::Move {
            return Err(Franka::trouble(&link.state));
        }
        let q = link.state.get(field::Q_D);
        let generator = Generator::at(ArmLimits::of(version), q, direct);
        let outside = self.settings.workspace.map_or([0.0; 3], |workspace| workspace.beyond(&q));
        self.motion = Some(Motion { id, generator, torque: [0.0; JOINTS], finished: false, outside });
        // The first command answers the state that has just come.
        self.respond(1)
    }

    /// Answers the newest state; `steps` states came since the last answered one.
    fn respond(&mut self, steps: u64) -> Result<(), Fault> {
        let gain = if self.resetting { self.settings.reset_gain_scale } else { self.settings.gain_scale };
        let (Some(link), Some(motion)) = (&mut self.link, &mut self.motion) else { return Ok(()) };
        let mut refusal = Ok(());
        // What was missed the arm has gone on with by itself.
        for _ in 0..steps.min(MISSED_CYCLES) {
            refusal = refusal.and(motion.keep_inside(&self.settings));
            motion.generator.step();
        }
        let mut setpoint =
            Setpoint { q: motion.generator.commanded(), finished: motion.finished, ..Setpoint::default() };
        if self.settings.impedance {
            let (q, dq) = (link.state.get(field::Q), link.state.get(field::DQ));
            for k in 0..JOINTS {
                let wanted = gain * (STIFFNESS[k] * (setpoint.q[k] - q[k]) - DAMPING[k] * dq[k]);
                let (most, change) = (MARGIN * TORQUE[k], MARGIN * TORQUE_RATE * CYCLE);
                let torque = wanted.clamp(-most, most);
                motion.torque[k] = torque.clamp(motion.torque[k] - change, motion.torque[k] + change);
            }
            setpoint.torque = motion.torque;
            setpoint.torque_finished = motion.finished;
        }
        link.answer(&setpoint)?;
        refusal
    }

    /// Takes what the arm says, and answers it.
    fn serve(&mut self) -> Result<(), Fault> {
        let Some(link) = &mut self.link else { return Ok(()) };
        let steps = link.pump()?;
        let now = link.now();
        let silence = now - link.received.unwrap_or(now);
        if steps > 0 {
            self.warned = false;
            return self.follow(steps);
        }
        if silence > WARN && !self.warned {
            self.warned = true;
            self.note = Some(format!("no state for {:.1} ms", silence * 1e3));
        }
        if silence > HOLD
            && let Some(motion) = &mut self.motion
        {
            motion.generator.halt();
        }
        if silence <= STOP || self.motion.is_none() {
            return Ok(());
        }
        self.stop_move()?;
        Err(Fault::Stale((silence * 1e3) as u64))
    }

    /// Goes on with the motion after a new state, or finds that it has ended.
    fn follow(&mut self, steps: u64) -> Result<(), Fault> {
        let (Some(link), Some(motion)) = (&mut self.link, &mut self.motion) else { return Ok(()) };
        if !self.halted {
            motion.generator.resume();
        }
        let (id, finished, version) = (motion.id, motion.finished, link.version);
        if link.state.mode == Mode::Move && link.state.generator != 0 {
            if steps > WARN_STATES {
                self.note = Some(format!("{} states in a row were missed", steps - 1));
            }
            return self.respond(steps);
        }
        self.motion = None;
        let end = link.reply(id).map(|byte| MoveEnd::of(byte, version));
        match end {
            _ if finished && link.state.mode == Mode::Idle => Ok(()),
            Some(MoveEnd::Preempted) if self.stopping.is_some() => Ok(()),
            _ => Err(Franka::trouble(&link.state)),
        }
    }

    /// Tells the arm to stop, once.
    fn stop_move(&mut self) -> Result<(), Fault> {
        if self.stopping.is_none() {
            self.stopping = Some(self.link()?.request(Command::StopMove, &[])?);
        }
        Ok(())
    }
}

/// States in a row that are missed before that is worth a line in the record.
const WARN_STATES: u64 = 3;

impl Driver for Franka {
    fn connect(&mut self) -> Result<(), Fault> {
        // The hand first: its states are rare, and the arm's must be fresh in the end.
        self.hand = match self.settings.hand {
            true => Some(Hand::open(self.sockets.as_ref(), &self.settings)?),
            false => None,
        };
        let Settings { host, port, version, .. } = &self.settings;
        let link = Link::open(self.sockets.as_ref(), host, *port, *version)?;
        self.note = Some(format!("the arm speaks version {}", link.version.number()));
        self.link = Some(link);
        (self.motion, self.stopping, self.warned) = (None, None, false);
        Ok(())
    }

    fn read(&mut self, values: &mut [f64]) -> Result<(), Fault> {
        let Franka { settings, link, hand, .. } = self;
        let link = link.as_mut().ok_or(Fault::NotConnected)?;
        let now = link.now();
        let silence = now - link.received.unwrap_or(now);
        if silence > WARN {
            return Err(Fault::Stale((silence * 1e3) as u64));
        }
        for (value, quantity) in values.iter_mut().zip(&settings.sensors) {
            *value = match *quantity {
                Quantity::Position(k) => link.state.get(field::Q)[k],
                Quantity::Velocity(k) => link.state.get(field::DQ)[k],
                Quantity::Torque(k) => link.state.get(field::TAU_J)[k],
                Quantity::External(k) => link.state.get(field::TAU_EXT)[k],
                Quantity::Width => hand.as_ref().map_or(0.0, |hand| hand.state.width),
            };
        }
        Ok(())
    }

    fn present(&mut self, commands: &mut [f64]) -> Result<(), Fault> {
        let link = self.link.as_mut().ok_or(Fault::NotConnected)?;
        let q = match &self.motion {
            Some(motion) => motion.generator.commanded(),
            None => {
                // What came before the last reply may be old.
                let before = link.state.message;
                link.wait_until("says its state", |link| link.state.message > before)?;
                link.state.get(field::Q_D)
            }
        };
        for (command, target) in commands.iter_mut().zip(&self.settings.targets) {
            *command = match target {
                Target::Joint(joint) => q[*joint],
                Target::Width => self.hand.as_ref().map_or(0.0, |hand| hand.state.width),
            };
        }
        Ok(())
    }

    fn arm(&mut self, _present: &[f64]) -> Result<(), Fault> {
        (self.stopping, self.halted) = (None, false);
        if let Some(hand) = &mut self.hand {
            hand.home()?;
            hand.begin();
        }
        self.recover()?;
        self.begin()
    }

    fn check(&self, commands: &[f64]) -> Result<(), Fault> {
        let Some(workspace) = self.settings.workspace else { return Ok(()) };
        let link = self.link.as_ref().ok_or(Fault::NotConnected)?;
        let (outside, mut wanted) = match &self.motion {
            Some(motion) => (motion.outside, motion.generator.targets()),
            None => {
                let here = link.state.get(field::Q_D);
                (workspace.beyond(&here), here)
            }
        };
        for (command, target) in commands.iter().zip(&self.settings.targets) {
            if let Target::Joint(joint) = target {
                wanted[*joint] = *command;
            }
        }
        let allowed = workspace.allows(&outside, &wanted);
        if allowed { Ok(()) } else { Err(workspace.refusal("it was commanded to have", &wanted)) }
    }

    fn command(&mut self, commands: &[f64]) -> Result<(), Fault> {
        let Some(motion) = &mut self.motion else {
            return Err(Fault::Refused("its motion has ended; a reset begins another".to_owned()));
        };
        for (command, target) in commands.iter().zip(&self.settings.targets) {
            match (target, &mut self.hand) {
                (Target::Joint(joint), _) => motion.generator.aim(*joint, *command),
                (Target::Width, Some(hand)) => hand.aim(*command),
                (Target::Width, None) => {}
            }
        }
        Ok(())
    }

    fn make_safe(&mut self) -> Result<bool, Fault> {
        if !std::mem::replace(&mut self.halted, true)
            && let Some(hand) = &mut self.hand
        {
            // The arm is stopped whether or not the hand hears.
            hand.stop().unwrap_or_default();
        }
        let Some(motion) = &mut self.motion else { return Ok(true) };
        motion.generator.halt();
        motion.finished |= motion.generator.at_rest();
        let link = self.link.as_mut().ok_or(Fault::NotConnected)?;
        if link.now() - link.received.unwrap_or(f64::NEG_INFINITY) <= STOP {
            return Ok(false);
        }
        self.stop_move()?;
        let Some(id) = self.stopping else { return Ok(false) };
        let link = self.link()?;
        link.pump()?;
        let stopped = link.reply(id).is_some();
        if stopped {
            self.motion = None;
        }
        Ok(stopped)
    }

    fn disconnect(&mut self) {
        (self.link, self.hand, self.motion) = (None, None, None);
    }

    fn limits(&self) -> Vec<Limits> {
        // Until it has answered the arm may be either kind.
        let arm = self.link.as_ref().map_or(&FER, |link| ArmLimits::of(link.version));
        let limit = |target: &Target| match target {
            Target::Joint(joint) => Limits::of_value(Generator::range(arm, *joint)),
            Target::Width => Limits::of_value([0.0, 0.1]),
        };
        self.settings.targets.iter().map(limit).collect()
    }

    fn timeouts(&self) -> Timeouts {
        Timeouts { command: self.settings.watchdog, reading: STOP, heartbeat: STOP / 4.0 }
    }

    fn resource(&self) -> String {
        format!("{}:{}", self.settings.host, self.settings.port)
    }

    fn period(&self) -> Option<f64> {
        Some(PERIOD)
    }

    fn work(&mut self) -> Result<(), Fault> {
        self.serve()?;
        match &mut self.hand {
            Some(hand) if self.motion.is_some() => hand.work(),
            Some(hand) => hand.pump(),
            None => Ok(()),
        }
    }

    fn take_note(&mut self) -> Option<String> {
        self.note.take()
    }

    fn set_resetting(&mut self, resetting: bool) {
        self.resetting = resetting;
    }

    fn reset_duration(&self) -> f64 {
        self.settings.reset_time
    }
}
