//! Targets that circle in the palm of the muscle-driven hand.

use crate::draws::Rng;
use crate::error::EnvError;
use crate::scene::Scene;
use crate::suite::baoding::{BALLS, Orbit, Pairs};
use crate::task::Pose;
use robot::Keeper;

/// Middle of the path in the palm \[m\].
const CENTER: [f64; 2] = [-0.0125, -0.07];
/// Angle \[rad\] of the forearm that turns the palm up.
const PALM_UP: f64 = -1.57;

/// The balls in the palm, their targets, and the path of these in an episode.
#[derive(Clone, Debug)]
pub struct Circling {
    /// Balls and targets.
    pub pairs: Pairs,
    /// The path.
    pub orbit: Orbit,
    /// Angles at which the targets begin \[rad\].
    pub starts: [f64; 2],
}

/// Draws half axes from their ranges along x and y \[m\].
///
/// # Errors
/// A range that cannot be drawn from.
pub fn draw_radii([[x0, x1], [y0, y1]]: [[f64; 2]; 2], rng: &mut Rng) -> Result<[f64; 2], EnvError> {
    Ok([rng.uniform(x0, x1)?, rng.uniform(y0, y1)?])
}

impl Circling {
    /// The balls of a scene, whose targets turn counterclockwise and steadily from `starts` \[rad\] on an ellipse with these
    /// half axes \[m\], once in a period \[s\].
    ///
    /// # Errors
    /// The model lacks the balls or their targets.
    pub fn new(scene: &Scene, radii: [f64; 2], period: f64, starts: [f64; 2]) -> Result<Self, EnvError> {
        let orbit = Orbit { radii, center: CENTER, period, direction: 1.0, jumps: None };
        Ok(Circling { pairs: Pairs::find(scene)?, orbit, starts })
    }

    /// Writes or reads what an episode drew of the path.
    pub fn keep(&mut self, keeper: &mut Keeper) {
        keeper.numbers(&mut self.orbit.radii);
        keeper.number(&mut self.orbit.period);
        keeper.number(&mut self.orbit.direction);
        keeper.numbers(&mut self.starts);
    }

    /// Moves the targets to where they are when a control period `dt` \[s\] has passed `steps` times.
    ///
    /// # Errors
    /// The place is no number.
    pub fn place_targets(&self, scene: &mut Scene, steps: usize, dt: f64) -> Result<(), EnvError> {
        let angle = self.orbit.angle(steps, dt);
        for (target, start) in self.pairs.targets.iter().zip(self.starts) {
            let place = self.orbit.at(angle + start);
            scene.overwrite(|m| m.site_pos[target.index()][..2].copy_from_slice(&place))?;
        }
        Ok(())
    }
}

/// Opens the hand and turns its palm up; the balls stay where they are.
pub fn open_hand(pose: &mut Pose) {
    let hand = pose.qpos.len() - BALLS[0];
    pose.qpos[..hand].fill(0.0);
    pose.qpos[0] = PALM_UP;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn targets_are_placed_in_the_palm() {
        let text = "<mujoco><worldbody>
            <body><joint/><geom size='.1'/></body>
            <body><freejoint/><geom size='.02'/><site name='ball1_site'/></body>
            <body><freejoint/><geom size='.02'/><site name='ball2_site'/></body>
            <site name='target1_site' pos='0 0 .5'/><site name='target2_site' pos='0 0 .5'/></worldbody></mujoco>";
        let mut scene = Scene::new(mjcf::load_str(text).unwrap().model).unwrap();
        let circling = Circling::new(&scene, [0.025, 0.028], 5.0, [0.0, std::f64::consts::PI]).unwrap();
        circling.place_targets(&mut scene, 50, 0.025).unwrap();
        let [first, second] = circling.pairs.targets.map(|target| scene.model.site_pos[target.index()]);
        let close = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
        let [x, y] = CENTER;
        assert!(
            close(first, [x, y + 0.028, 0.5]) && close(second, [x, y - 0.028, 0.5]),
            "{first:?} {second:?}"
        );
        let mut pose = Pose { qpos: vec![1.0; 15], qvel: vec![0.0; 13] };
        open_hand(&mut pose);
        assert_eq!(pose.qpos[..2], [PALM_UP, 1.0]);
    }
}
