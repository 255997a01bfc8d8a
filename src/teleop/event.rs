//! What devices say: presses, releases, axes, poses of hands.

use physics::math::{Quat, Vec3};

/// A key of a keyboard.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Key {
    /// The key that writes this character; letters are lower case.
    Char(char),
    /// Arrow up.
    Up,
    /// Arrow down.
    Down,
    /// Arrow left.
    Left,
    /// Arrow right.
    Right,
    /// Return.
    Enter,
    /// Escape.
    Escape,
    /// Backspace.
    Backspace,
    /// Tabulator.
    Tab,
    /// Delete.
    Delete,
    /// Page up.
    PageUp,
    /// Page down.
    PageDown,
    /// Home.
    Home,
    /// End.
    End,
    /// Ctrl-C, which terminals do not turn into a signal while their keys are read one by one.
    Interrupt,
}

/// Names of keys that write no visible character.
const NAMES: [(&str, Key); 16] = [
    ("up", Key::Up),
    ("down", Key::Down),
    ("left", Key::Left),
    ("right", Key::Right),
    ("enter", Key::Enter),
    ("escape", Key::Escape),
    ("backspace", Key::Backspace),
    ("tab", Key::Tab),
    ("delete", Key::Delete),
    ("page_up", Key::PageUp),
    ("page_down", Key::PageDown),
    ("home", Key::Home),
    ("end", Key::End),
    ("interrupt", Key::Interrupt),
    ("space", Key::Char(' ')),
    ("plus", Key::Char('+')),
];

impl Key {
    /// The key of a name in a mapping file: a character, or a word.
    pub fn named(name: &str) -> Option<Key> {
        let mut chars = name.chars();
        match (chars.next(), chars.next()) {
            (Some(only), None) => Some(Key::Char(only.to_ascii_lowercase())),
            _ => NAMES.iter().find(|(known, _)| *known == name).map(|(_, key)| *key),
        }
    }

    /// The name of the key in a mapping file.
    pub fn name(self) -> String {
        match (NAMES.iter().find(|(_, key)| *key == self), self) {
            (Some((name, _)), _) => (*name).to_owned(),
            (None, Key::Char(c)) => c.to_string(),
            (None, other) => format!("{other:?}").to_lowercase(),
        }
    }
}

/// A device with buttons and axes of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Device {
    /// A gamepad.
    Gamepad,
    /// A six-axis mouse.
    SpaceMouse,
    /// The controllers of a headset.
    Quest,
    /// A glove with a sensor for each joint of a hand.
    Glove,
}

/// What can be pressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Button {
    /// A key of the keyboard.
    Key(Key),
    /// A button of a device, by its number there.
    Of(Device, u16),
}

/// What has a place between two ends, by its number on a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Axis(pub Device, pub u16);

/// Where a hand's controller is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HandPose {
    /// The right one.
    pub right: bool,
    /// Position \[m\].
    pub position: Vec3,
    /// Orientation.
    pub orientation: Quat,
}

/// Something that a device says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event {
    /// A button went down, or its repetition says that it is down still.
    Press(Button),
    /// A button went up.
    Release(Button),
    /// An axis went somewhere, -1 to 1, or 0 to 1 where it rests at an end
    Move(Axis, f64),
    /// A joint of a leader arm is there \[rad\]; its place among those that lead.
    Lead(u16, f64),
    /// A hand is somewhere.
    Hand(HandPose),
    /// Nothing more is known of what is held: everything is released.
    Lost(Lost),
}

/// Whose state is not known any more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lost {
    /// The keyboard: another window has it.
    Keyboard,
    /// A device: it left out events, or is gone.
    Device(Device),
}
