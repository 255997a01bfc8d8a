//! A trot at a commanded velocity: diagonal pairs of legs step in turn, and inverse kinematics gives their joints. It detects neither
//! contacts nor falls.

use crate::error::TeleopError;
use crate::link::{Link, link};
use crate::settings::BaseSettings;
use physics::elements::{Element, JointId, SiteId};
use physics::math::{Vec3, add};
use physics::model::JointType;
use physics::position::kinematics::kinematics;
use physics::{Data, Model};
use robot::{Pose, Reach, Search};
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Number of joints of a leg.
const LEG: usize = 3;
/// Numbers of a free joint in `qpos`, and their values at the origin.
const ORIGIN: [f64; 7] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
/// Error below which a foot has reached its target \[m\].
const TOLERANCE: f64 = 1e-4;
/// Largest number of updates of the search, which starts from the last solution.
const STEPS: usize = 30;
/// Velocity below which the robot stands, as a fraction of the largest.
const SLOW: f64 = 1e-3;
/// Velocity above which feet are lifted to their full height, as a fraction of the largest.
const FULL: f64 = 0.2;

/// A leg.
#[derive(Clone, Debug)]
struct Leg {
    joints: Vec<JointId>,
    /// Indices of the joints in `qpos`, and their controls.
    places: Vec<(usize, usize)>,
    site: SiteId,
    /// Position of the foot when standing, in the frame of the torso \[m\].
    foot: Vec3,
    /// Delay of its step after that of the first pair, as a fraction of the period.
    late: f64,
}

/// A four-legged robot that trots. A copy is sufficient to continue an episode from here.
///
/// ```
/// use robohive_teleop::{Mapping, Trot};
///
/// let text = assets::text("quadruped/quadruped.xml").ok_or("no robot")?;
/// let model = mjcf::load_str(text)?.model;
/// let mut data = physics::Data::new(&model);
/// data.reset_to_key(&model, 0)?;
/// let mut trot = Trot::of(&model, &data, Mapping::default().base)?;
/// let mut controls = vec![0.0; model.nu];
/// for _ in 0..80 {
///     trot.step(&model, &data, [1.0, 0.0, 0.0], 0.025, &mut controls);
///     data.state.ctrl.copy_from_slice(&controls);
///     (0..10).try_for_each(|_| physics::step(&model, &mut data))?;
/// }
/// assert!(data.state.qpos[1] > 0.15, "it walks along y");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Trot {
    legs: Vec<Leg>,
    settings: BaseSettings,
    /// Joint positions, with the torso at the origin; the legs start from their standing positions.
    pose: Vec<f64>,
    /// Present velocity, as fractions of the largest: forward, to the left, counterclockwise.
    velocity: [f64; 3],
    phase: f64,
}

impl Trot {
    /// Finds the legs of a model: three servos each, between its floating torso and a site at the foot. They stand as in the first
    /// keyframe, or as in the state of `data` without keyframes.
    ///
    /// # Errors
    /// The model has no such torso, or no such legs.
    pub fn of(model: &Model, data: &Data, settings: BaseSettings) -> Result<Self, TeleopError> {
        let root = model.joints().next().filter(|joint| model.joint(*joint).kind() == Some(JointType::Free));
        let Some(root) = root else { return Err(missing("the model has no torso with a free joint")) };
        let torso = model.jnt_bodyid[root.index()];
        let mut pose = model.key_qpos.get(..model.nq).unwrap_or(&data.state.qpos).to_vec();
        pose[..ORIGIN.len()].copy_from_slice(&ORIGIN);
        let mut there = data.clone();
        there.state.qpos.copy_from_slice(&pose);
        kinematics(model, &there.state, &mut there.kin);
        let legs: Option<Vec<Leg>> =
            branches(model, torso).into_values().map(|links| leg(model, &there, &links)).collect();
        let legs = legs.filter(|legs| legs.len() == 4).ok_or_else(|| {
            missing(
                "a trot needs four legs of three servos each, with a site on the last body of each, its foot",
            )
        })?;
        Ok(Trot { legs, settings, pose, velocity: [0.0; 3], phase: 0.0 })
    }

    /// Stops, standing.
    pub fn stop(&mut self) {
        (self.velocity, self.phase) = ([0.0; 3], 0.0);
    }

    /// The positions of joints for the next `dt` seconds \[rad\], one of `controls` for each actuator, approaching the velocity `wanted`:
    /// forward, to the left, counterclockwise, as fractions of the largest, -1 to 1. Nothing of the state of `data` is used.
    pub fn step(&mut self, model: &Model, data: &Data, wanted: [f64; 3], dt: f64, controls: &mut [f64]) {
        let most = dt / self.settings.ramp;
        for (now, wanted) in self.velocity.iter_mut().zip(wanted) {
            *now += (wanted.clamp(-1.0, 1.0) - *now).clamp(-most, most);
        }
        let pace = self.velocity.iter().fold(0.0_f64, |pace, part| pace.max(part.abs()));
        self.phase = if pace < SLOW { 0.0 } else { (self.phase + dt / self.settings.period).fract() };
        let mut start = data.clone();
        start.state.qpos.copy_from_slice(&self.pose);
        for leg in &self.legs {
            let pose = Pose { position: Some(self.target(leg, pace)), ..Pose::default() };
            let search = Search { tolerance: TOLERANCE, max_steps: STEPS, ..Search::default() };
            let reach = Reach { joints: &leg.joints, rest: None, pull: 0.0 };
            // A foot that cannot reach its target goes as near as possible.
            let found = search.run_within(model, &start, leg.site, &pose, &reach);
            for &(place, control) in &leg.places {
                self.pose[place] = found.qpos[place];
                controls[control] = found.qpos[place];
            }
        }
    }

    /// Target of a foot, in the frame of the torso \[m\].
    fn target(&self, leg: &Leg, pace: f64) -> Vec3 {
        let BaseSettings { forward, left, turn, period, lift, heading, .. } = self.settings;
        let [ahead, aside, round] = self.velocity;
        let (sin, cos) = heading.sin_cos();
        let [ahead, aside, round] = [ahead * forward, aside * left, round * turn];
        let [x, y, _] = leg.foot;
        // The motion of the torso relative to a standing foot.
        let over = [ahead * cos - aside * sin - round * y, ahead * sin + aside * cos + round * x];
        let phase = (self.phase + leg.late).fract();
        let half = period / 2.0;
        let (way, height) = if phase < 0.5 {
            (half * (0.5 - 2.0 * phase), 0.0)
        } else {
            let swing = 2.0 * phase - 1.0;
            // Starts and ends without a jump in velocity.
            let part = swing - (2.0 * PI * swing).sin() / (2.0 * PI);
            (half * (part - 0.5), lift * (PI * swing).sin() * (pace / FULL).min(1.0))
        };
        add(leg.foot, [over[0] * way, over[1] * way, height])
    }
}

/// The servos of each branch of bodies below the torso.
fn branches(model: &Model, torso: i32) -> BTreeMap<i32, Vec<Link>> {
    let mut out: BTreeMap<i32, Vec<Link>> = BTreeMap::new();
    for actuator in model.actuators() {
        let control = usize::try_from(model.actuator_ctrladr[actuator.index()]).ok();
        let link = control.and_then(|control| link(model, actuator, control)).filter(Link::is_servo);
        let Some(link) = link else { continue };
        let mut body = model.jnt_bodyid[link.joint.index()];
        while body > 0 && model.body_parentid[body as usize] != torso {
            body = model.body_parentid[body as usize];
        }
        if body > 0 {
            out.entry(body).or_default().push(link);
        }
    }
    out
}

/// The leg of three servos whose foot is a site of the last body.
fn leg(model: &Model, stand: &Data, links: &[Link]) -> Option<Leg> {
    let last = links.last().filter(|_| links.len() == LEG)?;
    let body = model.jnt_bodyid[last.joint.index()];
    let site = (0..model.nsite).find(|site| model.site_bodyid[*site] == body)?;
    let foot = stand.kin.site_xpos[site];
    Some(Leg {
        joints: links.iter().map(|link| link.joint).collect(),
        places: links.iter().map(|link| (link.position, link.control)).collect(),
        site: SiteId::at(model, site)?,
        foot,
        // Feet of one diagonal are on the same side of both axes, or on the other one of both.
        late: if foot[0] * foot[1] > 0.0 { 0.0 } else { 0.5 },
    })
}

fn missing(message: &str) -> TeleopError {
    TeleopError::Control { message: message.to_owned() }
}
