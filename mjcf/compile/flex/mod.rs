//! Flexes: what their elements are made of, before any moves.
//!
//! | part | file |
//! |---|---|
//! | edges, shell, layers, pairs | `topology.rs` |
//! | elasticity of triangles, tetrahedra and edges | `elasticity.rs` |
//! | finite elements of interpolated flexes | `lattice.rs`, `linear.rs`, `modes.rs`, `shell_bending.rs` |
//! | what is asked of a flex | `check.rs` |
//! | what is settled of a flex; arrays of the model | `node.rs`; `rows.rs` |

mod check;
mod elasticity;
mod lattice;
mod linear;
mod modes;
mod node;
mod rows;
mod shell_bending;
mod topology;

pub(super) use rows::{allocate_derived, fill, set_sizes};

use super::frame::add;
use super::log::{Log, title};
use super::lookup::Lookup;
use super::nodes::{BodyNode, Tree};
use crate::flex::cells::{self, Cells};
use crate::spec::{Elastic2d, Flex, Spec};
use crate::vector::{cross, dot, rotate, sub};
use elasticity::{BENDING, METRIC, Material};
use lattice::Lattice;
use node::FlexNode;
use physics::geometry::hierarchy::{self as bvh, Bvh, Leaf};
use physics::math::{Mat3, Vec3};
use physics::model::bounds::MINVAL;
use physics::model::{EqType, ObjType};
use topology::{Edges, Shell};

/// Young's modulus and Poisson's ratio of strain constraints, of whose modes only the shapes count.
const STRAIN: Material = Material { young: 10.0, poisson: 0.3 };

/// Where vertices and nodes are in the world.
struct Placed {
    vertbody: Vec<i32>,
    nodebody: Vec<i32>,
    rigid: bool,
    centered: bool,
    vertex: Vec<Vec3>,
    node: Vec<Vec3>,
}

/// Compiles all flexes.
pub(super) fn compile<'s>(spec: &'s Spec, tree: &Tree, lookup: &Lookup, log: &mut Log) -> Vec<FlexNode<'s>> {
    let mut nodes = Vec::with_capacity(spec.flexes.len());
    for flex in &spec.flexes {
        let what = title("flex", &flex.name);
        let strained = spec.equalities.iter().any(|e| e.kind == EqType::Flexstrain && e.name1 == flex.name);
        if log.check(flex.loc, &what, check::counts(flex)).is_none() {
            continue;
        }
        if !log.charge(flex.loc, &what, memory(flex)) {
            return nodes;
        }
        let Some(placed) = place(flex, &tree.bodies, lookup, log) else { continue };
        nodes.extend(log.check(flex.loc, &what, one(flex, placed, strained)));
    }
    nodes
}

/// Bytes of an element with its edges, sides and elasticity.
const PER_ELEMENT: usize = 2048;

/// Bytes that a flex takes, with what is made on the way.
fn memory(flex: &Flex) -> usize {
    let elements = flex.elem.len() / (flex.dim as usize + 1);
    let width = 3 * (flex.order as usize + 1).pow(if flex.elastic2d == Elastic2d::None { 3 } else { 2 });
    let cells = flex.cellcount.iter().fold(1_usize, |n, &c| n.saturating_mul(c.max(0) as usize));
    let lattice = if flex.order > 0 { cells.saturating_mul(6 * 8 * width * width) } else { 0 };
    elements.saturating_mul(PER_ELEMENT).saturating_add(lattice)
}

/// Ids of bodies, and where they put vertices and nodes.
fn place(flex: &Flex, bodies: &[BodyNode<'_>], lookup: &Lookup, log: &mut Log) -> Option<Placed> {
    let what = title("flex", &flex.name);
    let mut ids = |names: &[String]| -> Option<Vec<i32>> {
        let id =
            |name: &String| lookup.require(ObjType::Body, name, flex.loc, &what, log).map(|id| id as i32);
        names.iter().map(id).collect()
    };
    let (vertbody, nodebody) = (ids(&flex.vertbody)?, ids(&flex.nodebody)?);
    let dofs = check::pinned(flex, &vertbody, |body| bodies[body].joints.len());
    log.check(flex.loc, &what, dofs)?;
    let interpolated = !nodebody.is_empty();
    let rigid = !interpolated && vertbody.iter().all(|&b| b == vertbody[0]);
    let offsets = if interpolated { &flex.node } else { &flex.vert };
    let centered = offsets.iter().all(|&x| x == 0.0);
    let at = |body: i32, offset: Option<Vec3>| {
        let world = bodies[body as usize].world;
        offset.map_or(world.pos, |offset| add(world.pos, rotate(offset, world.quat)))
    };
    let vert = flex.vert.as_chunks::<3>().0;
    let vertices = if vert.is_empty() { vertbody.len() } else { vert.len() };
    let place_vertex = |i: usize| {
        let offset = (!centered || interpolated).then(|| vert[i]);
        at(if rigid { vertbody[0] } else { vertbody[i] }, offset)
    };
    let node = flex.node.as_chunks::<3>().0;
    let place_node = |i: usize| at(nodebody[i], (!centered).then(|| node[i]));
    Some(Placed {
        vertex: (0..vertices).map(place_vertex).collect(),
        node: (0..nodebody.len()).map(place_node).collect(),
        vertbody: if interpolated { vec![-1; vertices] } else { vertbody },
        nodebody,
        rigid,
        centered,
    })
}

fn one(flex: &Flex, placed: Placed, strained: bool) -> Result<FlexNode<'_>, String> {
    let dim = flex.dim as usize;
    let Placed { vertbody, nodebody, rigid, centered, vertex, node } = placed;
    let interpolated = !nodebody.is_empty();
    let mut elem = flex.elem.clone();
    if dim == 3 {
        turn_alike(&mut elem, &vertex);
    }
    let edges = Edges::of(dim, &elem);
    let flaps = if dim == 2 { topology::flaps(&elem, &edges) } else { Vec::new() };
    let shell = Shell::of(dim, &elem);
    let bvh = hierarchy(flex, &elem, &shell.layer, &vertex)?;
    let mut compiled = FlexNode {
        spec: flex,
        rigid,
        centered,
        vertbody,
        nodebody,
        vertices: vertex.len(),
        elem,
        edges,
        flaps,
        shell,
        stiffness: Vec::new(),
        bending: Vec::new(),
        bvh,
        size: [0.0; 3],
        vert0: Vec::new(),
        node0: node,
    };
    if interpolated {
        interpolate(&mut compiled, &vertex, strained)?;
    } else {
        elastic(&mut compiled, &vertex)?;
        let root = compiled.bvh.aabb[0];
        compiled.size = std::array::from_fn(|k| root[3 + k] - flex.radius);
        let size = compiled.size;
        let inside = |x: f64, k: usize| (x - root[k]) / (2.0 * size[k]) + 0.5;
        compiled.vert0 = in_box(&vertex, |x, k| if size[k] > MINVAL { inside(x, k) } else { 0.5 });
    }
    Ok(compiled)
}

fn in_box(vertex: &[Vec3], inside: impl Fn(f64, usize) -> f64) -> Vec<Vec3> {
    vertex.iter().map(|p| std::array::from_fn(|k| inside(p[k], k))).collect()
}

/// Turns tetrahedra so that the sides turn outwards.
fn turn_alike(elem: &mut [i32], vertex: &[Vec3]) {
    for corners in elem.as_chunks_mut::<4>().0 {
        let [a, b, c, d] = corners.map(|v| vertex[v as usize]);
        if dot(cross(sub(b, a), sub(c, a)), sub(d, a)) > 0.0 {
            corners.swap(1, 2);
        }
    }
}

/// Boxes of the elements that collide. Its own boxes are those at rest; the simulation computes them at every step.
fn hierarchy(flex: &Flex, elem: &[i32], layer: &[i32], vertex: &[Vec3]) -> Result<Bvh, String> {
    let dim = flex.dim as usize;
    let active = |e: usize| dim < 3 || layer[e] < flex.activelayers;
    let mut leaves = Vec::new();
    for (e, corners) in elem.chunks_exact(dim + 1).enumerate().filter(|(e, _)| active(*e)) {
        let (mut low, mut high) = (vertex[corners[0] as usize], vertex[corners[0] as usize]);
        for &corner in &corners[1..] {
            for k in 0..3 {
                let x = vertex[corner as usize][k];
                (low[k], high[k]) = (low[k].min(x), high[k].max(x));
            }
        }
        let aabb: [f64; 6] = std::array::from_fn(|k| match k {
            0..3 => 0.5 * (high[k] + low[k]),
            _ => 0.5 * (high[k - 3] - low[k - 3]) + flex.radius,
        });
        let pos = [aabb[0], aabb[1], aabb[2]];
        leaves.push(Leaf { id: e as i32, pos, quat: None, aabb, collides: true });
    }
    match leaves.is_empty() {
        true => Err("no element is active: activelayers must be at least 1".into()),
        false => Ok(bvh::build(&leaves, [0.0; 3], [1.0, 0.0, 0.0, 0.0])),
    }
}

/// Elasticity of elements whose vertices move themselves.
fn elastic(node: &mut FlexNode<'_>, vertex: &[Vec3]) -> Result<(), String> {
    let flex = node.spec;
    if flex.young <= 0.0 {
        return Ok(());
    }
    let material = Material { young: flex.young, poisson: flex.poisson };
    let at = |v: i32| vertex[v as usize];
    let elements = node.elem.len() / (flex.dim as usize + 1);
    node.stiffness = vec![0.0; METRIC * elements];
    let rows = node.stiffness.chunks_exact_mut(METRIC).enumerate();
    let flat = |e: usize| format!("element {e} is flat: move its vertices apart");
    match flex.dim {
        2 if flex.elastic2d.stretches() => {
            for ((e, row), corners) in rows.zip(node.elem.as_chunks::<3>().0) {
                let form = elasticity::triangle(corners.map(at), material, flex.thickness);
                row[..6].copy_from_slice(&form.ok_or_else(|| flat(e))?);
            }
        }
        3 => {
            for ((e, row), corners) in rows.zip(node.elem.as_chunks::<4>().0) {
                row.copy_from_slice(
                    &elasticity::tetrahedron(corners.map(at), material).ok_or_else(|| flat(e))?,
                );
            }
        }
        _ => {}
    }
    if flex.dim == 2 && flex.elastic2d.bends() {
        for flap in &node.flaps {
            node.bending.extend(match flap[3] {
                -1 => [0.0; BENDING],
                _ => elasticity::bending(flap.map(at), material.shear(), flex.thickness),
            });
        }
    }
    Ok(())
}

/// The lattice of an interpolated flex: its axes, the places of vertices in it, and its elasticity.
fn interpolate(node: &mut FlexNode<'_>, vertex: &[Vec3], strained: bool) -> Result<(), String> {
    let flex = node.spec;
    let lattice = Lattice { order: flex.order as usize, cells: flex.cellcount.map(|c| c as usize) };
    let surface = flex.elastic2d != Elastic2d::None;
    // The axes belong to the first cell that a flexcomp found full, or to the first cell.
    let rotation = lattice.rotation(&flex.empty_cells, &node.node0)?;
    let mut empty = flex.empty_cells.clone();
    if !surface && empty.is_empty() && lattice.cells != [1; 3] {
        let cells = Cells { count: lattice.cells, bounds: bounds(vertex) };
        empty = cells::empty(&cells, flex.dim as usize, &node.elem, vertex.as_flattened());
    }
    node.node0 = lattice::turned(&rotation, &node.node0);
    if flex.young > 0.0 || strained {
        let elements = lattice.elements(surface, &empty);
        node.stiffness = stiffness(flex, &elements, &node.node0, strained)?;
    }
    if flex.elastic2d.bends() && flex.young > 0.0 {
        let material = Material { young: flex.young, poisson: flex.poisson };
        node.bending = shell_bending::bending(lattice, &node.node0, material, flex.thickness);
    }
    place_in_lattice(node, &rotation, vertex);
    Ok(())
}

fn bounds(points: &[Vec3]) -> [Vec3; 2] {
    points.iter().fold([[1e30; 3], [-1e30; 3]], |[low, high], p| {
        [std::array::from_fn(|k| low[k].min(p[k])), std::array::from_fn(|k| high[k].max(p[k]))]
    })
}

/// A matrix for each finite element, or its modes.
fn stiffness(
    flex: &Flex,
    elements: &[Option<lattice::FiniteElement>],
    node: &[Vec3],
    strained: bool,
) -> Result<Vec<f64>, String> {
    let order = flex.order as usize;
    let own = Material { young: flex.young, poisson: flex.poisson };
    let material = if strained { STRAIN } else { own };
    let nodes = elements.iter().flatten().next().map_or(0, |e| e.nodes.len());
    let width = 3 * nodes;
    let mut all = vec![0.0; elements.len() * width * width];
    for (element, out) in elements.iter().zip(all.chunks_exact_mut((width * width).max(1))) {
        let Some(element) = element else { continue };
        let matrix = linear::stiffness(element, node, order, material, flex.thickness)?;
        if !strained {
            out.copy_from_slice(&matrix);
            continue;
        }
        let (count, mut packed) = modes::pack(&matrix, width);
        if let Some(across) = element.across {
            let corners: Vec<Vec3> = element.nodes.iter().map(|&n| node[n]).collect();
            modes::add_twist((count, &mut packed), &corners, across, material, flex.thickness);
        }
        out.copy_from_slice(&packed);
    }
    Ok(all)
}

/// Vertices in the box of the nodes, along the axes of the lattice.
fn place_in_lattice(node: &mut FlexNode<'_>, rotation: &Mat3, vertex: &[Vec3]) {
    let [low, high] = bounds(&node.node0);
    node.size = std::array::from_fn(|k| (high[k] - low[k]) / 2.0);
    let inside = |x: f64, k: usize| {
        let extent = high[k] - low[k];
        if extent > MINVAL { (x - low[k]) / extent } else { 0.5 }
    };
    node.vert0 = in_box(&lattice::turned(rotation, vertex), inside);
}
