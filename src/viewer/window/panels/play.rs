//! The environment that is played: what acts, how the episode goes, what is observed and rewarded.

use super::table;
use crate::play::{Acting, Play};
use crate::session::Session;
use eframe::egui::{Slider, TextWrapMode, Ui};
use env::Rows;

/// Most values of a row that are shown.
const SHOWN: usize = 6;

/// What acts, and how the episode goes.
pub fn episode(ui: &mut Ui, session: &mut Session) {
    let Some(play) = session.play_mut() else { return };
    ui.horizontal_wrapped(|ui| {
        // A name that does not fit goes to the next row, whole.
        ui.style_mut().wrap_mode = Some(TextWrapMode::Extend);
        for (name, acting) in [
            ("Zero", Acting::Zero),
            ("Random", Acting::Random),
            ("Policy", Acting::Policy),
            ("By hand", Acting::Hand),
        ] {
            let there = acting != Acting::Policy || play.has_policy();
            let choice = ui.add_enabled_ui(there, |ui| ui.selectable_label(play.acting() == acting, name));
            if choice.inner.clicked() {
                play.let_act(acting);
            }
        }
    });
    let (episode, (finished, success)) = (play.episode(), play.finished());
    let solved = if play.env().verdict().solved { "yes" } else { "no" };
    table(
        ui,
        "episode",
        [
            ("seed", play.seed().to_string()),
            ("step", format!("{} of {}", episode.steps, play.env().spec().max_episode_steps)),
            ("return", format!("{:.4}", episode.reward)),
            ("solved now", solved.to_owned()),
            ("solved steps", episode.solved.to_string()),
            ("episodes over", finished.to_string()),
            ("success", format!("{:.0} %", 100.0 * success)),
        ],
    );
}

/// A slider for each part of the action; they act when a person does.
pub fn actions(ui: &mut Ui, session: &mut Session) {
    let Some(play) = session.play_mut() else { return };
    let by_hand = play.acting() == Acting::Hand;
    let bounds: Vec<_> = (0..play.env().action_len()).map(|k| play.env().action_bounds(k)).collect();
    let mut shown = if by_hand { play.hand().to_vec() } else { play.action().to_vec() };
    for (k, (value, [low, high])) in shown.iter_mut().zip(bounds).enumerate() {
        ui.add_enabled(by_hand, Slider::new(value, low..=high).text(format!("action {k}")));
    }
    if by_hand {
        play.hand().copy_from_slice(&shown);
    }
}

/// The terms of the reward.
pub fn reward(ui: &mut Ui, session: &Session) {
    let Some(play) = session.play() else { return };
    rows(ui, "reward", play, play.env().terms());
}

/// What is observed.
pub fn observation(ui: &mut Ui, session: &Session) {
    let Some(play) = session.play() else { return };
    rows(ui, "observation", play, play.env().rows());
}

fn rows(ui: &mut Ui, name: &str, play: &Play, rows: &Rows) {
    let weight = |key: &str| play.env().weights().iter().find(|(term, _)| term == key);
    table(
        ui,
        name,
        rows.iter().map(|(row, values)| {
            let mut text: Vec<String> =
                values.iter().take(SHOWN).map(|value| format!("{value:.4}")).collect();
            if values.len() > SHOWN {
                text.push(format!("… ({} values)", values.len()));
            }
            let weight = weight(row.name()).map_or(String::new(), |(_, weight)| format!("  × {weight}"));
            (row.name(), text.join(" ") + &weight)
        }),
    );
}
