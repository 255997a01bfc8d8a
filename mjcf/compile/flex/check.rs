//! What is asked of a flex before it is compiled.

use crate::spec::{Elastic2d, Flex};
use physics::math::Legible;
use physics::model::FlexSelf;

/// Refuses unless `holds`.
fn require(holds: bool, why: impl FnOnce() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(why()) }
}

/// Lengths of lists, references between them, and numbers that exclude each other.
pub(super) fn counts(flex: &Flex) -> Result<(), String> {
    let Flex { dim, elem, vertbody, nodebody, vert, .. } = flex;
    require((1..=3).contains(dim), || format!("dim must be 1, 2 or 3, is {dim}"))?;
    let corners = *dim as usize + 1;
    require(flex.radius >= 0.0, || {
        format!(
            "radius is {}: set it to 0 or more, elements are that thick on each side",
            Legible(flex.radius)
        )
    })?;
    require(!elem.is_empty() && elem.len().is_multiple_of(corners), || {
        format!("'element' has {} numbers, not {corners} an element", elem.len())
    })?;
    require(!vertbody.is_empty(), || "'body' names no body".into())?;
    require(vert.len().is_multiple_of(3), || {
        format!("'vertex' has {} numbers, not three a vertex", vert.len())
    })?;
    let vertices = if vert.is_empty() { vertbody.len() } else { vert.len() / 3 };
    let one_for_all = vertbody.len() == 1 && nodebody.is_empty() && !vert.is_empty();
    require(one_for_all || vertbody.len() == vertices, || {
        format!("'body' names {} bodies, not one or one for each of the {vertices} vertices", vertbody.len())
    })?;
    require(vertices >= corners, || {
        format!("{vertices} vertices make no element: at least {corners} are needed")
    })?;
    elements(flex, vertices)?;
    texture(flex, vertices)?;
    material(flex)?;
    contacts(flex)?;
    if nodebody.is_empty() && flex.order == 0 { Ok(()) } else { nodes(flex, vertices) }
}

fn elements(flex: &Flex, vertices: usize) -> Result<(), String> {
    let corners = flex.dim as usize + 1;
    for (e, element) in flex.elem.chunks_exact(corners).enumerate() {
        for (k, &v) in element.iter().enumerate() {
            let known = usize::try_from(v).is_ok_and(|v| v < vertices);
            require(known, || format!("element {e} has vertex {v}, and there are {vertices} vertices"))?;
            require(!element[..k].contains(&v), || format!("element {e} has vertex {v} twice"))?;
        }
    }
    Ok(())
}

fn texture(flex: &Flex, vertices: usize) -> Result<(), String> {
    let Flex { texcoord, elemtexcoord, elem, .. } = flex;
    if elemtexcoord.is_empty() {
        return require(texcoord.is_empty() || texcoord.len() == 2 * vertices, || {
            format!("'texcoord' has {} numbers, not two for each of the {vertices} vertices", texcoord.len())
        });
    }
    require(texcoord.len().is_multiple_of(2), || {
        format!("'texcoord' has {} numbers, not two each", texcoord.len())
    })?;
    require(elemtexcoord.len() <= elem.len(), || {
        format!("'elemtexcoord' has {} numbers, and the elements {} vertices", elemtexcoord.len(), elem.len())
    })?;
    let coordinates = texcoord.len() / 2;
    match elemtexcoord.iter().find(|&&t| t < -1 || t >= coordinates as i32) {
        None => Ok(()),
        Some(lost) => {
            Err(format!("'elemtexcoord' names texture coordinate {lost}, and there are {coordinates}"))
        }
    }
}

fn material(flex: &Flex) -> Result<(), String> {
    let ratio = (0.0..0.5).contains(&flex.poisson);
    let surface = flex.elastic2d != Elastic2d::None;
    require(flex.edgestiffness <= 0.0 || flex.dim == 1, || {
        "edges of triangles and tetrahedra have no stiffness: use <elasticity>".into()
    })?;
    require(!surface || flex.thickness > 0.0, || "elastic2d needs a positive thickness".into())?;
    require(!(surface || flex.young > 0.0) || ratio, || {
        format!("Poisson's ratio must be at least 0 and below 0.5, is {}", Legible(flex.poisson))
    })?;
    require(!surface || flex.dim == 2 || !flex.nodebody.is_empty(), || {
        "elastic2d is for triangles, and for interpolated flexes".into()
    })
}

fn contacts(flex: &Flex) -> Result<(), String> {
    require([1, 3, 4, 6].contains(&flex.condim), || {
        format!("condim must be 1, 3, 4 or 6, is {}", flex.condim)
    })?;
    let interpolated = !flex.nodebody.is_empty();
    require(!interpolated || flex.selfcollide == FlexSelf::None, || {
        "an interpolated flex cannot collide with itself: give <contact selfcollide=\"none\"/>".into()
    })?;
    require(!(interpolated && flex.internal), || {
        "an interpolated flex has no internal collisions: give <contact internal=\"false\"/>".into()
    })
}

/// The lattice of an interpolated flex.
fn nodes(flex: &Flex, vertices: usize) -> Result<(), String> {
    let Flex { order, cellcount, nodebody, node, vert, .. } = flex;
    require(*order > 0, || "nodes need dof=\"trilinear\" or dof=\"quadratic\"".into())?;
    require(cellcount.iter().all(|&c| c > 0), || "the numbers of 'cellcount' must be at least 1".into())?;
    let along = cellcount.map(|c| c as usize * *order as usize + 1);
    let expected = along.iter().fold(1_usize, |n, &a| n.saturating_mul(a));
    require(nodebody.len() == expected, || {
        format!("'node' names {} bodies, and the lattice has {expected} nodes", nodebody.len())
    })?;
    require(node.is_empty() || node.len() == 3 * nodebody.len(), || {
        format!("'nodecoord' has {} numbers, not three for each of the {expected} nodes", node.len())
    })?;
    require(vert.len() == 3 * vertices, || "an interpolated flex needs the attribute 'vertex'".into())
}

/// Vertices of a bending surface are fixed to bodies of three joints or none.
pub(super) fn pinned(flex: &Flex, vertbody: &[i32], joints: impl Fn(usize) -> usize) -> Result<(), String> {
    if flex.dim != 2 || !flex.elastic2d.bends() || !flex.nodebody.is_empty() {
        return Ok(());
    }
    let odd = vertbody.iter().position(|&body| ![0, 3].contains(&joints(body as usize)));
    odd.map_or(Ok(()), |v| {
        Err(format!(
            "body '{}' has joints of its own: a surface that bends is pinned to bodies without joints",
            flex.vertbody[v]
        ))
    })
}
