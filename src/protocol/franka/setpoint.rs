//! The answer to a state: what the arm is to do in the next cycle.

use super::command::{Version, double};

/// A command of one cycle; only what the motion's generator and controller ask for counts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Setpoint {
    /// The number of the state that it answers.
    pub message: u64,
    /// Positions of the joints \[rad\].
    pub q: [f64; 7],
    /// Velocities of the joints \[rad/s\].
    pub dq: [f64; 7],
    /// Pose of the end effector, column by column.
    pub pose: [f64; 16],
    /// Velocity of the end effector \[m/s, rad/s\].
    pub twist: [f64; 6],
    /// Position of joint 3 \[rad\] and sign of joint 4.
    pub elbow: [f64; 2],
    /// Whether `elbow` counts.
    pub elbow_valid: bool,
    /// The motion is at its end.
    pub finished: bool,
    /// Torques without those against gravity \[N m\].
    pub torque: [f64; 7],
    /// The torques are at their end; version 10.
    pub torque_finished: bool,
}

const ELBOW_VALID: usize = 312;
const FINISHED: usize = 313;
const TORQUE: usize = 314;
const TORQUE_FINISHED: usize = 370;

impl Setpoint {
    /// Bytes of a datagram.
    pub fn size(version: Version) -> usize {
        match version {
            Version::V5 => TORQUE_FINISHED,
            Version::V10 => TORQUE_FINISHED + 1,
        }
    }

    /// Writes the datagram into `out`, which is cleared first.
    pub fn encode(&self, version: Version, out: &mut Vec<u8>) {
        out.clear();
        out.extend(self.message.to_le_bytes());
        let values = self.q.iter().chain(&self.dq).chain(&self.pose).chain(&self.twist).chain(&self.elbow);
        out.extend(values.flat_map(|value| value.to_le_bytes()));
        out.extend([u8::from(self.elbow_valid), u8::from(self.finished)]);
        out.extend(self.torque.iter().flat_map(|value| value.to_le_bytes()));
        if version == Version::V10 {
            out.push(u8::from(self.torque_finished));
        }
    }

    /// Reads a datagram; `None` where its length is another.
    pub fn decode(bytes: &[u8], version: Version) -> Option<Setpoint> {
        if bytes.len() != Setpoint::size(version) {
            return None;
        }
        let mut at = 8;
        let mut fill = |values: &mut [f64]| {
            for value in values {
                *value = double(bytes, at).unwrap_or(f64::NAN);
                at += 8;
            }
        };
        let mut setpoint =
            Setpoint { message: u64::from_le_bytes(bytes[..8].try_into().ok()?), ..Setpoint::default() };
        fill(&mut setpoint.q);
        fill(&mut setpoint.dq);
        fill(&mut setpoint.pose);
        fill(&mut setpoint.twist);
        fill(&mut setpoint.elbow);
        setpoint.elbow_valid = bytes[ELBOW_VALID] != 0;
        setpoint.finished = bytes[FINISHED] != 0;
        for (k, value) in setpoint.torque.iter_mut().enumerate() {
            *value = double(bytes, TORQUE + 8 * k)?;
        }
        setpoint.torque_finished = bytes.get(TORQUE_FINISHED).is_some_and(|byte| *byte != 0);
        Some(setpoint)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_lie_where_they_should_and_come_back() {
        let mut setpoint = Setpoint { message: 0x0102, finished: true, ..Setpoint::default() };
        setpoint.q[0] = 1.5;
        setpoint.dq[6] = -2.5;
        setpoint.pose[15] = 1.0;
        setpoint.elbow[1] = -1.0;
        setpoint.torque[0] = 4.5;
        setpoint.torque[6] = 8.25;
        let mut bytes = Vec::new();
        for version in [Version::V5, Version::V10] {
            setpoint.encode(version, &mut bytes);
            assert_eq!(bytes.len(), Setpoint::size(version));
            assert_eq!(bytes[..2], [2, 1]);
            assert_eq!(bytes[8..16], 1.5_f64.to_le_bytes());
            assert_eq!(bytes[112..120], (-2.5_f64).to_le_bytes());
            assert_eq!(bytes[240..248], 1.0_f64.to_le_bytes());
            assert_eq!(bytes[304..312], (-1.0_f64).to_le_bytes());
            assert_eq!(bytes[312..314], [0, 1]);
            assert_eq!(bytes[314..322], 4.5_f64.to_le_bytes());
            assert_eq!(bytes[362..370], 8.25_f64.to_le_bytes());
            assert_eq!(Setpoint::decode(&bytes, version), Some(setpoint));
            assert_eq!(Setpoint::decode(&bytes[1..], version), None);
        }
        assert_eq!((Setpoint::size(Version::V5), Setpoint::size(Version::V10)), (370, 371));
    }
}
