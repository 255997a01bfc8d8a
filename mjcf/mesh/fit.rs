//! Primitive shapes fitted to a mesh: `geom` elements that name a mesh and a type other than mesh.

use super::compiled::CompiledMesh;

/// The shapes a mesh can be replaced by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Primitive {
    /// `size[0]` radius.
    Sphere,
    /// `size[0]` radius, `size[1]` half length of the straight part.
    Capsule,
    /// Half sizes.
    Ellipsoid,
    /// `size[0]` radius, `size[1]` half length.
    Cylinder,
    /// Half sizes.
    Box,
}

/// `geom_size` of `shape` fitted to `mesh`, and the shape's centre in the mesh's inertial frame.
/// With `fitaabb` the shape's bounding box contains the mesh's, else its inertia is close.
/// Entries a shape does not use keep the value in `size`, multiplied by `fitscale` like the others.
pub fn fit_primitive(
    mesh: &CompiledMesh,
    shape: Primitive,
    fitaabb: bool,
    fitscale: f64,
    size: [f64; 3],
) -> ([f64; 3], [f64; 3]) {
    let (fitted, center) =
        if fitaabb { enclose(mesh, shape) } else { (equal_inertia(mesh, shape), [0.0; 3]) };
    let size = std::array::from_fn(|k| fitted[k].unwrap_or(size[k]) * fitscale);
    (size, center)
}

fn equal_inertia(mesh: &CompiledMesh, shape: Primitive) -> [Option<f64>; 3] {
    let [x, y, z] = mesh.boxsz;
    match shape {
        Primitive::Sphere => [Some((x + y + z) / 3.0), None, None],
        Primitive::Capsule => {
            let radius = (x + y) / 2.0;
            [Some(radius), Some((z - radius / 2.0).max(0.0)), None]
        }
        Primitive::Cylinder => [Some((x + y) / 2.0), Some(z), None],
        Primitive::Ellipsoid | Primitive::Box => [Some(x), Some(y), Some(z)],
    }
}

fn enclose(mesh: &CompiledMesh, shape: Primitive) -> ([Option<f64>; 3], [f64; 3]) {
    let a = &mesh.aamm;
    let center: [f64; 3] = std::array::from_fn(|k| (a[k] + a[k + 3]) / 2.0);
    let [x, y, z] = std::array::from_fn(|k| a[k + 3] - center[k]);
    let size = match shape {
        Primitive::Sphere => [Some(x.max(y).max(z)), None, None],
        Primitive::Capsule => [Some(x.max(y)), Some(z - x.max(y)), None],
        Primitive::Cylinder => [Some(x.max(y)), Some(z), None],
        Primitive::Ellipsoid | Primitive::Box => [Some(x), Some(y), Some(z)],
    };
    (size, center)
}
