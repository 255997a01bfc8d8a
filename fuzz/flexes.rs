//! Flexes: models with deformable bodies, from a text or made up from bytes, loaded, written, loaded again and stepped.

use super::bytes::Bytes;
use super::models::{come_back, steps};
use mjcf::files::Memory;
use std::collections::BTreeMap;
use std::fmt::Write;

/// Most vertices and degrees of freedom of a flex that is stepped: steps of larger ones take too long for an input.
const MOST: usize = 150;

/// A first byte that is even: the text of a model and the files it may name, a zero byte between two. One that is odd: a
/// scene with a `flexcomp` whose attributes the other bytes choose.
pub fn flex(data: &[u8]) {
    let [choice, rest @ ..] = data else { return };
    let mut files = Memory::default();
    if choice & 1 == 0 {
        let names = ["model.xml", "f.msh", "m.obj"];
        names.iter().zip(rest.split(|&byte| byte == 0)).for_each(|(name, text)| files.insert(name, text));
    } else {
        files.insert("model.xml", made_up(*choice, &mut Bytes(rest)).as_bytes());
    }
    if let Some(model) = come_back(files, "model.xml")
        && model.nflexvert.max(model.nv).max(model.nflexelem / 4) <= MOST
    {
        steps(model);
    }
}

/// What a value is.
enum Kind {
    /// Whole numbers from -1 to 6.
    Counts(usize),
    Numbers(usize),
    Words(&'static [&'static str]),
}
use Kind::*;

const TRUTH: Kind = Words(&["true", "false"]);

/// Elements within the scene, their attributes and what these may be.
const CHOICES: [(&str, &str, Kind); 47] = [
    (
        "flexcomp",
        "type",
        Words(&["grid", "box", "cylinder", "ellipsoid", "square", "disc", "circle", "direct"]),
    ),
    ("flexcomp", "dim", Counts(1)),
    ("flexcomp", "dof", Words(&["full", "radial", "trilinear", "quadratic", "2d"])),
    ("flexcomp", "count", Counts(3)),
    ("flexcomp", "cellcount", Counts(3)),
    ("flexcomp", "spacing", Numbers(3)),
    ("flexcomp", "radius", Numbers(1)),
    ("flexcomp", "rigid", TRUTH),
    ("flexcomp", "mass", Numbers(1)),
    ("flexcomp", "inertiabox", Numbers(1)),
    ("flexcomp", "scale", Numbers(3)),
    ("flexcomp", "point", Numbers(12)),
    ("flexcomp", "element", Counts(4)),
    ("flexcomp", "texcoord", Numbers(8)),
    ("flexcomp", "pos", Numbers(3)),
    ("flexcomp", "quat", Numbers(4)),
    ("flexcomp", "origin", Numbers(3)),
    ("elasticity", "young", Numbers(1)),
    ("elasticity", "poisson", Numbers(1)),
    ("elasticity", "damping", Numbers(1)),
    ("elasticity", "thickness", Numbers(1)),
    ("elasticity", "elastic2d", Words(&["none", "bend", "stretch", "both"])),
    ("edge", "stiffness", Numbers(1)),
    ("edge", "damping", Numbers(1)),
    ("edge", "equality", Words(&["true", "false", "vert", "strain"])),
    ("edge", "solref", Numbers(2)),
    ("edge", "solimp", Numbers(3)),
    ("contact", "selfcollide", Words(&["none", "narrow", "bvh", "sap", "auto"])),
    ("contact", "internal", TRUTH),
    ("contact", "passive", TRUTH),
    ("contact", "activelayers", Counts(1)),
    ("contact", "condim", Counts(1)),
    ("contact", "contype", Counts(1)),
    ("contact", "friction", Numbers(3)),
    ("contact", "margin", Numbers(1)),
    ("contact", "gap", Numbers(1)),
    ("contact", "solref", Numbers(2)),
    ("pin", "id", Counts(1)),
    ("pin", "gridrange", Counts(6)),
    ("option", "integrator", Words(&["Euler", "implicit", "implicitfast", "RK4"])),
    ("option", "solver", Words(&["Newton", "CG", "PGS"])),
    ("option", "cone", Words(&["pyramidal", "elliptic"])),
    ("option", "jacobian", Words(&["dense", "sparse"])),
    ("option", "timestep", Numbers(1)),
    ("option", "wind", Numbers(3)),
    ("flag", "island", Words(&["enable", "disable"])),
    ("joint", "type", Words(&["free", "ball", "slide", "hinge"])),
];

/// A scene with a `flexcomp` above a floor and beside a ball; bits of `choice` say whether it hangs on a body that moves.
fn made_up(choice: u8, bytes: &mut Bytes<'_>) -> String {
    // Ten points along each axis, the default, take long.
    let mut chosen = BTreeMap::from([(("flexcomp", "count"), "3 3 1".to_owned())]);
    while !bytes.is_empty() && chosen.len() < 24 {
        let (element, attribute, kind) = bytes.one_of(&CHOICES);
        let value = match *kind {
            Counts(count) => joined((0..count).map(|_| i32::from(bytes.next() % 8) - 1)),
            Numbers(count) => joined((0..count).map(|_| bytes.number())),
            Words(words) => (*bytes.one_of(words)).to_owned(),
        };
        chosen.insert((element, attribute), value);
    }
    let written = |element: &str| {
        let own = chosen.iter().filter(|((of, _), _)| *of == element);
        let attributes = own.fold(String::new(), |mut text, ((_, name), value)| {
            let _ = write!(text, " {name}='{value}'");
            text
        });
        if attributes.is_empty() { attributes } else { format!("<{element}{attributes}/>") }
    };
    let parts: String = ["elasticity", "edge", "contact", "pin"].map(written).concat();
    let flexcomp = written("flexcomp");
    let attributes = flexcomp.strip_prefix("<flexcomp").and_then(|text| text.strip_suffix("/>"));
    let joint = if choice & 2 == 0 { String::new() } else { written("joint") };
    let option = format!("<option>{}</option>", written("flag"));
    format!(
        "<mujoco>{}{option}<worldbody><geom type='plane' size='2 2 .1' pos='0 0 -1'/>\
         <body pos='.5 0 .4'><freejoint/><geom size='.3'/></body>\
         <body name='b'>{joint}<geom size='.2' contype='0' conaffinity='0'/>\
         <flexcomp name='f'{}>{parts}</flexcomp></body></worldbody></mujoco>",
        written("option"),
        attributes.unwrap_or_default()
    )
}

fn joined(values: impl Iterator<Item = impl ToString>) -> String {
    values.map(|value| value.to_string()).collect::<Vec<_>>().join(" ")
}
