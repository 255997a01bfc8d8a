//! Damping and armature of actuators, reflected through the gear to the joint or tendon they drive.

use super::with_plugins::Model;
use crate::arrays::{Arrays, TrnType};
use crate::math::Polynomial;

/// Element on which an actuator's load acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Driven {
    /// A joint.
    Joint(usize),
    /// A tendon.
    Tendon(usize),
}

impl Driven {
    /// The only actuator that adds to the element; -1 for none, below that several.
    fn recorded(self, m: &Arrays) -> i32 {
        match self {
            Driven::Joint(j) => m.jnt_actuatorid[j],
            Driven::Tendon(t) => m.tendon_actuatorid[t],
        }
    }

    /// Actuators that drive the element through a plain transmission, in order.
    fn actuators(self, m: &Arrays) -> impl Iterator<Item = usize> + '_ {
        let (Driven::Joint(id) | Driven::Tendon(id)) = self;
        let recorded = self.recorded(m);
        let candidates = match recorded {
            -1 => 0..0,
            k if k >= 0 => k as usize..k as usize + 1,
            _ => 0..m.nactuator,
        };
        let drives = move |k: &usize| {
            let kind = TrnType::from_code(m.actuator_trntype[*k]);
            recorded >= 0
                || m.actuator_trnid[*k][0] as usize == id
                    && match self {
                        Driven::Joint(_) => matches!(kind, Some(TrnType::Joint | TrnType::Jointinparent)),
                        Driven::Tendon(_) => kind == Some(TrnType::Tendon),
                    }
        };
        candidates.filter(drives)
    }

    /// Own damping `law` plus what actuators add.
    #[inline]
    pub fn damping(self, m: &Model, law: Polynomial) -> Polynomial {
        if self.recorded(m) == -1 { law } else { self.damping_with_actuators(m, law) }
    }

    #[cold]
    fn damping_with_actuators(self, m: &Model, law: Polynomial) -> Polynomial {
        let mut poly = law.poly;
        let mut added = 0.0;
        for k in self.actuators(m) {
            let gear2 = gear_squared(m, k);
            added += m.actuator_damping[k] * gear2;
            for n in 0..2 {
                poly[n] += m.actuator_dampingpoly[k][n] * gear2;
            }
        }
        Polynomial { linear: law.linear + added, poly }
    }

    /// Armature that actuators add.
    #[inline]
    pub fn armature(self, m: &Arrays) -> f64 {
        if self.recorded(m) == -1 { 0.0 } else { self.armature_of_actuators(m) }
    }

    #[cold]
    fn armature_of_actuators(self, m: &Arrays) -> f64 {
        self.actuators(m).map(|k| m.actuator_armature[k] * gear_squared(m, k)).fold(0.0, |a, b| a + b)
    }
}

/// Armature of degree of freedom `dof`, actuators included.
#[inline(always)]
pub fn dof_armature(m: &Arrays, dof: usize) -> f64 {
    m.dof_armature[dof] + Driven::Joint(m.dof_jntid[dof] as usize).armature(m)
}

/// Damping law of degree of freedom `dof`, actuators included.
pub fn dof_damping(m: &Model, dof: usize) -> Polynomial {
    let law = Polynomial { linear: m.dof_damping[dof], poly: m.dof_dampingpoly[dof] };
    Driven::Joint(m.dof_jntid[dof] as usize).damping(m, law)
}

/// Damping law of tendon `t`, actuators included.
#[inline]
pub fn tendon_damping(m: &Model, t: usize) -> Polynomial {
    let law = Polynomial { linear: m.tendon_damping[t], poly: m.tendon_dampingpoly[t] };
    Driven::Tendon(t).damping(m, law)
}

fn gear_squared(m: &Arrays, actuator: usize) -> f64 {
    let gear = m.actuator_gear[m.actuator_outadr[actuator] as usize][0];
    gear * gear
}
