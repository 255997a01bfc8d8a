//! Controllers of a Quest, from the lines that the app of oculus_reader writes to the log of Android:
//! `TAG: POSE|POSE&BUTTONS`, a pose being `r:` or `l:` and sixteen numbers row by row, in the frame of the head.

use crate::event::{Axis, Button, Device, Event, HandPose};
use physics::math::mat_to_quat;

/// What stands before the payload of a line.
const TAG: &str = "wE9ryARX: ";

/// Buttons by the names of the log, which are those of mapping files.
pub const BUTTONS: [(&str, u16); 14] = [
    ("R", 0),
    ("A", 1),
    ("B", 2),
    ("RTr", 3),
    ("RG", 4),
    ("RThU", 5),
    ("RJ", 6),
    ("L", 7),
    ("X", 8),
    ("Y", 9),
    ("LTr", 10),
    ("LG", 11),
    ("LThU", 12),
    ("LJ", 13),
];

/// Axes by the names of the log; sticks have two.
pub const AXES: [(&str, u16); 8] = [
    ("rightTrig", 0),
    ("rightGrip", 1),
    ("rightJS_x", 2),
    ("rightJS_y", 3),
    ("leftTrig", 4),
    ("leftGrip", 5),
    ("leftJS_x", 6),
    ("leftJS_y", 7),
];

/// Longest line that can be one of the app.
const LONGEST: usize = 4096;

/// Decodes lines of the log.
#[derive(Debug, Default)]
pub struct Quest {
    rest: Vec<u8>,
    pressed: Vec<u16>,
}

impl Quest {
    /// Takes bytes, in pieces of any length.
    pub fn feed(&mut self, bytes: &[u8], events: &mut Vec<Event>) {
        self.rest.extend_from_slice(bytes);
        while let Some(end) = self.rest.iter().position(|&byte| byte == b'\n') {
            let line: Vec<u8> = self.rest.drain(..=end).collect();
            if let Ok(line) = std::str::from_utf8(&line) {
                self.line(line.trim_end(), events);
            }
        }
        if self.rest.len() > LONGEST {
            self.rest.clear();
        }
    }

    fn line(&mut self, line: &str, events: &mut Vec<Event>) {
        let Some((_, payload)) = line.split_once(TAG) else { return };
        let Some((poses, buttons)) = payload.split_once('&') else { return };
        events.extend(poses.split('|').filter_map(pose).map(Event::Hand));
        let mut now = Vec::new();
        for word in buttons.split(',').map(str::trim) {
            let mut parts = word.split_whitespace();
            let name = parts.next().unwrap_or_default();
            let numbers: Vec<f64> =
                parts.filter_map(|part| part.parse().ok()).filter(|x: &f64| x.is_finite()).collect();
            match numbers[..] {
                [] => now.extend(BUTTONS.iter().find(|(known, _)| *known == name).map(|(_, code)| *code)),
                [place] => moved(name, place, events),
                [x, y, ..] => {
                    moved(&format!("{name}_x"), x, events);
                    moved(&format!("{name}_y"), y, events);
                }
            }
        }
        let button = |&code: &u16| Button::Of(Device::Quest, code);
        events.extend(
            self.pressed.iter().filter(|code| !now.contains(code)).map(|code| Event::Release(button(code))),
        );
        // Every line says what is held, so that what is not said any more can be taken for released.
        events.extend(now.iter().map(|code| Event::Press(button(code))));
        self.pressed = now;
    }
}

fn moved(name: &str, place: f64, events: &mut Vec<Event>) {
    let code = AXES.iter().find(|(known, _)| *known == name).map(|(_, code)| *code);
    events.extend(code.map(|code| Event::Move(Axis(Device::Quest, code), place.clamp(-1.0, 1.0))));
}

/// A pose; nothing where it is no rigid motion.
fn pose(text: &str) -> Option<HandPose> {
    let (side, numbers) = text.trim().split_once(':')?;
    let right = match side {
        "r" => true,
        "l" => false,
        _ => return None,
    };
    let numbers: Vec<f64> = numbers.split_whitespace().map_while(|number| number.parse().ok()).collect();
    let m: [f64; 16] = numbers.try_into().ok()?;
    let turn = [m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]];
    let unit = |row: &[f64]| (row.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-2;
    let rigid = m.iter().all(|x| x.is_finite()) && turn.chunks(3).all(unit);
    rigid.then(|| HandPose { right, position: [m[3], m[7], m[11]], orientation: mat_to_quat(&turn) })
}

#[cfg(test)]
mod tests {
    use super::*;

    const LINE: &str = "04-12 10:00:00.123  1234  1250 I wE9ryARX: r:1 0 0 0.25 0 0 -1 -0.5 0 1 0 0.125 0 0 0 1|\
                        l:1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1&R,A,RG,rightJS 0.5 -1,rightTrig 0.75,rightGrip 1.0\n";

    #[test]
    fn lines_have_poses_buttons_and_axes() {
        let mut events = Vec::new();
        Quest::default().feed(LINE.as_bytes(), &mut events);
        let Event::Hand(right) = events[0] else { panic!("{events:?}") };
        assert_eq!((right.right, right.position), (true, [0.25, -0.5, 0.125]));
        // A quarter turn about x.
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let expected = [half, half, 0.0, 0.0];
        assert!(right.orientation.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{right:?}");
        assert!(matches!(events[1], Event::Hand(HandPose { right: false, .. })));
        let axis = |code, place| Event::Move(Axis(Device::Quest, code), place);
        assert_eq!(events[2..6], [axis(2, 0.5), axis(3, -1.0), axis(0, 0.75), axis(1, 1.0)]);
        let press = |code| Event::Press(Button::Of(Device::Quest, code));
        assert_eq!(events[6..], [press(0), press(1), press(4)]);
    }

    #[test]
    fn what_is_not_said_any_more_is_released_and_what_is_damaged_left_out() {
        let (mut quest, mut events) = (Quest::default(), Vec::new());
        let lines = [
            LINE,
            "I wE9ryARX: r:2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1&R\n",
            "I wE9ryARX: r:1 0 0&R\n",
            "I other: x&RG\n",
            "I wE9ryARX: r:nan 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1&R,rightTrig nan\n",
        ];
        lines.concat().as_bytes().chunks(7).for_each(|piece| quest.feed(piece, &mut events));
        let hands = events.iter().filter(|event| matches!(event, Event::Hand(_))).count();
        assert_eq!(hands, 2);
        let released = |code| events.contains(&Event::Release(Button::Of(Device::Quest, code)));
        assert!(released(1) && released(4) && !released(0));
    }
}
