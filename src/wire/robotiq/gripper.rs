//! What a gripper does, whatever line leads to it.

use crate::device::Moment;
use crate::plant::{Drive, Plant, PlantError};
use protocol::robotiq::{Action, Object, SERIOUS, SPEEDS, STROKE, Stage, Status, TRAVEL};

/// How long an activation takes \[s\].
const ACTIVATION: f64 = 1.5;
/// Silence after which it says so \[s\].
const SILENCE: f64 = 1.0;
/// Units of position that fingers may lag behind before something is taken to hold them.
const LAG: f64 = 8.0;
/// Share of the commanded speed below which fingers that lag behind are taken to be held.
const SLOW: f64 = 0.2;
/// How long it must be so \[s\].
const STILL: f64 = 0.1;
/// Units of position within which it has arrived.
const ARRIVED: f64 = 2.0;

/// The fingers, on a motor of the plant.
pub struct Gripper {
    motor: usize,
    /// Joint positions of closed and of open fingers.
    ends: [f64; 2],
    action: Action,
    stage: Stage,
    object: Object,
    /// When its activation began \[s\].
    begun: f64,
    fault: u8,
    /// When something was last said to it \[s\].
    heard: f64,
    /// Where the fingers are told to be, in units of position.
    told: f64,
    /// Since when they have lagged behind \[s\].
    lagging: Option<f64>,
}

impl Gripper {
    /// Fingers on this actuator, whose joint stands at the first of `ends` when they are closed and at the second when open.
    ///
    /// # Errors
    /// The plant has no such actuator, or it moves no single joint.
    pub fn new(plant: &Plant, actuator: &str, ends: [f64; 2]) -> Result<Gripper, PlantError> {
        let motor = plant.motor(actuator)?;
        let mut gripper = Gripper {
            motor,
            ends,
            action: Action::default(),
            stage: Stage::Reset,
            object: Object::Moving,
            begun: 0.0,
            fault: 0,
            heard: 0.0,
            told: 0.0,
            lagging: None,
        };
        gripper.told = gripper.measured(plant);
        Ok(gripper)
    }

    /// It has this fault from now on; a serious one ends its activation.
    pub fn break_down(&mut self, fault: u8) {
        self.fault = fault;
        if fault >= SERIOUS {
            self.stage = Stage::Reset;
        }
    }

    /// Where the fingers are, in units of position.
    fn measured(&self, plant: &Plant) -> f64 {
        let [closed, open] = self.ends;
        let width = (plant.position(self.motor) - closed) / (open - closed) * STROKE;
        let [least, most] = TRAVEL;
        most - (most - least) * width / STROKE
    }

    pub(super) fn hear(&mut self, now: f64) {
        self.heard = now;
        if self.fault == 0x09 {
            self.fault = 0;
        }
    }

    pub(super) fn command(&mut self, moment: &Moment<'_>, action: Action) {
        let before = std::mem::replace(&mut self.action, action);
        if !action.activate {
            (self.stage, self.fault) = (Stage::Reset, 0);
        } else if !before.activate {
            (self.stage, self.fault, self.begun) = (Stage::Activating, 0, moment.time);
        } else if action.go && self.fault < SERIOUS {
            self.fault = match self.stage {
                Stage::Reset => 0x07,
                Stage::Activating => 0x05,
                Stage::Active => 0,
            };
        }
        if (before.position, before.go) != (action.position, action.go) {
            (self.object, self.lagging) = (Object::Moving, None);
        }
    }

    pub(super) fn status(&self, plant: &Plant) -> Status {
        let measured = self.measured(plant).round().clamp(0.0, 255.0);
        Status {
            activate: self.action.activate,
            go: self.action.go,
            stage: self.stage,
            object: self.object,
            fault: self.fault,
            echo: self.action.position,
            position: measured as u8,
            current: if self.object == Object::Moving { 10 } else { 0 },
        }
    }

    /// Moves for a time step.
    pub(super) fn tick(&mut self, moment: &mut Moment<'_>) {
        let dt = moment.plant.model().opt.timestep;
        let now = moment.time;
        if self.stage != Stage::Reset && now - self.heard > SILENCE && self.fault == 0 {
            self.fault = 0x09;
        }
        let [open, closed] = TRAVEL;
        match self.stage {
            Stage::Reset => {}
            Stage::Activating => {
                let share = (now - self.begun) / ACTIVATION;
                let goal = if share < 0.5 { closed } else { open };
                self.approach(goal, 2.5 * (closed - open) / ACTIVATION * dt);
                if share >= 1.0 {
                    self.stage = Stage::Active;
                    self.object = Object::AtPosition;
                }
            }
            Stage::Active if self.action.go => {
                let [slow, fast] = SPEEDS;
                let speed = slow + (fast - slow) * f64::from(self.action.speed) / 255.0;
                self.go(moment.plant, speed / STROKE * (closed - open) * dt, now);
            }
            Stage::Active => {}
        }
        let width = (closed - self.told) / (closed - open);
        let [shut, wide] = self.ends;
        moment.plant.drive(self.motor, Drive::Control(shut + (wide - shut) * width));
    }

    fn approach(&mut self, goal: f64, most: f64) {
        self.told += (goal - self.told).clamp(-most, most);
    }

    /// Goes on towards the commanded position, until it is there or something holds the fingers.
    fn go(&mut self, plant: &Plant, most: f64, now: f64) {
        if matches!(self.object, Object::StoppedOpening | Object::StoppedClosing) {
            return;
        }
        let [open, closed] = TRAVEL;
        let goal = f64::from(self.action.position).clamp(open, closed);
        let measured = self.measured(plant);
        self.approach(goal, most);
        let lag = self.told - measured;
        let [closed, open] = self.ends;
        let speed = plant.velocity(self.motor).abs() / (open - closed).abs() * (TRAVEL[1] - TRAVEL[0]);
        let moves = speed * plant.model().opt.timestep > SLOW * most;
        // Fingers that still press the other way have only just been told to let go.
        let onward = lag * (goal - measured) > 0.0;
        if lag.abs() <= LAG || moves || !onward {
            self.lagging = None;
            let there = self.told == goal && (measured - goal).abs() <= ARRIVED;
            self.object = if there { Object::AtPosition } else { Object::Moving };
            return;
        }
        // It presses no harder than this.
        self.told = measured + lag.clamp(-3.0 * LAG, 3.0 * LAG);
        if now - *self.lagging.get_or_insert(now) > STILL {
            self.object = if lag > 0.0 { Object::StoppedClosing } else { Object::StoppedOpening };
        }
    }

    /// A variable of the gateway.
    pub(super) fn variable(&self, plant: &Plant, name: &str) -> Option<u8> {
        let Status { activate, go, stage, object, fault, echo, position, .. } = self.status(plant);
        Some(match name {
            "ACT" => u8::from(activate),
            "GTO" => u8::from(go),
            "ATR" => u8::from(self.action.release),
            "ADR" => 0,
            "FOR" => self.action.force,
            "SPE" => self.action.speed,
            "POS" => position,
            "STA" => match stage {
                Stage::Reset => 0,
                Stage::Activating => 1,
                Stage::Active => 3,
            },
            "PRE" => echo,
            "OBJ" => object as u8,
            "FLT" => fault,
            _ => return None,
        })
    }

    /// What is commanded, with one variable of the gateway set; `None` where there is none of that name.
    pub(super) fn with_variable(action: Action, name: &str, value: u8) -> Option<Action> {
        Some(match name {
            "ACT" => Action { activate: value != 0, ..action },
            "GTO" => Action { go: value != 0, ..action },
            "ATR" => Action { release: value != 0, ..action },
            "FOR" => Action { force: value, ..action },
            "SPE" => Action { speed: value, ..action },
            "POS" => Action { position: value, ..action },
            _ => return None,
        })
    }

    pub(super) fn action(&self) -> Action {
        self.action
    }
}
