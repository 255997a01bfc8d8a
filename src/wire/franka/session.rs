//! What an arm's server does with requests.

use super::arm::{Arm, Recovery};
use super::motion::Motion;
use super::urdf;
use crate::device::Moment;
use protocol::franka::{
    Command, Controller, Generator, Mode, Move, MoveEnd, Outcome, Request, encode, field, reply_size,
    request_size,
};

/// How long a recovery from an error takes \[s\].
const RECOVERY: f64 = 0.1;

impl Arm {
    /// Answers a request.
    pub(super) fn reply(&self, moment: &mut Moment<'_>, command: Command, id: u32, payload: &[u8]) {
        let Some(number) = command.number(self.version) else { return };
        let mut bytes = Vec::new();
        encode(&mut bytes, number, id, payload);
        moment.outbox.send(Arm::COMMANDS, moment.time, bytes);
    }

    /// Says how a motion ended, if there is one, and brings the arm to rest.
    pub(super) fn end_motion(&mut self, moment: &mut Moment<'_>, end: MoveEnd) {
        if let Some(motion) = self.motion.take() {
            self.reply(moment, Command::Move, motion.id, &[end.byte(self.version)]);
        }
    }

    /// Takes a request.
    pub(super) fn request(&mut self, moment: &mut Moment<'_>, number: u32, id: u32, payload: &[u8]) {
        let Some(command) = Command::of(number, self.version) else { return };
        if command == Command::Connect {
            return self.greet(moment, id, payload);
        }
        if self.client.is_none() {
            return;
        }
        if payload.len() != request_size(command, self.version) {
            let answer = match command {
                Command::Move => MoveEnd::Invalid.byte(self.version),
                _ => Outcome::Invalid.setter(),
            };
            return self.reply(moment, command, id, &[answer]);
        }
        match command {
            Command::Move => self.begin(moment, id, payload),
            Command::StopMove => {
                self.end_motion(moment, MoveEnd::Preempted);
                self.reply(moment, command, id, &[0]);
            }
            Command::AutomaticErrorRecovery => self.recover(moment, id),
            Command::GetRobotModel => {
                let mut answer = vec![0];
                answer.extend(urdf::text().bytes());
                self.reply(moment, command, id, &answer);
            }
            Command::GetCartesianLimit => self.reply(moment, command, id, &vec![0; reply_size(command)]),
            // The library is the maker's; this arm has none to give.
            Command::LoadModelLibrary => self.reply(moment, command, id, &[1]),
            _ => {
                let outcome =
                    if self.motion.is_some() { Outcome::NotPossible } else { self.set(command, payload) };
                self.reply(moment, command, id, &[outcome.setter()]);
            }
        }
    }

    /// Takes a client, if it speaks this arm's version; one that does not may try again.
    fn greet(&mut self, moment: &mut Moment<'_>, id: u32, payload: &[u8]) {
        let Some(request) = Request::decode(payload) else { return };
        let own = self.version.number();
        let fits = request.version == own;
        self.client = fits.then_some(request.port);
        let [low, high] = own.to_le_bytes();
        self.reply(moment, Command::Connect, id, &[u8::from(!fits), low, high]);
    }

    fn begin(&mut self, moment: &mut Moment<'_>, id: u32, payload: &[u8]) {
        let refused = |end: MoveEnd| Err(end);
        let outcome = match Move::decode(payload, self.version) {
            None => refused(MoveEnd::Invalid),
            Some(_) if self.mode() != Mode::Idle => refused(MoveEnd::NotPossible),
            Some(asked) => match asked.generator {
                Generator::CartesianPose | Generator::CartesianVelocity => refused(MoveEnd::NotPossible),
                Generator::None if asked.controller != Controller::External => refused(MoveEnd::Invalid),
                _ => Ok(asked),
            },
        };
        let answer = match outcome {
            Err(end) => end,
            Ok(Move { generator, controller, .. }) => {
                let (begun, answered, missed) = (false, true, 0);
                self.motion = Some(Motion { generator, controller, id, begun, answered, missed });
                self.reflex = 0;
                MoveEnd::Started
            }
        };
        self.reply(moment, Command::Move, id, &[answer.byte(self.version)]);
    }

    fn recover(&mut self, moment: &mut Moment<'_>, id: u32) {
        match self.mode() {
            Mode::Reflex => self.recovery = Some(Recovery { id, end: moment.time + RECOVERY }),
            Mode::Idle => self.reply(moment, Command::AutomaticErrorRecovery, id, &[0]),
            _ => self.reply(moment, Command::AutomaticErrorRecovery, id, &[1]),
        }
    }

    fn set(&mut self, command: Command, payload: &[u8]) -> Outcome {
        let numbers: Vec<f64> =
            payload.chunks_exact(8).map(|b| b.try_into().map_or(f64::NAN, f64::from_le_bytes)).collect();
        let finite = command == Command::SetGuidingMode || numbers.iter().all(|number| number.is_finite());
        let positive = numbers.iter().all(|number| *number >= 0.0);
        match command {
            _ if !finite => return Outcome::Invalid,
            Command::SetCollisionBehavior | Command::SetJointImpedance | Command::SetCartesianImpedance
                if !positive =>
            {
                return Outcome::Invalid;
            }
            // Lower and upper torques while it accelerates, then lower and upper nominal ones.
            Command::SetCollisionBehavior => self.collision.copy_from_slice(&numbers[21..28]),
            Command::SetLoad => {
                self.state.set(field::M_LOAD, [numbers[0]]);
                self.state.set(field::F_X_CLOAD, [numbers[1], numbers[2], numbers[3]]);
            }
            Command::SetEeToK => {
                if let Ok(pose) = numbers.try_into() {
                    self.state.set::<16>(field::EE_T_K, pose);
                }
            }
            Command::SetNeToEe => {
                if let Ok(pose) = numbers.try_into() {
                    self.state.set::<16>(field::NE_T_EE, pose);
                }
            }
            _ => {}
        }
        Outcome::Done
    }
}
