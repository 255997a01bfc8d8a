//! Points and elements of a flexcomp: computed, given in place, or read from a file.

use std::collections::HashMap;

use super::super::reader::Reader;
use super::pins;
use super::points::Points;
use crate::asset::AssetError;
use crate::budget::{Content, ELEMENT, decoded};
use crate::diagnostic::Loc;
use crate::flex::{Cloud, Regular, Shape, decode_gmsh};
use crate::mesh::{Format, RawMesh, decode};
use crate::spec::Flexcomp;
use crate::vector::{cross, dot, sub};
use crate::xml::Element;
use physics::model::bounds::MINVAL;

/// Elements of the tree that a point asks for: a body and three joints.
const PER_POINT: usize = 4;

impl Reader<'_> {
    /// Points and elements as the element gives them; `None` when they are beyond the budget.
    pub(super) fn flexcomp_cloud(
        &mut self,
        element: &Element,
        wanted: &Flexcomp,
    ) -> Result<Option<Cloud>, (Loc, String)> {
        let dim = wanted.flex.dim;
        let mut cloud = match wanted.shape {
            Shape::Direct => Cloud {
                dim,
                point: wanted.point.clone(),
                element: wanted.element.clone(),
                ..Cloud::default()
            },
            Shape::Mesh | Shape::Gmsh => match self.flexcomp_file(element, wanted)? {
                Some(cloud) => cloud,
                None => return Ok(None),
            },
            shape => {
                let count = wanted.count.map(|n| n as usize);
                let points = count.iter().fold(1_usize, |n, &c| n.saturating_mul(c));
                let nodes = if wanted.rigid { 0 } else { pins::nodes(wanted) };
                if !self.charge_points(element, nodes.saturating_add(points)) {
                    return Ok(None);
                }
                let textured = wanted.texcoord.is_empty() && !wanted.flex.material.is_empty();
                let regular = Regular { shape, dim, count, spacing: wanted.spacing, textured };
                let cloud = regular.build().map_err(|message| (element.loc, message))?;
                if !wanted.point.is_empty() || !wanted.element.is_empty() {
                    let message =
                        "points and elements are computed: remove 'point' and 'element', or type=\"direct\"";
                    return Err((element.loc, message.into()));
                }
                return Ok(Some(with_given_texcoord(cloud, wanted)));
            }
        };
        let nodes = if wanted.rigid { 0 } else { pins::nodes(wanted) };
        if !self.charge_points(element, nodes.saturating_add(cloud.point.len() / 3)) {
            return Ok(None);
        }
        if cloud.texcoord.is_empty() {
            cloud = with_given_texcoord(cloud, wanted);
        }
        Ok(Some(cloud))
    }

    fn charge_points(&mut self, element: &Element, points: usize) -> bool {
        let bytes = points.saturating_mul(PER_POINT * ELEMENT);
        self.charge(element.loc, &format!("<flexcomp> of {points} points"), bytes)
    }

    /// What a file holds; `None` when it is beyond the budget.
    fn flexcomp_file(
        &mut self,
        element: &Element,
        wanted: &Flexcomp,
    ) -> Result<Option<Cloud>, (Loc, String)> {
        let Some(attribute) = element.attribute("file") else {
            return Err((element.loc, "it needs the attribute 'file'".into()));
        };
        let at = attribute.value_loc;
        let (file, _) = self.asset_file(attribute, &self.spec.compiler.meshdir.clone());
        let bytes = self.expansion.files.read(&file);
        let bytes = bytes.map_err(|error| (at, format!("cannot read '{file}': {error}")))?;
        if !self.charge(at, &format!("file '{file}'"), decoded(Content::Mesh, &bytes)) {
            return Ok(None);
        }
        let cloud = match wanted.shape {
            Shape::Gmsh => decode_gmsh(&bytes, &file).map_err(|error| (at, error.to_string()))?,
            _ => of_mesh(&bytes, &file, wanted).map_err(|message| (at, message))?,
        };
        Ok(Some(cloud))
    }
}

fn with_given_texcoord(cloud: Cloud, wanted: &Flexcomp) -> Cloud {
    match wanted.texcoord.is_empty() {
        true => cloud,
        false => Cloud { texcoord: wanted.texcoord.clone(), ..cloud },
    }
}

/// The surface of a mesh, its lines, or the tetrahedra between its triangles and the origin.
fn of_mesh(bytes: &[u8], file: &str, wanted: &Flexcomp) -> Result<Cloud, String> {
    let mesh = decode(bytes, file, "").map_err(|error: AssetError| error.to_string())?;
    if mesh.format == Format::Msh {
        return Err(format!("'{file}' is a legacy mesh of MuJoCo: give STL or OBJ, or type=\"gmsh\""));
    }
    let mesh = welded(mesh);
    if mesh.vert.iter().any(|x| !x.is_finite()) {
        return Err(format!("'{file}' has a vertex that is not finite"));
    }
    let vertices = mesh.vert.len() / 3;
    if let Some(&lost) = mesh.face.iter().chain(&mesh.line).find(|&&v| v < 0 || v as usize >= vertices) {
        return Err(format!("'{file}' has a face with vertex {lost}, and there are {vertices}"));
    }
    let point = mesh.vert.iter().map(|&x| f64::from(x)).collect();
    let mut cloud = Cloud { dim: wanted.flex.dim, point, ..Cloud::default() };
    if !mesh.texcoord.is_empty() {
        (cloud.texcoord, cloud.elemtexcoord) = (mesh.texcoord, mesh.facetexcoord);
    }
    let faces = mesh.face.as_chunks::<3>().0;
    match wanted.flex.dim {
        1 if faces.is_empty() => cloud.element = mesh.line,
        1 => cloud.element = faces.iter().flat_map(|f| [f[0], f[1]]).collect(),
        2 => cloud.element = mesh.face,
        _ => {
            let origin = wanted.origin.ok_or("tetrahedra over a mesh need the attribute 'origin'")?;
            fill(&mut cloud, faces, origin);
        }
    }
    if cloud.element.is_empty() {
        return Err(format!("'{file}' has nothing between its vertices"));
    }
    Ok(cloud)
}

/// Vertices of the same coordinates become one, numbered by their first.
fn welded(mesh: RawMesh) -> RawMesh {
    let mut numbers: HashMap<[u32; 3], i32> = HashMap::new();
    let (mut vert, mut renumbered) = (Vec::new(), Vec::new());
    for v in mesh.vert.as_chunks::<3>().0 {
        // Zeros of both signs are equal.
        let key = v.map(|x| (x + 0.0).to_bits());
        let next = (vert.len() / 3) as i32;
        let number = *numbers.entry(key).or_insert(next);
        if number == next {
            vert.extend(v);
        }
        renumbered.push(number);
    }
    let renumber = |list: Vec<i32>| -> Vec<i32> {
        let number = |v: i32| usize::try_from(v).ok().and_then(|v| renumbered.get(v)).copied();
        list.into_iter().map(|v| number(v).unwrap_or(-1)).collect()
    };
    RawMesh { vert, face: renumber(mesh.face), line: renumber(mesh.line), ..mesh }
}

/// Puts `origin` before the points, and a tetrahedron between it and every triangle that it is behind.
fn fill(cloud: &mut Cloud, faces: &[[i32; 3]], origin: [f64; 3]) {
    cloud.point.splice(0..0, origin);
    let point = |v: i32| *cloud.point[3 * v as usize..].first_chunk::<3>().unwrap_or(&origin);
    let mut element = Vec::with_capacity(4 * faces.len());
    for face in faces {
        let corners = face.map(|v| v + 1);
        let [a, b, c] = corners.map(|v| sub(point(v), origin));
        if dot(cross(a, b), c) >= MINVAL {
            element.extend([0, corners[0], corners[1], corners[2]]);
        }
    }
    cloud.element = element;
}

/// Removes the points that no element has.
pub(super) fn drop_unused(points: &mut Points) {
    let cloud = &mut points.cloud;
    let n = cloud.point.len() / 3;
    let mut used = vec![false; n];
    cloud.element.iter().for_each(|&p| used[p as usize] = true);
    if used.iter().all(|&u| u) {
        return;
    }
    let mut number = vec![0; n];
    let mut kept = 0;
    for p in 0..n {
        number[p] = kept as i32;
        if used[p] {
            cloud.point.copy_within(3 * p..3 * p + 3, 3 * kept);
            // Texture coordinates move with points, whatever numbers them.
            if 2 * p + 2 <= cloud.texcoord.len() {
                cloud.texcoord.copy_within(2 * p..2 * p + 2, 2 * kept);
            }
            points.pinned[kept] = points.pinned[p];
            kept += 1;
        }
    }
    cloud.point.truncate(3 * kept);
    cloud.texcoord.truncate(2 * kept);
    cloud.element.iter_mut().for_each(|p| *p = number[*p as usize]);
}
