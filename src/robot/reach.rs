//! Searches for a pose that keep joints within their ranges, and use the freedom that is left to stay near a posture
//! (Siciliano, Sciavicco, Villani, Oriolo, Robotics: Modelling, Planning and Control, section 3.5.1).

use crate::inverse_kinematics::{Pose, Search, Solution, least_squares, place};
use crate::symmetric::ROWS;
use physics::elements::{JointId, SiteId};
use physics::integration::integrate::integrate_pos;
use physics::model::JointType;
use physics::position::jacobian::Jacobian;
use physics::{Data, Model};

/// Share of its range within which a joint is at its end.
const AT_END: f64 = 1e-9;

/// What joints may do on the way to a pose.
#[derive(Clone, Copy, Debug)]
pub struct Reach<'a> {
    /// The joints that move.
    pub joints: &'a [JointId],
    /// Positions of all joints of the model that are kept to where the pose leaves a choice.
    pub rest: Option<&'a [f64]>,
    /// Share of the way to `rest` that one update goes.
    pub pull: f64,
}

/// A degree of freedom that moves along a coordinate.
struct Freedom {
    dof: usize,
    /// Its place in `qpos`; ball and free joints have none of their own.
    place: Option<usize>,
    range: [f64; 2],
}

impl Freedom {
    /// Whether an update would push it further beyond an end at which it stands.
    fn is_blocked(&self, qpos: &[f64], update: &[f64]) -> bool {
        let Some(place) = self.place else { return false };
        let ([low, high], now, step) = (self.range, qpos[place], update[self.dof]);
        let near = AT_END * (high - low);
        near.is_finite() && ((now <= low + near && step < 0.0) || (now >= high - near && step > 0.0))
    }
}

fn freedoms(model: &Model, joints: &[JointId]) -> Vec<Freedom> {
    let of = |&joint: &JointId| {
        let id = joint.index();
        let straight = matches!(model.joint(joint).kind(), Some(JointType::Hinge | JointType::Slide));
        let limited = straight && model.jnt_limited[id];
        let range = if limited { model.jnt_range[id] } else { [f64::NEG_INFINITY, f64::INFINITY] };
        let place = straight.then(|| model.jnt_qposadr[id] as usize);
        model.joint(joint).dof_range().map(move |dof| Freedom { dof, place, range })
    };
    joints.iter().flat_map(of).collect()
}

impl Search {
    /// Looks for a pose as [`Search::run`] does, with joints that stop at the ends of their ranges.
    ///
    /// ```
    /// # use physics as robohive_physics;
    /// use robohive_robot::{Pose, Reach, Search};
    ///
    /// let model = robohive_mjcf::load_str(
    ///     "<mujoco><worldbody><body><joint name='a' axis='0 1 0' range='-20 20'/><geom size='.1'/>
    ///        <body pos='1 0 0'><joint name='b' axis='0 1 0'/><geom size='.1'/><site name='hand' pos='1 0 0'/></body>
    ///      </body></worldbody></mujoco>",
    /// )?
    /// .model;
    /// let (hand, joints) = (model.site("hand").ok_or("no hand")?, model.joints().collect::<Vec<_>>());
    /// let data = robohive_physics::Data::new(&model);
    /// let pose = Pose { position: Some([1.5, 0.0, -1.0]), ..Pose::default() };
    /// let reach = Reach { joints: &joints, rest: None, pull: 0.0 };
    /// let solution = Search { tolerance: 1e-9, ..Search::default() }.run_within(&model, &data, hand, &pose, &reach);
    /// assert!(solution.qpos[0] <= 20_f64.to_radians());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn run_within(
        &self,
        model: &Model,
        data: &Data,
        site: SiteId,
        pose: &Pose,
        reach: &Reach<'_>,
    ) -> Solution {
        let mut d = data.clone();
        let freedoms = freedoms(model, reach.joints);
        clip(&freedoms, &mut d.state.qpos);
        let mut jacobian = Jacobian::default();
        let mut update = vec![0.0; model.nv];
        let mut steps = 0;
        let mut offset = place(model, &mut d, site, pose);
        while steps < self.max_steps && self.error(&offset) >= self.tolerance {
            jacobian.set_to(model, &d, site);
            let asked = [pose.position.is_some(), pose.orientation.is_some()];
            let rows = ([&jacobian.pos, &jacobian.rot], asked);
            self.update(&freedoms, rows, &d.state.qpos, (&offset, reach), &mut update);
            let length = update.iter().map(|x| x * x).sum::<f64>().sqrt();
            if self.error(&offset) > self.progress_threshold * length {
                break;
            }
            if length > self.max_update {
                update.iter_mut().for_each(|x| *x *= self.max_update / length);
            }
            integrate_pos(model, &mut d.state.qpos, &update, 1.0);
            clip(&freedoms, &mut d.state.qpos);
            offset = place(model, &mut d, site, pose);
            steps += 1;
        }
        let error = self.error(&offset);
        Solution { qpos: d.state.qpos, error, steps, reached: error < self.tolerance }
    }

    /// One update. Joints that it would push beyond their ends are left out, and what they would have done is shared among the
    /// others.
    fn update(
        &self,
        freedoms: &[Freedom],
        (rows, asked): ([&Vec<f64>; 2], [bool; 2]),
        qpos: &[f64],
        (offset, reach): (&[f64; ROWS], &Reach<'_>),
        update: &mut [f64],
    ) {
        let damping = if self.error(offset) > self.damping_threshold { self.damping } else { 0.0 };
        let mut free: Vec<&Freedom> = freedoms.iter().collect();
        loop {
            let dofs: Vec<usize> = free.iter().map(|freedom| freedom.dof).collect();
            least_squares(rows, asked, &dofs, (damping, offset), update);
            if let Some(rest) = reach.rest {
                let wish = wish(&free, qpos, rest, reach.pull, update.len());
                add_freely(rows, asked, &dofs, &wish, update);
            }
            let before = free.len();
            free.retain(|freedom| !freedom.is_blocked(qpos, update));
            if free.len() == before {
                return;
            }
        }
    }
}

/// The way to the posture, of degrees of freedom that have one.
fn wish(free: &[&Freedom], qpos: &[f64], rest: &[f64], pull: f64, nv: usize) -> Vec<f64> {
    let mut wish = vec![0.0; nv];
    for Freedom { dof, place, .. } in free {
        let way = place.and_then(|place| Some(rest.get(place)? - qpos[place]));
        wish[*dof] = pull * way.unwrap_or_default();
    }
    wish
}

/// Adds the part of a wish that moves nothing of what was asked for.
fn add_freely(rows: [&Vec<f64>; 2], asked: [bool; 2], dofs: &[usize], wish: &[f64], update: &mut [f64]) {
    let nv = wish.len();
    let moved: [f64; ROWS] = std::array::from_fn(|row| {
        let entry = |dof: usize| if asked[row / 3] { rows[row / 3][row % 3 * nv + dof] } else { 0.0 };
        dofs.iter().map(|&dof| entry(dof) * wish[dof]).sum()
    });
    let mut bound = vec![0.0; nv];
    least_squares(rows, asked, dofs, (0.0, &moved), &mut bound);
    for &dof in dofs {
        update[dof] += wish[dof] - bound[dof];
    }
}

fn clip(freedoms: &[Freedom], qpos: &mut [f64]) {
    for Freedom { place, range: [low, high], .. } in freedoms {
        if let Some(place) = *place {
            qpos[place] = qpos[place].max(*low).min(*high);
        }
    }
}
