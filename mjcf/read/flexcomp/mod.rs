//! `flexcomp`: points and elements become a flex, with a body a point or a node, sliding joints, and constraints.
//!
//! | part | file |
//! |---|---|
//! | points and elements | `cloud.rs` |
//! | what is fixed to the parent body | `pins.rs` |
//! | bodies, joints, constraints | `bodies.rs` |
//! | the lattice of an interpolated flex | `lattice.rs` |

mod bodies;
mod cloud;
mod lattice;
mod masses;
mod pins;
mod points;

use super::reader::Reader;
use super::tree::Place;
use crate::diagnostic::Loc;
use crate::flex::Cloud;
use crate::schema::flex::{
    CONTACT_ROWS, EDGE_EQUALITY_ROWS, EDGE_ROWS, ELASTICITY_ROWS, FLEXCOMP_ROWS, ORIGIN_ROW, PIN_ROWS,
};
use crate::schema::text::LARGEST;
use crate::spec::{Dof, Elastic2d, EqualityOf, Flexcomp, Pin, resolve};
use crate::vector::rotate;
use crate::xml::Element;
use physics::math::Legible;
use physics::model::bounds::MINVAL;
use points::Points;

impl Reader<'_> {
    /// Adds the flex to the model, and what moves it to the open body.
    pub(super) fn flexcomp(&mut self, element: &Element, place: Place) {
        let wanted = self.flexcomp_element(element);
        if place.frame.is_some() {
            let message =
                "<flexcomp> ignores the frame around it, as MuJoCo does: give it 'pos' and an orientation";
            self.warning(element.loc, message);
        }
        let made = self.flexcomp_points(element, &wanted);
        match made {
            Ok(Some(points)) => self.flexcomp_bodies(element, &wanted, points, place),
            // The budget has said why.
            Ok(None) => {}
            Err((loc, message)) => self.error(loc, format!("<flexcomp> '{}': {message}", wanted.flex.name)),
        }
    }

    fn flexcomp_element(&mut self, element: &Element) -> Flexcomp {
        let mut wanted = Flexcomp::default();
        wanted.flex.loc = element.loc;
        self.rows(element, &FLEXCOMP_ROWS, &mut wanted);
        self.rows(element, &ORIGIN_ROW, &mut wanted);
        let name = wanted.flex.name.clone();
        for child in &element.children {
            match child.name.as_str() {
                "edge" => {
                    self.rows(child, &EDGE_ROWS, &mut wanted.flex);
                    self.rows(child, &EDGE_EQUALITY_ROWS, &mut wanted);
                }
                "elasticity" => self.rows(child, &ELASTICITY_ROWS, &mut wanted.flex),
                "contact" => self.rows(child, &CONTACT_ROWS, &mut wanted.flex),
                "plugin" if wanted.plugin.is_none() => {
                    let used = self.child_plugin(element);
                    wanted.plugin = used.map(|used| self.shared_plugin(used, format!("flexcomp{name}")));
                }
                "pin" => {
                    let mut pin = Pin { loc: child.loc, ..Pin::default() };
                    self.rows(child, &PIN_ROWS, &mut pin);
                    wanted.pins.push(pin);
                }
                // Refused by the structural check.
                _ => {}
            }
        }
        wanted
    }

    /// Points and elements, checked, in the parent body; `None` when they are beyond the budget.
    fn flexcomp_points(
        &mut self,
        element: &Element,
        wanted: &Flexcomp,
    ) -> Result<Option<Points>, (Loc, String)> {
        let at = |message: String| (element.loc, message);
        if self.body_here().name.is_empty() {
            return Err(at("the body around it needs a name".into()));
        }
        check(wanted).map_err(at)?;
        let quat = resolve(wanted.quat, wanted.alt, &self.spec.compiler).map_err(at)?;
        let Some(mut cloud) = self.flexcomp_cloud(element, wanted)? else { return Ok(None) };
        check_cloud(&cloud).map_err(at)?;
        for point in cloud.point.as_chunks_mut::<3>().0 {
            if wanted.shape.is_given() {
                *point = std::array::from_fn(|k| point[k] * wanted.scale[k]);
            }
            let turned = rotate(*point, quat);
            *point = std::array::from_fn(|k| turned[k] + wanted.pos[k]);
        }
        check_distance(&cloud.point).map_err(at)?;
        let mut points = Points {
            bounds: bounds(&cloud.point),
            pinned: Vec::new(),
            rigid: wanted.rigid,
            free: false,
            cloud,
        };
        pins::pin(wanted, &mut points)?;
        if wanted.shape.is_given() {
            cloud::drop_unused(&mut points);
        }
        Ok(Some(points))
    }
}

/// What can be said before there are points.
fn check(wanted: &Flexcomp) -> Result<(), String> {
    let flex = &wanted.flex;
    if !(1..=3).contains(&flex.dim) {
        return Err(format!("dim must be 1, 2 or 3, is {}", flex.dim));
    }
    if flex.radius < 0.0 {
        return Err(format!("'radius' is {}: set it to 0 or more", Legible(flex.radius)));
    }
    let least = if wanted.dof == Dof::Radial && flex.dim == 3 { 2 } else { 1 };
    if wanted.count.iter().any(|&n| n < least) {
        return Err(format!("the numbers of 'count' must be at least {least}"));
    }
    let size = 2.0 * flex.radius + flex.margin;
    let least_spacing = Legible(size);
    if !wanted.shape.is_given() && wanted.spacing.iter().any(|&x| x < size) {
        return Err(format!(
            "the numbers of 'spacing' must be at least {least_spacing}, twice the radius plus the margin"
        ));
    }
    if wanted.scale.iter().any(|&x| x < MINVAL) {
        return Err("the numbers of 'scale' must be positive".into());
    }
    if wanted.mass < MINVAL || wanted.inertiabox < MINVAL {
        return Err("'mass' and 'inertiabox' must be positive".into());
    }
    if flex.elastic2d != Elastic2d::Bend && wanted.equality != EqualityOf::Nothing && flex.young > 0.0 {
        return Err("constraints and elasticity exclude each other: remove 'equality' or 'young'".into());
    }
    let nodes_make_cells = wanted.dof.order() == 0 || wanted.cellcount == [-1; 3] || wanted.rigid;
    if !nodes_make_cells && wanted.cellcount.iter().any(|&n| n < 1) {
        return Err("the numbers of 'cellcount' must be at least 1".into());
    }
    if flex.dim == 1 && wanted.pins.iter().any(|p| !(p.grid.is_empty() && p.gridrange.is_empty())) {
        return Err("pins of lines are given by 'id' and 'range', not by places of a grid".into());
    }
    Ok(())
}

/// Differences of points become positions of bodies, which are written as numbers of a text.
fn check_distance(point: &[f64]) -> Result<(), String> {
    const FARTHEST: f64 = LARGEST / 2.0;
    match point.iter().find(|x| x.is_nan() || x.abs() > FARTHEST) {
        None => Ok(()),
        Some(&x) => Err(format!(
            "a coordinate of a point is {}, and at most {FARTHEST:e} can be: lower 'spacing', 'scale' or 'pos'",
            Legible(x)
        )),
    }
}

/// What elements need of points.
fn check_cloud(cloud: &Cloud) -> Result<(), String> {
    if cloud.point.is_empty() || cloud.element.is_empty() {
        return Err("points and elements are needed".into());
    }
    if !cloud.point.len().is_multiple_of(3) {
        return Err(format!("'point' has {} numbers, not three a point", cloud.point.len()));
    }
    let corners = cloud.dim as usize + 1;
    if !cloud.element.len().is_multiple_of(corners) {
        return Err(format!("'element' has {} numbers, not {corners} an element", cloud.element.len()));
    }
    let points = cloud.point.len() / 3;
    match cloud.element.iter().position(|&p| p < 0 || p as usize >= points) {
        None => Ok(()),
        Some(at) => Err(format!(
            "element {} has point {}, and there are {points} points",
            at / corners,
            cloud.element[at]
        )),
    }
}

fn bounds(point: &[f64]) -> [[f64; 3]; 2] {
    let mut bounds: [[f64; 3]; 2] = [[1e10; 3], [-1e10; 3]];
    for p in point.as_chunks::<3>().0 {
        for k in 0..3 {
            bounds[0][k] = bounds[0][k].min(p[k]);
            bounds[1][k] = bounds[1][k].max(p[k]);
        }
    }
    bounds
}
