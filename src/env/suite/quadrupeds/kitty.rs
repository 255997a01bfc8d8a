//! The D'Kitty: a torso on three slides and three hinges, four legs of three joints, and the marks around it.

use crate::error::EnvError;
use crate::rotation::cosine;
use crate::rows::Rows;
use crate::task::{Defaults, Episode, Pose, Setup, View};
use physics::elements::SiteId;
use physics::math::ops;
use robot::Compat;
use serde::Deserialize;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_8};
use std::ops::Range;

/// Joints of the torso: x, y, z, and the angles about them.
const ROOT: usize = 6;

/// How far \[m\] the point to look at lies behind the target, so that the heading is steady at the target.
const BEYOND: f64 = 0.5;

/// The settings of all tasks of the robot.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// First and last joint of the legs.
    pub dof_range_names: [String; 2],
    /// First and last actuator of the legs.
    pub act_range_names: [String; 2],
    /// Below this height of the torso's vertical axis the robot has fallen.
    pub upright_threshold: Option<f64>,
    #[serde(default = "torso")]
    torso_site_name: String,
    #[serde(default = "target")]
    target_site_name: String,
    #[serde(default = "heading")]
    heading_site_name: String,
    /// Distance of the target \[m\].
    pub target_distance_range: Option<[f64; 2]>,
    #[serde(default = "ahead")]
    target_angle_range: [f64; 2],
    /// Height of the torso \[m\].
    #[serde(default = "standing")]
    pub target_height_range: [f64; 2],
    /// How a standing robot starts.
    #[serde(default)]
    pub reset_type: Option<Start>,
}

/// How a standing robot starts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Start {
    /// Crouched.
    #[default]
    Fixed,
    /// Legs anywhere within the limits of the configuration.
    Random,
}

fn torso() -> String {
    "torso".into()
}

fn target() -> String {
    "target".into()
}

fn heading() -> String {
    "heading".into()
}

fn ahead() -> [f64; 2] {
    [FRAC_PI_2; 2]
}

fn standing() -> [f64; 2] {
    [0.28; 2]
}

/// An actuated joint: where it stands in `qpos`, and the limits of the configuration \[rad\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// Place in `qpos`.
    pub place: usize,
    /// Lowest and highest position.
    pub range: [f64; 2],
}

/// The robot and its marks in the model.
#[derive(Clone)]
pub struct Kitty {
    torso: SiteId,
    target: SiteId,
    heading: SiteId,
    qpos: Range<usize>,
    qvel: Range<usize>,
    /// Limits of the configuration, actuator by actuator.
    pub limits: Vec<Limit>,
    distance: [f64; 2],
    angle: [f64; 2],
    compat: Compat,
}

impl Kitty {
    /// Finds the robot in the model; `distance` is the target's distance \[m\].
    ///
    /// # Errors
    /// Elements are missing; the id has no robot configuration.
    pub fn new(args: &Args, distance: [f64; 2], setup: &Setup<'_>) -> Result<Self, EnvError> {
        let scene = &*setup.scene;
        let [first, last] = &args.dof_range_names;
        let (first, last) = (scene.joint(first)?, scene.joint(last)?);
        for name in &args.act_range_names {
            scene.actuator(name)?;
        }
        let m = &scene.model;
        let (first, last) = (m.joint(first), m.joint(last));
        if m.nq < ROOT || m.nv < ROOT {
            return Err(setup.wrong("the model needs three slides and three hinges of a torso, and legs"));
        }
        Ok(Kitty {
            torso: scene.site(&args.torso_site_name)?,
            target: scene.site(&args.target_site_name)?,
            heading: scene.site(&args.heading_site_name)?,
            qpos: first.qpos_range().start..last.qpos_range().end,
            qvel: first.dof_range().start..last.dof_range().end,
            limits: limits(setup)?,
            distance,
            angle: args.target_angle_range,
            compat: setup.compat,
        })
    }

    /// Observation and proprioception.
    pub fn defaults(obs_keys: &[&str], weights: &[(&str, f64)]) -> Defaults {
        Defaults::new(obs_keys, weights, 40).proprio(&["kitty_qpos"])
    }

    /// Moves every actuated joint to the middle of the limits of the configuration.
    pub fn centre(&self, pose: &mut Pose) {
        for limit in &self.limits {
            pose.qpos[limit.place] = (limit.range[0] + limit.range[1]) / 2.0;
        }
    }

    /// Turns the legs a little and sets the marks: draws of every joint, of the target's distance and of its angle.
    ///
    /// # Errors
    /// Ranges that cannot be drawn from.
    pub fn start(&self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        for angle in &mut episode.start.qpos[ROOT..] {
            *angle += FRAC_PI_8 * episode.rng.uniform(-1.0, 1.0)?;
        }
        let distance = episode.rng.uniform(self.distance[0], self.distance[1])?;
        let angle = episode.rng.uniform(self.angle[0], self.angle[1])?;
        let at = |distance: f64| [distance * ops::cos(angle), distance * ops::sin(angle), 0.0];
        episode.scene.overwrite(|m| {
            m.site_pos[self.target.index()] = at(distance);
            m.site_pos[self.heading.index()] = at(distance + BEYOND);
        })?;
        Ok(())
    }

    /// Where the legs stand in `qpos`.
    pub fn legs(&self) -> Range<usize> {
        self.qpos.clone()
    }

    /// Writes the observation; the last controls are called `action_key`.
    pub fn observe(&self, action_key: &'static str, view: &View<'_>, rows: &mut Rows) {
        let state = &view.data.state;
        let torso = view.data.site(self.torso);
        let (here, axes) = (*torso.xpos(), torso.xmat());
        let offset = |site| {
            let there = view.data.site(site).xpos();
            [there[0] - here[0], there[1] - here[1]]
        };
        let target = offset(self.target);
        // A reset clears the controls; the original keeps showing the previous episode's.
        let control = match self.compat {
            Compat::RoboHive07 => view.control,
            Compat::Fixed => &state.ctrl,
        };
        rows.set(action_key, "rad", control);
        rows.set("upright", "", [axes[8]]);
        rows.set("root_pos", "m", here);
        rows.set("root_euler", "rad", &state.qpos[3..ROOT]);
        rows.set("root_vel", "m/s", &state.qvel[..3]);
        rows.set("root_angular_vel", "rad/s", &state.qvel[3..ROOT]);
        rows.set("kitty_qpos", "rad", &state.qpos[self.qpos.clone()]);
        rows.set("kitty_qvel", "rad/s", &state.qvel[self.qvel.clone()]);
        // The robot looks along the y axis of its torso.
        rows.set("heading", "", [cosine(&[axes[1], axes[4]], &offset(self.heading))]);
        rows.set("target_pos", "m", &view.data.site(self.target).xpos()[..2]);
        let along = |axis: usize| axes[axis] * target[0] + axes[3 + axis] * target[1];
        rows.set("target_error", "m", [along(0), along(1)]);
    }
}

/// The limits of the configuration, in its order.
fn limits(setup: &Setup<'_>) -> Result<Vec<Limit>, EnvError> {
    let config = setup.config.ok_or_else(|| setup.wrong("config_path is missing, which names the limits"))?;
    let m = &setup.scene.model;
    let limit = |actuator: &robot::ActuatorConfig| -> Result<Limit, EnvError> {
        let id = setup.scene.actuator(&actuator.name)?;
        let joint = usize::try_from(m.actuator_trnid[id.index()][0])
            .map_err(|_| setup.wrong(format!("the actuator {} moves no joint", actuator.name)))?;
        Ok(Limit { place: m.jnt_qposadr[joint] as usize, range: actuator.position_range })
    };
    config.devices.iter().flat_map(|device| &device.actuators).map(limit).collect()
}
