//! Keys to commands.

use crate::command::{Command, Shortcut, shortcuts};
use eframe::egui::{Context, Key, Modifiers};

/// Keys with what they do.
pub struct Keys(Vec<(Modifiers, Key, Shortcut)>);

impl Keys {
    /// MuJoCo's.
    pub fn new() -> Self {
        let known = |shortcut: Shortcut| {
            let (modifiers, key) = parse(&shortcut.key)?;
            Some((modifiers, key, shortcut))
        };
        Keys(shortcuts().into_iter().filter_map(known).collect())
    }

    /// The commands of the keys pressed since the last frame, but those that something else takes; none while a person types
    /// text.
    pub fn pressed(&self, context: &Context, taken: &[Key]) -> Vec<Command> {
        if context.egui_wants_keyboard_input() {
            return Vec::new();
        }
        context.input(|input| {
            let held = input.modifiers;
            let is_pressed = |(modifiers, key, _): &&(Modifiers, Key, Shortcut)| {
                input.key_pressed(*key)
                    && !taken.contains(key)
                    && held.shift == modifiers.shift
                    && held.command == modifiers.command
                    && !held.alt
            };
            self.0.iter().filter(is_pressed).map(|(.., shortcut)| shortcut.command).collect()
        })
    }

    /// Keys and names, for people.
    pub fn rows(&self) -> impl Iterator<Item = (&str, &str)> {
        self.0.iter().map(|(.., shortcut)| (shortcut.key.as_str(), shortcut.name.as_str()))
    }
}

/// A key by its name, after `Shift+` or `Ctrl+`.
fn parse(name: &str) -> Option<(Modifiers, Key)> {
    let (modifiers, key) = match name.split_once('+') {
        Some(("Shift", key)) => (Modifiers::SHIFT, key),
        Some(("Ctrl", key)) => (Modifiers::COMMAND, key),
        _ => (Modifiers::NONE, name),
    };
    Some((modifiers, Key::from_name(key)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shortcut_has_a_key_of_its_own() {
        let keys = Keys::new();
        assert_eq!(keys.0.len(), shortcuts().len(), "a key has a name that egui does not know");
        for (i, (modifiers, key, shortcut)) in keys.0.iter().enumerate() {
            let twin = keys.0[..i].iter().find(|(m, k, _)| (m, k) == (modifiers, key));
            assert!(twin.is_none(), "{shortcut:?} and {twin:?}");
        }
    }
}
