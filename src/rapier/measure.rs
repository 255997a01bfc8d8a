//! Whether a model becomes a world, and how far the world is from the model.

use crate::convert::array;
use crate::refuse::unsupported;
use crate::shapes::touching_shapes;
use crate::world::World;
use physics::inertia::full_inertia;
use physics::model::{JointType, NotSimulated};
use physics::{Data, Model};
use rapier3d_f64::math::Vector;
use rapier3d_f64::utils::AngularInertiaOps;

/// Everything in a model that keeps it from becoming a world, each by the name of its element; the first is the error of
/// [`World::new`].
///
/// ```
/// let text = "<mujoco><worldbody><geom name='glue' size='.1' adhesion='3'/></worldbody></mujoco>";
/// let refusals = robohive_rapier::refusals(&mjcf::load_str(text)?.model);
/// assert!(refusals[0].to_string().starts_with("geom \"glue\" asks for adhesion under rapier"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn refusals(m: &Model) -> Vec<NotSimulated> {
    unsupported(m).chain(touching_shapes(m).filter_map(Result::err)).collect()
}

/// Quantities of a world at the reference configuration, for comparison with its model.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Measures {
    /// Number of positions.
    pub nq: usize,
    /// Number of degrees of freedom.
    pub nv: usize,
    /// Mass of all moving bodies \[kg\].
    pub mass: f64,
    /// Axis of each hinge and slide in the world frame; zero for other joints.
    pub axes: Vec<[f64; 3]>,
    /// Largest difference between the inertia of rapier's multibodies and the model's, relative to the largest entry.
    pub inertia: f64,
}

/// Differences of a world from its model.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Differences {
    /// Difference of the mass of all moving bodies, relative to it.
    pub mass: f64,
    /// Largest difference of a coordinate of a joint's axis in the world frame.
    pub axes: f64,
    /// Largest difference of an entry of the joint-space inertia, relative to the largest one.
    pub inertia: f64,
}

impl Differences {
    /// Whether all are below a bound; false where one is NaN.
    pub fn within(self, bound: f64) -> bool {
        [self.mass, self.axes, self.inertia].iter().all(|x| *x < bound)
    }
}

impl Measures {
    /// Compares with the model; NaN where its reference configuration cannot be evaluated.
    pub fn differences(&self, m: &Model) -> Differences {
        let moves = |b: &usize| m.body_treeid[*b] >= 0;
        let moving: f64 = (1..m.nbody).filter(moves).map(|b| m.body_mass[b]).sum();
        let mass = if moving > 0.0 { (self.mass / moving - 1.0).abs() } else { self.mass.abs() };
        Differences { mass, axes: self.axes_off(m), inertia: self.inertia }
    }

    fn axes_off(&self, m: &Model) -> f64 {
        let mut d = Data::new(m);
        if physics::forward(m, &mut d).is_err() {
            return f64::NAN;
        }
        let found = self.axes.iter().zip(&d.kin.xaxis).filter(|(found, _)| **found != [0.0; 3]);
        let off = found.flat_map(|(a, b)| [0, 1, 2].map(|k| (a[k] - b[k]).abs()));
        off.fold(0.0, f64::max)
    }
}

impl World {
    /// Measures rapier's bodies and joints.
    pub fn measure(&self, m: &Model) -> Measures {
        let (mut nq, mut nv) = (0, 0);
        let mut axes = vec![[0.0; 3]; m.njnt];
        for tree in &self.body.links.trees {
            let Some(multibody) = tree.multibody(&self.physics.multibody_joints) else { continue };
            nv += multibody.ndofs();
            nq += multibody.ndofs() + usize::from(tree.root.is_some());
            for link in &tree.links {
                nq += usize::from(link.kind == JointType::Ball);
                let before = &self.physics.bodies[link.before];
                if let (JointType::Hinge | JointType::Slide, Some(place)) =
                    (link.kind, multibody.link(link.id))
                {
                    let frame = before.position().rotation * place.joint.data.local_frame1.rotation;
                    axes[link.joint] = array(frame * Vector::X);
                }
            }
        }
        let moving = self.body.groups.all.iter().zip(&self.body.links.handles);
        let bodies = moving.map(|(group, &handle)| (group, &self.physics.bodies[handle]));
        let alone = bodies.clone().filter(|(group, _)| group.motion == crate::groups::Motion::Alone).count();
        let mass = bodies.map(|(_, rigid)| rigid.mass()).sum();
        Measures { nq: nq + 7 * alone, nv: nv + 6 * alone, mass, axes, inertia: self.inertia_off(m) }
    }

    /// Largest relative difference of the inertia of trees without floating roots, whose coordinates are the model's.
    fn inertia_off(&self, m: &Model) -> f64 {
        let mut d = Data::new(m);
        if physics::forward(m, &mut d).is_err() {
            return f64::NAN;
        }
        let ours = full_inertia(m, &d.inertia.M);
        let mut off = 0.0_f64;
        for tree in self.body.links.trees.iter().filter(|tree| tree.root.is_none()) {
            let Some(multibody) = tree.multibody(&self.physics.multibody_joints) else { continue };
            let n = multibody.ndofs();
            let mut theirs = vec![0.0; n * n];
            for (i, armature) in multibody.armature().iter().enumerate() {
                theirs[i * n + i] = *armature;
            }
            for (id, link) in multibody.links().enumerate() {
                let rigid = &self.physics.bodies[link.rigid_body_handle()];
                let inertia = rigid.mass_properties().effective_angular_inertia().into_matrix();
                let jacobian = multibody.body_jacobian(id);
                for (i, a) in jacobian.column_iter().enumerate() {
                    let turn = inertia * Vector::new(a[3], a[4], a[5]);
                    for (j, b) in jacobian.column_iter().enumerate() {
                        let linear = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
                        theirs[i * n + j] += rigid.mass() * linear + turn.dot(Vector::new(b[3], b[4], b[5]));
                    }
                }
            }
            let own = |i: usize, j: usize| ours[(tree.dofs.start + i) * m.nv + tree.dofs.start + j];
            let all = || (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
            let largest = all().map(|(i, j)| own(i, j).abs()).fold(f64::MIN_POSITIVE, f64::max);
            off = all().map(|(i, j)| (theirs[i * n + j] - own(i, j)).abs() / largest).fold(off, f64::max);
        }
        off
    }
}
