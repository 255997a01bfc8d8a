//! Ball on beam: a ball that rolls freely on the two rails of a beam is to come to rest over a mark, by tilting the beam (Hauser,
//! Sastry and Kokotović, Nonlinear control via approximate input-output linearization: the ball and beam example, IEEE Transactions on
//! Automatic Control 37, 1992). The ball is held by nothing but its contacts with the rails.
//!
//! Action: angle that the servo of the beam is told, -1 to 1 for -0.2 to 0.2 rad. Observation: position and velocity of the ball along
//! the beam \[m, m/s\], angle and velocity of the beam \[rad, rad/s\], offset of the mark from the ball \[m\], seconds for which the
//! ball has been there. Dense reward: minus the distance \[m\], one more while the ball is there, 100 at the end, -100 where
//! it falls. Sparse reward: 1 while it is there. Solved: within 2 cm of the mark for 2 s, which ends the episode. Ball and mark start
//! anywhere within 0.4 m of the middle, 0.15 m or more apart; an episode lasts 15 s.

use crate::error::EnvError;
use crate::rows::Rows;
use crate::suite::hold::Hold;
use crate::task::{Defaults, Episode, Setup, Success, Task, Turn, Verdict, View};
use physics::Data;
use physics::elements::{BodyId, SiteId};
use physics::math::{dot, sub};
use robot::Keeper;
use serde::Deserialize;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// Distance that counts as there \[m\].
    distance: f64,
    /// How long the ball is to stay there \[s\].
    hold: f64,
    /// Largest distance of ball and mark from the middle at the start \[m\].
    reach: f64,
    /// Least distance between them at the start \[m\].
    apart: f64,
}

#[derive(Clone)]
pub struct BallOnBeam {
    beam: BodyId,
    ball: BodyId,
    target: SiteId,
    args: [f64; 3],
    there: Hold,
}

/// Height of the ball's centre under the beam's axis at which it has fallen \[m\].
const FALLEN: f64 = 0.15;

impl BallOnBeam {
    /// The task with these settings.
    ///
    /// # Errors
    /// A body or site is missing; a ball and a mark that are always too near.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        if !(args.apart >= 0.0 && args.apart <= args.reach) {
            return Err(setup.wrong("apart is 0 or more, and at most reach"));
        }
        Ok(BallOnBeam {
            beam: setup.scene.body("beam")?,
            ball: setup.scene.body("ball")?,
            target: setup.scene.site("beam_target")?,
            args: [args.distance, args.reach, args.apart],
            there: Hold::new(args.hold),
        })
    }

    /// Place of the ball along the beam, and over its axis \[m\].
    fn ball(&self, data: &Data) -> [f64; 2] {
        let (beam, axes) = (*data.body(self.beam).xpos(), data.body(self.beam).xmat());
        let offset = sub(*data.body(self.ball).xpos(), beam);
        [dot([axes[0], axes[3], axes[6]], offset), offset[2]]
    }

    /// Offset of the mark from the ball along the beam \[m\].
    fn offset(&self, view: (&physics::Model, &Data)) -> f64 {
        view.0.site_pos[self.target.index()][0] - self.ball(view.1)[0]
    }
}

impl Task for BallOnBeam {
    fn defaults(&self) -> Defaults {
        let weights = [("distance", -1.0), ("held", 1.0), ("bonus", 100.0), ("penalty", -100.0)];
        let rows = ["ball", "ball_velocity", "beam", "target_error", "held"];
        let defaults = Defaults::new(&rows, &weights, 5);
        Defaults { success: Success::MoreThan(0), ..defaults }.proprio(&["beam"])
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let [_, reach, apart] = self.args;
        let (mut ball, mut mark) = (0.0_f64, 0.0_f64);
        while (ball - mark).abs() <= apart {
            ball = episode.rng.uniform(-reach, reach)?;
            mark = episode.rng.uniform(-reach, reach)?;
            if apart == 0.0 {
                break;
            }
        }
        episode.start.qpos[1] += ball;
        self.there.begin();
        episode.scene.overwrite(|m| m.site_pos[self.target.index()][0] = mark)
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        let offset = self.offset((&turn.scene.model, &turn.scene.data));
        self.there.leave(offset.abs() < self.args[0]);
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let state = &view.data.state;
        let offset = self.offset((view.model, view.data));
        let axes = view.data.body(self.beam).xmat();
        // Speed along the beam; what the turning beam adds is small.
        let speed = dot([axes[0], axes[3], axes[6]], [state.qvel[1], state.qvel[2], state.qvel[3]]);
        rows.set("ball", "m", self.ball(view.data));
        rows.set("ball_velocity", "m/s", [speed]);
        rows.set("beam", "rad, rad/s", [state.qpos[0], state.qvel[0]]);
        rows.set("target_error", "m", [offset]);
        rows.set("held", "s", [self.there.seconds(offset.abs() < self.args[0], view.dt)]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let distance = rows["target_error"][0].abs();
        terms.set("distance", "m", [distance]);
        let fallen = rows["ball"][1] < -FALLEN;
        self.there.judge(rows["held"][0], distance < self.args[0] && !fallen, fallen, terms)
    }

    fn resting_rows(&self) -> Vec<String> {
        vec!["held".into()]
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.there.keep(keeper);
    }
}
