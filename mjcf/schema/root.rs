//! `mujoco` and `default`: where the tables meet.

use super::actuator::ACTUATOR;
use super::asset::{ASSET, MATERIAL, MESH, SKIN};
use super::constraint::{CONTACT, DEFAULT_EQUALITY, DEFAULT_TENDON, EQUALITY, PAIR, TENDON};
use super::flex::FLEX;
use super::option::OPTION;
use super::plugin::EXTENSION;
use super::sensor::SENSOR;
use super::settings::{COMPILER, CUSTOM, KEYFRAME, SIZE, STATISTIC};
use super::tree::{CAMERA, GEOM, JOINT, LIGHT, SITE, WORLDBODY};
use super::visual::VISUAL;
use super::{Bind, Child, ElementType, Kind, Row, Space, actuator, any, class, leaf, required, row, section};

/// The whole format.
pub static MUJOCO: ElementType = leaf("mujoco", "A model", &[&MODEL_NAME]).children(&[
    any(&COMPILER),
    any(&OPTION),
    any(&SIZE),
    any(&STATISTIC),
    any(&VISUAL),
    any(&TOP_DEFAULT),
    any(&EXTENSION),
    any(&ASSET),
    any(&WORLDBODY),
    any(&DEFORMABLE),
    any(&CONTACT),
    any(&TENDON),
    any(&EQUALITY),
    any(&ACTUATOR),
    any(&SENSOR),
    any(&CUSTOM),
    any(&KEYFRAME),
]);
static MODEL_NAME: [Row<()>; 1] = [row("model", Bind::Own(Kind::Text), "name of the model")];
static DEFORMABLE: ElementType = section("deformable", "Deformable bodies", &[any(&FLEX), any(&SKIN)]);

static TOP_DEFAULT: ElementType =
    leaf("default", "Defaults of all elements", &[&TOP_CLASS]).children(&DEFAULT_CHILDREN);
static DEFAULT: ElementType =
    leaf("default", "A class of defaults, inheriting from the enclosing one", &[&CLASS_NAME])
        .children(&DEFAULT_CHILDREN);
static TOP_CLASS: [Row<()>; 1] = [row("class", Bind::Own(Kind::Text), "'main', whatever is written")];
static CLASS_NAME: [Row<()>; 1] =
    [required("class", Bind::Own(Kind::Name(Space::Class)), "name of the class")];

static DEFAULT_CHILDREN: [Child; 23] = {
    let [
        general,
        motor,
        position,
        velocity,
        intvelocity,
        damper,
        cylinder,
        muscle,
        adhesion,
        so3,
        pid,
        dcmotor,
    ] = actuator::DEFAULTS;
    [
        any(&DEFAULT),
        class(&MESH),
        class(&MATERIAL),
        class(&JOINT),
        class(&GEOM),
        class(&SITE),
        class(&CAMERA),
        class(&LIGHT),
        class(&PAIR),
        class(&DEFAULT_EQUALITY),
        class(&DEFAULT_TENDON),
        general,
        motor,
        position,
        velocity,
        intvelocity,
        damper,
        cylinder,
        muscle,
        adhesion,
        so3,
        pid,
        dcmotor,
    ]
};
