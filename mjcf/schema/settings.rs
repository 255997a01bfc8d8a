//! `compiler`, `size`, `statistic`, `custom` and `keyframe`.

use physics::model::LengthRangeMode;

use super::Bind::*;
use super::words::FALSE_TRUE_AUTO;
use super::{ElementType, Kind, Row, Rule, Space, Words, any, leaf, once, required, row, section};
use crate::spec::{
    Compiler, Conflict, InertiaFromGeom, Key, LengthRangeOptions, Numeric, Size, StatisticOverride,
    Text as CustomText, Tuple, TupleEntry,
};

/// `compiler`.
pub static COMPILER: ElementType =
    leaf("compiler", "How the text becomes a model", &[&COMPILER_ROWS]).children(&[once(&LENGTHRANGE)]);
static LENGTHRANGE: ElementType =
    leaf("lengthrange", "How actuator length ranges are found", &[&LENGTHRANGE_ROWS]);
/// `size`.
pub static SIZE: ElementType = leaf("size", "Sizes of arrays", &[&SIZE_ROWS])
    .rules(&[Rule::Exclusive(&[&["memory"], &["nstack"]]), Rule::Exclusive(&[&["memory"], &["njmax"]])]);
/// `statistic`.
pub static STATISTIC: ElementType =
    leaf("statistic", "Statistics that replace the computed ones", &[&STATISTIC_ROWS]);
/// `custom`.
pub static CUSTOM: ElementType =
    section("custom", "Data of the user", &[any(&NUMERIC), any(&TEXT), any(&TUPLE)]);
static NUMERIC: ElementType = leaf("numeric", "Numbers", &[&NUMERIC_ROWS]);
static TEXT: ElementType = leaf("text", "Text", &[&TEXT_ROWS]);
static TUPLE: ElementType = leaf("tuple", "References", &[&TUPLE_ROWS]).children(&[any(&ENTRY)]);
static ENTRY: ElementType = leaf("element", "One reference", &[&ENTRY_ROWS]);
/// `keyframe`.
pub static KEYFRAME: ElementType = section("keyframe", "States to reset to", &[any(&KEY)]);
static KEY: ElementType = leaf("key", "One state", &[&KEY_ROWS]);

const ANGLES: Words = &[("radian", 0), ("degree", 1)];
const COORDINATES: Words = &[("local", 0), ("global", 1)];
const CONFLICTS: Words = &[("warning", 0), ("merge", 1), ("error", 2)];
const LENGTHRANGE_MODES: Words = &[("none", 0), ("muscle", 1), ("muscleuser", 2), ("all", 3)];

/// Attributes of `compiler`; `assetdir` comes before the directories that override it.
pub static COMPILER_ROWS: [Row<Compiler>; 21] = [
    row("autolimits", Bool(|c| &mut c.autolimits), "a range implies a limit"),
    row("boundmass", Real(|c| &mut c.boundmass), "least mass of a moving body, kg"),
    row("boundinertia", Real(|c| &mut c.boundinertia), "least moment of inertia of a moving body, kg m²"),
    row("settotalmass", Real(|c| &mut c.settotalmass), "total mass to scale to, kg"),
    row("balanceinertia", Bool(|c| &mut c.balanceinertia), "repair impossible moments of inertia"),
    row("strippath", Bool(|c| &mut c.strippath), "ignore directories in file names"),
    row("coordinate", Own(Kind::Keyword(COORDINATES)), "only local is supported"),
    row("angle", Keyword { words: ANGLES, assign: |c, code| c.degree = code == 1 }, "unit of angles"),
    row("fitaabb", Bool(|c| &mut c.fitaabb), "fit shapes to boxes instead of inertias"),
    row("eulerseq", Own(Kind::Text), "axes of Euler angles; capitals are fixed axes"),
    row("assetdir", Own(Kind::Text), "directory of meshes and textures"),
    row("meshdir", Text(|c| &mut c.meshdir), "directory of meshes and height fields"),
    row("texturedir", Text(|c| &mut c.texturedir), "directory of textures"),
    row("discardvisual", Bool(|c| &mut c.discardvisual), "drop geoms without contact and mass"),
    row("usethread", Bool(|c| &mut c.usethread), "accepted and without effect"),
    row("fusestatic", Bool(|c| &mut c.fusestatic), "merge bodies without joints into their parents"),
    row(
        "inertiafromgeom",
        Keyword {
            words: FALSE_TRUE_AUTO,
            assign: |c, code| {
                use InertiaFromGeom::*;
                c.inertiafromgeom = [False, True, Auto][code as usize];
            },
        },
        "masses come from geoms",
    ),
    row("inertiagrouprange", Ints(|c| &mut c.inertiagrouprange), "groups of geoms that have mass"),
    row("saveinertial", Bool(|c| &mut c.saveinertial), "write inertias when saving"),
    row("alignfree", Bool(|c| &mut c.alignfree), "frames of free bodies move to their inertial frames"),
    row(
        "conflict",
        Keyword {
            words: CONFLICTS,
            assign: |c, code| {
                c.conflict = [Conflict::Warning, Conflict::Merge, Conflict::Error][code as usize]
            },
        },
        "what becomes of settings that differ from an attached model's",
    ),
];

/// Attributes of `compiler/lengthrange`.
pub static LENGTHRANGE_ROWS: [Row<LengthRangeOptions>; 10] = [
    row(
        "mode",
        Keyword {
            words: LENGTHRANGE_MODES,
            assign: |l, c| l.mode = LengthRangeMode::from_code(c).unwrap_or(l.mode),
        },
        "actuators concerned",
    ),
    row("useexisting", Bool(|l| &mut l.useexisting), "keep ranges that are given"),
    row("uselimit", Bool(|l| &mut l.uselimit), "take ranges of limited joints and tendons"),
    row("accel", Real(|l| &mut l.accel), "acceleration that moves to the ends"),
    row("maxforce", Real(|l| &mut l.maxforce), "largest force, 0 for any"),
    row("timeconst", Real(|l| &mut l.timeconst), "time constant of damping, seconds"),
    row("timestep", Real(|l| &mut l.timestep), "time step, seconds"),
    row("inttotal", Real(|l| &mut l.inttotal), "simulated time, seconds"),
    row("interval", Real(|l| &mut l.interval), "time measured at the end, seconds"),
    row("tolrange", Real(|l| &mut l.tolrange), "tolerance, as a share of the range"),
];

/// Attributes of `size`.
pub static SIZE_ROWS: [Row<Size>; 14] = [
    row("memory", Own(Kind::Text), "bytes of arena, with suffix K, M, G, T, P or E"),
    row("njmax", Int(|s| s.njmax.get_or_insert(-1)), "older limit on constraints"),
    row("nconmax", Int(|s| s.nconmax.get_or_insert(-1)), "older limit on contacts"),
    row("nstack", Own(Kind::Int { min: 1, max: Some(1) }), "older size of the stack"),
    row("nuserdata", Int(|s| &mut s.nuserdata), "user numbers of the state"),
    row("nkey", Int(|s| &mut s.nkey), "keyframes"),
    row("nuser_body", Int(|s| s.nuser_body.get_or_insert(-1)), "user numbers of a body"),
    row("nuser_jnt", Int(|s| s.nuser_jnt.get_or_insert(-1)), "user numbers of a joint"),
    row("nuser_geom", Int(|s| s.nuser_geom.get_or_insert(-1)), "user numbers of a geom"),
    row("nuser_site", Int(|s| s.nuser_site.get_or_insert(-1)), "user numbers of a site"),
    row("nuser_cam", Int(|s| s.nuser_cam.get_or_insert(-1)), "user numbers of a camera"),
    row("nuser_tendon", Int(|s| s.nuser_tendon.get_or_insert(-1)), "user numbers of a tendon"),
    row("nuser_actuator", Int(|s| s.nuser_actuator.get_or_insert(-1)), "user numbers of an actuator"),
    row("nuser_sensor", Int(|s| s.nuser_sensor.get_or_insert(-1)), "user numbers of a sensor"),
];

/// Attributes of `statistic`.
pub static STATISTIC_ROWS: [Row<StatisticOverride>; 5] = [
    row("meaninertia", Real(|s| s.meaninertia.get_or_insert(0.0)), "mean diagonal of the inertia matrix"),
    row("meanmass", Real(|s| s.meanmass.get_or_insert(0.0)), "mean mass of bodies, kg"),
    row("meansize", Real(|s| s.meansize.get_or_insert(0.0)), "mean size of bodies, metres"),
    row("extent", Real(|s| s.extent.get_or_insert(0.0)), "half size of the model, metres"),
    row(
        "center",
        Reals { min: 3, field: |s| s.center.get_or_insert([0.0; 3]) },
        "centre of the model, metres",
    ),
];

/// Attributes of `numeric`.
pub static NUMERIC_ROWS: [Row<Numeric>; 3] = [
    required("name", Name(Space::Numeric, |n| &mut n.name), "name"),
    row("size", Own(Kind::Int { min: 1, max: Some(1) }), "numbers, zeros filled in"),
    row("data", RealList(|n| &mut n.data), "numbers"),
];
/// Attributes of `text`.
pub static TEXT_ROWS: [Row<CustomText>; 2] = [
    required("name", Name(Space::Text, |t| &mut t.name), "name"),
    required("data", Text(|t| &mut t.data), "text"),
];
/// Attributes of `tuple`.
pub static TUPLE_ROWS: [Row<Tuple>; 1] = [required("name", Name(Space::Tuple, |t| &mut t.name), "name")];
/// Attributes of `tuple/element`.
pub static ENTRY_ROWS: [Row<TupleEntry>; 3] = [
    required("objtype", Own(Kind::Text), "kind of the object"),
    required("objname", ObjRef("objtype", |e| &mut e.objname), "object"),
    row("prm", Real(|e| &mut e.prm), "number kept beside it"),
];

/// Attributes of `key`.
pub static KEY_ROWS: [Row<Key>; 8] = [
    row("name", Name(Space::Key, |k| &mut k.name), "name"),
    row("time", Real(|k| &mut k.time), "time, seconds"),
    row("qpos", RealList(|k| &mut k.qpos), "positions"),
    row("qvel", RealList(|k| &mut k.qvel), "velocities"),
    row("act", RealList(|k| &mut k.act), "activations"),
    row("mpos", RealList(|k| &mut k.mpos), "positions of mocap bodies, metres"),
    row("mquat", RealList(|k| &mut k.mquat), "orientations of mocap bodies"),
    row("ctrl", RealList(|k| &mut k.ctrl), "controls"),
];
