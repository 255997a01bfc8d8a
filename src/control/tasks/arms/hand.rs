//! A gripper of two fingers, by the roles of its robot: how its tool is turned, how wide it opens, what its actuators are told.

use super::frame::Frame;
use crate::error::ControlError;
use crate::tasks::joints::Servo;
use env::Env;
use physics::elements::{JointId, SiteId};
use physics::math::{Mat3, Quat, Vec3, add, cross, dot, mat_to_quat, mul_mat_t_vec, mul_mat_vec, scale, sub};
use physics::math::{mul_mat, normalize, transpose};
use physics::model::{JointType, TrnType};
use physics::position::kinematics::kinematics;
use physics::{Data, Model};
use robot::{Cast, Roles};

/// Openings at which the gap between the fingertips is measured.
const SAMPLES: usize = 33;
/// Force of a finger that is driven by a motor, for each metre that it is off \[N/m\].
const STIFFNESS: f64 = 1500.0;
/// How far beyond its place such a finger is told to close \[m\].
const SQUEEZE: f64 = 0.01;

/// A joint of a finger.
#[derive(Clone, Copy)]
struct Finger {
    place: usize,
    closed: f64,
    open: f64,
}

/// An actuator of a finger.
#[derive(Clone, Copy)]
struct Drive {
    control: usize,
    servo: Servo,
    finger: Finger,
}

/// What is between the fingertips at an opening.
#[derive(Clone, Copy)]
struct Gap {
    width: f64,
    /// Its middle, in the frame of the tool \[m\].
    middle: Vec3,
}

/// A gripper.
pub struct Hand {
    /// The tool centre point.
    pub tool: SiteId,
    /// How far the fingers reach beyond the tool \[m\].
    pub depth: f64,
    /// Directions in the frame of the tool: out of the hand, and of the fingers' motion.
    approach: Vec3,
    close: Vec3,
    fingers: Vec<Finger>,
    drives: Vec<Drive>,
    /// Gaps from closed to open, equally far apart in opening.
    gaps: Vec<Gap>,
}

impl Hand {
    /// The gripper at the end of `joints`. Joints that the pose `open` names are those of its fingers.
    ///
    /// # Errors
    /// The roles have no tool or no pose `open`, or the model not what they name.
    pub fn new(env: &Env, roles: &Roles, body: &Cast<'_>, joints: &[JointId]) -> Result<Self, ControlError> {
        let unfit = |message: String| ControlError::unfit(env, message);
        let told = |error: robot::ConfigError| unfit(error.to_string());
        let m = &env.scene().model;
        let tool = body.tool().map_err(told)?;
        let (mut open, mut closed) = (m.qpos0.to_vec(), m.qpos0.to_vec());
        body.pose("open", &mut open).map_err(told)?;
        body.pose("closed", &mut closed).map_err(told)?;
        let moving = body.joints_of("open").map_err(told)?;
        let finger = |joint: &JointId| {
            let place = m.jnt_qposadr[joint.index()] as usize;
            Finger { place, closed: closed[place], open: open[place] }
        };
        let fingers: Vec<Finger> = moving.iter().map(finger).collect();
        let first =
            moving.first().ok_or_else(|| unfit("the pose `open` of the roles names no joint".into()))?;
        let last = joints.last().ok_or_else(|| unfit("no actuator moves the tool".into()))?;
        let mut posed = Data::new(m);
        posed.state.qpos.copy_from_slice(&open);
        kinematics(m, &posed.state, &mut posed.kin);
        let frame = posed.kin.site_xmat[tool.index()];
        let out = sub(posed.kin.site_xpos[tool.index()], posed.kin.xanchor[last.index()]);
        let approach = nearest_axis(mul_mat_t_vec(&frame, out));
        let axis = mul_mat_t_vec(&frame, posed.kin.xaxis[first.index()]);
        let slides = m.jnt_type[first.index()] == JointType::Slide as i32;
        let close = nearest_axis(if slides { axis } else { cross(axis, approach) });
        let depth = reach_beyond(m, &posed, tool, &moving, mul_mat_vec(&frame, approach));
        let tips = roles.fingertips.as_ref().map(|_| body.fingertips()).transpose().map_err(told)?;
        let mut hand =
            Hand { tool, depth, approach, close, drives: drives(m, &fingers), fingers, gaps: Vec::new() };
        hand.gaps = (0..SAMPLES).map(|k| hand.gap(m, &mut posed, tips.as_deref(), k)).collect();
        Ok(hand)
    }

    fn gap(&self, m: &Model, posed: &mut Data, tips: Option<&[SiteId]>, sample: usize) -> Gap {
        let opening = sample as f64 / (SAMPLES - 1) as f64;
        for finger in &self.fingers {
            posed.state.qpos[finger.place] = finger.at(opening);
        }
        kinematics(m, &posed.state, &mut posed.kin);
        let tool = Frame::of_site(posed, self.tool);
        let Some([first, second]) = tips else {
            let width = self.fingers.iter().map(|finger| (finger.at(opening) - finger.closed).abs()).sum();
            return Gap { width, middle: [0.0; 3] };
        };
        let local = |site: &SiteId| Frame::of_site(posed, *site).within(&tool).place;
        let (first, second) = (local(first), local(second));
        let middle = dot(scale(add(first, second), 0.5), self.close);
        Gap { width: dot(sub(first, second), self.close).abs(), middle: scale(self.close, middle) }
    }

    /// The opening, 0 to 1, at which a thing of this width \[m\] fits between the fingers.
    pub fn opening(&self, width: f64) -> f64 {
        self.fitting(width) as f64 / (SAMPLES - 1) as f64
    }

    /// The first of the gaps that is as wide.
    fn fitting(&self, width: f64) -> usize {
        self.gaps.iter().position(|gap| gap.width >= width).unwrap_or(SAMPLES - 1)
    }

    /// The tool's frame with the middle between fingers that hold a thing of this width \[m\] at `place`. The hand points along
    /// `approach`, and fingers close along `close`, directions of the world at a right angle.
    pub fn around(&self, place: Vec3, width: f64, approach: Vec3, close: Vec3) -> Frame {
        let turn = self.turned(approach, close);
        let middle = self.gaps[self.fitting(width)].middle;
        Frame { place, turn }.moved(scale(physics::math::quat_rotate(turn, middle), -1.0))
    }

    /// The direction in which the hand points, of a tool that is turned like this.
    pub fn pointing(&self, turn: Quat) -> Vec3 {
        physics::math::quat_rotate(turn, self.approach)
    }

    fn turned(&self, approach: Vec3, close: Vec3) -> Quat {
        let columns = |a: Vec3, b: Vec3| {
            let c = cross(a, b);
            [a[0], b[0], c[0], a[1], b[1], c[1], a[2], b[2], c[2]]
        };
        let (own, world): (Mat3, Mat3) = (columns(self.approach, self.close), columns(approach, close));
        mat_to_quat(&mul_mat(&world, &transpose(&own)))
    }

    /// Writes the controls by which the fingers go to an opening.
    pub fn command(&self, qpos: &[f64], opening: f64, controls: &mut [f64]) {
        for Drive { control, servo, finger } in &self.drives {
            let wanted = finger.at(opening);
            controls[*control] = if servo.stiffness > 0.0 {
                wanted
            } else {
                let beyond =
                    if opening <= 0.0 { SQUEEZE * (finger.closed - finger.open).signum() } else { 0.0 };
                STIFFNESS * (wanted + beyond - qpos[finger.place])
            };
        }
    }
}

impl Finger {
    fn at(&self, opening: f64) -> f64 {
        self.closed + opening * (self.open - self.closed)
    }
}

/// Actuators that move fingers.
fn drives(m: &Model, fingers: &[Finger]) -> Vec<Drive> {
    let moving = (0..m.nactuator).filter(|&actuator| m.actuator_trntype[actuator] == TrnType::Joint as i32);
    let drive = |actuator: usize| {
        let (servo, control) = (Servo::new(m, actuator), m.actuator_ctrladr[actuator] as usize);
        let finger = fingers.iter().find(|finger| finger.place == servo.place)?;
        Some(Drive { control, servo, finger: *finger })
    };
    moving.filter_map(drive).collect()
}

/// How far shapes that touch, of the bodies of fingers and of the tool, reach beyond the tool along a direction \[m\].
fn reach_beyond(m: &Model, d: &Data, tool: SiteId, fingers: &[JointId], along: Vec3) -> f64 {
    let mut bodies: Vec<i32> = fingers.iter().map(|joint| m.jnt_bodyid[joint.index()]).collect();
    bodies.push(m.site_bodyid[tool.index()]);
    let touching =
        (0..m.ngeom).filter(|&geom| m.geom_contype[geom] != 0 && bodies.contains(&m.geom_bodyid[geom]));
    let beyond = |geom: usize| {
        let [x, y, z, a, b, c] = m.geom_aabb[geom];
        let local = mul_mat_t_vec(&d.kin.geom_xmat[geom], along);
        let origin = dot(sub(d.kin.geom_xpos[geom], d.kin.site_xpos[tool.index()]), along);
        origin + dot([x, y, z], local) + dot([a, b, c], local.map(f64::abs))
    };
    touching.map(beyond).fold(0.0, f64::max)
}

/// The axis of a frame that is nearest to a direction in it.
fn nearest_axis(direction: Vec3) -> Vec3 {
    let (direction, _) = normalize(direction);
    let mut axis = [0.0; 3];
    let largest = (0..3).max_by(|&a, &b| direction[a].abs().total_cmp(&direction[b].abs())).unwrap_or(2);
    axis[largest] = direction[largest].signum();
    axis
}
