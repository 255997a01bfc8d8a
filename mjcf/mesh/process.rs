//! From raw arrays to compiled rows: completion, checks, mesh frame, mass, inertial frame, hierarchy.

use super::compiled::CompiledMesh;
use super::graph::{extrema, graph_array};
use super::hull::{Hull, convex_hull};
use super::mass::{MeshInertia, center_of_mass, face_centroid, inertia, triangle};
use super::normals::{normalize_given, vertex_normals};
use super::octree::{self, Octree};
use super::polygons::Polygons;
use super::source::{Format, MeshSource, RawMesh};
use crate::asset::AssetError;
use crate::vector::{apply, cross, dot, matrix, normalize, principal_axes, sub, transpose};
use physics::geometry::hierarchy::{self as bvh, Bvh, Leaf};
use physics::model::bounds::MINVAL;

/// The arrays of a mesh while it is processed, coordinates in double precision.
struct Arrays {
    vert: Vec<[f64; 3]>,
    normal: Vec<[f32; 3]>,
    texcoord: Vec<[f32; 2]>,
    face: Vec<[i32; 3]>,
    facenormal: Vec<[i32; 3]>,
    facetexcoord: Vec<[i32; 3]>,
}

/// Compiles one mesh.
pub fn process(source: MeshSource) -> Result<CompiledMesh, AssetError> {
    let MeshSource { name, file, inline, scale, refpos, refquat, inertia: mode, .. } = source;
    let mirrored = scale[0] * scale[1] * scale[2] <= 0.0;
    let raw = merge(file, inline, mirrored)?;
    let format = raw.format;
    let mut arrays = check(raw, &name)?;
    if mode == MeshInertia::Exact {
        check_orientation(&arrays, &name)?;
    }
    let hull = if source.needhull || mode == MeshInertia::Convex || arrays.face.is_empty() {
        let hull = convex_hull(&arrays.vert, source.maxhullvert)
            .map_err(|why| AssetError::geometry(format!("mesh '{name}': {why}")))?;
        Some(hull)
    } else {
        None
    };
    if let (true, Some(hull)) = (arrays.face.is_empty(), &hull) {
        arrays.face = hull.face.clone();
    }
    complete(&mut arrays, source.smoothnormal, format, &name)?;
    let mut polygons = match &hull {
        Some(hull) => Polygons::of_hull(&arrays.vert, &hull.face),
        None => Polygons::default(),
    };
    if mirrored {
        for rows in [&mut arrays.face, &mut arrays.facenormal, &mut arrays.facetexcoord] {
            rows.iter_mut().for_each(|f| f.swap(1, 2));
        }
    }
    place(&mut arrays, refpos, refquat, scale);
    let mut mass = weigh(&arrays, hull.as_ref(), mode, &name)?;
    if source.keep_frame {
        (mass.com, mass.quat) = ([0.0; 3], [1.0, 0.0, 0.0, 0.0]);
    }
    let aamm = to_inertial_frame(&mut arrays, mass.com, mass.quat);
    check_size(&arrays.vert, &name)?;
    polygons.update_normals(&arrays.vert);
    let bvh = face_hierarchy(&arrays);
    let octree = match source.octree {
        Some(depth) => octree::build(&arrays.vert, &arrays.face, &aamm, depth, &bvh),
        None => Octree::default(),
    };
    Ok(CompiledMesh { octree, ..finish(arrays, hull, polygons, mass, aamm, bvh, scale) })
}

/// File arrays completed by inline ones; an array may not come from both.
fn merge(file: Option<RawMesh>, inline: RawMesh, mirrored: bool) -> Result<RawMesh, AssetError> {
    let Some(mut raw) = file else { return Ok(inline) };
    if raw.format == Format::Msh && mirrored {
        // The legacy format has its vertex indices, and only these, flipped on loading.
        raw.face.chunks_exact_mut(3).for_each(|f| f.swap(1, 2));
    }
    fn either<T>(file: Vec<T>, inline: Vec<T>, what: &str) -> Result<Vec<T>, AssetError> {
        match (file.is_empty(), inline.is_empty()) {
            (false, false) => {
                Err(AssetError::inconsistent(format!("repeated {what}: in the mesh file and in the element")))
            }
            (true, _) => Ok(inline),
            (false, true) => Ok(file),
        }
    }
    Ok(RawMesh {
        format: raw.format,
        normal: either(raw.normal, inline.normal, "normal")?,
        texcoord: either(raw.texcoord, inline.texcoord, "texcoord")?,
        face: either(raw.face, inline.face, "face")?,
        vert: either(raw.vert, inline.vert, "vertex")?,
        facenormal: either(raw.facenormal, inline.facenormal, "facenormal")?,
        facetexcoord: either(raw.facetexcoord, inline.facetexcoord, "facetexcoord")?,
        line: raw.line,
    })
}

/// Sizes and indices, so that later stages can index without checks.
fn check(raw: RawMesh, name: &str) -> Result<Arrays, AssetError> {
    if raw.vert.len() < 12 {
        return Err(AssetError::inconsistent(format!("mesh '{name}' has fewer than 4 vertices")));
    }
    let multiple = |length: usize, of: usize, what: &str| {
        if length.is_multiple_of(of) {
            return Ok(());
        }
        Err(AssetError::inconsistent(format!(
            "mesh '{name}': {what} has {length} numbers, not a multiple of {of}"
        )))
    };
    multiple(raw.vert.len(), 3, "vertex")?;
    multiple(raw.normal.len(), 3, "normal")?;
    multiple(raw.texcoord.len(), 2, "texcoord")?;
    multiple(raw.face.len(), 3, "face")?;
    multiple(raw.facenormal.len(), 3, "facenormal")?;
    multiple(raw.facetexcoord.len(), 3, "facetexcoord")?;
    let nvert = raw.vert.len() / 3;
    if let Some(at) = raw.vert.iter().position(|x| !x.is_finite()) {
        return Err(AssetError::geometry(format!("mesh '{name}': vertex {} is not finite", at / 3)));
    }
    if !raw.texcoord.is_empty()
        && raw.facetexcoord.is_empty()
        && raw.format != Format::Obj
        && raw.texcoord.len() != 2 * nvert
    {
        return Err(AssetError::inconsistent(format!(
            "mesh '{name}': texcoord must have two numbers per vertex when faces give no texcoord indices"
        )));
    }
    if let Some(at) = raw.face.iter().position(|&v| v < 0 || v as usize >= nvert) {
        return Err(AssetError::inconsistent(format!(
            "mesh '{name}': vertex {} of face {} does not exist",
            raw.face[at],
            at / 3
        )));
    }
    let triples = |v: &[i32]| v.chunks_exact(3).map(|f| [f[0], f[1], f[2]]).collect();
    Ok(Arrays {
        vert: raw.vert.chunks_exact(3).map(|v| [v[0].into(), v[1].into(), v[2].into()]).collect(),
        normal: raw.normal.chunks_exact(3).map(|v| [v[0], v[1], v[2]]).collect(),
        texcoord: raw.texcoord.chunks_exact(2).map(|v| [v[0], v[1]]).collect(),
        face: triples(&raw.face),
        facenormal: triples(&raw.facenormal),
        facetexcoord: triples(&raw.facetexcoord),
    })
}

/// In a consistently oriented mesh no two faces run through an edge in the same direction.
fn check_orientation(arrays: &Arrays, name: &str) -> Result<(), AssetError> {
    let mut edges = Vec::with_capacity(3 * arrays.face.len());
    for &[a, b, c] in &arrays.face {
        let [p, q, r] = [a, b, c].map(|v| arrays.vert[v as usize]);
        if triangle(p, q, r).area > MINVAL.sqrt() {
            edges.extend([(a, b), (b, c), (c, a)]);
        }
    }
    edges.sort_unstable();
    match edges.windows(2).find(|pair| pair[0] == pair[1]) {
        None => Ok(()),
        Some(pair) => Err(AssetError::geometry(format!(
            "mesh '{name}': two triangles follow the edge from vertex {} to vertex {}: reverse one of them",
            pair[0].0 + 1,
            pair[0].1 + 1
        ))),
    }
}

/// Computes missing normals and fills the index arrays that follow from others.
fn complete(arrays: &mut Arrays, smooth: bool, format: Format, name: &str) -> Result<(), AssetError> {
    let nface = arrays.face.len();
    if arrays.normal.is_empty() {
        arrays.normal = vertex_normals(&arrays.vert, &arrays.face, smooth);
        arrays.facenormal = arrays.face.clone();
    }
    if arrays.facenormal.is_empty() {
        let per_vertex = (arrays.normal.len() / arrays.vert.len()) as i32;
        arrays.facenormal = arrays.face.iter().map(|f| f.map(|v| per_vertex * v)).collect();
    }
    if arrays.texcoord.is_empty() {
        arrays.facetexcoord = vec![[0; 3]; nface];
    } else if arrays.facetexcoord.is_empty() {
        arrays.facetexcoord = arrays.face.clone();
    }
    // Corners of a file may lack a normal or a texture coordinate; those are -1.
    let least = if format == Format::Obj { -1 } else { 0 };
    for (what, rows, count) in [
        ("facenormal", &arrays.facenormal, arrays.normal.len()),
        ("facetexcoord", &arrays.facetexcoord, arrays.texcoord.len().max(1)),
    ] {
        if rows.len() != nface {
            return Err(AssetError::inconsistent(format!(
                "mesh '{name}': {what} has {} rows for {nface} faces",
                rows.len()
            )));
        }
        if let Some(index) = rows.iter().flatten().find(|&&i| i < least || i >= count as i32) {
            return Err(AssetError::inconsistent(format!(
                "mesh '{name}': {what} index {index} does not exist"
            )));
        }
    }
    Ok(())
}

/// Applies `refpos`, `refquat` and `scale`; normals turn along and scale inversely.
fn place(arrays: &mut Arrays, refpos: [f64; 3], mut refquat: [f64; 4], scale: [f64; 3]) {
    if refpos != [0.0; 3] {
        arrays.vert.iter_mut().for_each(|v| *v = sub(*v, refpos));
    }
    if refquat != [1.0, 0.0, 0.0, 0.0] {
        normalize(&mut refquat);
        let inverse = transpose(&matrix(refquat));
        arrays.vert.iter_mut().for_each(|v| *v = apply(&inverse, *v));
        for n in &mut arrays.normal {
            *n = apply(&inverse, n.map(f64::from)).map(|x| x as f32);
        }
    }
    if scale != [1.0; 3] {
        for v in &mut arrays.vert {
            for k in 0..3 {
                v[k] *= scale[k];
            }
        }
        for n in &mut arrays.normal {
            for k in 0..3 {
                n[k] = (f64::from(n[k]) / scale[k]) as f32;
            }
        }
    }
    normalize_given(&mut arrays.normal);
}

/// Mass properties at unit density.
struct Mass {
    volume: f64,
    com: [f64; 3],
    quat: [f64; 4],
    boxsz: [f64; 3],
}

fn weigh(arrays: &Arrays, hull: Option<&Hull>, mode: MeshInertia, name: &str) -> Result<Mass, AssetError> {
    let fail = |what: &str| Err(AssetError::geometry(format!("mesh '{name}': {what}")));
    let (area, apex) = face_centroid(&arrays.vert, &arrays.face);
    if area.is_nan() || area < MINVAL {
        return fail(&format!(
            "its triangles have almost no area, {area:.1e} m²: check the units, or set 'scale'"
        ));
    }
    let solid = match (mode, hull) {
        (MeshInertia::Convex, Some(hull)) => &hull.face,
        _ => &arrays.face,
    };
    let (volume, com) = center_of_mass(&arrays.vert, solid, apex, mode);
    if volume < 0.0 {
        return fail("its triangles face inwards: order their corners counterclockwise as seen from outside");
    }
    if volume.is_nan() || volume < MINVAL {
        return fail(&format!(
            "it encloses almost no volume, {volume:.1e} m³: set inertia=\"shell\" for a thin mesh"
        ));
    }
    let (volume, matrix) = inertia(&arrays.vert, solid, com, mode);
    let ([a, b, c], quat) = principal_axes(&matrix);
    if c.is_nan() || c <= 0.0 {
        return fail("inertia is not positive");
    }
    let violates = |x: f64, y: f64, z: f64| x + y < z * (1.0 - 1e-6) - 1e-9;
    if violates(a, b, c) || violates(a, c, b) || violates(b, c, a) {
        return fail("principal inertias violate A + B >= C");
    }
    let half = |sum: f64| 0.5 * (6.0 * sum / volume).sqrt();
    let boxsz = [half(b + c - a), half(a + c - b), half(a + b - c)];
    Ok(Mass { volume, com, quat, boxsz })
}

/// Moves vertices and normals to the inertial frame, returns the bounding box (minimum, maximum).
fn to_inertial_frame(arrays: &mut Arrays, com: [f64; 3], quat: [f64; 4]) -> [f64; 6] {
    let turn = matrix([quat[0], -quat[1], -quat[2], -quat[3]]);
    let mut aamm = [1e10, 1e10, 1e10, -1e10, -1e10, -1e10];
    for v in &mut arrays.vert {
        *v = apply(&turn, sub(*v, com));
        for k in 0..3 {
            aamm[k] = f64::min(aamm[k], v[k]);
            aamm[k + 3] = f64::max(aamm[k + 3], v[k]);
        }
    }
    for n in &mut arrays.normal {
        *n = apply(&turn, n.map(f64::from)).map(|x| x as f32);
    }
    aamm
}

/// Vertices are kept in single precision.
fn check_size(vert: &[[f64; 3]], name: &str) -> Result<(), AssetError> {
    match vert.as_flattened().iter().find(|x| !(**x as f32).is_finite()) {
        None => Ok(()),
        Some(x) => Err(AssetError::geometry(format!(
            "mesh '{name}': a coordinate about the centre of mass is {x:.3e}, beyond single precision; scale it down"
        ))),
    }
}

/// Hierarchy of the faces, split by their circumcentres.
fn face_hierarchy(arrays: &Arrays) -> Bvh {
    let leaves: Vec<Leaf> = arrays
        .face
        .iter()
        .enumerate()
        .map(|(id, &f)| {
            let corners = f.map(|v| arrays.vert[v as usize]);
            Leaf {
                id: id as i32,
                pos: circumcenter(corners),
                quat: None,
                aabb: face_box(corners),
                collides: true,
            }
        })
        .collect();
    bvh::build(&leaves, [0.0; 3], [1.0, 0.0, 0.0, 0.0])
}

/// Not a number for degenerate triangles.
fn circumcenter([p, q, r]: [[f64; 3]; 3]) -> [f64; 3] {
    let (a, b) = (sub(p, r), sub(q, r));
    let n = cross(a, b);
    let (aa, bb) = (dot(a, a), dot(b, b));
    let area = dot(n, n).sqrt();
    let offset = cross(std::array::from_fn(|k| aa * b[k] - bb * a[k]), n);
    std::array::from_fn(|k| offset[k] / (2.0 * area * area) + r[k])
}

fn face_box(corners: [[f64; 3]; 3]) -> [f64; 6] {
    let lo: [f64; 3] = std::array::from_fn(|k| corners[0][k].min(corners[1][k]).min(corners[2][k]));
    let hi: [f64; 3] = std::array::from_fn(|k| corners[0][k].max(corners[1][k]).max(corners[2][k]));
    std::array::from_fn(|k| if k < 3 { 0.5 * (lo[k] + hi[k]) } else { 0.5 * (hi[k - 3] - lo[k - 3]) })
}

fn finish(
    arrays: Arrays,
    hull: Option<Hull>,
    polygons: Polygons,
    mass: Mass,
    aamm: [f64; 6],
    bvh: Bvh,
    scale: [f64; 3],
) -> CompiledMesh {
    let vert: Vec<[f32; 3]> = arrays.vert.iter().map(|v| v.map(|x| x as f32)).collect();
    let graph = hull.as_ref().map(graph_array).unwrap_or_default();
    let extrema = hull.as_ref().map(|hull| extrema(&vert, &hull.vert)).unwrap_or([0; 27]);
    let map = polygons.by_vertex(vert.len());
    CompiledMesh {
        normal: arrays.normal,
        texcoord: arrays.texcoord,
        face: arrays.face,
        facenormal: arrays.facenormal,
        facetexcoord: arrays.facetexcoord,
        graph,
        extrema,
        poly_vertadr: polygons.vertadr(),
        poly_vertnum: polygons.paths.iter().map(|p| p.len() as i32).collect(),
        poly_vert: polygons.paths.concat(),
        poly_normal: polygons.normal,
        poly_mapadr: map.adr,
        poly_mapnum: map.num,
        poly_map: map.polygon,
        octree: Octree::default(),
        scale,
        pos: mass.com,
        quat: mass.quat,
        aamm,
        boxsz: mass.boxsz,
        volume: mass.volume,
        bvh,
        vert,
    }
}
