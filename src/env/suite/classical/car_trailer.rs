//! Parking a car with a trailer: neither rolls sideways, and backwards the trailer folds unless it is steered against (Rouchon, Fliess,
//! Lévine and Martin, Flatness and motion planning: the car with n trailers, ECC 1993). The wheels are bodies that touch the ground.
//!
//! Action: speed of the rear wheels, -1 to 1 for -0.5 to 0.5 m/s, and angle that the front wheels are told, for -0.5 to 0.5 rad.
//! Observation: place of the rear axle from the bay \[m\], cosine and sine of the heading, angle of the trailer from the car \[rad\], speed
//! \[m/s\], turning \[rad/s\], steering \[rad\], seconds for which it has been parked. Dense reward: minus the distance \[m\], minus
//! half the angles of car and trailer from the bay's direction \[rad\], one more while parked, 100 at the end. Sparse reward: 1
//! while parked. Solved: rear axle within 5 cm of the bay, car and trailer within 5 degrees of its direction for 0.5 s, which ends the
//! episode. Episodes start 0.6 to 1.2 m before the bay, 0.4 m to either side, car within 0.5 rad, trailer within 0.3 rad, and last 30 s.

use super::ground::{at_origin, pose, put, spread, velocity};
use crate::error::EnvError;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::hold::Hold;
use crate::task::{Defaults, Episode, Pose, Setup, Success, Task, Turn, Verdict, View};
use physics::Data;
use physics::elements::BodyId;
use physics::math::ops;
use robot::Keeper;
use serde::Deserialize;

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// Distance \[m\] and angle \[rad\] that count as parked.
    within: [f64; 2],
    /// How long \[s\].
    hold: f64,
    /// Distances before the bay at the start \[m\].
    before: [f64; 2],
    /// Largest distance to the side \[m\], heading and angle of the trailer \[rad\] at the start.
    start: [f64; 3],
}

#[derive(Clone)]
pub struct CarTrailer {
    car: BodyId,
    /// Position and velocity of the hitch, and position of the steering.
    places: [usize; 3],
    args: Args,
    parked: Hold,
}

impl CarTrailer {
    /// The task with these settings.
    ///
    /// # Errors
    /// A body or joint is missing; the car does not move freely.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let (scene, m) = (&setup.scene, &setup.scene.model);
        let [hitch, steer] = [scene.joint("hitch")?.index(), scene.joint("steer_left")?.index()];
        let free = scene.joint("car")?.index();
        if m.jnt_qposadr[free] != 0 {
            return Err(setup.wrong("the car's free joint is the model's first"));
        }
        Ok(CarTrailer {
            car: scene.body("car")?,
            places: [
                m.jnt_qposadr[hitch] as usize,
                m.jnt_dofadr[hitch] as usize,
                m.jnt_qposadr[steer] as usize,
            ],
            parked: Hold::new(args.hold),
            args,
        })
    }

    fn holds(&self, data: &Data) -> bool {
        let pose = pose(data, self.car);
        let trailer = pose[2] + data.state.qpos[self.places[0]];
        at_origin(pose, self.args.within) && trailer.abs() < self.args.within[1]
    }
}

impl Task for CarTrailer {
    fn defaults(&self) -> Defaults {
        let weights = [("distance", -1.0), ("angles", -0.5), ("held", 1.0), ("bonus", 100.0)];
        let rows = ["car", "heading", "trailer", "motion", "steering", "held"];
        let defaults = Defaults::new(&rows, &weights, 10);
        Defaults { success: Success::MoreThan(0), ..defaults }.proprio(&["trailer", "steering"])
    }

    fn initial_pose(&self, scene: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        // Wheels have no range whose middle they could start from.
        pose.qpos.copy_from_slice(&scene.model.qpos0);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let x = episode.rng.uniform(self.args.before[0], self.args.before[1])?;
        let [y, heading, trailer] = spread(episode.rng, self.args.start)?;
        put(&mut episode.start.qpos, [x, y, heading]);
        episode.start.qpos[self.places[0]] = trailer;
        self.parked.begin();
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.parked.leave(self.holds(&turn.scene.data));
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let [hitch, turns, steering] = self.places;
        let state = &view.data.state;
        let [x, y, heading] = pose(view.data, self.car);
        let (sine, cosine) = ops::sincos(heading);
        let [speed, turning] = velocity(view.data, self.car, 0);
        rows.set("car", "m", [x, y]);
        rows.set("heading", "", [cosine, sine]);
        rows.set("trailer", "rad, rad/s", [state.qpos[hitch], state.qvel[turns]]);
        rows.set("motion", "m/s, rad/s", [speed, turning]);
        rows.set("steering", "rad", [state.qpos[steering]]);
        rows.set("held", "s", [self.parked.seconds(self.holds(view.data), view.dt)]);
    }

    fn reward(&self, view: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let [x, y, heading] = pose(view.data, self.car);
        terms.set("distance", "m", [(x * x + y * y).sqrt()]);
        terms.set("angles", "rad", [heading.abs() + (heading + rows["trailer"][0]).abs()]);
        self.parked.judge(rows["held"][0], self.holds(view.data), false, terms)
    }

    fn rewards_paths(&self) -> bool {
        false
    }

    fn resting_rows(&self) -> Vec<String> {
        vec!["held".into()]
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.parked.keep(keeper);
    }
}
