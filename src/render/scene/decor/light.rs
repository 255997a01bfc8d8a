//! Lights as things.

use crate::scene::item::Shape;
use crate::scene::options::{FrameChoice, LabelChoice};
use crate::scene::sink::{Form, Items, Source, element, from_z};
use physics::math::add_scaled;
use physics::model::ObjType;

/// How far a light stands behind the cylinder that shows it, for it not to light the cylinder \[m\].
const CLEARANCE: f64 = 0.0001;

/// Adds a cylinder behind every light.
pub(super) fn lights(from: Source<'_>, items: &mut Items<'_>) {
    let Source { m, d, options, .. } = from;
    if !options.show.lights {
        return;
    }
    let (size, [width, length]) = (from.size(m.vis.scale.light), from.axis_size());
    for (i, (&pos, &dir)) in d.kin.light_xpos.iter().zip(&d.kin.light_xdir).enumerate() {
        let form = Form {
            shape: Shape::Cylinder,
            size: [size * 0.8, size * 0.8, size],
            pos: add_scaled(pos, dir, -size - CLEARANCE),
            mat: from_z(dir),
        };
        let item = items.decor(&form, m.vis.rgba.light, element(ObjType::Light, i));
        if options.label == LabelChoice::Light {
            item.label = from.label(ObjType::Light, i);
        }
        if options.frame == FrameChoice::Light {
            items.axes(width, length, pos, &form.mat, i);
        }
    }
}
