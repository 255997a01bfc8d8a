//! Contacts: points, frames, forces, and the motion of surfaces.

use crate::scene::island;
use crate::scene::item::Shape;
use crate::scene::options::{FrameChoice, LabelChoice};
use crate::scene::sink::{Form, Items, Source, unnamed};
use physics::acceleration::contact_force::contact_force;
use physics::data::Contact;
use physics::math::{
    Vec3, add, add_scaled, column, cross, dot, mul_mat_vec, norm, row, scale, sub, transpose,
};
use physics::model::ObjType;
use physics::model::bounds::MINVAL;

/// Length of an arrow for a unit of surface speed \[s\].
const SPEED: f64 = 0.5;

/// Adds points, frames and forces of all contacts, as far as they are asked for.
pub(super) fn contacts(from: Source<'_>, items: &mut Items<'_>) {
    let show = &from.options.show;
    for (i, contact) in from.d.con.contact.iter().enumerate() {
        if show.contact_points {
            add_point(from, i, contact, items);
        }
        if from.options.frame == FrameChoice::Contact {
            let [width, length] = from.axis_size();
            items.axes(width / 2.0, length / 2.0, contact.pos, &transpose(&contact.frame), i);
        }
        if show.contact_forces && contact.efc_address >= 0 {
            add_forces(from, i, contact, items);
        }
    }
}

/// Adds the disk of a contact, as thick as the penetration, and the speeds of its surfaces.
fn add_point(from: Source<'_>, i: usize, contact: &Contact, items: &mut Items<'_>) {
    let (m, options) = (from.m, from.options);
    let [normal, first, second] = [0, 1, 2].map(|k| row(&contact.frame, k));
    let width = from.size(m.vis.scale.contactwidth);
    let form = Form {
        shape: Shape::Cylinder,
        size: [width, width, from.size(m.vis.scale.contactheight).max(-contact.dist / 2.0)],
        pos: contact.pos,
        mat: std::array::from_fn(|k| [first, second, normal][k % 3][k / 3]),
    };
    let rgba = match contact.efc_address {
        row if row >= 0 && options.show.islands => island::color(from.first_dof_of_row(row)),
        row if row >= 0 => m.vis.rgba.contactpoint,
        _ => m.vis.rgba.contactgap,
    };
    let item = items.decor(&form, rgba, unnamed(i));
    if options.label == LabelChoice::ContactPoint {
        let [a, b] = [0, 1].map(|side| match contact.geom[side] {
            -1 => flex_label(from, contact, side),
            geom => geom_label(from, geom),
        });
        item.label = format!("{a} | {b}");
    }
    let width = from.size(m.vis.scale.forcewidth);
    for (geom, side) in contact.geom.into_iter().zip([-0.5, 0.5]) {
        let Some(speed) = surface_speed(from, geom, contact) else { continue };
        let start = add_scaled(contact.pos, normal, side * width);
        let arrow = Form::connector(Shape::Arrow, width, start, add_scaled(start, speed, SPEED));
        items.decor(&arrow, rgba, unnamed(i));
    }
}

/// Name of the flex on one side of a contact, with the element or vertex that touches.
fn flex_label(from: Source<'_>, contact: &Contact, side: usize) -> String {
    let flex = contact.flex[side];
    let name = match from.m.name_of(ObjType::Flex, flex.max(0) as usize) {
        "" => format!("f{flex}"),
        name => name[..name.floor_char_boundary(MAX_NAME)].to_owned(),
    };
    match contact.elem[side] {
        -1 => format!("{name}.v{}", contact.vert[side]),
        element => format!("{name}.e{element}"),
    }
}

/// Longest name of a geom in the label of a contact, in bytes.
const MAX_NAME: usize = 47;

fn geom_label(from: Source<'_>, geom: i32) -> String {
    let name = from.m.name_of(ObjType::Geom, geom.max(0) as usize);
    if name.is_empty() { format!("g{geom}") } else { name[..name.floor_char_boundary(MAX_NAME)].to_owned() }
}

/// Velocity of the material of a moving surface along the contact; none for one at rest \[m/s\].
fn surface_speed(from: Source<'_>, geom: i32, contact: &Contact) -> Option<Vec3> {
    let (kin, geom) = (&from.d.kin, usize::try_from(geom).ok()?);
    let [a, b, c, x, y, z] = from.m.geom_surfacevel[geom];
    let [linear, angular] = [[a, b, c], [x, y, z]].map(|v| mul_mat_vec(&kin.geom_xmat[geom], v));
    let speed = add(linear, cross(angular, sub(contact.pos, kin.geom_xpos[geom])));
    let normal = row(&contact.frame, 0);
    let along = add_scaled(speed, normal, -dot(speed, normal));
    (norm(along) >= MINVAL).then_some(along)
}

/// Adds the force of a contact as one arrow, or its normal and frictional part as two.
fn add_forces(from: Source<'_>, i: usize, contact: &Contact, items: &mut Items<'_>) {
    let Source { m, d, options, .. } = from;
    let [x, y, z, ..] = contact_force(m, &d.efc, contact);
    let force = if contact.dim >= 3 { [x, y, z] } else { [x, 0.0, 0.0] };
    if norm(force) < MINVAL {
        return;
    }
    let mat = transpose(&contact.frame);
    let split = options.show.split_forces && contact.dim > 1;
    let (normal, friction) = (scale(column(&mat, 0), x), mul_mat_vec(&mat, [0.0, y, z]));
    let parts = if split {
        [Some((normal, m.vis.rgba.contactforce)), Some((friction, m.vis.rgba.contactfriction))]
    } else {
        [Some((mul_mat_vec(&mat, force), m.vis.rgba.contactforce)), None]
    };
    let [a, b] = contact.geom.map(|geom| usize::try_from(geom).map_or(0, |geom| m.geom_bodyid[geom]));
    // Arrows point to the body with the higher number; between two bodies that are not the world, both ways.
    let stretch = from.force_scale() * if a > b { -1.0 } else { 1.0 };
    let shape = if a > 0 && b > 0 && !split { Shape::DoubleArrow } else { Shape::Arrow };
    for (k, (vector, rgba)) in parts.into_iter().flatten().enumerate() {
        let tip = add_scaled(contact.pos, vector, stretch);
        let form = Form::connector(shape, from.size(m.vis.scale.forcewidth), contact.pos, tip);
        let item = items.decor(&form, rgba, unnamed(i));
        if options.label == LabelChoice::ContactForce && k == 0 {
            item.label = three_digits(norm(force));
        }
    }
}

/// A positive number in three significant digits, without trailing zeros, as C's `%.3g` writes it.
fn three_digits(x: f64) -> String {
    let rounded = format!("{x:.2e}");
    let Some((digits, exponent)) = rounded.split_once('e') else { return rounded };
    let trim = |s: &str| {
        if s.contains('.') { s.trim_end_matches('0').trim_end_matches('.').to_owned() } else { s.to_owned() }
    };
    match exponent.parse::<i32>() {
        Ok(power @ -4..=2) => trim(&format!("{x:.*}", (2 - power) as usize)),
        Ok(power) => {
            let sign = if power < 0 { '-' } else { '+' };
            format!("{}e{sign}{:02}", trim(digits), power.abs())
        }
        Err(_) => rounded,
    }
}

#[cfg(test)]
mod tests {
    use super::three_digits;

    #[test]
    fn numbers_have_three_digits() {
        let cases = [(9.81, "9.81"), (98.1, "98.1"), (981.4, "981"), (1234.0, "1.23e+03"), (2.0, "2")];
        for (x, text) in
            cases.into_iter().chain([(0.012_35, "0.0123"), (0.000_05, "5e-05"), (999.9, "1e+03")])
        {
            assert_eq!(three_digits(x), text);
        }
    }
}
