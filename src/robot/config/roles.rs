//! What tasks need of a body, by role: the text of a `roles.toml`.

use super::error::{ConfigError, Source};
use super::fields::{Fields, Outcome};
use super::node::{Content, Node};
use super::toml_reader;
use std::collections::BTreeMap;

const KEYS: [&str; 13] = [
    "root",
    "forward",
    "up",
    "head",
    "feet",
    "palm",
    "fingertips",
    "tool",
    "hardware",
    "poses",
    "fallen",
    "walk",
    "swim",
];

/// Parts of a robot by their roles, so that one task serves robots whose elements have other names.
///
/// ```
/// use robohive_robot::Roles;
///
/// let roles = Roles::from_toml(
///     "root = 'torso'
///      feet = ['left_sole', 'right_sole']
///      [poses.stand]
///      root_z = 0.9
///      left_knee = 0.4
///      [fallen]
///      height = 0.5
///      tilt = 1.0",
///     "biped/roles.toml",
/// )?;
/// assert_eq!(roles.feet.as_ref().map(|feet| feet.names.len()), Some(2));
/// assert_eq!(roles.poses["stand"].joints["left_knee"], 0.4);
/// # Ok::<(), robohive_robot::ConfigError>(())
/// ```
///
/// | key | meaning |
/// |---|---|
/// | `root` | body whose pose and velocity tasks read |
/// | `forward` | axis of the root that points forward: `x` (if left out), `-x`, `y` or `-y` |
/// | `up` | axis of the root that points up when it stands: `z` (if left out) or `y` |
/// | `head` | body |
/// | `feet` | sites at the soles, front before hind, left before right |
/// | `palm` | site in the middle of the palm or between the fingers of a gripper, its z axis the way the palm faces |
/// | `fingertips` | sites, the thumb first |
/// | `tool` | site: the tool centre point of an arm |
/// | `hardware` | path of the [`Config`](super::Config), from the folder of this file |
/// | `poses.NAME` | a pose: joints and where they are \[rad or m\], the others stay; `root_z` is the height of a root that is free or slides \[m\] |
/// | `walk` | how fast a legged body walks: `speed` \[m/s\], `turn` \[rad/s\] |
/// | `swim` | the same of a body without feet that swims at one depth |
/// | `fallen` | when a robot has fallen: `height` \[m\] of the root over the ground, `tilt` \[rad\] of its upward axis from the vertical |
#[derive(Clone, Debug, PartialEq)]
pub struct Roles {
    /// The text, as the caller named it.
    pub file: String,
    /// Body whose pose and velocity tasks read.
    pub root: Option<Named>,
    /// Direction that the robot looks and walks in, in the frame of the root.
    pub forward: [f64; 3],
    /// Direction that points up when the robot stands, in the frame of the root.
    pub up: [f64; 3],
    /// Body.
    pub head: Option<Named>,
    /// Sites at the soles.
    pub feet: Option<Named>,
    /// Site in the palm.
    pub palm: Option<Named>,
    /// Sites at the tips of the fingers, the thumb first.
    pub fingertips: Option<Named>,
    /// Site: the tool centre point.
    pub tool: Option<Named>,
    /// Path of the robot's config, from the folder of this file.
    pub hardware: Option<String>,
    /// Poses by their names.
    pub poses: BTreeMap<String, NominalPose>,
    /// When the robot has fallen.
    pub fallen: Option<Fallen>,
    /// How fast it walks.
    pub walk: Option<Walk>,
    /// How fast it swims.
    pub swim: Option<Walk>,
}

/// The elements of a role.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Named {
    /// Names in the model, at least one.
    pub names: Vec<String>,
    /// Line and column of the role in the text, from 1.
    pub position: (usize, usize),
}

/// A pose that tasks start from.
#[derive(Clone, Debug, PartialEq)]
pub struct NominalPose {
    /// Height of a root that is free or slides \[m\].
    pub root_z: Option<f64>,
    /// Where joints are \[rad or m\]; the others stay.
    pub joints: BTreeMap<String, f64>,
    /// Line and column of the pose in the text, from 1.
    pub position: (usize, usize),
}

/// When a robot has fallen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fallen {
    /// The root is lower over the ground than this \[m\].
    pub height: f64,
    /// The upward axis of the root leans more than this from the vertical \[rad\].
    pub tilt: f64,
}

/// How fast a body walks or swims.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Walk {
    /// Forward \[m/s\].
    pub speed: f64,
    /// About the vertical \[rad/s\].
    pub turn: f64,
}

impl Roles {
    /// Reads a `roles.toml`. `file` names the text in errors.
    ///
    /// # Errors
    /// Texts that are no TOML, unknown keys, values of another kind: with line and column.
    pub fn from_toml(text: &str, file: &str) -> Result<Roles, ConfigError> {
        let source = Source::new(text, file)?;
        let root = toml_reader::parse(&source)?;
        let mut fields = Fields::new(&source, "the list of roles", root, &KEYS)?;
        Ok(Roles {
            file: file.to_owned(),
            root: one(&mut fields, "root")?,
            forward: axis(&mut fields, "forward", &["x", "-x", "y", "-y"])?,
            up: axis(&mut fields, "up", &["z", "y"])?,
            head: one(&mut fields, "head")?,
            feet: several(&mut fields, "feet")?,
            palm: one(&mut fields, "palm")?,
            fingertips: several(&mut fields, "fingertips")?,
            tool: one(&mut fields, "tool")?,
            hardware: fields.text("hardware")?,
            poses: poses(&mut fields)?,
            fallen: pair(&mut fields, "fallen", ["height", "tilt"])?
                .map(|[height, tilt]| Fallen { height, tilt }),
            walk: velocity(&mut fields, "walk")?,
            swim: velocity(&mut fields, "swim")?,
        })
    }
}

fn velocity(fields: &mut Fields, key: &str) -> Outcome<Option<Walk>> {
    Ok(pair(fields, key, ["speed", "turn"])?.map(|[speed, turn]| Walk { speed, turn }))
}

/// The element of a role.
fn one(fields: &mut Fields, role: &str) -> Outcome<Option<Named>> {
    let Some(at) = fields.place(role) else { return Ok(None) };
    let name = fields.text(role)?;
    Ok(name.map(|name| Named { names: vec![name], position: fields.source.position(at) }))
}

/// An axis of the root, one of those named; the first where none is given.
fn axis(fields: &mut Fields, key: &str, names: &[&str]) -> Outcome<[f64; 3]> {
    let at = fields.place(key).unwrap_or(fields.at);
    let given = fields.text(key)?;
    let name = given.as_deref().unwrap_or(names[0]);
    if !names.contains(&name) {
        return Err(fields.wrong(at, key, &format!("is '{name}', not one of {}", names.join(", "))));
    }
    let sign = if name.starts_with('-') { -1.0 } else { 1.0 };
    Ok(["x", "y", "z"].map(|axis| if name.ends_with(axis) { sign } else { 0.0 }))
}

/// The elements of a role, at least one.
fn several(fields: &mut Fields, role: &str) -> Outcome<Option<Named>> {
    let Some(at) = fields.place(role) else { return Ok(None) };
    let items = fields.list(role)?;
    let name = |node: Node| match node.content {
        Content::Text(name) => Ok(name),
        _ => Err(fields.wrong(node.at, role, &format!("has {}, not only names", node.kind()))),
    };
    let names = items.into_iter().map(name).collect::<Outcome<Vec<_>>>()?;
    if names.is_empty() {
        return Err(fields.wrong(at, role, "is empty; leave it out, or name its sites"));
    }
    Ok(Some(Named { names, position: fields.source.position(at) }))
}

fn poses(fields: &mut Fields) -> Outcome<BTreeMap<String, NominalPose>> {
    let source = fields.source;
    let Some(node) = fields.take("poses") else { return Ok(BTreeMap::new()) };
    let kind = node.kind();
    let Content::Table(entries) = node.content else {
        return Err(fields.wrong(node.at, "poses", &format!("is {kind}, not a table of poses")));
    };
    let read = |(key, node): (super::node::Key, Node)| {
        let owner = format!("pose '{}'", key.name);
        let mut joints = Fields::any(source, &owner, node)?.numbers()?;
        let pose = NominalPose { root_z: joints.remove("root_z"), joints, position: source.position(key.at) };
        Ok((key.name, pose))
    };
    entries.into_iter().map(read).collect()
}

/// The two numbers of a table.
fn pair(fields: &mut Fields, key: &str, names: [&'static str; 2]) -> Outcome<Option<[f64; 2]>> {
    let Some(node) = fields.take(key) else { return Ok(None) };
    let mut own = Fields::new(fields.source, &format!("'{key}'"), node, &names)?;
    let mut number = |name: &str| own.number(name)?.ok_or_else(|| own.missing(name));
    Ok(Some([number(names[0])?, number(names[1])?]))
}
