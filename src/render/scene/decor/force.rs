//! Applied forces and the anchors of constraints.

use crate::scene::item::Shape;
use crate::scene::options::LabelChoice;
use crate::scene::sink::{Form, Items, Source, element, unnamed};
use physics::math::{Mat3, Vec3, add, add_scaled, mul_mat_vec, norm};
use physics::model::bounds::MINVAL;
use physics::model::{EqType, ObjType};

impl Source<'_> {
    /// Length of an arrow for a unit of force \[m/N\].
    pub(super) fn force_scale(&self) -> f64 {
        f64::from(self.m.vis.map.force) / self.m.stat.meanmass
    }
}

/// Adds the user forces on bodies.
pub(super) fn applied(from: Source<'_>, items: &mut Items<'_>) {
    let Source { m, d, options, .. } = from;
    if !options.show.applied_forces {
        return;
    }
    for i in 1..m.nbody {
        let [x, y, z, ..] = d.state.xfrc_applied[i];
        if norm([x, y, z]) > MINVAL {
            let start = d.kin.xipos[i];
            let tip = add_scaled(start, [x, y, z], from.force_scale());
            let form = Form::connector(Shape::Arrow, from.size(m.vis.scale.forcewidth), start, tip);
            items.decor(&form, m.vis.rgba.force, unnamed(i));
        }
    }
}

/// Adds both anchors of every active connect and weld constraint.
pub(super) fn constraints(from: Source<'_>, items: &mut Items<'_>) {
    let Source { m, d, options, .. } = from;
    if !options.show.constraints {
        return;
    }
    let radius = from.size(m.vis.scale.constraint);
    for i in (0..m.neq).filter(|&i| d.state.eq_active[i]) {
        let Some([first, second]) = anchors(from, i) else { continue };
        for ((pos, mat), rgba) in [(first, m.vis.rgba.connect), (second, m.vis.rgba.constraint)] {
            let item = items.decor(&Form::ball(radius, pos, mat), rgba, element(ObjType::Equality, i));
            if options.label == LabelChoice::Constraint {
                item.label = from.label(ObjType::Equality, i);
            }
        }
    }
}

/// Place and orientation of the two anchors of a constraint; none for one without.
fn anchors<'a>(from: Source<'a>, i: usize) -> Option<[(Vec3, &'a Mat3); 2]> {
    let (m, kin) = (from.m, &from.d.kin);
    let [a, b, c, x, y, z, ..] = m.eq_data[i];
    let ([front, back], object) =
        ([[a, b, c], [x, y, z]], [m.eq_obj1id[i], m.eq_obj2id[i]].map(|id| id.max(0) as usize));
    // The first three numbers are the anchor on the first body of a connect constraint, on the second body of a weld.
    let local = match EqType::from_code(m.eq_type[i]) {
        Some(EqType::Connect) => [front, back],
        Some(EqType::Weld) => [back, front],
        _ => return None,
    };
    if m.eq_objtype[i] == ObjType::Site.code() {
        return Some(object.map(|site| (kin.site_xpos[site], &kin.site_xmat[site])));
    }
    Some([0, 1].map(|k| {
        let (body, mat) = (object[k], &kin.xmat[object[k]]);
        (add(mul_mat_vec(mat, local[k]), kin.xpos[body]), mat)
    }))
}
