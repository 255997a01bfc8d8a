//! The arm: a thousand states a second, and the joints that follow what is commanded.

use super::motion::{Desired, Judge, Motion};
use crate::device::{Device, Moment};
use crate::plant::{Drive, Plant, PlantError};
use crate::shaft::Shaft;
use protocol::franka::{
    CYCLE, Command, Decoder, JOINTS, MISSED_CYCLES, Mode, MoveEnd, Setpoint, State, Version, error_bit,
    field, flange, identity,
};

/// A joint that moves this much faster than its limit is stopped, as a share of it.
const OVERSPEED: f64 = 0.1;
/// A joint may be this far beyond the end of its range before it is stopped \[rad\].
const OVERTRAVEL: f64 = 0.02;

/// A recovery from an error under way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Recovery {
    pub(super) id: u32,
    /// \[s\].
    pub(super) end: f64,
}

/// An arm with seven joints, see [the module](super).
pub struct Arm {
    pub(super) version: Version,
    shafts: [Shaft; JOINTS],
    judge: Judge,
    decoder: Decoder,
    /// Port of the client that has connected.
    pub(super) client: Option<u16>,
    pub(super) motion: Option<Motion>,
    pub(super) recovery: Option<Recovery>,
    desired: Desired,
    /// What the joint's torque must not exceed from outside \[N m\].
    pub(super) collision: [f64; JOINTS],
    errors: u64,
    pub(super) reflex: u64,
    stopped: bool,
    patient: bool,
    /// Number of the next state.
    cycle: u64,
    /// Commands of the last hundred cycles that came in time, newest in bit 0.
    arrived: u128,
    pub(super) state: State,
}

impl Arm {
    /// Channel of its server.
    pub const COMMANDS: usize = 0;
    /// Channel of its states and of the commands that answer them.
    pub const STATES: usize = 1;

    /// An arm whose joints are these actuators of the plant, where they stand.
    ///
    /// # Errors
    /// The plant has no such actuator, or it moves no single joint.
    pub fn new(version: Version, plant: &Plant, actuators: [&str; JOINTS]) -> Result<Arm, PlantError> {
        let mut shafts = [Shaft { motor: 0, scale: 1.0, offset: 0.0 }; JOINTS];
        for (shaft, name) in shafts.iter_mut().zip(actuators) {
            shaft.motor = plant.motor(name)?;
        }
        let mut state = State::default();
        for pose in [field::F_T_EE, field::F_T_NE, field::NE_T_EE, field::EE_T_K] {
            state.set(pose, identity());
        }
        let q = shafts.map(|shaft| shaft.angle(plant));
        Ok(Arm {
            version,
            shafts,
            judge: Judge::new(version),
            decoder: Decoder::arm(),
            client: None,
            motion: None,
            recovery: None,
            desired: Desired { q, ..Desired::default() },
            collision: [f64::INFINITY; JOINTS],
            errors: 0,
            reflex: 0,
            stopped: false,
            patient: false,
            cycle: (plant.time() / CYCLE).round() as u64 + 1,
            arrived: 0,
            state,
        })
    }

    /// The same arm on joints that count their angles otherwise: the arm's angle \[rad\] is joint × scale + offset, with a
    /// scale of 1 or -1.
    #[must_use]
    pub fn mounted(mut self, plant: &Plant, mounts: [[f64; 2]; JOINTS]) -> Arm {
        for (shaft, [scale, offset]) in self.shafts.iter_mut().zip(mounts) {
            (shaft.scale, shaft.offset) = (scale, offset);
        }
        self.desired.q = self.shafts.map(|shaft| shaft.angle(plant));
        self
    }

    /// Takes every command that is a number, as no arm of steel would: for comparison with a simulation whose targets jump.
    #[must_use]
    pub fn without_limits(mut self) -> Arm {
        self.judge.lenient = true;
        self
    }

    /// Lets time wait for its client where [`serve`](crate::serve) serves it, so that one without a real-time system is
    /// never late.
    #[must_use]
    pub fn patient(mut self) -> Arm {
        self.patient = true;
        self
    }

    /// What it is doing.
    pub(super) fn mode(&self) -> Mode {
        if self.stopped {
            Mode::UserStopped
        } else if self.recovery.is_some() {
            Mode::Recovering
        } else if self.errors != 0 {
            Mode::Reflex
        } else if self.motion.is_some() {
            Mode::Move
        } else {
            Mode::Idle
        }
    }

    /// Ends what it does because of an error.
    fn fail(&mut self, moment: &mut Moment<'_>, errors: u64) {
        self.errors |= errors;
        self.reflex = errors;
        self.end_motion(moment, MoveEnd::Reflex);
    }

    /// Takes the answer to a state.
    fn answer(&mut self, moment: &mut Moment<'_>, setpoint: &Setpoint) {
        let Some(mut motion) = self.motion else { return };
        // An answer to an old state comes too late, a second one to the same state is one too many.
        if motion.answered || setpoint.message + 1 != self.cycle {
            return;
        }
        match self.judge.follow(&self.desired, &motion, setpoint) {
            Err(errors) => return self.fail(moment, errors),
            Ok(desired) => self.desired = desired,
        }
        (motion.begun, motion.answered, motion.missed) = (true, true, 0);
        self.motion = Some(motion);
        self.arrived |= 1;
        let finished = setpoint.finished || setpoint.torque_finished && motion.external();
        if !finished {
            return;
        }
        if self.judge.at_rest(&self.desired) {
            self.end_motion(moment, MoveEnd::Success);
        } else {
            self.fail(moment, error_bit("joint_motion_generator_velocity_discontinuity"));
        }
    }

    /// What a cycle brings about by itself, before its state.
    fn pass_cycle(&mut self, moment: &mut Moment<'_>) {
        self.arrived = self.arrived << 1 & ((1 << 100) - 1);
        if let Some(Recovery { id, end }) = self.recovery
            && moment.time >= end
        {
            self.recovery = None;
            self.errors = 0;
            self.reply(moment, Command::AutomaticErrorRecovery, id, &[0]);
        }
        match &mut self.motion {
            Some(motion) if !motion.answered && motion.begun => {
                motion.missed += 1;
                let (missed, motion) = (motion.missed, *motion);
                if missed >= MISSED_CYCLES {
                    self.fail(moment, error_bit("communication_constraints_violation"));
                } else {
                    self.judge.extrapolate(&mut self.desired, &motion);
                }
            }
            Some(_) => {}
            None => self.judge.brake(&mut self.desired),
        }
        if let Some(motion) = &mut self.motion {
            motion.answered = false;
            if motion.external() {
                let plant = &moment.plant;
                self.desired.q = self.shafts.map(|shaft| shaft.angle(plant));
                self.desired.dq = self.shafts.map(|shaft| shaft.velocity(plant));
            }
            self.watch(moment);
        }
    }

    /// Stops joints that are where they must not be, or run into something.
    fn watch(&mut self, moment: &mut Moment<'_>) {
        if self.judge.lenient {
            return;
        }
        let mut errors = 0;
        for (k, shaft) in self.shafts.into_iter().enumerate() {
            let [low, high] = self.judge.limits.position[k];
            let q = shaft.angle(moment.plant);
            if q < low - OVERTRAVEL || q > high + OVERTRAVEL {
                errors |= error_bit("joint_position_limits_violation");
            }
            if shaft.velocity(moment.plant).abs() > self.judge.limits.velocity[k] * (1.0 + OVERSPEED) {
                errors |= error_bit("joint_velocity_violation");
            }
            if shaft.external(moment.plant).abs() > self.collision[k] {
                errors |= error_bit("joint_reflex");
            }
        }
        if errors != 0 {
            self.fail(moment, errors);
        }
    }

    /// Fills in what it measures.
    fn measure(&mut self, plant: &Plant) {
        let all = |read: fn(&Shaft, &Plant) -> f64| self.shafts.map(|shaft| read(&shaft, plant));
        let (q, dq) = (all(Shaft::angle), all(Shaft::velocity));
        let (effort, external) = (all(Shaft::effort), all(Shaft::external));
        let (mode, desired, state) = (self.mode(), self.desired, &mut self.state);
        state.message = self.cycle;
        (state.mode, state.errors, state.reflex) = (mode, self.errors, self.reflex);
        (state.generator, state.controller) = self
            .motion
            .map_or((0, 3), |motion| (motion.generator.number() as u8 + 1, motion.controller.number() as u8));
        state.success = f64::from(self.arrived.count_ones()) / 100.0;
        for (place, values) in [
            (field::Q, q),
            (field::THETA, q),
            (field::DQ, dq),
            (field::DTHETA, dq),
            (field::Q_D, desired.q),
            (field::DQ_D, desired.dq),
            (field::DDQ_D, desired.ddq),
            (field::TAU_J, effort),
            (field::TAU_J_D, desired.torque),
            (field::TAU_EXT, external),
        ] {
            state.set(place, values);
        }
        let sign = |q4: f64| if q4 < 0.0 { -1.0 } else { 1.0 };
        state.set(field::ELBOW, [q[2], sign(q[3])]);
        state.set(field::ELBOW_D, [desired.q[2], sign(desired.q[3])]);
        state.set(field::O_T_EE, flange(&q));
        state.set(field::O_T_EE_D, flange(&desired.q));
        state.set(field::O_T_EE_C, flange(&desired.q));
        let touched = external.map(|torque| f64::from(u8::from(torque.abs() > 5.0)));
        state.set(field::JOINT_CONTACT, touched);
    }
}

impl Device for Arm {
    fn receive(&mut self, moment: &mut Moment<'_>, channel: usize, bytes: &[u8]) {
        if channel == Arm::STATES {
            if let Some(setpoint) = Setpoint::decode(bytes, self.version) {
                self.answer(moment, &setpoint);
            }
            return;
        }
        let mut decoder = std::mem::replace(&mut self.decoder, Decoder::arm());
        decoder.push(bytes);
        while let Some(frame) = decoder.next_frame() {
            match frame {
                Ok(frame) => self.request(moment, frame.command, frame.id, frame.payload),
                // Nothing in the stream can be understood from here on.
                Err(_) => {
                    decoder = Decoder::arm();
                    break;
                }
            }
        }
        self.decoder = decoder;
    }

    fn tick(&mut self, moment: &mut Moment<'_>) {
        let external = self.motion.is_some_and(|motion| motion.external());
        for (k, shaft) in self.shafts.into_iter().enumerate() {
            let drive = if external {
                shaft.torque(moment.plant, self.desired.torque[k])
            } else {
                Drive::Control(shaft.joint(self.desired.q[k]))
            };
            moment.plant.drive(shaft.motor, drive);
        }
    }

    fn stop_button(&mut self, pressed: bool) {
        self.stopped = pressed;
        self.recovery = None;
    }

    fn due(&self) -> f64 {
        self.cycle as f64 * CYCLE
    }

    fn work(&mut self, moment: &mut Moment<'_>) {
        if self.stopped {
            self.end_motion(moment, MoveEnd::Emergency);
        }
        self.pass_cycle(moment);
        self.measure(moment.plant);
        if self.client.is_some() {
            moment.outbox.send(Arm::STATES, moment.time, self.state.encode(self.version));
        }
        self.cycle += 1;
    }

    fn expects(&self) -> bool {
        self.patient && self.motion.is_some_and(|motion| motion.begun && !motion.answered)
    }

    fn connected(&mut self, _moment: &mut Moment<'_>, channel: usize, _connected: bool) {
        if channel == Arm::COMMANDS {
            self.client = None;
            self.motion = None;
            self.recovery = None;
            self.decoder = Decoder::arm();
        }
    }

    fn announced(&self, channel: usize) -> Option<u16> {
        self.client.filter(|_| channel == Arm::STATES)
    }
}
