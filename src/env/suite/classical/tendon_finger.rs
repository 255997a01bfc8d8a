//! A finger of three joints that five muscles move over cables: which of them pull is not decided by the torques that they are to make
//! (Crowninshield and Brand, A physiologically based criterion of muscle force prediction in locomotion, Journal of Biomechanics 14, 1981;
//! tendons over several joints as in Salisbury and Craig, Articulated hands: force control and kinematic issues, International
//! Journal of Robotics Research 1, 1982). Muscles only pull, and follow their commands with a lag of 30 ms.
//!
//! Action: commands of the muscles, -1 to 1 for none to all of 10 N. Observation: angles \[rad\] and velocities \[rad/s\] of the joints,
//! activations, offsets of the wanted angles \[rad\], seconds for which the pose has been taken. Dense reward: minus the sum of the offsets
//! \[rad\], minus a tenth of the mean activation, one more while the pose is taken, 100 at the end. Sparse reward: 1 while it is
//! taken. Solved: every joint within 0.08 rad for 1 s, which ends the episode. Episodes start hanging, within 0.2 rad, wanted angles
//! between 0.4 and 1.1 rad, and last 6 s.

use crate::error::EnvError;
use crate::rows::Rows;
use crate::suite::hold::Hold;
use crate::task::{Defaults, Episode, Setup, Success, Task, Turn, Verdict, View};
use robot::Keeper;
use serde::Deserialize;

/// Joints of the finger.
const JOINTS: usize = 3;

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// Offset of a joint that counts as taken \[rad\].
    within: f64,
    /// How long \[s\].
    hold: f64,
    /// Largest angle at the start \[rad\].
    start: f64,
    /// Wanted angles \[rad\].
    wanted: [f64; 2],
}

#[derive(Clone)]
pub struct TendonFinger {
    args: Args,
    wanted: [f64; JOINTS],
    taken: Hold,
}

impl TendonFinger {
    /// The task with these settings.
    ///
    /// # Errors
    /// The model is no finger of three joints.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let m = &setup.scene.model;
        if m.nq != JOINTS || m.nv != JOINTS {
            return Err(setup.wrong("the model has the three joints of a finger"));
        }
        Ok(TendonFinger { wanted: [0.0; JOINTS], taken: Hold::new(args.hold), args })
    }

    fn holds(&self, qpos: &[f64]) -> bool {
        qpos.iter().zip(self.wanted).all(|(angle, wanted)| (wanted - angle).abs() < self.args.within)
    }
}

impl Task for TendonFinger {
    fn defaults(&self) -> Defaults {
        let weights = [("distance", -1.0), ("effort", -0.1), ("held", 1.0), ("bonus", 100.0)];
        let rows = ["angles", "velocities", "activations", "target_error", "held"];
        let defaults = Defaults::new(&rows, &weights, 5);
        let shown = Defaults { success: Success::MoreThan(0), show_actuators: true, ..defaults };
        shown.proprio(&["angles", "velocities", "activations"])
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        for angle in &mut episode.start.qpos {
            *angle = episode.rng.uniform(0.0, self.args.start)?;
        }
        for wanted in &mut self.wanted {
            *wanted = episode.rng.uniform(self.args.wanted[0], self.args.wanted[1])?;
        }
        self.taken.begin();
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.taken.leave(self.holds(&turn.scene.data.state.qpos));
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let state = &view.data.state;
        let offsets = state.qpos.iter().zip(self.wanted).map(|(angle, wanted)| wanted - angle);
        rows.set("angles", "rad", &state.qpos);
        rows.set("velocities", "rad/s", &state.qvel);
        rows.set("activations", "", &state.act);
        rows.set("target_error", "rad", offsets);
        rows.set("held", "s", [self.taken.seconds(self.holds(&state.qpos), view.dt)]);
    }

    fn reward(&self, view: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let activations = &rows["activations"];
        let mean = activations.iter().sum::<f64>() / activations.len().max(1) as f64;
        terms.set("distance", "rad", [rows["target_error"].iter().map(|offset| offset.abs()).sum::<f64>()]);
        terms.set("effort", "", [mean]);
        self.taken.judge(rows["held"][0], self.holds(&view.data.state.qpos), false, terms)
    }

    fn rewards_paths(&self) -> bool {
        false
    }

    fn resting_rows(&self) -> Vec<String> {
        vec!["held".into()]
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        keeper.numbers(&mut self.wanted);
        self.taken.keep(keeper);
    }
}
