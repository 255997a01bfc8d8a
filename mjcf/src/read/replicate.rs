//! `replicate`: numbered copies of a piece of the tree, and of everything that refers into it.
//!
//! Copy `i` stands in a frame turned by `i` times the Euler angles; its origin follows the previous copy's by
//! `offset` in that copy's axes. Names get the separator and the number, padded to the digits of the count.
//! An actuator, sensor, pair, exclusion, equality or tuple whose every reference leads into the piece is copied
//! with it, and so is a tendon that leads through it; what refers to nothing is not (MuJoCo 3.12 multiplies
//! clocks by accident).

use std::collections::BTreeSet;
use std::ops::Range;

use physics::math::{Vec3, quat_rotate};
use physics::model::ObjType;

use super::Reader;
use super::tree::Place;
use crate::compile::frame::resolve;
use crate::schema::Space;
use crate::schema::tree::{REPLICATE_ROWS, Replicate};
use crate::spec::{
    Actuator, Body, Equality, Exclude, Frame, Orientation, Pair, Sensor, Spec, Tendon, Tuple, Wrap, WrapKind,
};
use crate::xml::Element;

/// Elements that the copies of one model may hold together; nesting multiplies.
const MAX_COPIED: usize = 1_000_000;

/// Names declared inside the piece.
type Names = BTreeSet<(Space, String)>;

impl Reader<'_> {
    pub(super) fn replicate(&mut self, element: &Element, body: &mut Body, place: Place) {
        let class = self.class_of(element, "childclass", place.class);
        let mut wanted = Replicate::default();
        self.rows(element, &REPLICATE_ROWS, &mut wanted);
        let Ok(count) = usize::try_from(wanted.count) else {
            return self.error(element.loc, "<replicate> cannot make a negative number of copies");
        };
        let first = self.spec.frames.len();
        self.spec.frames.push(Frame { loc: element.loc, parent: place.frame, ..Frame::default() });
        let mut piece = Body::default();
        self.inside(element, &mut piece, Place { frame: Some(first), class, world: place.world });
        if let Some(inertial) = &piece.inertial {
            self.error(inertial.loc, "<replicate> cannot hold <inertial>");
        }
        let frames = first..self.spec.frames.len();
        let mut names = Names::new();
        collect(&piece, &mut names);
        self.copied = self.copied.saturating_add(elements(&piece).saturating_mul(count));
        if self.copied > MAX_COPIED {
            return self.error(element.loc, format!("<replicate> makes more than {MAX_COPIED} elements"));
        }
        let suffixes = suffixes(&wanted);
        let poses = match poses(&wanted, &self.spec) {
            Ok(poses) => poses,
            Err(message) => return self.error(element.loc, message),
        };
        for (suffix, pose) in suffixes.iter().zip(poses) {
            let shift = self.copy_frames(&frames, pose, suffix);
            add_copy(&piece, body, suffix, shift, &names);
        }
        for frame in &mut self.spec.frames[frames] {
            frame.name.clear();
        }
        copy_references(&mut self.spec, &names, &suffixes);
    }

    /// Adds the frames of one copy and returns how far their indices are from the originals'.
    fn copy_frames(&mut self, frames: &Range<usize>, (pos, euler): (Vec3, Vec3), suffix: &str) -> usize {
        let shift = self.spec.frames.len() - frames.start;
        for i in frames.clone() {
            let mut frame = self.spec.frames[i].clone();
            rename(&mut frame.name, suffix);
            match i == frames.start {
                true => (frame.pos, frame.alt) = (pos, Some(Orientation::Euler(euler))),
                false => frame.parent = frame.parent.map(|p| if p >= frames.start { p + shift } else { p }),
            }
            self.spec.frames.push(frame);
        }
        shift
    }
}

/// The number of elements in `body`, itself included.
fn elements(body: &Body) -> usize {
    let fixed =
        body.joints.len() + body.geoms.len() + body.sites.len() + body.cameras.len() + body.lights.len();
    1 + fixed + body.bodies.iter().map(elements).sum::<usize>()
}

fn suffixes(wanted: &Replicate) -> Vec<String> {
    let digits = wanted.count.to_string().len();
    (0..wanted.count).map(|i| format!("{}{i:0digits$}", wanted.sep)).collect()
}

/// Origin and Euler angles of every copy.
fn poses(wanted: &Replicate, spec: &Spec) -> Result<Vec<(Vec3, Vec3)>, String> {
    let mut origin = [0.0; 3];
    let mut poses = Vec::with_capacity(wanted.count as usize);
    for i in 0..wanted.count {
        let euler = wanted.euler.map(|angle| f64::from(i) * angle);
        poses.push((origin, euler));
        let quat = resolve([1.0, 0.0, 0.0, 0.0], Some(Orientation::Euler(euler)), &spec.compiler)?;
        let step = quat_rotate(quat, wanted.offset);
        origin = std::array::from_fn(|k| origin[k] + step[k]);
    }
    Ok(poses)
}

fn rename(name: &mut String, suffix: &str) {
    if !name.is_empty() {
        name.push_str(suffix);
    }
}

fn collect(body: &Body, names: &mut Names) {
    let mut add = |space, name: &String| {
        if !name.is_empty() {
            names.insert((space, name.clone()));
        }
    };
    body.joints.iter().for_each(|j| add(Space::Joint, &j.name));
    body.geoms.iter().for_each(|g| add(Space::Geom, &g.name));
    body.sites.iter().for_each(|s| add(Space::Site, &s.name));
    body.cameras.iter().for_each(|c| add(Space::Camera, &c.name));
    body.lights.iter().for_each(|l| add(Space::Light, &l.name));
    body.bodies.iter().for_each(|b| add(Space::Body, &b.name));
    body.bodies.iter().for_each(|b| collect(b, names));
}

/// Appends what `piece` holds to `body`, renamed, in frames `shift` further on.
fn add_copy(piece: &Body, body: &mut Body, suffix: &str, shift: usize, names: &Names) {
    let mut copy = piece.clone();
    rename_contents(&mut copy, suffix, shift, names);
    body.joints.append(&mut copy.joints);
    body.geoms.append(&mut copy.geoms);
    body.sites.append(&mut copy.sites);
    body.cameras.append(&mut copy.cameras);
    body.lights.append(&mut copy.lights);
    body.bodies.append(&mut copy.bodies);
}

fn rename_contents(body: &mut Body, suffix: &str, shift: usize, names: &Names) {
    let moved = |frame: Option<usize>| frame.map(|f| f + shift);
    let refer = |target: &mut String| {
        if names.contains(&(Space::Body, target.clone())) {
            target.push_str(suffix);
        }
    };
    for joint in &mut body.joints {
        (joint.frame, _) = (moved(joint.frame), rename(&mut joint.name, suffix));
    }
    for geom in &mut body.geoms {
        (geom.frame, _) = (moved(geom.frame), rename(&mut geom.name, suffix));
    }
    for site in &mut body.sites {
        (site.frame, _) = (moved(site.frame), rename(&mut site.name, suffix));
    }
    for camera in &mut body.cameras {
        (camera.frame, _) = (moved(camera.frame), rename(&mut camera.name, suffix));
        refer(&mut camera.targetbody);
    }
    for light in &mut body.lights {
        (light.frame, _) = (moved(light.frame), rename(&mut light.name, suffix));
        refer(&mut light.targetbody);
    }
    for child in &mut body.bodies {
        (child.frame, _) = (moved(child.frame), rename(&mut child.name, suffix));
        rename_contents(child, suffix, shift, names);
    }
}

/// An object outside the tree that may refer into it.
trait Referring: Clone {
    /// One reference into the piece is enough, and only those that lead there are renamed.
    const MIXED: bool = false;

    /// The object's own name and all its references.
    fn names(&mut self) -> (&mut String, Vec<(Space, &mut String)>);
}

fn copy_references(spec: &mut Spec, names: &Names, suffixes: &[String]) {
    copy_list(&mut spec.pairs, names, suffixes);
    copy_list(&mut spec.excludes, names, suffixes);
    // Tendons come before what may refer to them, and pass on their own copies' names.
    let tendons = copy_list(&mut spec.tendons, names, suffixes);
    let mut names = names.clone();
    names.extend(tendons.into_iter().map(|name| (Space::Tendon, name)));
    copy_list(&mut spec.equalities, &names, suffixes);
    let actuators = copy_list(&mut spec.actuators, &names, suffixes);
    names.extend(actuators.into_iter().map(|name| (Space::Actuator, name)));
    copy_list(&mut spec.sensors, &names, suffixes);
    copy_list(&mut spec.tuples, &names, suffixes);
}

/// Replaces the objects that refer into the piece by one copy for each suffix, at the end of the list;
/// returns the names of the objects replaced.
fn copy_list<T: Referring>(list: &mut Vec<T>, names: &Names, suffixes: &[String]) -> Vec<String> {
    let inside = |object: &mut T| {
        let (_, references) = object.names();
        let known =
            references.iter().filter(|(space, name)| names.contains(&(*space, (*name).clone()))).count();
        known > 0 && (T::MIXED || known == references.len())
    };
    let (originals, kept): (Vec<T>, Vec<T>) =
        std::mem::take(list).into_iter().partition(|o| inside(&mut o.clone()));
    *list = kept;
    for suffix in suffixes {
        list.extend(originals.iter().cloned().map(|mut object| {
            let (name, references) = object.names();
            rename(name, suffix);
            for (space, reference) in references {
                if names.contains(&(space, reference.clone())) {
                    reference.push_str(suffix);
                }
            }
            object
        }));
    }
    originals.into_iter().map(|mut o| std::mem::take(o.names().0)).filter(|n| !n.is_empty()).collect()
}

fn space(kind: ObjType) -> Space {
    match kind {
        ObjType::Joint => Space::Joint,
        ObjType::Geom => Space::Geom,
        ObjType::Site => Space::Site,
        ObjType::Camera => Space::Camera,
        ObjType::Light => Space::Light,
        ObjType::Tendon => Space::Tendon,
        ObjType::Actuator => Space::Actuator,
        ObjType::Sensor => Space::Sensor,
        ObjType::Mesh => Space::Mesh,
        ObjType::Body | ObjType::Xbody => Space::Body,
        // Other kinds are not copied; their names are in no piece.
        _ => Space::Class,
    }
}

fn given(list: Vec<(Space, &mut String)>) -> Vec<(Space, &mut String)> {
    list.into_iter().filter(|(_, name)| !name.is_empty()).collect()
}

impl Referring for Pair {
    fn names(&mut self) -> (&mut String, Vec<(Space, &mut String)>) {
        (&mut self.name, vec![(Space::Geom, &mut self.geomname1), (Space::Geom, &mut self.geomname2)])
    }
}

impl Referring for Exclude {
    fn names(&mut self) -> (&mut String, Vec<(Space, &mut String)>) {
        (&mut self.name, vec![(Space::Body, &mut self.bodyname1), (Space::Body, &mut self.bodyname2)])
    }
}

impl Referring for Equality {
    fn names(&mut self) -> (&mut String, Vec<(Space, &mut String)>) {
        let kind = space(self.objtype);
        (&mut self.name, given(vec![(kind, &mut self.name1), (kind, &mut self.name2)]))
    }
}

impl Referring for Tendon {
    const MIXED: bool = true;

    fn names(&mut self) -> (&mut String, Vec<(Space, &mut String)>) {
        (&mut self.name, given(self.path.iter_mut().flat_map(wrap_names).collect()))
    }
}

fn wrap_names(wrap: &mut Wrap) -> Vec<(Space, &mut String)> {
    match &mut wrap.kind {
        WrapKind::Site { site } => vec![(Space::Site, site)],
        WrapKind::Geom { geom, sidesite } => vec![(Space::Geom, geom), (Space::Site, sidesite)],
        WrapKind::Joint { joint, .. } => vec![(Space::Joint, joint)],
        WrapKind::Pulley { .. } => vec![],
    }
}

impl Referring for Actuator {
    fn names(&mut self) -> (&mut String, Vec<(Space, &mut String)>) {
        use physics::model::TrnType;
        let target = match self.trntype {
            TrnType::Joint | TrnType::Jointinparent => Space::Joint,
            TrnType::Tendon => Space::Tendon,
            TrnType::Body => Space::Body,
            // A slider-crank names its crank's site.
            _ => Space::Site,
        };
        let sites = [(Space::Site, &mut self.refsite), (Space::Site, &mut self.slidersite)];
        (&mut self.name, given([(target, &mut self.target)].into_iter().chain(sites).collect()))
    }
}

impl Referring for Sensor {
    fn names(&mut self) -> (&mut String, Vec<(Space, &mut String)>) {
        let (object, reference) = (space(self.objtype), space(self.reftype));
        (&mut self.name, given(vec![(object, &mut self.objname), (reference, &mut self.refname)]))
    }
}

impl Referring for Tuple {
    fn names(&mut self) -> (&mut String, Vec<(Space, &mut String)>) {
        (&mut self.name, self.entries.iter_mut().map(|e| (space(e.objtype), &mut e.objname)).collect())
    }
}
