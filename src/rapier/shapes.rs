//! Geoms of a model as shapes of parry.

use crate::convert::{pose, vector};
use parry3d_f64::math::{Pose, Rotation, Vector};
use parry3d_f64::shape::SharedShape;
use parry3d_f64::transformation::try_convex_hull;
use parry3d_f64::utils::Array2;
use physics::Model;
use physics::model::{GeomType, NotSimulated, ObjType};
use std::f64::consts::FRAC_PI_2;

/// A geom as a shape of parry.
#[derive(Clone)]
pub struct GeomShape {
    /// The geom.
    pub geom: usize,
    /// The body that it is fixed to.
    pub body: usize,
    /// Pose of the shape in the frame of the body \[m\]. The axes of parry's cylinders and height fields differ from
    /// MuJoCo's, so this may be rotated relative to the frame of the geom.
    pub pose: Pose,
    /// The shape; sizes in m.
    pub shape: SharedShape,
}

/// Number of times that the edges of an icosahedron are halved to approximate an ellipsoid.
const HALVINGS: usize = 3;

/// All geoms of a model as shapes of parry, in the order of geoms, for parry's distances, ray casts, projections and continuous
/// collision detection.
///
/// | geom | shape | exact |
/// |---|---|---|
/// | plane | half-space, of any normal | yes |
/// | sphere, capsule, box, cylinder | ball, capsule, cuboid, cylinder | yes |
/// | ellipsoid | polyhedron of 642 vertices; a ball where all sizes are equal | its surface is within 0.4 % of each size |
/// | mesh | convex hull, as MuJoCo collides it | yes, but for coplanar vertices |
/// | height field | surface without its base | yes, but open below |
///
/// A mesh is one hull because that is all MJCF says of it: a model has no decomposition into convex parts, and whoever wants a hollow
/// body to be hollow writes several geoms, of which each is a shape here too, or a signed distance field, which is refused. Nothing is
/// decomposed here, as contacts would then be others than the model's. A program that wants it for queries of its own gives `mesh_vert` and
/// `mesh_face` to parry's `SharedShape::convex_decomposition` ([`parry`](crate::parry)).
///
/// ```
/// use parry3d_f64::query;
///
/// let text = "<mujoco><worldbody><body pos='0 0 2'><freejoint/><geom size='.5'/></body>
///     <geom type='plane' size='1 1 1'/></worldbody></mujoco>";
/// let model = mjcf::load_str(text)?.model;
/// let shapes = robohive_rapier::shapes_of(&model)?;
/// // The plane belongs to the world, which comes first.
/// let ball_at = robohive_rapier::rapier::math::Pose::translation(0.0, 0.0, 2.0);
/// let gap = query::distance(&shapes[0].pose, &*shapes[0].shape, &(ball_at * shapes[1].pose), &*shapes[1].shape)?;
/// assert!((gap.distance - 1.5).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// The first geom that has no such shape: a signed distance field, or a mesh whose vertices enclose no volume.
pub fn shapes_of(m: &Model) -> Result<Vec<GeomShape>, NotSimulated> {
    (0..m.ngeom).map(|g| shape_of(m, g)).collect()
}

/// One geom as a shape of parry.
///
/// # Errors
/// The geom has no such shape, see [`shapes_of`].
pub fn shape_of(m: &Model, g: usize) -> Result<GeomShape, NotSimulated> {
    let [a, b, c] = m.geom_size[g];
    let upright = Pose::from_rotation(Rotation::from_rotation_x(FRAC_PI_2));
    let (turned, shape) = match GeomType::from_code(m.geom_type[g]) {
        Some(GeomType::Plane) => (Pose::IDENTITY, SharedShape::halfspace(Vector::Z)),
        Some(GeomType::Sphere) => (Pose::IDENTITY, SharedShape::ball(a)),
        Some(GeomType::Capsule) => (Pose::IDENTITY, SharedShape::capsule_z(b, a)),
        Some(GeomType::Box) => (Pose::IDENTITY, SharedShape::cuboid(a, b, c)),
        Some(GeomType::Cylinder) => (upright, SharedShape::cylinder(b, a)),
        Some(GeomType::Ellipsoid) if a == b && b == c => (Pose::IDENTITY, SharedShape::ball(a)),
        Some(GeomType::Ellipsoid) => (Pose::IDENTITY, ellipsoid(m, g)?),
        Some(GeomType::Mesh) => (Pose::IDENTITY, mesh(m, g)?),
        Some(GeomType::Hfield) => (upright, height_field(m, g)),
        Some(GeomType::Sdf) => return Err(refusal(m, g, "contacts of a signed distance field")),
        Some(GeomType::None) | None => return Err(refusal(m, g, "this type of geom")),
    };
    let local = pose(m.geom_pos[g], m.geom_quat[g]);
    Ok(GeomShape { geom: g, body: m.geom_bodyid[g] as usize, pose: local * turned, shape })
}

/// The shapes of geoms, in their order; `None` for those that touch nothing.
pub(crate) fn touching_shapes(m: &Model) -> impl Iterator<Item = Result<Option<GeomShape>, NotSimulated>> {
    (0..m.ngeom).map(|g| touches(m, g).then(|| shape_of(m, g)).transpose())
}

/// True where a geom may touch another.
fn touches(m: &Model, g: usize) -> bool {
    let named = |ids: &[i32]| ids.contains(&(g as i32));
    m.geom_contype[g] | m.geom_conaffinity[g] != 0 || named(&m.pair_geom1) || named(&m.pair_geom2)
}

fn refusal(m: &Model, g: usize, what: &str) -> NotSimulated {
    crate::refuse::of(m, ObjType::Geom, g, what)
}

/// A convex shape; `None` where the points enclose no volume.
fn hull(points: &[Vector]) -> Option<SharedShape> {
    let (vertices, triangles) = try_convex_hull(points).ok()?;
    SharedShape::convex_mesh(vertices, &triangles)
}

fn mesh(m: &Model, g: usize) -> Result<SharedShape, NotSimulated> {
    let id = m.geom_dataid[g] as usize;
    let first = m.mesh_vertadr[id] as usize;
    let vertices = &m.mesh_vert[first..first + m.mesh_vertnum[id] as usize];
    let points: Vec<_> = vertices.iter().map(|v| vector(v.map(f64::from))).collect();
    hull(&points).ok_or_else(|| refusal(m, g, "contacts of a mesh without volume"))
}

/// A polyhedron whose largest distances outside and inside the surface are equal.
fn ellipsoid(m: &Model, g: usize) -> Result<SharedShape, NotSimulated> {
    let (points, inner) = sphere_points();
    let scale = 2.0 / (1.0 + inner) * vector(m.geom_size[g]);
    let points: Vec<_> = points.into_iter().map(|p| p * scale).collect();
    hull(&points).ok_or_else(|| refusal(m, g, "an ellipsoid so thin"))
}

/// Points on the unit sphere, an icosahedron refined, and the radius of the ball inside its faces.
fn sphere_points() -> (Vec<Vector>, f64) {
    let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let corner = |a: f64, b: f64| [[0.0, a, b], [a, b, 0.0], [b, 0.0, a]];
    let signs = [(1.0, golden), (1.0, -golden), (-1.0, golden), (-1.0, -golden)];
    let mut points: Vec<Vector> =
        signs.iter().flat_map(|&(a, b)| corner(a, b)).map(|p| vector(p).normalize()).collect();
    let edge = 2.0 / (1.0 + golden * golden).sqrt();
    let near = |p: Vector, q: Vector| ((p - q).length() - edge).abs() < 1e-6;
    let mut faces = Vec::new();
    for i in 0..12 {
        for j in i + 1..12 {
            for k in j + 1..12 {
                let [p, q, r] = [points[i], points[j], points[k]];
                if near(p, q) && near(q, r) && near(p, r) {
                    faces.push([p, q, r]);
                }
            }
        }
    }
    for _ in 0..HALVINGS {
        faces = faces
            .into_iter()
            .flat_map(|[p, q, r]| {
                let [a, b, c] = [(p + q).normalize(), (q + r).normalize(), (r + p).normalize()];
                [[p, a, c], [a, q, b], [c, b, r], [a, b, c]]
            })
            .collect();
    }
    let flat = |[p, q, r]: &[Vector; 3]| (*q - *p).cross(*r - *p).normalize().dot(*p).abs();
    let inner = faces.iter().map(flat).fold(1.0, f64::min);
    // Neighbouring faces share corners up to rounding.
    points = faces.into_iter().flatten().collect();
    points.sort_by(|p, q| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)).then(p.z.total_cmp(&q.z)));
    let mut distinct: Vec<Vector> = Vec::new();
    for p in points {
        if !distinct.iter().rev().take(24).any(|q| (p - *q).length() < 1e-9) {
            distinct.push(p);
        }
    }
    (distinct, inner)
}

/// Parry's height fields rise along y, with rows along z and columns along x; turned upright, rows run against MuJoCo's y.
fn height_field(m: &Model, g: usize) -> SharedShape {
    let id = m.geom_dataid[g] as usize;
    let [rows, columns] = [m.hfield_nrow[id] as usize, m.hfield_ncol[id] as usize];
    let first = m.hfield_adr[id] as usize;
    let [x, y, height, _] = m.hfield_size[id];
    let at =
        |row: usize, column: usize| f64::from(m.hfield_data[first + (rows - 1 - row) * columns + column]);
    let heights: Vec<f64> =
        (0..columns).flat_map(|c| (0..rows).map(move |r| (r, c))).map(|(r, c)| at(r, c)).collect();
    SharedShape::heightfield(Array2::new(rows, columns, heights), Vector::new(2.0 * x, height, 2.0 * y))
}
