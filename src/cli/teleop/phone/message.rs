//! Converts messages of the page, and of the OpenXR bridge, to lines of a headset's log, which sessions read.

use serde_json::Value;

/// Largest delay of a message beyond the smallest delay of the session [s].
const LATE: f64 = 0.15;
/// Largest number of buttons in a message.
const BUTTONS: usize = 24;

/// Decoder of the messages of one page.
#[derive(Default)]
pub struct Messages {
    /// Number of the last one.
    last: Option<u64>,
    /// Smallest difference between our clock and the page's [s].
    offset: Option<f64>,
}

impl Messages {
    /// The line of a message that arrived at `now` [s]; `None` if it is invalid, or older than an earlier one. A pose that is not
    /// tracked, or is too late, is left out: nothing follows it.
    pub fn line(&mut self, text: &str, now: f64) -> Option<String> {
        let message: Value = serde_json::from_str(text).ok()?;
        let number = message["seq"].as_u64().filter(|number| self.last.is_none_or(|last| *number > last))?;
        let time = message["time"].as_f64().filter(|time| time.is_finite())?;
        self.last = Some(number);
        let difference = now - time;
        let offset = self.offset.map_or(difference, |offset| offset.min(difference));
        self.offset = Some(offset);
        if difference - offset > LATE {
            return Some("wE9ryARX: &\n".to_owned());
        }
        let names = message["buttons"].as_array()?.iter().filter_map(Value::as_str).take(BUTTONS);
        let plain =
            |name: &&str| name.bytes().all(|byte| byte.is_ascii_alphanumeric() || b" ._-".contains(&byte));
        let buttons: Vec<&str> = names.filter(plain).collect();
        message["tracked"].as_bool()?;
        // The message is of the right hand; a second controller is in `left`.
        let hands = [('r', &message), ('l', &message["left"])];
        let poses: Vec<String> = hands.into_iter().filter_map(|(side, hand)| pose(side, hand)).collect();
        Some(format!("wE9ryARX: {}&{}\n", poses.join("|"), buttons.join(",")))
    }
}

/// Position \[m\] and quaternion (x, y, z, w) of a tracked hand as the rows of a homogeneous transform.
fn pose(side: char, hand: &Value) -> Option<String> {
    hand["tracked"].as_bool().filter(|tracked| *tracked)?;
    let numbers: Option<Vec<f64>> = hand["pose"].as_array()?.iter().map(Value::as_f64).collect();
    let [px, py, pz, x, y, z, w]: [f64; 7] = numbers?.try_into().ok()?;
    let norm = (x * x + y * y + z * z + w * w).sqrt();
    if !(0.5..2.0).contains(&norm) {
        return None;
    }
    let [x, y, z, w] = [x, y, z, w].map(|part| part / norm);
    let rows = [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y), px],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x), py],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y), pz],
    ];
    let numbers: Vec<String> = rows.as_flattened().iter().map(f64::to_string).collect();
    Some(format!("{side}:{} 0 0 0 1", numbers.join(" ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(seq: u64, time: f64, tracked: bool) -> String {
        format!(
            r#"{{"seq":{seq},"time":{time},"pose":[0.25,1,-0.5,0,0,0,1],"tracked":{tracked},"buttons":["RG","rightTrig 0.5"]}}"#
        )
    }

    #[test]
    fn messages_become_lines() {
        let mut messages = Messages::default();
        let line = messages.line(&message(1, 0.0, true), 100.0).unwrap();
        assert_eq!(line, "wE9ryARX: r:1 0 0 0.25 0 1 0 1 0 0 1 -0.5 0 0 0 1&RG,rightTrig 0.5\n");
        let lost = messages.line(&message(2, 0.02, false), 100.02).unwrap();
        assert_eq!(lost, "wE9ryARX: &RG,rightTrig 0.5\n", "what is not tracked has no pose");
        let quarter = message(3, 0.04, true).replace("0,0,0,1]", "1,0,0,1]");
        let turned = messages.line(&quarter, 100.04).unwrap();
        let (_, pose) = turned.split_once("r:").unwrap();
        let (pose, _) = pose.split_once('&').unwrap();
        let numbers: Vec<f64> = pose.split(' ').map(|number| number.parse().unwrap()).collect();
        // A quarter turn about x: y becomes z, and z becomes -y.
        let wanted = [1.0, 0.0, 0.0, 0.25, 0.0, 0.0, -1.0, 1.0, 0.0, 1.0, 0.0, -0.5, 0.0, 0.0, 0.0, 1.0];
        assert!(numbers.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-12), "{numbers:?}");
        assert_eq!(numbers.len(), 16);
    }

    #[test]
    fn a_left_hand_is_told_beside_the_right_one() {
        let mut messages = Messages::default();
        let both = |seq, tracked, left| {
            let left = format!(r#""left":{{"pose":[-0.25,1,-0.5,0,0,0,1],"tracked":{left}}},"buttons""#);
            message(seq, 0.0, tracked).replace("\"buttons\"", &left)
        };
        let [right, left] = ["r:1 0 0 0.25", "l:1 0 0 -0.25"];
        let rest = "0 1 0 1 0 0 1 -0.5 0 0 0 1";
        let line = messages.line(&both(1, true, true), 100.0).unwrap();
        assert_eq!(line, format!("wE9ryARX: {right} {rest}|{left} {rest}&RG,rightTrig 0.5\n"));
        let line = messages.line(&both(2, false, true), 100.0).unwrap();
        assert_eq!(line, format!("wE9ryARX: {left} {rest}&RG,rightTrig 0.5\n"));
        let line = messages.line(&both(3, true, false), 100.0).unwrap();
        assert_eq!(line, format!("wE9ryARX: {right} {rest}&RG,rightTrig 0.5\n"));
    }

    #[test]
    fn what_is_old_late_or_damaged_moves_nothing() {
        let mut messages = Messages::default();
        messages.line(&message(5, 1.0, true), 101.0).unwrap();
        assert_eq!(messages.line(&message(5, 1.1, true), 101.1), None);
        assert_eq!(messages.line(&message(4, 1.1, true), 101.1), None);
        // Delayed 0.2 s more than the first: its buttons are released.
        assert_eq!(messages.line(&message(6, 1.1, true), 101.3).as_deref(), Some("wE9ryARX: &\n"));
        assert!(messages.line(&message(7, 1.3, true), 101.4).unwrap().contains("r:"));
        for wrong in ["", "{}", "[1]", r#"{"seq":9,"time":1.4,"buttons":[]}"#, r#"{"seq":-1,"time":0}"#] {
            assert_eq!(messages.line(wrong, 101.4), None, "{wrong}");
        }
        let flat = message(20, 1.5, true).replace("0,0,0,1]", "0,0,0,0]");
        assert!(!messages.line(&flat, 101.5).unwrap().contains("r:"));
        let line = messages.line(&message(21, 1.5, true).replace("\"RG\"", "\"RG\\nwE9ryARX: &A\""), 101.5);
        assert_eq!(line.unwrap().lines().count(), 1, "a name cannot be a line of its own");
    }
}
