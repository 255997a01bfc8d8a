//! `composite`: a cable, a chain of bodies along a curve (XML reference, `body/composite`).
//!
//! Vertices are kept in single precision. A body reaches from one vertex to the next, its x axis along it; its frame turns
//! with the curve and as little as possible about it. Default classes do not apply, as they do not in MuJoCo.

use physics::math::{cross, dot, ops, quat_conj, quat_from_axis_angle, quat_rotate};
use physics::model::{GeomType, JointType};
use std::f64::consts::PI;

use super::cable_skin::{cable_skin, vertex_count};
use super::reader::Reader;
use super::tree::Place;
use crate::schema::composite::{
    CABLE, COMPOSITE_ROWS, Composite, CompositeSkin, GEOM_ROWS, JOINT_ROWS, JOINT_UNUSED, SITE_ROWS,
    SKIN_ROWS, TYPES,
};
use crate::spec::{Body, Exclude, Geom, Joint, PluginUse, Site, Text, from_axes};
use crate::vector::{compose, normalize};
use crate::xml::Element;

/// The only plugin that composites know.
const PLUGIN: &str = "mujoco.elasticity.cable";

/// Bytes of a vertex of a skin: its place, texture coordinates, two triangles, and sixteen weights.
const VERTEX: usize = 12 + 8 + 24 + 16 * 8;

/// What to take instead of a type that MuJoCo has dropped.
const INSTEAD: [(&str, &str); 5] = [
    ("particle", "<replicate>"),
    ("grid", "<flexcomp>"),
    ("rope", "type=\"cable\""),
    ("loop", "<flexcomp>"),
    ("cloth", "<flexcomp>"),
];

/// What each part of a cable starts from.
struct Parts {
    joint: Joint,
    geom: Geom,
    site: Site,
    skin: CompositeSkin,
    plugin: Option<PluginUse>,
}

/// Where a body stands: length, and orientation in the frame of the curve.
struct Segment {
    length: f64,
    quat: [f64; 4],
}

impl Reader<'_> {
    pub(super) fn composite(&mut self, element: &Element, place: Place) {
        let errors = self.expansion.diagnostics.list.len();
        let mut wanted = Composite::default();
        self.rows(element, &COMPOSITE_ROWS, &mut wanted);
        if let Some(count) = element.attribute("count") {
            for (to, n) in wanted.count.iter_mut().zip(self.between(element, count, 1, 3).unwrap_or_default())
            {
                *to = n;
            }
        }
        if wanted.kind != CABLE {
            let name = TYPES.iter().find(|(_, code)| *code == wanted.kind).map_or("", |(name, _)| name);
            let instead = INSTEAD.iter().find(|(old, _)| *old == name).map_or("", |(_, new)| new);
            let message = format!("composite type '{name}' has been dropped from the format");
            return self.error_with(element.loc, message, Some(format!("use {instead}")));
        }
        let parts = self.composite_parts(element, &wanted);
        let made = count(&mut wanted).and_then(|count| {
            self.count_copies(count.saturating_mul(4))?;
            let vertices = vertices(&wanted)?;
            if parts.geom.kind == GeomType::Box {
                self.count_skin(&parts.skin, vertices.len())?;
            }
            Ok(vertices)
        });
        match made {
            Err(message) => self.error(element.loc, message),
            Ok(_)
                if self.expansion.diagnostics.list.len() > errors
                    && self.expansion.diagnostics.has_errors() => {}
            Ok(vertices) => self.cable(element, place, &wanted, &vertices, &parts),
        }
    }

    /// Adds to the elements that were made of others.
    fn count_copies(&mut self, elements: usize) -> Result<(), String> {
        self.copied = self.copied.saturating_add(elements);
        let most = self.expansion.limits.copies;
        if self.copied > most {
            return Err(format!("<composite> makes more than {most} elements"));
        }
        let bytes = elements.saturating_mul(crate::budget::ELEMENT);
        let taken = self.expansion.budget.take("parts of <composite>", bytes);
        taken.map_err(|e| format!("{e}; {}", crate::budget::ADVICE))
    }

    /// Adds what the skin of a cable takes, and refuses cables too short for one.
    fn count_skin(&mut self, skin: &CompositeSkin, vertices: usize) -> Result<(), String> {
        if vertices < 4 {
            return Err(
                "a cable of boxes has four vertices or more, for its skin: add some, or take capsules".into(),
            );
        }
        let bytes = vertex_count(skin, vertices - 1).and_then(|n| n.checked_mul(VERTEX));
        let taken = self.expansion.budget.take("the skin of <composite>", bytes.unwrap_or(usize::MAX));
        taken.map_err(|e| format!("{e}; {}", crate::budget::ADVICE))
    }

    fn composite_parts(&mut self, element: &Element, wanted: &Composite) -> Parts {
        let loc = element.loc;
        let mut joint = Joint { loc, group: 3, ..Joint::default() };
        let mut joints = element.children_named("joint");
        if let Some(child) = joints.next() {
            self.rows(child, &JOINT_ROWS, &mut joint);
            for row in JOINT_UNUSED.iter().filter(|row| row.name != "kind") {
                if let Some(unused) = child.attribute(row.name) {
                    self.warning(
                        unused.loc,
                        format!("attribute '{}' is ignored here: {}", row.name, row.doc),
                    );
                }
            }
        }
        if let Some(second) = joints.next() {
            self.error(second.loc, "a cable has one kind of joint: remove this <joint>");
        }
        let mut geom = Geom { loc, ..Geom::default() };
        let mut site = Site { loc, group: 3, ..Site::default() };
        let mut skin = CompositeSkin::default();
        for child in &element.children {
            match child.name.as_str() {
                "geom" => self.rows(child, &GEOM_ROWS, &mut geom),
                "site" => self.rows(child, &SITE_ROWS, &mut site),
                "skin" => self.rows(child, &SKIN_ROWS, &mut skin),
                _ => {}
            }
        }
        match geom.kind {
            GeomType::Capsule | GeomType::Cylinder | GeomType::Box => {}
            _ => self.error(loc, "a cable is made of capsules, cylinders or boxes: set 'type' of its <geom>"),
        }
        if !(0..6).contains(&skin.group) {
            self.error(loc, "attribute 'group' of <skin> must be between 0 and 5");
        }
        let plugin = self.child_plugin(element).map(|used| self.composite_plugin(used, &wanted.prefix));
        Parts { joint, geom, site, skin, plugin }
    }

    /// A plugin with an instance, which all bodies share.
    fn composite_plugin(&mut self, used: PluginUse, prefix: &str) -> PluginUse {
        if used.plugin != PLUGIN {
            self.error(
                used.loc,
                format!("<composite> takes no plugin but {PLUGIN}: set plugin=\"{PLUGIN}\""),
            );
        }
        self.shared_plugin(used, format!("composite{prefix}"))
    }

    /// Adds the bodies of a cable, and what belongs to it elsewhere.
    fn cable(
        &mut self,
        element: &Element,
        place: Place,
        wanted: &Composite,
        vertices: &[[f32; 3]],
        parts: &Parts,
    ) {
        let (loc, prefix) = (element.loc, &wanted.prefix);
        let (name, data) = (format!("composite_{prefix}"), format!("rope_{prefix}"));
        self.spec.texts.push(Text { name, loc, data });
        let segments = segments(vertices);
        let last = segments.len() - 1;
        for ix in 0..last {
            let bodyname = |ix| label(prefix, 'B', ix, last);
            let (bodyname1, bodyname2) = (bodyname(ix), bodyname(ix + 1));
            self.spec.excludes.push(Exclude { loc, bodyname1, bodyname2, ..Exclude::default() });
        }
        // From the end on, each body takes the one behind it.
        let mut chain: Option<Body> = None;
        for ix in (0..=last).rev() {
            let mut body = segment_body(ix, last, &segments, wanted, parts);
            body.loc = loc;
            if ix == 0 {
                let start = vertices[0].map(f64::from);
                body.pos = std::array::from_fn(|k| wanted.offset[k] + start[k]);
                body.frame = place.frame;
            } else {
                body.pos = [shortened(&vertices[ix - 1..=ix]), 0.0, 0.0];
            }
            body.bodies.extend(chain.take());
            chain = Some(body);
        }
        self.body_here().bodies.extend(chain);
        if parts.geom.kind == GeomType::Box {
            let bodies: Vec<String> = (0..=last).map(|ix| label(prefix, 'B', ix, last)).collect();
            let mut skin = cable_skin(&parts.skin, format!("{prefix}Skin"), parts.geom.size, &bodies);
            skin.loc = loc;
            skin.bones.iter_mut().for_each(|bone| bone.loc = loc);
            self.spec.skins.push(skin);
        }
    }
}

/// The name of part `ix` of a kind; parts are numbered up to `last`.
fn label(prefix: &str, kind: char, ix: usize, last: usize) -> String {
    match ix {
        0 => format!("{prefix}{kind}_first"),
        _ if ix == last => format!("{prefix}{kind}_last"),
        _ => format!("{prefix}{kind}_{ix}"),
    }
}

/// Body `ix`, with all but its position.
fn segment_body(ix: usize, last: usize, segments: &[Segment], wanted: &Composite, parts: &Parts) -> Body {
    let prefix = &wanted.prefix;
    let Segment { length, quat } = segments[ix];
    let before = if ix == 0 { quat } else { segments[ix - 1].quat };
    let mut body = Body {
        name: label(prefix, 'B', ix, last),
        quat: if ix == 0 { quat } else { compose(quat_conj(before), quat) },
        plugin: parts.plugin.clone(),
        ..Body::default()
    };
    let mut geom = Geom { name: format!("{prefix}G{ix}"), ..parts.geom.clone() };
    if geom.kind == GeomType::Box {
        (geom.pos, geom.size[0]) = ([length / 2.0, 0.0, 0.0], length / 2.0);
    } else {
        geom.fromto = Some([0.0, 0.0, 0.0, length, 0.0, 0.0]);
    }
    body.geoms.push(geom);
    if ix > 0 || wanted.initial != "none" {
        let mut joint =
            Joint { name: label(prefix, 'J', ix, last), kind: JointType::Ball, ..parts.joint.clone() };
        if ix == 0 && wanted.initial == "free" {
            joint.kind = JointType::Free;
            (joint.damping, joint.armature, joint.frictionloss) = ([0.0; 3], 0.0, 0.0);
        }
        body.joints.push(joint);
    }
    if ix == 0 || ix == last {
        let at = if ix == last { length } else { 0.0 };
        let name = label(prefix, 'S', ix, last);
        body.sites.push(Site { name, pos: [at, 0.0, 0.0], ..parts.site.clone() });
    }
    body
}

/// How many vertices a cable has, which is checked before they are made.
fn count(wanted: &mut Composite) -> Result<usize, String> {
    if wanted.count.iter().any(|n| *n < 1) {
        return Err("attribute 'count' of <composite>: set each number to 1 or more".into());
    }
    let given = !wanted.vertex.is_empty();
    if given && wanted.count[0] > 1 {
        return Err("<composite> takes either 'vertex' or 'count'".into());
    }
    if given && !wanted.vertex.len().is_multiple_of(3) {
        return Err(format!("attribute 'vertex' has {} numbers: write three a vertex", wanted.vertex.len()));
    }
    if given {
        wanted.count[0] = i32::try_from(wanted.vertex.len() / 3).unwrap_or(i32::MAX);
    }
    if !given && dot(wanted.size, wanted.size) < physics::model::bounds::MINVAL {
        return Err("attribute 'size' of <composite> is zero: its first number is the length".into());
    }
    match wanted.count {
        [count @ (2 | 4..), 1, 1] => Ok(count as usize),
        [3, 1, 1] => {
            Err("a cable of three vertices cannot be made, in MuJoCo neither: take two, or more".into())
        }
        _ => Err("a cable has one dimension: write its number of vertices as count=\"N 1 1\"".into()),
    }
}

/// The vertices of a cable, given or along its curve.
fn vertices(wanted: &Composite) -> Result<Vec<[f32; 3]>, String> {
    let curve = curve(&wanted.curve)?;
    if !wanted.vertex.is_empty() {
        return Ok(wanted.vertex.as_chunks().0.to_vec());
    }
    let steps = f64::from(wanted.count[0] - 1);
    let point = |ix: i32| {
        let [length, radius, turns] = wanted.size;
        let angle = || PI * f64::from(ix) * turns / steps;
        let on_curve = curve.map(|function| match function {
            Function::Zero => 0.0,
            Function::Line => f64::from(ix) * length / steps,
            Function::Cosine => radius * ops::cos(angle()),
            Function::Sine => radius * ops::sin(angle()),
        });
        quat_rotate(wanted.quat, on_curve).map(|x| x as f32)
    };
    Ok((0..wanted.count[0]).map(point).collect())
}

/// A coordinate as a function of the arc.
#[derive(Clone, Copy)]
enum Function {
    Zero,
    Line,
    Cosine,
    Sine,
}

fn curve(text: &str) -> Result<[Function; 3], String> {
    let mut curve = [Function::Zero; 3];
    for (k, word) in text.split_ascii_whitespace().enumerate() {
        let slot = curve.get_mut(k).ok_or("attribute 'curve' has more than three functions: remove some")?;
        *slot = match word {
            "s" => Function::Line,
            "cos(s)" => Function::Cosine,
            "sin(s)" => Function::Sine,
            "0" => Function::Zero,
            other => return Err(format!("attribute 'curve': '{other}' is none of s, cos(s), sin(s) and 0")),
        };
    }
    Ok(curve)
}

/// From one vertex to the next.
fn edge(pair: &[[f32; 3]]) -> [f64; 3] {
    std::array::from_fn(|k| f64::from(pair[1][k] - pair[0][k]))
}

/// Distance of two vertices, 0 for one that defines no direction.
fn shortened(pair: &[[f32; 3]]) -> f64 {
    normalize(&mut edge(pair))
}

/// Lengths and orientations along the curve: the normal is carried from vertex to vertex by the rotation of the tangent.
fn segments(vertices: &[[f32; 3]]) -> Vec<Segment> {
    let mut normal = [0.0, 1.0, 0.0];
    let unit = |pair: &[[f32; 3]]| {
        let mut direction = edge(pair);
        normalize(&mut direction);
        direction
    };
    let mut out = Vec::with_capacity(vertices.len() - 1);
    for (ix, pair) in vertices.windows(2).enumerate() {
        let tangent = unit(pair);
        let mut binormal;
        if ix == 0 {
            let next = vertices.get(1..3).map_or([0.0; 3], unit);
            binormal = cross(tangent, next);
            normalize(&mut binormal);
            normal = cross(binormal, tangent);
            normalize(&mut normal);
        } else {
            let before = unit(&vertices[ix - 1..=ix]);
            let mut axis = cross(before, tangent);
            let angle = ops::atan2(normalize(&mut axis), dot(before, tangent));
            normal = quat_rotate(quat_from_axis_angle(axis, angle), normal);
            normalize(&mut normal);
            binormal = cross(tangent, normal);
            normalize(&mut binormal);
        }
        let e = edge(pair);
        out.push(Segment { length: dot(e, e).sqrt(), quat: from_axes(tangent, normal, binormal) });
    }
    out
}
