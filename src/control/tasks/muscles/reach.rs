//! A limb whose tips are to reach targets: the angles that bring them there are looked for once, by damped least squares over all tips,
//! and the limb takes that pose.

use super::limb::Limb;
use crate::controller::Controller;
use crate::error::ControlError;
use env::Env;
use nalgebra::{DMatrix, DVector};
use physics::elements::SiteId;
use physics::forward;
use physics::math::sub;
use std::collections::BTreeMap;

/// Updates of the search.
const UPDATES: usize = 100;
/// Damping of the least squares \[m/rad\].
const DAMPING: f64 = 0.01;
/// Largest update of an angle \[rad\].
const LARGEST: f64 = 0.2;
/// Part of a joint's range that its ends keep free of the pose.
const MARGIN: f64 = 0.02;

pub struct MuscleReach {
    limb: Limb,
    /// Tips and their targets.
    tips: Vec<[SiteId; 2]>,
    /// The pose (nq) \[rad, m\].
    pose: Vec<f64>,
}

impl MuscleReach {
    /// The controller.
    ///
    /// # Errors
    /// A body that is no limb; settings without the names of tips.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let scene = env.scene();
        let named: Option<BTreeMap<String, [[f64; 3]; 2]>> = env.spec().args.get("target_reach_range");
        let named =
            named.ok_or_else(|| ControlError::unfit(env, "the setting target_reach_range is needed"))?;
        let pair = |tip: &String| Ok([scene.site(tip)?, scene.site(&format!("{tip}_target"))?]);
        let tips = named.keys().map(pair).collect::<Result<_, ControlError>>()?;
        Ok(MuscleReach { limb: Limb::new(env)?, tips, pose: Vec::new() })
    }

    /// Looks for the pose, from the present one.
    fn search(&mut self, env: &Env) -> Result<(), ControlError> {
        let m = &env.scene().model;
        let mut posed = env.scene().data.clone();
        for _ in 0..UPDATES {
            forward(m, &mut posed)?;
            let (mut slopes, mut errors) =
                (DMatrix::zeros(3 * self.tips.len(), m.nv), DVector::zeros(3 * self.tips.len()));
            for (k, &[tip, target]) in self.tips.iter().enumerate() {
                let jacobian = posed.jacobian(m, tip).pos;
                slopes.rows_mut(3 * k, 3).copy_from(&DMatrix::from_row_slice(3, m.nv, &jacobian));
                let error = sub(*posed.site(target).xpos(), *posed.site(tip).xpos());
                errors.rows_mut(3 * k, 3).copy_from_slice(&error);
            }
            let square = slopes.transpose() * &slopes + DMatrix::identity(m.nv, m.nv) * (DAMPING * DAMPING);
            let Some(update) = square.cholesky().map(|factor| factor.solve(&(slopes.transpose() * errors)))
            else {
                break;
            };
            for joint in 0..m.njnt {
                let place = &mut posed.state.qpos[m.jnt_qposadr[joint] as usize];
                *place += update[m.jnt_dofadr[joint] as usize].clamp(-LARGEST, LARGEST);
                if m.jnt_limited[joint] {
                    let [low, high] = m.jnt_range[joint];
                    let free = MARGIN * (high - low);
                    *place = place.clamp(low + free, high - free);
                }
            }
        }
        self.pose.clone_from(&posed.state.qpos);
        Ok(())
    }
}

impl Controller for MuscleReach {
    fn reset(&mut self, env: &Env, _: u64) -> Result<(), ControlError> {
        self.limb.restart();
        self.search(env)
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        let qpos = &env.scene().data.state.qpos;
        let errors: Vec<f64> = self.pose.iter().zip(qpos).map(|(wanted, now)| wanted - now).collect();
        self.limb.act(env, &errors, action)
    }
}
