//! Six-axis mice of 3Dconnexion, from the reports of Linux's `hidraw`. Some models send translation and rotation in two reports of
//! three numbers, some in one of six: the length says which.

use crate::event::{Axis, Button, Device, Event};

/// Numbers at which the cap is at its end.
const FULL: f64 = 350.0;
/// Share of its way within which the cap counts as released.
const DEAD: f64 = 0.05;

/// Axes by the names of mapping files.
pub const AXES: [(&str, u16); 6] = [("x", 0), ("y", 1), ("z", 2), ("roll", 3), ("pitch", 4), ("yaw", 5)];

/// Buttons by the names of mapping files: eight times the byte, plus the bit.
pub const BUTTONS: [(&str, u16); 14] = [
    ("left", 0),
    ("right", 1),
    ("fit", 1),
    ("top", 2),
    ("side", 4),
    ("front", 5),
    ("1", 12),
    ("2", 13),
    ("3", 14),
    ("4", 15),
    ("escape", 22),
    ("alt", 23),
    ("shift", 24),
    ("ctrl", 25),
];

/// Where each number of a report goes, and its sign: translation x, y, z; rotation about x, y, z, of which the first is pitch.
const PLACES: [(u16, f64); 6] = [(0, 1.0), (1, -1.0), (2, -1.0), (4, -1.0), (3, -1.0), (5, 1.0)];

/// Decodes the reports of a six-axis mouse.
#[derive(Debug, Default)]
pub struct SpaceMouse {
    pressed: Vec<u8>,
}

impl SpaceMouse {
    /// Takes one report, as one reading of the device returns it.
    pub fn report(&mut self, report: &[u8], events: &mut Vec<Event>) {
        match report {
            [1, numbers @ ..] if numbers.len() >= 12 => moves(0, &numbers[..12], events),
            [1, numbers @ ..] if numbers.len() >= 6 => moves(0, &numbers[..6], events),
            [2, numbers @ ..] if numbers.len() >= 6 => moves(3, &numbers[..6], events),
            [3, bytes @ ..] => self.buttons(bytes, events),
            // Batteries and the like.
            _ => {}
        }
    }

    fn buttons(&mut self, bytes: &[u8], events: &mut Vec<Event>) {
        let count = self.pressed.len().max(bytes.len());
        for byte in 0..count {
            let of = |bytes: &[u8]| bytes.get(byte).copied().unwrap_or(0);
            let (before, now) = (of(&self.pressed), of(bytes));
            for bit in (0..8).filter(|bit| (before ^ now) >> bit & 1 == 1) {
                let button = Button::Of(Device::SpaceMouse, (8 * byte + bit) as u16);
                events.push(if now >> bit & 1 == 1 { Event::Press(button) } else { Event::Release(button) });
            }
        }
        self.pressed = bytes.to_vec();
    }
}

/// The axes that numbers stand for, the first being the `from`th of a report of six.
fn moves(from: usize, numbers: &[u8], events: &mut Vec<Event>) {
    for (bytes, (axis, sign)) in numbers.as_chunks::<2>().0.iter().zip(&PLACES[from..]) {
        let place = (sign * f64::from(i16::from_le_bytes(*bytes)) / FULL).clamp(-1.0, 1.0);
        let beyond = ((place.abs() - DEAD) / (1.0 - DEAD)).max(0.0);
        events.push(Event::Move(Axis(Device::SpaceMouse, *axis), place.signum() * beyond));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axes(reports: &[Vec<u8>]) -> [f64; 6] {
        let (mut mouse, mut events) = (SpaceMouse::default(), Vec::new());
        reports.iter().for_each(|report| mouse.report(report, &mut events));
        let mut places = [0.0; 6];
        for event in events {
            let Event::Move(Axis(_, axis), place) = event else { panic!("{event:?}") };
            places[usize::from(axis)] = place;
        }
        places
    }

    fn report(id: u8, numbers: &[i16]) -> Vec<u8> {
        [id].into_iter().chain(numbers.iter().flat_map(|number| number.to_le_bytes())).collect()
    }

    #[test]
    fn both_families_of_reports_say_the_same() {
        let numbers = [350, 350, -350, 350, -175, 10];
        let one = axes(&[report(1, &numbers)]);
        assert_eq!(one, axes(&[report(1, &numbers[..3]), report(2, &numbers[3..])]));
        let [x, y, z, roll, pitch, yaw] = one;
        assert_eq!((x, y, z, pitch, yaw), (1.0, -1.0, 1.0, -1.0, 0.0));
        assert!((roll - 0.45 / 0.95).abs() < 1e-12, "{roll}");
        assert_eq!(axes(&[report(1, &[i16::MIN, 0, 0, 0, 0, 0])])[0], -1.0);
    }

    #[test]
    fn buttons_are_told_when_they_change() {
        let (mut mouse, mut events) = (SpaceMouse::default(), Vec::new());
        for report in
            [&[3, 0b11, 0][..], &[3, 0b10, 0], &[3, 0b10, 0], &[3, 0, 0b0001_0000], &[3], &[23, 50], &[]]
        {
            mouse.report(report, &mut events);
        }
        let [left, right, one] = [0, 1, 12].map(|bit| Button::Of(Device::SpaceMouse, bit));
        let expected = [
            Event::Press(left),
            Event::Press(right),
            Event::Release(left),
            Event::Release(right),
            Event::Press(one),
            Event::Release(one),
        ];
        assert_eq!(events, expected);
    }
}
