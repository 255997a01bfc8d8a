//! What an arm says of itself a thousand times a second.

use super::command::Version;

/// A place of a state's values: `N` numbers from this one on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field<const N: usize>(pub usize);

/// Places of a state's values, by the names that the documents have for them.
pub mod field {
    #![allow(missing_docs)]
    use super::Field;
    pub const O_T_EE: Field<16> = Field(0);
    pub const O_T_EE_D: Field<16> = Field(16);
    pub const F_T_EE: Field<16> = Field(32);
    pub const EE_T_K: Field<16> = Field(48);
    pub const F_T_NE: Field<16> = Field(64);
    pub const NE_T_EE: Field<16> = Field(80);
    pub const M_EE: Field<1> = Field(96);
    pub const M_LOAD: Field<1> = Field(109);
    pub const I_LOAD: Field<9> = Field(110);
    pub const F_X_CLOAD: Field<3> = Field(119);
    pub const ELBOW: Field<2> = Field(122);
    pub const ELBOW_D: Field<2> = Field(124);
    pub const TAU_J: Field<7> = Field(126);
    pub const TAU_J_D: Field<7> = Field(133);
    pub const DTAU_J: Field<7> = Field(140);
    pub const Q: Field<7> = Field(147);
    pub const Q_D: Field<7> = Field(154);
    pub const DQ: Field<7> = Field(161);
    pub const DQ_D: Field<7> = Field(168);
    pub const DDQ_D: Field<7> = Field(175);
    pub const JOINT_CONTACT: Field<7> = Field(182);
    pub const JOINT_COLLISION: Field<7> = Field(195);
    pub const TAU_EXT: Field<7> = Field(208);
    pub const O_F_EXT: Field<6> = Field(215);
    pub const K_F_EXT: Field<6> = Field(221);
    pub const ELBOW_C: Field<2> = Field(236);
    pub const O_T_EE_C: Field<16> = Field(242);
    pub const THETA: Field<7> = Field(270);
    pub const DTHETA: Field<7> = Field(277);
}

/// What the arm as a whole is doing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Mode {
    #[default]
    Other,
    Idle,
    Move,
    Guiding,
    Reflex,
    UserStopped,
    Recovering,
}

impl Mode {
    const ALL: [Mode; 7] = [
        Mode::Other,
        Mode::Idle,
        Mode::Move,
        Mode::Guiding,
        Mode::Reflex,
        Mode::UserStopped,
        Mode::Recovering,
    ];
}

/// Names of the error flags, in their order.
pub const ERRORS: [&str; 41] = [
    "joint_position_limits_violation",
    "cartesian_position_limits_violation",
    "self_collision_avoidance_violation",
    "joint_velocity_violation",
    "cartesian_velocity_violation",
    "force_control_safety_violation",
    "joint_reflex",
    "cartesian_reflex",
    "max_goal_pose_deviation_violation",
    "max_path_pose_deviation_violation",
    "cartesian_velocity_profile_safety_violation",
    "joint_position_motion_generator_start_pose_invalid",
    "joint_motion_generator_position_limits_violation",
    "joint_motion_generator_velocity_limits_violation",
    "joint_motion_generator_velocity_discontinuity",
    "joint_motion_generator_acceleration_discontinuity",
    "cartesian_position_motion_generator_start_pose_invalid",
    "cartesian_motion_generator_elbow_limit_violation",
    "cartesian_motion_generator_velocity_limits_violation",
    "cartesian_motion_generator_velocity_discontinuity",
    "cartesian_motion_generator_acceleration_discontinuity",
    "cartesian_motion_generator_elbow_sign_inconsistent",
    "cartesian_motion_generator_start_elbow_invalid",
    "force_controller_desired_force_tolerance_violation",
    "start_elbow_sign_inconsistent",
    "communication_constraints_violation",
    "power_limit_violation",
    "cartesian_motion_generator_joint_position_limits_violation",
    "cartesian_motion_generator_joint_velocity_limits_violation",
    "cartesian_motion_generator_joint_velocity_discontinuity",
    "cartesian_motion_generator_joint_acceleration_discontinuity",
    "cartesian_position_motion_generator_invalid_frame",
    "controller_torque_discontinuity",
    "joint_p2p_insufficient_torque_for_planning",
    "tau_j_range_violation",
    "instability_detected",
    "joint_move_in_wrong_direction",
    "cartesian_spline_motion_generator_violation",
    "joint_via_motion_generator_planning_joint_limit_violation",
    "base_acceleration_initialization_timeout",
    "base_acceleration_invalid_reading",
];

/// The bit of an error, by name; 0 where there is no such error.
pub fn error_bit(name: &str) -> u64 {
    ERRORS.iter().position(|known| *known == name).map_or(0, |place| 1 << place)
}

/// Names of the errors in a set of bits.
pub fn describe_errors(bits: u64) -> String {
    let names: Vec<_> =
        ERRORS.iter().enumerate().filter(|(k, _)| bits >> k & 1 != 0).map(|(_, n)| *n).collect();
    if names.is_empty() { "no error".to_owned() } else { names.join(", ") }
}

/// Values of a state: version 10 has 36 of accelerometers more.
const VALUES: usize = 320;

/// A state.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Milliseconds since the arm was switched on.
    pub message: u64,
    values: [f64; VALUES],
    /// What is commanded, 0 where nothing moves: see [`Generator::number`](super::Generator::number).
    pub generator: u8,
    /// Who keeps the arm on its path; 3 where nobody does.
    pub controller: u8,
    /// Errors that last, as bits.
    pub errors: u64,
    /// Errors that ended the last motion, as bits.
    pub reflex: u64,
    /// What the arm is doing.
    pub mode: Mode,
    /// Share of the last hundred commands that arrived in time.
    pub success: f64,
}

impl Default for State {
    fn default() -> State {
        State {
            message: 0,
            values: [0.0; VALUES],
            generator: 0,
            controller: 3,
            errors: 0,
            reflex: 0,
            mode: Mode::Other,
            success: 0.0,
        }
    }
}

impl State {
    /// Bytes of a datagram.
    pub fn size(version: Version) -> usize {
        let (count, width) = State::shape(version);
        8 + width * (count + 1) + 85
    }

    /// Number of values, and bytes of each.
    fn shape(version: Version) -> (usize, usize) {
        match version {
            Version::V5 => (284, 8),
            Version::V10 => (VALUES, 4),
        }
    }

    /// The values of a field.
    pub fn get<const N: usize>(&self, field: Field<N>) -> [f64; N] {
        let mut values = [0.0; N];
        values.copy_from_slice(&self.values[field.0..field.0 + N]);
        values
    }

    /// Sets the values of a field.
    pub fn set<const N: usize>(&mut self, field: Field<N>, values: [f64; N]) {
        self.values[field.0..field.0 + N].copy_from_slice(&values);
    }

    /// The datagram.
    pub fn encode(&self, version: Version) -> Vec<u8> {
        let (count, width) = State::shape(version);
        let mut out = Vec::with_capacity(State::size(version));
        out.extend(self.message.to_le_bytes());
        let number = |out: &mut Vec<u8>, value: f64| match width {
            8 => out.extend(value.to_le_bytes()),
            _ => out.extend((value as f32).to_le_bytes()),
        };
        self.values[..count].iter().for_each(|value| number(&mut out, *value));
        out.extend([self.generator, self.controller]);
        for bits in [self.errors, self.reflex] {
            out.extend((0..ERRORS.len()).map(|k| (bits >> k & 1) as u8));
        }
        out.push(Mode::ALL.iter().position(|mode| *mode == self.mode).unwrap_or(0) as u8);
        number(&mut out, self.success);
        out
    }

    /// Reads a datagram; `None` where its length is another version's, or nobody's.
    pub fn decode(bytes: &[u8], version: Version) -> Option<State> {
        if bytes.len() != State::size(version) {
            return None;
        }
        let (count, width) = State::shape(version);
        let number = |at: usize| match width {
            8 => bytes[at..at + 8].try_into().map_or(f64::NAN, f64::from_le_bytes),
            _ => bytes[at..at + 4].try_into().map_or(f64::NAN, |b| f64::from(f32::from_le_bytes(b))),
        };
        let mut state =
            State { message: u64::from_le_bytes(bytes[..8].try_into().ok()?), ..State::default() };
        for (k, value) in state.values[..count].iter_mut().enumerate() {
            *value = number(8 + width * k);
        }
        let tail = &bytes[8 + width * count..];
        let bits = |flags: &[u8]| flags.iter().rev().fold(0, |bits, flag| bits << 1 | u64::from(*flag != 0));
        (state.generator, state.controller) = (tail[0], tail[1]);
        (state.errors, state.reflex) = (bits(&tail[2..43]), bits(&tail[43..84]));
        state.mode = Mode::ALL.get(usize::from(tail[84])).copied().unwrap_or_default();
        state.success = number(bytes.len() - width);
        Some(state)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_lie_where_they_should_and_come_back() {
        let mut state = State { message: 513, generator: 1, controller: 2, success: 0.5, ..State::default() };
        state.set(field::O_T_EE, std::array::from_fn(|k| k as f64));
        state.set(field::Q, [0.5, 1.5, 2.5, 3.5, 4.5, 5.5, 6.5]);
        state.set(field::DTHETA, [0.25; 7]);
        state.errors = error_bit("communication_constraints_violation");
        state.reflex = state.errors | error_bit("base_acceleration_invalid_reading");
        state.mode = Mode::Reflex;
        for (version, size, tail, width) in [(Version::V5, 2373, 2280, 8), (Version::V10, 1377, 1288, 4)] {
            let bytes = state.encode(version);
            assert_eq!((bytes.len(), State::size(version)), (size, size));
            assert_eq!(bytes[..2], [1, 2]);
            let at = |index: usize| {
                let place = 8 + width * index;
                match width {
                    8 => f64::from_le_bytes(bytes[place..place + 8].try_into().unwrap()),
                    _ => f64::from(f32::from_le_bytes(bytes[place..place + 4].try_into().unwrap())),
                }
            };
            assert_eq!((at(15), at(147), at(153), at(283)), (15.0, 0.5, 6.5, 0.25));
            assert_eq!(bytes[tail..tail + 2], [1, 2]);
            assert_eq!((bytes[tail + 2 + 25], bytes[tail + 2 + 40]), (1, 0));
            assert_eq!((bytes[tail + 43 + 25], bytes[tail + 43 + 40]), (1, 1));
            assert_eq!(bytes[tail + 84], 4);
            assert_eq!(State::decode(&bytes, version), Some(state.clone()));
            assert_eq!(State::decode(&bytes[..1000], version), None);
        }
        assert_eq!(describe_errors(state.errors), "communication_constraints_violation");
    }
}
