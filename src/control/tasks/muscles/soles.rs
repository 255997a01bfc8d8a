//! The ground as one more muscle: forces that push capsules of feet off the floor, within their cones of friction.

use crate::error::ControlError;
use env::Env;
use nalgebra::DMatrix;
use physics::elements::{GeomId, SiteId};
use physics::math::{Vec3, cross};
use physics::model::GeomType;
use physics::{Data, Model};

/// Height below which an end of a capsule bears weight \[m\].
const AIR: f64 = 0.006;
/// Friction that is relied on.
const FRICTION: f64 = 0.5;
/// Largest force along an edge of a cone, as a share of the body's weight.
const EDGE: f64 = 0.5;

/// The capsules under a foot.
pub struct Sole {
    capsules: Vec<GeomId>,
}

impl Sole {
    /// The capsules that collide on the body that has the site `foot`.
    ///
    /// # Errors
    /// There are none.
    pub fn new(env: &Env, foot: SiteId) -> Result<Self, ControlError> {
        let m = &env.scene().model;
        let bears = |geom: &GeomId| {
            let id = geom.index();
            m.geom_bodyid[id] == m.site_bodyid[foot.index()]
                && m.geom_type[id] == GeomType::Capsule as i32
                && m.geom_contype[id] != 0
        };
        let capsules: Vec<_> = m.geoms().filter(bears).collect();
        if capsules.is_empty() {
            let name = m.site(foot).name();
            return Err(ControlError::unfit(env, format!("no capsule bears the foot {name}")));
        }
        Ok(Sole { capsules })
    }

    /// Lowest points of the ends of a capsule, from its middle, and their heights over the floor \[m\].
    fn ends(m: &Model, d: &Data, capsule: GeomId) -> [(Vec3, f64); 2] {
        let (id, axes) = (capsule.index(), &d.kin.geom_xmat[capsule.index()]);
        let [radius, half, _] = m.geom_size[id];
        [half, -half].map(|along| {
            let point = [along * axes[2], along * axes[5], along * axes[8] - radius];
            (point, d.kin.geom_xpos[id][2] + point[2])
        })
    }

    /// Height of the lowest point over the floor \[m\].
    pub fn height(&self, m: &Model, d: &Data) -> f64 {
        let ends = self.capsules.iter().flat_map(|capsule| Self::ends(m, d, *capsule));
        ends.map(|(_, height)| height).fold(f64::INFINITY, f64::min)
    }

    /// What the largest forces along edges of cones do to all degrees of freedom (nv by edges), of points that are on the floor.
    pub fn pushes(&self, m: &Model, d: &Data, weight: f64) -> DMatrix<f64> {
        let mut columns = Vec::new();
        for &capsule in &self.capsules {
            let jacobian = d.jacobian(m, capsule);
            for (point, height) in Self::ends(m, d, capsule) {
                if height > AIR {
                    continue;
                }
                for [x, y] in [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]] {
                    let force = [FRICTION * x, FRICTION * y, 1.0].map(|part| part * EDGE * weight);
                    let start = columns.len();
                    columns.resize(start + m.nv, 0.0);
                    jacobian.add_wrench(force, cross(point, force), &mut columns[start..]);
                }
            }
        }
        DMatrix::from_vec(m.nv, columns.len() / m.nv, columns)
    }
}
