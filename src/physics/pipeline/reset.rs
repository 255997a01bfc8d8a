//! Where simulations begin: the reference configuration and keyframes. Trees that begin asleep need an evaluation, so
//! `Data` is made here.

use crate::actuation::history;
use crate::data::{
    Acceleration, Actuation, Com, Data, Flexes, Implicit, Inertia, Kinematics, NoKeyframe, Passive, Sensors,
    State, Tendons, Transmission, Velocity,
};
use crate::model::{Model, ObjType, SleepPolicy};
use crate::pipeline::rest::begin;
use crate::sleep::{self, is_on};

impl State {
    /// The reference configuration at time zero: zero velocities, activations and inputs, mocap bodies at their model
    /// poses, equality constraints as the model says.
    pub(crate) fn reset(&mut self, m: &Model) {
        self.clear(m);
        self.qpos.copy_from_slice(&m.qpos0);
        history::reset(m, &mut self.history);
        self.eq_active.copy_from_slice(&m.eq_active0);
        for b in 0..m.nbody {
            if let Ok(k) = usize::try_from(m.body_mocapid[b]) {
                self.mocap_pos[k] = m.body_pos[b];
                self.mocap_quat[k] = m.body_quat[b];
            }
        }
        for running in m.plugins().all() {
            running.instance.reset(m, &mut self.plugin_state[running.state.clone()]);
        }
        self.tree_asleep.fill(sleep::MOVED);
        sleep::update(m, self);
    }
}

impl Data {
    /// Data of `m` at its reference configuration, derived quantities zero.
    pub fn new(m: &Model) -> Self {
        let mut d = Data {
            state: State::new(m),
            kin: Kinematics::new(m),
            com: Com::new(m),
            flex: Flexes::new(m),
            ten: Tendons::new(m),
            trn: Transmission::new(m),
            inertia: Inertia::new(m),
            vel: Velocity::new(m),
            passive: Passive::new(m),
            actuation: Actuation::new(m),
            acc: Acceleration::new(m),
            sensor: Sensors::new(m),
            implicit: Implicit::new(m),
            ..Data::default()
        };
        d.reset(m);
        d
    }

    /// Returns to the reference configuration at time zero: zero velocities, activations and inputs, mocap bodies
    /// at their model poses, equality constraints as the model says. Stage outputs keep their last values. Nothing is
    /// allocated.
    pub fn reset(&mut self, m: &Model) {
        self.energy = [0.0; 2];
        self.unsettled = false;
        self.origin = m.origin();
        self.state.reset(m);
        // A model whose trees cannot begin asleep is refused where it is compiled; there they are awake.
        let _ = begin(m, self);
    }

    /// Resets, then takes time, positions, velocities, activations, mocap poses and controls of keyframe `key`. Nothing
    /// is allocated.
    ///
    /// # Errors
    /// The model has no such keyframe; the data stay as they were.
    pub fn reset_to_key(&mut self, m: &Model, key: usize) -> Result<(), NoKeyframe> {
        if key >= m.nkey {
            return Err(NoKeyframe { key, keyframes: m.nkey });
        }
        self.reset(m);
        let state = &mut self.state;
        state.time = m.key_time[key];
        for (values, keys) in [
            (&mut state.qpos[..], &m.key_qpos[..]),
            (&mut state.qvel, &m.key_qvel),
            (&mut state.act, &m.key_act),
            (&mut state.ctrl, &m.key_ctrl),
            (state.mocap_pos.as_flattened_mut(), &m.key_mpos),
            (state.mocap_quat.as_flattened_mut(), &m.key_mquat),
        ] {
            let n = values.len();
            values.copy_from_slice(&keys[key * n..(key + 1) * n]);
        }
        Ok(())
    }
}

/// Checks once that the trees which begin asleep can: their islands begin asleep as a whole.
///
/// # Errors
/// The root body of the first that cannot.
pub(crate) fn check(m: &Model) -> Result<(), String> {
    let begins = |policy: &i32| *policy == SleepPolicy::Init.code();
    if !is_on(m) || !m.tree_sleep_policy.iter().any(begins) {
        return Ok(());
    }
    match begin(m, &mut Data::new(m)) {
        Ok(None) => Ok(()),
        Ok(Some(tree)) => {
            let body = m.label_of(ObjType::Body, m.tree_bodyadr[tree] as usize);
            Err(format!(
                "{body} cannot begin asleep: all that touches it or is coupled to it must have sleep=\"init\""
            ))
        }
        Err(error) => Err(error.to_string()),
    }
}
