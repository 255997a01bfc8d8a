//! Slider cranks.

use super::item::{Category, Shape};
use super::options::LabelChoice;
use super::sink::{Form, Items, Source, element};
use physics::math::{add_scaled, column, dot, ops, sub};
use physics::model::{ObjType, TrnType};

/// Adds the slider and the rod of every slider crank; the rod is red where it does not reach the crank.
pub(super) fn slider_cranks(from: Source<'_>, items: &mut Items<'_>) {
    let Source { m, d, options, .. } = from;
    if !from.shows(Category::Dynamic) {
        return;
    }
    for i in (0..m.nactuator).filter(|&i| m.actuator_trntype[i] == TrnType::Slidercrank.code()) {
        let [crank, slider] = m.actuator_trnid[i].map(|site| site as usize);
        let (start, pin) = (d.kin.site_xpos[slider], d.kin.site_xpos[crank]);
        let (axis, span, rod) =
            (column(&d.kin.site_xmat[slider], 2), sub(pin, start), m.actuator_cranklength[i]);
        let along = dot(span, axis);
        let square = along * along + rod * rod - dot(span, span);
        let end = add_scaled(start, axis, along - ops::sqrt(square.max(0.0)));
        let (width, rgba) = (from.size(m.vis.scale.slidercrank), &m.vis.rgba);
        let object = element(ObjType::Actuator, i);
        let form = Form::connector(Shape::Cylinder, width, start, end);
        let item = items.add(&form, rgba.slidercrank.into(), object, Category::Dynamic);
        if options.label == LabelChoice::Actuator {
            item.label = from.label(ObjType::Actuator, i);
        }
        let color = if square < 0.0 { rgba.crankbroken } else { rgba.slidercrank };
        let form = Form::connector(Shape::Capsule, width / 2.0, end, pin);
        items.add(&form, color.into(), object, Category::Dynamic);
    }
}
