//! Keys, buttons and axes that are held, and when they expire.

use crate::event::{Axis, Button, Device, Event, HandPose, Lost};
use std::collections::{BTreeMap, BTreeSet};

/// Time after which a key or a report that is not repeated counts as released, for devices that do not report releases \[s\].
pub const BELIEF: f64 = 0.15;

/// Keys, buttons and axes of all devices that are held now.
#[derive(Clone, Debug, Default)]
pub struct Held {
    /// Buttons that are down, and the time of their last report \[s\].
    down: BTreeMap<Button, f64>,
    /// Buttons that went down since the last sample.
    struck: BTreeSet<Button>,
    axes: BTreeMap<Axis, (f64, f64)>,
    hands: [Option<(HandPose, f64)>; 2],
    /// Joints of a leader arm.
    leader: BTreeMap<u16, (f64, f64)>,
    /// Whether the keyboard reports releases.
    tells_releases: bool,
}

/// The input of a tick.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sample {
    /// Buttons that are down, or were since the last sample.
    pub down: BTreeSet<Button>,
    /// Those of them that were not down before.
    pub struck: BTreeSet<Button>,
    /// Axes that are not at rest.
    pub axes: BTreeMap<Axis, f64>,
    /// The left and the right hand.
    pub hands: [Option<HandPose>; 2],
    /// Joints of a leader arm \[rad\].
    pub leader: BTreeMap<u16, f64>,
}

impl Held {
    /// Sets whether the keyboard reports releases.
    pub fn tells_releases(&mut self, does: bool) {
        self.tells_releases = does;
    }

    /// Takes an event of the time `now` \[s\].
    pub fn apply(&mut self, event: Event, now: f64) {
        match event {
            Event::Press(button) => {
                let before = self.down.insert(button, now);
                // A key whose repetitions were late had expired, and counts as pressed again.
                if before.is_none_or(|then| self.is_over(button, then, now)) {
                    self.struck.insert(button);
                }
            }
            Event::Release(button) => drop(self.down.remove(&button)),
            Event::Move(axis, place) => drop(self.axes.insert(axis, (place, now))),
            Event::Lead(joint, place) => drop(self.leader.insert(joint, (place, now))),
            Event::Hand(hand) => self.hands[usize::from(hand.right)] = Some((hand, now)),
            Event::Lost(Lost::Keyboard) => self.down.retain(|button, _| !matches!(button, Button::Key(_))),
            Event::Lost(Lost::Device(device)) => {
                self.down.retain(|button, _| !matches!(button, Button::Of(of, _) if *of == device));
                self.axes.retain(|axis, _| axis.0 != device);
                if device == Device::Quest {
                    self.hands = [None; 2];
                }
            }
        }
    }

    /// The input held at `now` \[s\]. A button that was pressed and released since the last sample counts as held once.
    pub fn sample(&mut self, now: f64) -> Sample {
        let over: Vec<Button> = self
            .down
            .iter()
            .filter(|&(&button, &then)| self.is_over(button, then, now))
            .map(|(b, _)| *b)
            .collect();
        self.down.retain(|button, _| !over.contains(button));
        self.axes.retain(|axis, (_, then)| axis.0 == Device::Gamepad || now - *then <= BELIEF);
        self.leader.retain(|_, (_, then)| now - *then <= BELIEF);
        let hand = |hand: Option<(HandPose, f64)>| {
            hand.filter(|(_, then)| now - then <= BELIEF).map(|(hand, _)| hand)
        };
        let struck = std::mem::take(&mut self.struck);
        Sample {
            down: self.down.keys().chain(&struck).copied().collect(),
            struck,
            axes: self
                .axes
                .iter()
                .filter(|(axis, (place, _))| *place != 0.0 || axis.0 == Device::Glove)
                .map(|(axis, (place, _))| (*axis, *place))
                .collect(),
            hands: self.hands.map(hand),
            leader: self.leader.iter().map(|(joint, (place, _))| (*joint, *place)).collect(),
        }
    }

    /// Whether a report of the time `then` \[s\] has expired. Reports of gamepads do not expire: they send changes only.
    fn is_over(&self, button: Button, then: f64, now: f64) -> bool {
        let believed = match button {
            Button::Key(_) => self.tells_releases,
            Button::Of(device, _) => device != Device::Quest,
        };
        !believed && now - then > BELIEF
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::event::Key;

    const D: Button = Button::Key(Key::Char('d'));

    #[test]
    fn a_key_is_released_when_its_repetitions_end() {
        let mut held = Held::default();
        held.apply(Event::Press(D), 0.0);
        assert!(held.sample(0.05).struck.contains(&D));
        for k in 1..20 {
            held.apply(Event::Press(D), 0.04 * f64::from(k));
            let sample = held.sample(0.04 * f64::from(k));
            assert!(sample.down.contains(&D) && sample.struck.is_empty());
        }
        // The last repetition came at 0.76 s.
        assert!(held.sample(0.86).down.contains(&D));
        assert!(held.sample(0.96).down.is_empty());
        // With releases it is held until one comes.
        held.tells_releases(true);
        held.apply(Event::Press(D), 1.0);
        assert!(held.sample(5.0).down.contains(&D));
        held.apply(Event::Release(D), 5.1);
        assert!(held.sample(5.2).down.is_empty());
        held.apply(Event::Press(D), 6.0);
        held.apply(Event::Lost(Lost::Keyboard), 6.1);
        assert_eq!(held.sample(6.2).down.len(), 1, "it was struck since the last sample");
        assert!(held.sample(6.3).down.is_empty());
    }

    #[test]
    fn a_short_strike_counts_once() {
        let mut held = Held::default();
        held.tells_releases(true);
        held.apply(Event::Press(D), 0.0);
        held.apply(Event::Release(D), 0.01);
        let sample = held.sample(0.08);
        assert!(sample.down.contains(&D) && sample.struck.contains(&D));
        assert!(held.sample(0.16).down.is_empty());
    }

    #[test]
    fn reports_that_end_are_releases_and_steady_sticks_are_not() {
        let mut held = Held::default();
        let (stick, cap) = (Axis(Device::Gamepad, 0), Axis(Device::SpaceMouse, 0));
        let hand = HandPose { right: true, position: [0.0; 3], orientation: [1.0, 0.0, 0.0, 0.0] };
        let grip = Button::Of(Device::Quest, 4);
        held.apply(Event::Move(stick, 0.5), 0.0);
        held.apply(Event::Move(cap, 0.5), 0.0);
        held.apply(Event::Hand(hand), 0.0);
        held.apply(Event::Press(grip), 0.0);
        let sample = held.sample(0.1);
        assert_eq!((sample.axes.len(), sample.hands[1], sample.down.len()), (2, Some(hand), 1));
        let sample = held.sample(0.2);
        assert_eq!((sample.axes.len(), sample.hands[1], sample.down.len()), (1, None, 0));
        held.apply(Event::Lost(Lost::Device(Device::Gamepad)), 0.3);
        assert!(held.sample(0.4).axes.is_empty());
    }
}
