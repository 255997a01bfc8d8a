//! Keys and a gamepad that move the action of an environment.

use super::gamepad::Gamepad;
use crate::play::Acting;
use crate::session::Session;
use eframe::egui::{Context, Key, Ui};

/// Keys that lower and raise the parts of an action, part by part.
pub(super) const PAIRS: [(Key, Key); 10] = [
    (Key::A, Key::D),
    (Key::S, Key::W),
    (Key::Q, Key::E),
    (Key::J, Key::L),
    (Key::K, Key::I),
    (Key::U, Key::O),
    (Key::F, Key::H),
    (Key::G, Key::T),
    (Key::Z, Key::X),
    (Key::N, Key::M),
];

/// Share of its range that a held key moves a part of the action by in a second.
const RATE: f64 = 0.5;

/// What moves the action, while a person acts.
#[derive(Default)]
pub(super) struct Steering {
    /// Keys do.
    pub(super) by_keys: bool,
    gamepad: Option<Gamepad>,
}

impl Steering {
    /// Keys that are taken from the shortcuts.
    pub(super) fn taken(&self, session: &Session) -> Vec<Key> {
        let acts = session.play().is_some_and(|play| play.acting() == Acting::Hand);
        let keys = PAIRS.iter().flat_map(|&(lower, raise)| [lower, raise]);
        keys.filter(|_| self.by_keys && acts).collect()
    }

    /// Takes the first gamepad there is, or lets it go.
    ///
    /// # Errors
    /// There is none.
    pub(super) fn use_gamepad(&mut self, on: bool) -> Result<(), String> {
        self.gamepad = on.then(Gamepad::first).transpose()?;
        Ok(())
    }

    /// Whether a gamepad moves the action.
    pub(super) fn has_gamepad(&self) -> bool {
        self.gamepad.is_some()
    }

    /// Moves the action of a session whose person acts; `seconds` went by.
    ///
    /// # Errors
    /// The gamepad is gone.
    pub(super) fn steer(
        &mut self,
        context: &Context,
        session: &mut Session,
        seconds: f64,
    ) -> Result<(), String> {
        let Some(play) = session.play_mut().filter(|play| play.acting() == Acting::Hand) else {
            return Ok(());
        };
        let bounds: Vec<[f64; 2]> =
            (0..play.env().action_len()).map(|k| play.env().action_bounds(k)).collect();
        let action = play.hand();
        if self.by_keys && !context.egui_wants_keyboard_input() {
            for ((value, [low, high]), (lower, raise)) in action.iter_mut().zip(&bounds).zip(PAIRS) {
                let pushed = context
                    .input(|input| f64::from(input.key_down(raise)) - f64::from(input.key_down(lower)));
                *value = (*value + pushed * RATE * seconds * (high - low)).clamp(*low, *high);
            }
        }
        if let Some(gamepad) = &mut self.gamepad {
            if let Err(why) = gamepad.poll() {
                self.gamepad = None;
                return Err(why);
            }
            for ((value, [low, high]), axis) in action.iter_mut().zip(&bounds).zip(gamepad.axes()) {
                *value = (low + high) / 2.0 + axis * (high - low) / 2.0;
            }
        }
        Ok(())
    }
}

/// What moves the action of an environment, beside sliders. The error says why a gamepad does not.
pub(super) fn steering_panel(ui: &mut Ui, steering: &mut Steering) -> Result<(), String> {
    ui.checkbox(&mut steering.by_keys, "Keys move actions").on_hover_text(
        "A D, S W, Q E, J L, K I, U O, F H, G T, Z X and N M, a pair for each part of the action",
    );
    let mut on = steering.has_gamepad();
    match ui.checkbox(&mut on, "Gamepad moves actions").changed() {
        true => steering.use_gamepad(on),
        false => Ok(()),
    }
}
