//! Meshes of the kitchen.

mod kettle;
mod shapes;

use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] = &[
    ("bowls", kettle::bowls),
    ("counter_door", shapes::counter_door),
    ("counter_drawer", shapes::counter_drawer),
    ("counter_top", shapes::counter_top),
    ("grate", shapes::grate),
    ("hinge_door", shapes::hinge_door),
    ("hood", shapes::hood),
    ("kettle", kettle::kettle),
    ("kettle_bow", kettle::kettle_bow),
    ("kettle_grip", kettle::kettle_grip),
    ("kettle_lid", kettle::kettle_lid),
    ("knob", shapes::knob),
    ("micro_controls", shapes::micro_controls),
    ("micro_door", shapes::micro_door),
    ("micro_knobs", shapes::micro_knobs),
    ("micro_shell", shapes::micro_shell),
    ("mug", kettle::mug),
    ("sink", shapes::sink),
    ("sink_body", shapes::sink_body),
    ("sink_drawer", shapes::sink_drawer),
    ("sink_top", shapes::sink_top),
    ("slide_door", shapes::slide_door),
    ("slide_frame", shapes::slide_frame),
    ("stove_body", shapes::stove_body),
    ("stove_fronts", shapes::stove_fronts),
];
