//! Recording: an arm with a gripper that somebody else moves, with what a data set of it holds and no reward.

use super::text_precision::round_frames;
use crate::error::EnvError;
use crate::rows::Rows;
use crate::task::{Defaults, Setup, Task, Verdict, View};
use physics::elements::SiteId;
use robot::Compat;
use serde::Deserialize;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    nq_arm: usize,
    nq_ee: usize,
    name_ee: String,
}

#[derive(Clone)]
pub struct Recording {
    arm: usize,
    /// Joints of arm and gripper.
    joints: usize,
    tip: SiteId,
}

impl Recording {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings or the site are missing; the model has fewer joints than the robot.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        if setup.compat == Compat::RoboHive07 {
            round_frames(setup.scene)?;
        }
        let m = &setup.scene.model;
        let found = m.nq.min(m.nv);
        let joints =
            args.nq_arm.checked_add(args.nq_ee).filter(|&joints| joints <= found).ok_or_else(|| {
                setup.wrong(format!("nq_arm and nq_ee are more joints than the {found} of the model"))
            })?;
        Ok(Recording { arm: args.nq_arm, joints, tip: setup.scene.site(&args.name_ee)? })
    }
}

impl Task for Recording {
    fn defaults(&self) -> Defaults {
        Defaults::new(&["time"], &[("none", 0.0)], 40)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let (qp, qv) = (&view.data.state.qpos[..self.joints], &view.data.state.qvel[..self.joints]);
        let tip = view.data.site(self.tip);
        rows.set("qp", "rad, m", qp);
        rows.set("qp_arm", "rad", &qp[..self.arm]);
        rows.set("qv_arm", "rad/s", &qv[..self.arm]);
        rows.set("qp_ee", "rad, m", &qp[self.arm..]);
        rows.set("qv_ee", "rad/s, m/s", &qv[self.arm..]);
        rows.set("pos_ee", "m", tip.xpos());
        rows.set("rot_ee", "", tip.xmat());
    }

    fn reward(&self, _: &View<'_>, _: &Rows, terms: &mut Rows) -> Verdict {
        terms.set("none", "", [0.0]);
        Verdict::default()
    }
}
