//! What a model has of the quantities that are published: masses, distances, ranges, torques.

use physics::elements::{BodyId, Element, JointId, SiteId};
use physics::model::{JointType, TrnType};
use physics::position::kinematics::kinematics;
use physics::{Data, Model};

/// A point of a model.
#[derive(Clone, Copy)]
enum Anchor {
    Joint(usize),
    Site(usize),
    Body(usize),
}

/// Distances between points of a model.
pub struct Ruler<'a> {
    model: &'a Model,
    data: Data,
    ends: [Anchor; 2],
}

impl<'a> Ruler<'a> {
    /// A ruler between two points: joints (their anchors), sites or bodies.
    ///
    /// # Errors
    /// The model has no such element.
    pub fn new(model: &'a Model, from: &str, to: &str) -> Result<Self, String> {
        Ok(Ruler { model, data: Data::new(model), ends: [anchor(model, from)?, anchor(model, to)?] })
    }

    /// The distance with all joints at 0 \[m\].
    pub fn at_zero(&mut self) -> f64 {
        for joint in scalar_joints(self.model) {
            self.data.state.qpos[self.model.jnt_qposadr[joint] as usize] = 0.0;
        }
        self.distance()
    }

    /// The largest distance that joints within their ranges allow \[m\], found by moving one joint after the other, from
    /// two dozen postures.
    pub fn largest(&mut self) -> f64 {
        let mut best = 0.0_f64;
        for start in 0..STARTS {
            for (k, joint) in scalar_joints(self.model).enumerate() {
                let share = (0.5 + (start as f64) * GOLDEN * (k + 1) as f64).fract();
                self.put(joint, share);
            }
            best = best.max(self.climb());
        }
        best
    }

    /// The distance after every joint was moved to where it is largest, until that gains nothing.
    fn climb(&mut self) -> f64 {
        let mut best = self.distance();
        loop {
            let before = best;
            for joint in scalar_joints(self.model) {
                best = self.sweep(joint, best);
            }
            if best - before < 1e-5 {
                return best;
            }
        }
    }

    /// Moves a joint to where the distance is largest of [`STEPS`] places, if it is then larger than `best`.
    fn sweep(&mut self, joint: usize, mut best: f64) -> f64 {
        let place = self.model.jnt_qposadr[joint] as usize;
        let mut kept = self.data.state.qpos[place];
        for step in 0..=STEPS {
            self.put(joint, step as f64 / STEPS as f64);
            let distance = self.distance();
            if distance > best {
                (best, kept) = (distance, self.data.state.qpos[place]);
            }
        }
        self.data.state.qpos[place] = kept;
        best
    }

    /// Puts a joint at a share of its range.
    fn put(&mut self, joint: usize, share: f64) {
        let limited = self.model.jnt_limited[joint];
        let turn = [-std::f64::consts::PI, std::f64::consts::PI];
        let [low, high] = if limited { self.model.jnt_range[joint] } else { turn };
        self.data.state.qpos[self.model.jnt_qposadr[joint] as usize] = low + share * (high - low);
    }

    fn distance(&mut self) -> f64 {
        kinematics(self.model, &self.data.state, &mut self.data.kin);
        let kin = &self.data.kin;
        let [a, b] = self.ends.map(|end| match end {
            Anchor::Joint(id) => kin.xanchor[id],
            Anchor::Site(id) => kin.site_xpos[id],
            Anchor::Body(id) => kin.xpos[id],
        });
        (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
    }
}

/// Postures from which the largest distance is sought.
const STARTS: usize = 24;
/// Places of a joint that are tried.
const STEPS: usize = 64;
/// Shares of a range that are spread evenly.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Hinges and slides.
fn scalar_joints(model: &Model) -> impl Iterator<Item = usize> + '_ {
    let kinds = [JointType::Hinge as i32, JointType::Slide as i32];
    (0..model.njnt).filter(move |&joint| kinds.contains(&model.jnt_type[joint]))
}

fn anchor(model: &Model, name: &str) -> Result<Anchor, String> {
    let joint = model.id_of(JointId::KIND, name).map(Anchor::Joint);
    let site = || model.id_of(SiteId::KIND, name).map(Anchor::Site);
    let body = || model.id_of(BodyId::KIND, name).map(Anchor::Body);
    joint.or_else(site).or_else(body).ok_or_else(|| format!("no joint, site or body '{name}'"))
}

/// Number of the joint called `name`.
///
/// # Errors
/// The model has no such joint.
pub fn joint(model: &Model, name: &str) -> Result<usize, String> {
    model.id_of(JointId::KIND, name).ok_or_else(|| format!("no joint '{name}'"))
}

/// Mass of all bodies \[kg\].
pub fn mass(model: &Model) -> f64 {
    model.body_mass.iter().sum()
}

/// The range of a joint \[rad or m\]; `None` where it has none.
pub fn range(model: &Model, joint: usize) -> Option<[f64; 2]> {
    model.jnt_limited[joint].then(|| model.jnt_range[joint])
}

/// The largest force or torque that the actuators of a joint may apply to it \[N or N m\]; infinite where nothing limits
/// it.
pub fn torque(model: &Model, joint: usize) -> f64 {
    let own = |&actuator: &usize| {
        model.actuator_trntype[actuator] == TrnType::Joint.code()
            && model.actuator_trnid[actuator][0] as usize == joint
    };
    let larger = |[low, high]: [f64; 2]| low.abs().max(high.abs());
    let force = |actuator: usize| {
        let gear = model.actuator_gear[model.actuator_outadr[actuator] as usize][0].abs();
        let limited = model.actuator_forcelimited[actuator];
        let by_force = if limited { larger(model.actuator_forcerange[actuator]) } else { f64::INFINITY };
        let plain = model.actuator_biasprm[actuator].iter().all(|&term| term == 0.0);
        let by_control = if plain && model.actuator_ctrllimited[actuator] {
            larger(model.actuator_ctrlrange[actuator]) * model.actuator_gainprm[actuator][0].abs()
        } else {
            f64::INFINITY
        };
        gear * by_force.min(by_control)
    };
    let actuators: f64 = (0..model.nu).filter(own).map(force).sum();
    let of_joint =
        if model.jnt_actfrclimited[joint] { larger(model.jnt_actfrcrange[joint]) } else { f64::INFINITY };
    actuators.min(of_joint)
}
