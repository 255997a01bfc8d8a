//! Positions of joints that bring a site to a pose: damped least squares (Buss, Introduction to inverse kinematics with
//! Jacobian transpose, pseudoinverse and damped least squares methods, 2004), with the constants and stopping rules of
//! dm_control's `qpos_from_site_pose`, which RoboHive uses.

use crate::symmetric::{ROWS, Square, solve as solve_symmetric};
use physics::elements::{JointId, SiteId};
use physics::integration::integrate::integrate_pos;
use physics::math::{Quat, Vec3, norm, quat_conj, quat_mul, quat_normalize, quat_to_velocity, sub};
use physics::position::com::com_pos;
use physics::position::jacobian::Jacobian;
use physics::position::kinematics::kinematics;
use physics::{Data, Model};

/// Where a site should be.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// Position, world frame \[m\]; `None` for any.
    pub position: Option<Vec3>,
    /// Orientation; `None` for any. It is normalised.
    pub orientation: Option<Quat>,
}

/// How a pose is looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search {
    /// The error at which it is reached.
    pub tolerance: f64,
    /// Weight of the angle \[rad\] beside the distance \[m\] in the error.
    pub rotation_weight: f64,
    /// Damping while the error is above `damping_threshold`.
    pub damping: f64,
    /// See `damping`.
    pub damping_threshold: f64,
    /// Largest norm of one update.
    pub max_update: f64,
    /// Ratio of the error to an update's norm at which the search ends without success.
    pub progress_threshold: f64,
    /// Updates after which the search ends without success.
    pub max_steps: usize,
}

impl Default for Search {
    fn default() -> Self {
        Search {
            tolerance: 1e-14,
            rotation_weight: 1.0,
            damping: 3e-2,
            damping_threshold: 0.1,
            max_update: 2.0,
            progress_threshold: 20.0,
            max_steps: 500,
        }
    }
}

/// What a search found.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// Positions of all joints.
    pub qpos: Vec<f64>,
    /// Distance \[m\] plus weighted angle \[rad\] that is left.
    pub error: f64,
    /// Updates made.
    pub steps: usize,
    /// The error is below the tolerance.
    pub reached: bool,
}

impl Search {
    /// Moves `joints`, or all of them, from where `data` has them until `site` is at `pose`. Ranges of joints are not
    /// respected, as in the original; [`Search::run_within`] respects them. Of `data`, which stays as it is, the state counts alone. A pose that asks for
    /// nothing is reached.
    ///
    /// ```
    /// # use physics as robohive_physics;
    /// use robohive_robot::{Pose, Search};
    ///
    /// let model = robohive_mjcf::load_str(
    ///     "<mujoco><worldbody><body><joint axis='0 1 0'/><geom size='.1'/>
    ///        <body pos='1 0 0'><joint axis='0 1 0'/><geom size='.1'/><site name='hand' pos='1 0 0'/></body>
    ///      </body></worldbody></mujoco>",
    /// )?
    /// .model;
    /// let hand = model.site("hand").ok_or("no hand")?;
    /// let mut data = robohive_physics::Data::new(&model);
    /// data.state.qpos[1] = 0.5;
    /// let pose = Pose { position: Some([1.0, 0.0, -1.0]), ..Pose::default() };
    /// let solution = Search { tolerance: 1e-12, ..Search::default() }.run(&model, &data, hand, &pose, None);
    /// assert!(solution.reached && solution.steps < 20);
    ///
    /// data.state.qpos.copy_from_slice(&solution.qpos);
    /// robohive_physics::forward(&model, &mut data)?;
    /// assert!(data.site(hand).xpos().iter().zip([1.0, 0.0, -1.0]).all(|(x, y)| (x - y).abs() < 1e-12));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn run(
        &self,
        model: &Model,
        data: &Data,
        site: SiteId,
        pose: &Pose,
        joints: Option<&[JointId]>,
    ) -> Solution {
        let mut d = data.clone();
        let mut jacobian = Jacobian::default();
        let mut update = vec![0.0; model.nv];
        let dofs: Vec<usize> = match joints {
            None => (0..model.nv).collect(),
            Some(joints) => joints.iter().flat_map(|&joint| model.joint(joint).dof_range()).collect(),
        };
        let (mut steps, mut reached) = (0, false);
        let mut offset = place(model, &mut d, site, pose);
        while steps < self.max_steps {
            let error = self.error(&offset);
            if error < self.tolerance {
                reached = true;
                break;
            }
            jacobian.set_to(model, &d, site);
            let rows = [&jacobian.pos, &jacobian.rot];
            let asked = [pose.position.is_some(), pose.orientation.is_some()];
            let damping = if error > self.damping_threshold { self.damping } else { 0.0 };
            least_squares(rows, asked, &dofs, (damping, &offset), &mut update);
            let length = update.iter().map(|x| x * x).sum::<f64>().sqrt();
            if error > self.progress_threshold * length {
                break;
            }
            if length > self.max_update {
                update.iter_mut().for_each(|x| *x *= self.max_update / length);
            }
            integrate_pos(model, &mut d.state.qpos, &update, 1.0);
            offset = place(model, &mut d, site, pose);
            steps += 1;
        }
        let error = self.error(&offset);
        Solution { qpos: d.state.qpos, error, steps, reached: reached || error < self.tolerance }
    }

    pub(crate) fn error(&self, offset: &[f64; ROWS]) -> f64 {
        let [x, y, z, a, b, c] = *offset;
        norm([x, y, z]) + norm([a, b, c]) * self.rotation_weight
    }
}

/// Recomputes poses; returns the way and the rotation vector from the site to `pose`, world frame.
pub(crate) fn place(model: &Model, d: &mut Data, site: SiteId, pose: &Pose) -> [f64; ROWS] {
    kinematics(model, &d.state, &mut d.kin);
    com_pos(model, &d.kin, &mut d.com);
    let way = pose.position.map_or([0.0; 3], |position| sub(position, d.kin.site_xpos[site.index()]));
    let turn = pose.orientation.map_or([0.0; 3], |orientation| {
        let body = model.site_bodyid[site.index()] as usize;
        let now = quat_mul(d.kin.xquat[body], model.site_quat[site.index()]);
        quat_to_velocity(quat_mul(quat_normalize(orientation), quat_conj(now)), 1.0)
    });
    [way[0], way[1], way[2], turn[0], turn[1], turn[2]]
}

/// The update Jᵀ (J Jᵀ + damping I)⁻¹ offset, which is (Jᵀ J + damping I)⁻¹ Jᵀ offset with a smaller matrix. Rows that
/// nobody asked for are zero, as are columns other than `dofs`.
pub(crate) fn least_squares(
    rows: [&Vec<f64>; 2],
    asked: [bool; 2],
    dofs: &[usize],
    (damping, offset): (f64, &[f64; ROWS]),
    update: &mut [f64],
) {
    let nv = update.len();
    let entry = |row: usize, dof: usize| {
        if asked[row / 3] { rows[row / 3][row % 3 * nv + dof] } else { 0.0 }
    };
    let gram: Square = std::array::from_fn(|i| {
        std::array::from_fn(|j| dofs.iter().map(|&dof| entry(i, dof) * entry(j, dof)).sum())
    });
    let weights = solve_symmetric(&gram, damping, offset);
    update.fill(0.0);
    for &dof in dofs {
        update[dof] = (0..ROWS).map(|row| entry(row, dof) * weights[row]).sum();
    }
}
