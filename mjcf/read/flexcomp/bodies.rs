//! The flex of a flexcomp, the bodies and joints of its points, and its constraints.

use super::super::reader::Reader;
use super::super::tree::Place;
use super::lattice;
use super::masses::{AXES, Maker};
use super::points::Points;
use crate::flex::Shape;
use crate::spec::{Body, Dof, Equality, EqualityOf, Flex, Flexcomp, Joint};
use crate::vector::normalize;
use crate::xml::Element;
use physics::model::{EqType, ObjType};

impl Reader<'_> {
    /// Adds the flex, its bodies and its constraints.
    pub(super) fn flexcomp_bodies(
        &mut self,
        element: &Element,
        wanted: &Flexcomp,
        points: Points,
        place: Place,
    ) {
        let parent = self.body_here().name.clone();
        let joint = Joint { frame: None, ..self.spec.classes.of(place.body_class).joint.clone() };
        let maker = Maker { joint, element, inertiabox: wanted.inertiabox, plugin: wanted.plugin.as_ref() };
        let mut flex = flex_of(wanted, &points);
        if points.rigid {
            if let Some(used) = &wanted.plugin {
                let why = "<plugin> is ignored: a rigid <flexcomp> has no bodies of its own";
                self.warning(used.loc, why);
            }
            flex.vert = points.cloud.point;
            flex.vertbody = vec![parent];
            self.spec.flexes.push(flex);
            return;
        }
        let mut bodies = Vec::new();
        if wanted.dof.order() > 0 {
            flex.vertbody = vec![parent.clone(); points.cloud.point.len() / 3];
            lattice::add_nodes(wanted, &points, (&maker, &parent), &mut flex, &mut bodies);
            flex.vert = points.cloud.point;
        } else {
            add_points(wanted, points, (&maker, &parent), &mut flex, &mut bodies);
        }
        self.body_here().bodies.append(&mut bodies);
        let constraints = constraints(wanted, &flex);
        self.spec.equalities.extend(constraints);
        self.spec.flexes.push(flex);
    }
}

/// What does not depend on bodies.
fn flex_of(wanted: &Flexcomp, points: &Points) -> Flex {
    let Points { cloud, .. } = points;
    let solid = wanted.shape == Shape::Grid && cloud.dim == 3;
    let angular = matches!(wanted.shape, Shape::Box | Shape::Cylinder) || solid;
    Flex {
        dim: cloud.dim,
        flatskin: wanted.flex.flatskin || angular,
        elem: cloud.element.clone(),
        texcoord: cloud.texcoord.clone(),
        elemtexcoord: cloud.elemtexcoord.clone(),
        ..wanted.flex.clone()
    }
}

/// A body for each point that is not pinned.
fn add_points(
    wanted: &Flexcomp,
    points: Points,
    (maker, parent): (&Maker<'_>, &str),
    flex: &mut Flex,
    bodies: &mut Vec<Body>,
) {
    let mut vert = points.cloud.point;
    let mass = wanted.mass / (vert.len() / 3) as f64;
    for (i, point) in vert.as_chunks_mut::<3>().0.iter_mut().enumerate() {
        if points.pinned[i] {
            flex.vertbody.push(parent.to_owned());
            continue;
        }
        let name = format!("{}_{i}", flex.name);
        let mut outwards = [*point];
        let axes: &[[f64; 3]] = match wanted.dof {
            Dof::Radial => {
                normalize(&mut outwards[0]);
                &outwards
            }
            Dof::Plane => &AXES[..2],
            _ => &AXES,
        };
        bodies.push(maker.body(name.clone(), *point, mass, axes));
        flex.vertbody.push(name);
        *point = [0.0; 3];
    }
    if !points.free {
        flex.vert = vert;
    }
}

/// The equality constraints that are asked for.
fn constraints(wanted: &Flexcomp, flex: &Flex) -> Vec<Equality> {
    let one = |kind: EqType| Equality {
        loc: flex.loc,
        kind,
        name1: flex.name.clone(),
        objtype: ObjType::Flex,
        solref: wanted.solref,
        solimp: wanted.solimp,
        ..Equality::default()
    };
    match wanted.equality {
        EqualityOf::Nothing => Vec::new(),
        EqualityOf::Edges => vec![one(EqType::Flex)],
        EqualityOf::Vertices => vec![one(EqType::Flexvert)],
        EqualityOf::Strains => {
            let strain = |cell: [f64; 3]| {
                let mut equality = one(EqType::Flexstrain);
                equality.data[..3].copy_from_slice(&cell);
                equality
            };
            lattice::strained_cells(flex).into_iter().map(strain).collect()
        }
    }
}
