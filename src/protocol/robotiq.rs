//! Robotiq 2F-85: what its registers say.
//!
//! A command has three registers from [`OUTPUT`] on, a status three from [`INPUT`] on; each is told byte by byte. Position 0
//! is open and 255 closed, of which the fingers of a 2F-85 reach about 3 to 230.
//!
//! Source: Robotiq 2F-85 instruction manual, "Control"; the ends of the fingers' travel as Polymetis has them.

/// First register of a command.
pub const OUTPUT: u16 = 0x03E8;
/// First register of a status.
pub const INPUT: u16 = 0x07D0;
/// The gripper's address on a line as it is delivered.
pub const ADDRESS: u8 = 9;
/// Width between open fingers \[m\].
pub const STROKE: f64 = 0.085;
/// Position register of open and of closed fingers.
pub const TRAVEL: [f64; 2] = [3.0, 230.0];
/// Slowest and fastest fingers \[m/s\].
pub const SPEEDS: [f64; 2] = [0.02, 0.15];
/// Weakest and strongest grip \[N\].
pub const FORCES: [f64; 2] = [20.0, 235.0];

/// Position register of a width \[m\].
pub fn register(width: f64) -> u8 {
    let [open, closed] = TRAVEL;
    (closed - (closed - open) * width / STROKE).round().clamp(0.0, 255.0) as u8
}

/// Width of a position register \[m\].
pub fn width(register: u8) -> f64 {
    let [open, closed] = TRAVEL;
    ((closed - f64::from(register)) / (closed - open) * STROKE).clamp(0.0, STROKE)
}

/// A value within a range as a register of speed or force.
pub fn share(value: f64, [low, high]: [f64; 2]) -> u8 {
    (255.0 * (value - low) / (high - low)).round().clamp(0.0, 255.0) as u8
}

/// What the gripper is to do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Action {
    /// It is switched on; a rising edge begins its activation.
    pub activate: bool,
    /// It goes to the position.
    pub go: bool,
    /// It opens slowly and stops, whatever holds it.
    pub release: bool,
    /// 0 open to 255 closed.
    pub position: u8,
    /// 0 slow to 255 fast.
    pub speed: u8,
    /// 0 weak to 255 strong.
    pub force: u8,
}

impl Action {
    /// Bytes of its registers.
    pub fn encode(self) -> [u8; 6] {
        let bits = u8::from(self.activate) | u8::from(self.go) << 3 | u8::from(self.release) << 4;
        [bits, 0, 0, self.position, self.speed, self.force]
    }

    /// What registers say.
    pub fn decode(bytes: [u8; 6]) -> Action {
        let [bits, _, _, position, speed, force] = bytes;
        let bit = |k: u8| bits >> k & 1 != 0;
        Action { activate: bit(0), go: bit(3), release: bit(4), position, speed, force }
    }
}

/// How far its activation is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Stage {
    #[default]
    Reset,
    Activating,
    Active,
}

/// What its fingers do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Object {
    #[default]
    Moving,
    StoppedOpening,
    StoppedClosing,
    AtPosition,
}

/// What the gripper says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Status {
    /// The command's bit.
    pub activate: bool,
    /// The command's bit.
    pub go: bool,
    /// How far its activation is.
    pub stage: Stage,
    /// What its fingers do.
    pub object: Object,
    /// See [`describe_fault`]; 0 is none.
    pub fault: u8,
    /// Position that was commanded.
    pub echo: u8,
    /// Position that is measured.
    pub position: u8,
    /// Current of its motor \[10 mA\].
    pub current: u8,
}

/// The fault from which on a gripper must be activated again.
pub const SERIOUS: u8 = 0x0A;

/// A fault in words.
pub fn describe_fault(fault: u8) -> &'static str {
    match fault {
        0 => "no fault",
        0x05 => "its activation must end before it moves",
        0x07 => "it is not activated",
        0x08 => "it is hotter than 85 °C",
        0x09 => "nothing was said to it for a second",
        0x0A => "its supply is below the least voltage",
        0x0B => "it is releasing what it holds",
        0x0C => "an internal fault",
        0x0D => "its activation failed; is something between the fingers?",
        0x0E => "its motor drew too much current",
        0x0F => "it has released what it held",
        _ => "a fault that its manual does not have",
    }
}

impl Status {
    /// Bytes of its registers.
    pub fn encode(self) -> [u8; 6] {
        let stage = match self.stage {
            Stage::Reset => 0,
            Stage::Activating => 1,
            Stage::Active => 3,
        };
        let bits = u8::from(self.activate) | u8::from(self.go) << 3 | stage << 4 | (self.object as u8) << 6;
        [bits, 0, self.fault, self.echo, self.position, self.current]
    }

    /// What registers say.
    pub fn decode(bytes: [u8; 6]) -> Status {
        let [bits, _, fault, echo, position, current] = bytes;
        let stage = match bits >> 4 & 3 {
            1 => Stage::Activating,
            3 => Stage::Active,
            _ => Stage::Reset,
        };
        let object = match bits >> 6 {
            0 => Object::Moving,
            1 => Object::StoppedOpening,
            2 => Object::StoppedClosing,
            _ => Object::AtPosition,
        };
        let fault = fault & 0x0F;
        Status {
            activate: bits & 1 != 0,
            go: bits >> 3 & 1 != 0,
            stage,
            object,
            fault,
            echo,
            position,
            current,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn registers_say_what_the_manual_has() {
        let action =
            Action { activate: true, go: true, position: 255, speed: 255, force: 255, release: false };
        assert_eq!(action.encode(), [0x09, 0, 0, 255, 255, 255]);
        assert_eq!(Action::decode(action.encode()), action);
        // Active, holding something that it closed on: B9.
        let status = Status::decode([0xB9, 0, 0, 0xFF, 0xBD, 0x00]);
        assert_eq!((status.stage, status.object, status.echo), (Stage::Active, Object::StoppedClosing, 255));
        assert_eq!(status.encode(), [0xB9, 0, 0, 0xFF, 0xBD, 0]);
        assert_eq!(Status::decode([0x11, 0, 0, 0, 0, 0]).stage, Stage::Activating);
        assert_eq!((register(0.0), register(STROKE), register(0.0425)), (230, 3, 117));
        assert!((width(117) - 0.0425).abs() < STROKE / 227.0);
        assert_eq!((share(0.02, SPEEDS), share(0.15, SPEEDS), share(9.0, SPEEDS)), (0, 255, 255));
    }
}
