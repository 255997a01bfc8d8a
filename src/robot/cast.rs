//! Roles in a model, as one task wants them.

use crate::config::{ConfigError, Fallen, Named, NominalPose, Roles, Walk};
use physics::Model;
use physics::elements::{BodyId, Element, JointId, SiteId};
use physics::model::{JointType, Suggestions};

/// The parts of a robot in a model, for one task, which error messages name.
///
/// ```
/// use robohive_robot::Roles;
///
/// let model = robohive_mjcf::load_str(
///     "<mujoco><worldbody><body name='left/torso'><freejoint/><geom size='.1'/><site name='left/sole'/>
///      <body><joint name='left/knee'/><geom size='.1'/></body></body></worldbody></mujoco>",
/// )?
/// .model;
/// let roles = Roles::from_toml(
///     "root = 'torso'\nfeet = ['sole', 'front_pad']\n[poses.crouch]\nroot_z = 0.4\nknee = 0.7",
///     "biped/roles.toml",
/// )?;
/// let body = roles.cast(&model, "left/", "tag");
/// assert_eq!(body.root()?.index(), 1);
/// let mut qpos = model.qpos0.clone();
/// body.pose("crouch", &mut qpos)?;
/// assert_eq!((qpos[2], qpos[7]), (0.4, 0.7));
/// assert_eq!(
///     body.feet().unwrap_err().to_string(),
///     "biped/roles.toml:2:1: the model has no site 'left/front_pad' for the role 'feet', which the task 'tag' needs; \
///      add a site of this name to the robot, or name another here",
/// );
/// assert_eq!(
///     body.palm().unwrap_err().to_string(),
///     "biped/roles.toml: there is no role 'palm', which the task 'tag' needs; name its site here: palm = \"…\"",
/// );
/// # use physics as robohive_physics;
/// # use robohive_physics::elements::Element;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Cast<'a> {
    roles: &'a Roles,
    model: &'a Model,
    prefix: &'a str,
    task: &'a str,
}

impl Roles {
    /// The roles in `model`, where the robot's names begin with `prefix` (as `attach` makes them, or empty). Errors name
    /// the `task` that wants them.
    pub fn cast<'a>(&'a self, model: &'a Model, prefix: &'a str, task: &'a str) -> Cast<'a> {
        Cast { roles: self, model, prefix, task }
    }
}

/// Of each: the text does not have the role, or the model not the element.
impl Cast<'_> {
    /// The body whose pose and velocity tasks read.
    ///
    /// # Errors
    /// The role or its element is missing.
    pub fn root(&self) -> Result<BodyId, ConfigError> {
        self.one("root", self.roles.root.as_ref(), "body")
    }

    /// Direction that the robot looks and walks in, in the frame of the root.
    pub fn forward(&self) -> [f64; 3] {
        self.roles.forward
    }

    /// Direction that points up when the robot stands, in the frame of the root.
    pub fn up(&self) -> [f64; 3] {
        self.roles.up
    }

    /// The head.
    ///
    /// # Errors
    /// The role or its element is missing.
    pub fn head(&self) -> Result<BodyId, ConfigError> {
        self.one("head", self.roles.head.as_ref(), "body")
    }

    /// Sites at the soles, front before hind, left before right.
    ///
    /// # Errors
    /// The role or one of its elements is missing.
    pub fn feet(&self) -> Result<Vec<SiteId>, ConfigError> {
        self.all("feet", self.roles.feet.as_ref(), "site")
    }

    /// The site in the middle of the palm.
    ///
    /// # Errors
    /// The role or its element is missing.
    pub fn palm(&self) -> Result<SiteId, ConfigError> {
        self.one("palm", self.roles.palm.as_ref(), "site")
    }

    /// Sites at the tips of the fingers, the thumb first.
    ///
    /// # Errors
    /// The role or one of its elements is missing.
    pub fn fingertips(&self) -> Result<Vec<SiteId>, ConfigError> {
        self.all("fingertips", self.roles.fingertips.as_ref(), "site")
    }

    /// The tool centre point.
    ///
    /// # Errors
    /// The role or its element is missing.
    pub fn tool(&self) -> Result<SiteId, ConfigError> {
        self.one("tool", self.roles.tool.as_ref(), "site")
    }

    /// When the robot has fallen.
    ///
    /// # Errors
    /// The text does not say.
    pub fn fallen(&self) -> Result<Fallen, ConfigError> {
        self.roles.fallen.ok_or_else(|| {
            self.error(None, format!("there is no [fallen], which {}; give its height and tilt", self.need()))
        })
    }

    /// How fast the body walks.
    ///
    /// # Errors
    /// The text does not say.
    pub fn walk(&self) -> Result<Walk, ConfigError> {
        self.roles.walk.ok_or_else(|| {
            self.error(None, format!("there is no [walk], which {}; give its speed and turn", self.need()))
        })
    }

    /// How fast the body swims; `None` for one that has feet.
    pub fn swim(&self) -> Option<Walk> {
        self.roles.swim
    }

    /// Writes the pose called `name` into `qpos`: every joint that it names, and the height of the root.
    ///
    /// # Errors
    /// The text has no such pose, or the model not its joints; a joint that turns by a quaternion, or a pose with `root_z`
    /// whose root has neither a free joint nor a vertical slide.
    pub fn pose(&self, name: &str, qpos: &mut [f64]) -> Result<(), ConfigError> {
        let pose = self.named(name)?;
        if let Some(height) = pose.root_z {
            let (place, offset) = self.vertical(name, pose)?;
            qpos[place] = height - offset;
        }
        for (joint, &value) in &pose.joints {
            let role = format!("pose '{name}'");
            let id: JointId = self.find(&role, pose.position, joint, "joint")?;
            if ![JointType::Hinge, JointType::Slide]
                .map(|kind| kind as i32)
                .contains(&self.model.jnt_type[id.index()])
            {
                let message = format!("the joint '{joint}' of {role} is neither a hinge nor a slide");
                return Err(self.error(Some(pose.position), message));
            }
            qpos[self.model.jnt_qposadr[id.index()] as usize] = value;
        }
        Ok(())
    }

    /// The joints that the pose called `name` names, in the order of their names.
    ///
    /// # Errors
    /// The text has no such pose, or the model not its joints.
    pub fn joints_of(&self, name: &str) -> Result<Vec<JointId>, ConfigError> {
        let pose = self.named(name)?;
        let role = format!("pose '{name}'");
        pose.joints.keys().map(|joint| self.find(&role, pose.position, joint, "joint")).collect()
    }

    fn named(&self, name: &str) -> Result<&NominalPose, ConfigError> {
        self.roles.poses.get(name).ok_or_else(|| {
            let known = self.roles.poses.keys().map(String::as_str);
            let near = Suggestions::default().nearest(name, known);
            let hint =
                near.map_or_else(|| format!("add [poses.{name}]"), |near| format!("there is '{near}'"));
            self.error(None, format!("there is no pose '{name}', which {}; {hint}", self.need()))
        })
    }

    /// Where `qpos` has the height of the root, and the height of the root over the ground when 0 stands there.
    fn vertical(&self, name: &str, pose: &NominalPose) -> Result<(usize, f64), ConfigError> {
        let m = self.model;
        let (mut body, mut offset) = (self.root()?.index(), 0.0);
        while body > 0 {
            let first = m.body_jntadr[body].max(0) as usize;
            for joint in first..first + m.body_jntnum[body] as usize {
                let place = m.jnt_qposadr[joint] as usize;
                if m.jnt_type[joint] == JointType::Free as i32 {
                    return Ok((place + 2, offset));
                }
                if m.jnt_type[joint] == JointType::Slide as i32 && m.jnt_axis[joint] == [0.0, 0.0, 1.0] {
                    let above =
                        std::iter::successors(Some(body), |&body| Some(m.body_parentid[body] as usize));
                    let heights = above.take_while(|&body| body > 0).map(|body| m.body_pos[body][2]);
                    return Ok((place, offset + heights.sum::<f64>()));
                }
            }
            offset += m.body_pos[body][2];
            body = m.body_parentid[body] as usize;
        }
        let message =
            format!("pose '{name}' has 'root_z', but nothing moves the root of the model up and down");
        Err(self.error(Some(pose.position), message))
    }

    fn one<E: Element>(&self, role: &str, named: Option<&Named>, kind: &str) -> Result<E, ConfigError> {
        Ok(self.all(role, named, kind)?[0])
    }

    fn all<E: Element>(&self, role: &str, named: Option<&Named>, kind: &str) -> Result<Vec<E>, ConfigError> {
        let named = named.ok_or_else(|| {
            let message = format!(
                "there is no role '{role}', which {}; name its {kind} here: {role} = \"…\"",
                self.need()
            );
            self.error(None, message)
        })?;
        named
            .names
            .iter()
            .map(|name| self.find(&format!("the role '{role}'"), named.position, name, kind))
            .collect()
    }

    /// The element called `name` that a role or a pose names.
    fn find<E: Element>(
        &self,
        owner: &str,
        position: (usize, usize),
        name: &str,
        kind: &str,
    ) -> Result<E, ConfigError> {
        let name = format!("{}{name}", self.prefix);
        let found = self.model.id_of(E::KIND, &name).and_then(|index| E::at(self.model, index));
        found.ok_or_else(|| {
            let names = (0..E::count(self.model)).map(|id| self.model.name_of(E::KIND, id));
            let near = Suggestions::default().nearest(&name, names);
            let hint = near.map_or_else(
                || format!("add a {kind} of this name to the robot, or name another here"),
                |near| format!("did you mean '{near}'?"),
            );
            let message =
                format!("the model has no {kind} '{name}' for {owner}, which {}; {hint}", self.need());
            self.error(Some(position), message)
        })
    }

    fn need(&self) -> String {
        format!("the task '{}' needs", self.task)
    }

    fn error(&self, position: Option<(usize, usize)>, message: String) -> ConfigError {
        ConfigError { file: self.roles.file.clone(), position, message }
    }
}
