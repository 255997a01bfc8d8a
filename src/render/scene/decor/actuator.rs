//! Actuators, in colours that tell their control or activation.

use crate::scene::item::{Category, Shape};
use crate::scene::options::{LabelChoice, is_visible};
use crate::scene::sink::{Form, Items, Source, element};
use crate::scene::tendon::stretches;
use physics::actuation::is_disabled;
use physics::math::scale;
use physics::model::bounds::MINVAL;
use physics::model::{DynType, ObjType, TrnType};

/// How much larger than the site or geom it pulls on an actuator is drawn.
const INFLATION: f64 = 1.05;

/// Size of an actuator of a ball or free joint relative to the length of joints.
const KNOB: f64 = 0.33;

/// Adds the visible actuators that are not switched off.
pub(super) fn actuators(from: Source<'_>, items: &mut Items<'_>) {
    let Source { m, options, .. } = from;
    if !options.show.actuators {
        return;
    }
    for i in 0..m.nactuator {
        if is_visible(&options.groups.actuators, m.actuator_group[i]) && !is_disabled(m, i) {
            add(from, i, items);
        }
    }
}

fn add(from: Source<'_>, i: usize, items: &mut Items<'_>) {
    let (m, kin) = (from.m, &from.d.kin);
    let (rgba, object) = (color(from, i), element(ObjType::Actuator, i));
    let Ok(target) = usize::try_from(m.actuator_trnid[i][0]) else { return };
    match TrnType::from_code(m.actuator_trntype[i]) {
        Some(TrnType::Joint | TrnType::Jointinparent) => {
            if let Some(form) = mark(from, target) {
                let item = items.decor(&form, rgba, object);
                label(from, i, &mut item.label);
            }
        }
        Some(TrnType::Site) => {
            let size = scale(m.site_size[target], INFLATION);
            let (pos, mat) = (kin.site_xpos[target], &kin.site_xmat[target]);
            if let Some(form) = Form::primitive(m.site_type[target], size, pos, mat) {
                let item = items.decor(&form, rgba, object);
                label(from, i, &mut item.label);
            }
        }
        Some(TrnType::Body) => {
            let first = m.body_geomadr[target].max(0) as usize;
            for geom in first..first + m.body_geomnum[target] as usize {
                let size = scale(m.geom_size[geom], INFLATION);
                let (pos, mat) = (kin.geom_xpos[geom], &kin.geom_xmat[geom]);
                if let Some(form) = Form::primitive(m.geom_type[geom], size, pos, mat) {
                    items.decor(&form, rgba, object);
                }
            }
        }
        Some(TrnType::Tendon) => {
            let mut coat = from.coat(m.tendon_matid[target], m.tendon_rgba[target], Category::Decor);
            coat.rgba = rgba;
            for stretch in stretches(from, target) {
                let width = stretch.width * f64::from(m.vis.map.actuatortendon);
                let form = Form::connector(Shape::Capsule, width, stretch.ends[0], stretch.ends[1]);
                let item = items.add(&form, coat, object, Category::Decor);
                if stretch.first {
                    label(from, i, &mut item.label);
                }
            }
        }
        _ => {}
    }
}

/// The mark of an actuated joint.
fn mark(from: Source<'_>, joint: usize) -> Option<Form> {
    let scale = &from.m.vis.scale;
    let (width, length) = (from.size(scale.actuatorwidth), from.size(scale.actuatorlength));
    from.joint_mark(joint, width, length, from.size(scale.jointlength) * KNOB)
}

fn label(from: Source<'_>, i: usize, text: &mut String) {
    if from.options.label == LabelChoice::Actuator {
        *text = from.label(ObjType::Actuator, i);
    }
}

/// Colour by control, or by activation: from one colour at zero to another at either end of the range.
fn color(from: Source<'_>, i: usize) -> [f32; 4] {
    let Source { m, d, options, .. } = from;
    let ctrl = usize::try_from(m.actuator_ctrladr[i]).ok();
    let limited = ctrl.is_some_and(|k| m.actuator_ctrllimited[k]);
    let range = match ctrl {
        Some(k) if limited => m.actuator_ctrlrange[k],
        _ if options.show.activations && m.actuator_actlimited[i] => m.actuator_actrange[i],
        _ => [-1.0, 1.0],
    };
    let [low, middle, high] = marks(range);
    let value = if options.show.activations && m.actuator_dyntype[i] != DynType::None.code() {
        usize::try_from(m.actuator_actadr[i] + m.actuator_actnum[i] - 1).map_or(0.0, |k| d.state.act[k])
    } else {
        ctrl.map_or(0.0, |k| d.state.ctrl[k])
    };
    let value = value.max(low).min(high);
    let rgba = &m.vis.rgba;
    let (end, share) = if value <= middle {
        (rgba.actuatornegative, (middle - value) / (middle - low).max(MINVAL))
    } else {
        (rgba.actuatorpositive, (value - middle) / (high - middle).max(MINVAL))
    };
    let share = share as f32;
    std::array::from_fn(|k| share * end[k] + (1.0 - share) * rgba.actuator[k])
}

/// Values that have the colours of the lower end, of no force and of the upper end: a range that leaves out zero is
/// extended to the unit on that side, and no part of it is empty.
fn marks([low, high]: [f64; 2]) -> [f64; 3] {
    let [low, middle, high] = if low >= 0.0 {
        [-1.0, low, high]
    } else if high <= 0.0 {
        [low, high, 1.0]
    } else {
        [low, 0.0, high]
    };
    let low = if middle - low < MINVAL { middle - MINVAL } else { low };
    let high = if high - middle < MINVAL { middle + MINVAL } else { high };
    [low, middle, high]
}
