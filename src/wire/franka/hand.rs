//! The hand: fingers that move to a width, and grasp what is between them.

use crate::device::{Device, Moment};
use crate::plant::{Drive, Plant, PlantError};
use protocol::franka::Decoder;
use protocol::franka::hand::{State, VERSION, command, encode, numbers, status};

/// Time between two states \[s\]. The documents do not say how many a second there are; 10 is a guess.
const PERIOD: f64 = 0.1;
/// Speed while it finds its largest width \[m/s\].
const HOMING: f64 = 0.05;
/// Widths that are the same \[m\].
const SAME: f64 = 1e-3;
/// How long the fingers stand still before they are taken to be stopped \[s\].
const STILL: f64 = 0.2;

/// A command under way.
#[derive(Clone, Copy, Debug)]
struct Task {
    command: u16,
    id: u32,
    /// \[m\].
    width: f64,
    /// \[m/s\].
    speed: f64,
    epsilon: [f64; 2],
    /// When the fingers last moved \[s\].
    moved: f64,
}

/// A hand: the width is twice the travel of one finger.
pub struct Hand {
    motor: usize,
    /// Largest width \[m\].
    largest: f64,
    homed: bool,
    grasped: bool,
    decoder: Decoder,
    client: Option<u16>,
    task: Option<Task>,
    /// Width that the fingers are told \[m\].
    told: f64,
    before: f64,
    next: f64,
    message: u32,
}

impl Hand {
    /// Channel of its server.
    pub const COMMANDS: usize = 0;
    /// Channel of its states.
    pub const STATES: usize = 1;

    /// A hand whose finger is this actuator of the plant, already homed.
    ///
    /// # Errors
    /// The plant has no such actuator, or it moves no single joint.
    pub fn new(plant: &Plant, actuator: &str, largest: f64) -> Result<Hand, PlantError> {
        let motor = plant.motor(actuator)?;
        let width = 2.0 * plant.position(motor);
        Ok(Hand {
            motor,
            largest,
            homed: true,
            grasped: false,
            decoder: Decoder::hand(),
            client: None,
            task: None,
            told: width,
            before: width,
            next: plant.time(),
            message: 0,
        })
    }

    /// As it is after it was switched on: it does not know its largest width.
    #[must_use]
    pub fn not_homed(mut self) -> Hand {
        self.homed = false;
        self
    }

    fn reply(moment: &mut Moment<'_>, command: u16, id: u32, payload: &[u8]) {
        let mut bytes = Vec::new();
        encode(&mut bytes, command, id, payload);
        moment.outbox.send(Hand::COMMANDS, moment.time, bytes);
    }

    fn request(&mut self, moment: &mut Moment<'_>, command: u16, id: u32, payload: &[u8]) {
        let time = moment.time;
        let mut begin = |hand: &mut Hand, width: f64, speed: f64, epsilon: [f64; 2]| {
            let possible = hand.homed || command == command::HOMING;
            let within = (0.0..=hand.largest + SAME).contains(&width) && speed > 0.0 && speed.is_finite();
            if !possible || !within {
                return Hand::reply(moment, command, id, &status::FAIL.to_le_bytes());
            }
            hand.abort(moment);
            hand.grasped = false;
            hand.task = Some(Task { command, id, width, speed, epsilon, moved: time });
        };
        match command {
            command::CONNECT => {
                let [a, b, c, d] = *payload else { return };
                let fits = u16::from_le_bytes([a, b]) == VERSION;
                self.client = fits.then_some(u16::from_le_bytes([c, d]));
                let answer = [u16::from(!fits).to_le_bytes(), VERSION.to_le_bytes()];
                Hand::reply(moment, command, id, answer.as_flattened());
            }
            _ if self.client.is_none() => {}
            command::HOMING => {
                self.homed = false;
                let largest = self.largest;
                begin(self, largest, HOMING, [0.0; 2]);
            }
            command::GRASP => match numbers::<5>(payload) {
                Some([width, inner, outer, speed, force]) if force >= 0.0 => {
                    begin(self, width, speed, [inner, outer]);
                }
                _ => Hand::reply(moment, command, id, &status::FAIL.to_le_bytes()),
            },
            command::MOVE => match numbers::<2>(payload) {
                Some([width, speed]) => begin(self, width, speed, [0.0; 2]),
                None => Hand::reply(moment, command, id, &status::FAIL.to_le_bytes()),
            },
            command::STOP => {
                self.abort(moment);
                self.told = 2.0 * moment.plant.position(self.motor);
                Hand::reply(moment, command, id, &status::SUCCESS.to_le_bytes());
            }
            _ => {}
        }
    }

    /// Ends the command under way.
    fn abort(&mut self, moment: &mut Moment<'_>) {
        if let Some(task) = self.task.take() {
            Hand::reply(moment, task.command, task.id, &status::ABORTED.to_le_bytes());
        }
    }

    /// Goes on with the command under way for `dt` seconds.
    fn go_on(&mut self, moment: &mut Moment<'_>, dt: f64) {
        let Some(mut task) = self.task else { return };
        let width = 2.0 * moment.plant.position(self.motor);
        // Grasping fingers press beyond what they hold.
        let goal = if task.command == command::GRASP { 0.0 } else { task.width };
        let most = task.speed * dt;
        self.told += (goal - self.told).clamp(-most, most);
        if (width - self.before).abs() > 1e-5 {
            task.moved = moment.time;
            self.before = width;
        }
        let still = moment.time - task.moved > STILL;
        let arrived =
            task.command != command::GRASP && (width - task.width).abs() < SAME && self.told == goal;
        self.task = Some(task);
        if !arrived && !still {
            return;
        }
        self.task = None;
        let answer = match task.command {
            command::HOMING => {
                self.homed = true;
                status::SUCCESS
            }
            command::MOVE if arrived => status::SUCCESS,
            command::MOVE => status::UNSUCCESSFUL,
            _ => {
                let [inner, outer] = task.epsilon;
                self.grasped = width > SAME && width > task.width - inner && width < task.width + outer;
                if self.grasped { status::SUCCESS } else { status::UNSUCCESSFUL }
            }
        };
        Hand::reply(moment, task.command, task.id, &answer.to_le_bytes());
    }
}

impl Device for Hand {
    fn receive(&mut self, moment: &mut Moment<'_>, channel: usize, bytes: &[u8]) {
        if channel != Hand::COMMANDS {
            return;
        }
        let mut decoder = std::mem::replace(&mut self.decoder, Decoder::hand());
        decoder.push(bytes);
        while let Some(frame) = decoder.next_frame() {
            let Ok(frame) = frame else {
                decoder = Decoder::hand();
                break;
            };
            if let Ok(command) = u16::try_from(frame.command) {
                self.request(moment, command, frame.id, frame.payload);
            }
        }
        self.decoder = decoder;
    }

    fn tick(&mut self, moment: &mut Moment<'_>) {
        let dt = moment.plant.model().opt.timestep;
        self.go_on(moment, dt);
        moment.plant.drive(self.motor, Drive::Control(self.told / 2.0));
    }

    fn stop_button(&mut self, _pressed: bool) {
        // The arm's button leaves the hand its power, so that it drops nothing.
    }

    fn due(&self) -> f64 {
        self.next
    }

    fn work(&mut self, moment: &mut Moment<'_>) {
        self.next += PERIOD;
        self.message += 1;
        if self.client.is_none() {
            return;
        }
        let state = State {
            message: self.message,
            width: 2.0 * moment.plant.position(self.motor),
            max_width: if self.homed { self.largest } else { 0.0 },
            grasped: self.grasped,
            temperature: 30,
        };
        moment.outbox.send(Hand::STATES, moment.time, state.encode());
    }

    fn connected(&mut self, _moment: &mut Moment<'_>, channel: usize, _connected: bool) {
        if channel == Hand::COMMANDS {
            self.client = None;
            self.task = None;
            self.decoder = Decoder::hand();
        }
    }

    fn announced(&self, channel: usize) -> Option<u16> {
        self.client.filter(|_| channel == Hand::STATES)
    }
}
