//! Moving things in a household to where they belong: joints of objects have goals, and a hand approaches a site.

use crate::draws::Rng;
use crate::error::EnvError;
use crate::rotation::{euler_of_mat, euler_of_quat, norm};
use crate::rows::{Name, Rows};
use crate::scene::Scene;
use crate::spec::Spec;
use crate::task::{Defaults, Pose, Setup, Verdict, View};
use physics::elements::{BodyId, JointId, SiteId};
use physics::math::sub;
use physics::model::JointType;
use robot::Keeper;
use serde::Deserialize;
use std::f64::consts::PI;
use toml::{Table, Value};

/// The hand.
const HAND: &str = "end_effector";

/// Share of a joint's span within which it is at its goal, if the span is small.
const SMALL_SPAN_SHARE: f64 = 0.15;

/// Spans of hinges \[rad\] and slides \[m\] that are large, and how near their goals are then.
const LARGE_HINGE: (f64, f64) = (PI, PI / 12.0);
const LARGE_SLIDE: (f64, f64) = (1.0, 0.05);

/// Errors, in units of that nearness, that earn a bonus.
const BONUS: [f64; 2] = [5.0, 1.67];

/// Settings of all chores. Positions and goals are numbers, or ranges to draw from, by the joints' names.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// Joints of the robot.
    #[serde(default = "panda")]
    pub robot_jnt_names: Vec<String>,
    /// Joints of objects.
    pub obj_jnt_names: Vec<String>,
    /// The site at which each of these joints is moved.
    pub obj_interaction_site: Vec<String>,
    /// Goals of joints; of others, their reference positions.
    #[serde(default)]
    pub obj_goal: Table,
    /// Initial positions of joints; other joints start as in the first keyframe.
    #[serde(default)]
    pub obj_init: Table,
    /// The site that the hand approaches.
    #[serde(default = "hand")]
    pub interact_site: String,
    /// The body that carries the robot.
    #[serde(default = "base")]
    pub robot_base_name: String,
}

fn panda() -> Vec<String> {
    let arm = (1..=7).map(|k| format!("panda0_joint{k}"));
    arm.chain((1..=2).map(|k| format!("panda0_finger_joint{k}"))).collect()
}

fn hand() -> String {
    HAND.into()
}

fn base() -> String {
    "chef".into()
}

/// A number, or a range that it is drawn from.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Wish {
    range: [f64; 2],
    drawn: bool,
}

impl Wish {
    fn new(spec: &Spec, joint: &str, value: &Value) -> Result<Self, EnvError> {
        let number = |value: &Value| value.as_float().or_else(|| value.as_integer().map(|n| n as f64));
        let range = value.as_array().map(|pair| pair.iter().filter_map(number).collect::<Vec<_>>());
        match (number(value), range.as_deref()) {
            (Some(number), _) => Ok(Wish { range: [number; 2], drawn: false }),
            (None, Some(&[low, high])) => Ok(Wish { range: [low, high], drawn: true }),
            _ => {
                Err(spec
                    .wrong(format!("{joint} of obj_init or obj_goal is no number and no pair of numbers")))
            }
        }
    }

    fn fulfil(&self, rng: &mut Rng) -> Result<f64, EnvError> {
        if self.drawn { Ok(rng.uniform(self.range[0], self.range[1])?) } else { Ok(self.range[0]) }
    }
}

/// A joint of the robot.
#[derive(Clone, Copy)]
pub struct RobotJoint {
    /// Where it stands in `qpos`.
    pub place: usize,
    velocity: usize,
    /// Its limits \[rad, m\].
    pub range: [f64; 2],
}

/// A joint of an object.
#[derive(Clone)]
struct ObjectJoint {
    place: usize,
    velocity: usize,
    /// How near \[rad, m\] a position at its goal is.
    near: f64,
    goal: f64,
}

/// A site and the row that shows where it is from the hand.
#[derive(Clone)]
struct Handle {
    row: String,
    site: SiteId,
}

/// What all chores remember.
#[derive(Clone)]
pub struct Chore {
    hand: SiteId,
    approached: SiteId,
    /// The body that carries the robot.
    pub base: BodyId,
    /// Joints of the robot.
    pub robot: Vec<RobotJoint>,
    objects: Vec<ObjectJoint>,
    handles: Vec<Handle>,
    init: Vec<(usize, Wish)>,
    goals: Vec<(usize, Wish)>,
    /// Positions drawn last for the joints that `obj_init` names.
    first: Vec<(usize, f64)>,
}

impl Chore {
    /// Finds the parts in the model, and draws goals and first positions.
    ///
    /// # Errors
    /// Elements are missing; joints and sites of objects are not one to one; goals or positions are no numbers or of
    /// joints that no object has.
    pub fn new(args: &Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let scene = &*setup.scene;
        if args.obj_jnt_names.len() != args.obj_interaction_site.len() {
            return Err(setup.wrong("obj_interaction_site needs one site for each of obj_jnt_names"));
        }
        let joints =
            |names: &[String]| names.iter().map(|name| scene.joint(name)).collect::<Result<Vec<_>, _>>();
        let objects = joints(&args.obj_jnt_names)?;
        let wishes = |wishes: &Table| {
            let wish = |(joint, value): (&String, &Value)| {
                let object = args.obj_jnt_names.iter().position(|name| name == joint);
                let unknown = || {
                    EnvError::missing("object joint", joint, args.obj_jnt_names.iter().map(String::as_str))
                };
                Ok((object.ok_or_else(unknown)?, Wish::new(setup.spec, joint, value)?))
            };
            wishes.iter().map(wish).collect::<Result<Vec<_>, EnvError>>()
        };
        let mut chore = Chore {
            hand: scene.site(HAND)?,
            approached: scene.site(&args.interact_site)?,
            base: scene.body(&args.robot_base_name)?,
            robot: joints(&args.robot_jnt_names)?
                .into_iter()
                .map(|joint| robot_joint(scene, joint))
                .collect(),
            objects: objects
                .into_iter()
                .map(|joint| object_joint(setup.spec, scene, joint))
                .collect::<Result<_, _>>()?,
            handles: handles(scene, &args.obj_interaction_site)?,
            init: wishes(&args.obj_init)?,
            goals: wishes(&args.obj_goal)?,
            first: Vec::new(),
        };
        chore.draw_goals(setup.rng)?;
        chore.draw_first(setup.rng)?;
        Ok(chore)
    }

    /// Weights and observation, the rows `obs_keys` and those that show handles where `handles` is set.
    pub fn defaults(&self, obs_keys: &[&str], handles: bool) -> Defaults {
        let rows = self.handles.iter().map(|handle| handle.row.as_str()).filter(|_| handles);
        let keys: Vec<&str> = obs_keys.iter().copied().chain(rows).collect();
        let weights = [("obj_goal", 1.0), ("bonus", 0.5), ("pose", 0.0), ("approach", 0.5)];
        Defaults::new(&keys, &weights, 40).proprio(&["robot_jnt", "robot_vel", "ee_pose_wrt_robot"])
    }

    /// Rows of the observation that never change: goals, unless they are drawn.
    pub fn constant_rows(&self) -> Vec<String> {
        let drawn = self.goals.iter().any(|(_, wish)| wish.drawn);
        if drawn { Vec::new() } else { vec!["obj_goal".into()] }
    }

    /// Draws the goals.
    ///
    /// # Errors
    /// Ranges that cannot be drawn from.
    pub fn draw_goals(&mut self, rng: &mut Rng) -> Result<(), EnvError> {
        for (object, wish) in &self.goals {
            self.objects[*object].goal = wish.fulfil(rng)?;
        }
        Ok(())
    }

    /// Draws the first positions of objects.
    ///
    /// # Errors
    /// Ranges that cannot be drawn from.
    pub fn draw_first(&mut self, rng: &mut Rng) -> Result<(), EnvError> {
        self.first.clear();
        for (object, wish) in &self.init {
            self.first.push((self.objects[*object].place, wish.fulfil(rng)?));
        }
        Ok(())
    }

    /// Writes or reads what was drawn.
    pub fn keep(&mut self, keeper: &mut Keeper) {
        self.objects.iter_mut().for_each(|object| keeper.number(&mut object.goal));
        self.first.iter_mut().for_each(|(_, position)| keeper.number(position));
    }

    /// Puts the first positions of objects into a pose.
    pub fn place_objects(&self, pose: &mut Pose) {
        for &(place, position) in &self.first {
            pose.qpos[place] = position;
        }
    }

    /// The first keyframe with the objects in their first positions.
    ///
    /// # Errors
    /// The model has no keyframe.
    pub fn initial_pose(&self, scene: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        let m = &scene.model;
        if m.nkey == 0 {
            return Err(EnvError::missing("keyframe", "the first one", std::iter::empty()));
        }
        pose.qpos.copy_from_slice(&m.key_qpos[..m.nq]);
        pose.qvel.copy_from_slice(&m.key_qvel[..m.nv]);
        self.place_objects(pose);
        Ok(())
    }

    /// Moves every joint of the robot by up to half of `scale` times its span; one draw a joint.
    pub fn shake(&self, scale: f64, rng: &mut Rng, pose: &mut Pose) {
        for joint in &self.robot {
            pose.qpos[joint.place] += scale * (rng.random() - 0.5) * (joint.range[1] - joint.range[0]);
        }
    }

    /// Writes the observation.
    pub fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let (m, state) = (view.model, &view.data.state);
        let (robot, objects) = (&self.robot, &self.objects);
        let hand = view.data.site(self.hand);
        let from_hand = |site| sub(*view.data.site(site).xpos(), *hand.xpos());
        rows.set("robot_jnt", "rad, m", robot.iter().map(|joint| state.qpos[joint.place]));
        rows.set("objs_jnt", "rad, m", objects.iter().map(|joint| state.qpos[joint.place]));
        rows.set("robot_vel", "rad, m", robot.iter().map(|joint| state.qvel[joint.velocity] * view.dt));
        rows.set("objs_vel", "rad, m", objects.iter().map(|joint| state.qvel[joint.velocity] * view.dt));
        rows.set("obj_goal", "rad, m", objects.iter().map(|joint| joint.goal));
        rows.set("goal_err", "rad, m", objects.iter().map(|joint| joint.goal - state.qpos[joint.place]));
        rows.set("approach_err", "m", from_hand(self.approached));
        let middle = |joint: &RobotJoint| (joint.range[0] + joint.range[1]) / 2.0;
        rows.set("pose_err", "rad, m", robot.iter().map(|joint| middle(joint) - state.qpos[joint.place]));
        let (pos, euler) = (*hand.xpos(), euler_of_mat(hand.xmat()));
        rows.set("ee_pose", "m, rad", [pos, euler].as_flattened());
        let base = self.base.index();
        let relative = [sub(pos, m.body_pos[base]), sub(euler, euler_of_quat(m.body_quat[base]))];
        rows.set("ee_pose_wrt_robot", "m, rad", relative.as_flattened());
        rows.set("qpos", "rad, m", &state.qpos);
        for handle in &self.handles {
            rows.set(Name(&handle.row), "m", from_hand(handle.site));
        }
    }

    /// Writes the terms of the reward.
    pub fn reward(&self, rows: &Rows, terms: &mut Rows) -> Verdict {
        let errors = &rows["goal_err"];
        let far = errors.iter().map(|error| error.abs()).sum::<f64>();
        let all_within = |factor: f64| {
            errors.iter().zip(&self.objects).all(|(error, joint)| error.abs() < factor * joint.near)
        };
        terms.set("obj_goal", "rad, m", [-far]);
        terms.set("bonus", "", [BONUS.iter().map(|&factor| f64::from(all_within(factor))).sum::<f64>()]);
        terms.set("pose", "rad, m", [-rows["pose_err"].iter().map(|error| error.abs()).sum::<f64>()]);
        terms.set("approach", "m", [-norm(&rows["approach_err"])]);
        Verdict { sparse: -far, solved: all_within(1.0), done: false }
    }
}

fn robot_joint(scene: &Scene, joint: JointId) -> RobotJoint {
    let view = scene.model.joint(joint);
    RobotJoint {
        place: view.qpos_range().start,
        velocity: view.dof_range().start,
        range: scene.model.jnt_range[joint.index()],
    }
}

fn object_joint(spec: &Spec, scene: &Scene, joint: JointId) -> Result<ObjectJoint, EnvError> {
    let view = scene.model.joint(joint);
    let [low, high] = scene.model.jnt_range[joint.index()];
    let (large, near) = match view.kind() {
        Some(JointType::Hinge) => LARGE_HINGE,
        Some(JointType::Slide) => LARGE_SLIDE,
        _ => return Err(spec.wrong(format!("the object joint {} is no hinge and no slide", view.name()))),
    };
    let span = high - low;
    Ok(ObjectJoint {
        place: view.qpos_range().start,
        velocity: view.dof_range().start,
        near: if span < large { SMALL_SPAN_SHARE * span } else { near },
        goal: scene.data.state.qpos[view.qpos_range().start],
    })
}

/// The sites in order, each once.
fn handles(scene: &Scene, names: &[String]) -> Result<Vec<Handle>, EnvError> {
    let mut handles: Vec<Handle> = Vec::new();
    for name in names {
        let row = format!("{name}_err");
        if handles.iter().all(|handle| handle.row != row) {
            handles.push(Handle { row, site: scene.site(name)? });
        }
    }
    Ok(handles)
}
