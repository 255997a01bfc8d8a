//! First states of episodes: the model's reference configuration, with noise.

use crate::error::EnvError;
use crate::task::Episode;

/// The distribution of the noise on velocities. That on positions is uniform.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VelocityNoise {
    /// Uniform within plus and minus the scale.
    Uniform,
    /// Normal, the scale its standard deviation.
    Normal,
}

/// Puts the world into its reference configuration with noise of this scale: positions first, then velocities.
///
/// # Errors
/// A scale that is not finite.
pub fn start(episode: &mut Episode<'_>, scale: f64, velocity: VelocityNoise) -> Result<(), EnvError> {
    let Episode { scene, rng, initial, .. } = episode;
    scene.data.reset(&scene.model);
    // A forward pass computes no forces on bodies, so the last episode's would stay.
    scene.data.sensor.cfrc_ext.fill([0.0; 6]);
    let state = &mut scene.data.state;
    for (place, reference) in state.qpos.iter_mut().zip(&initial.qpos) {
        *place = reference + rng.uniform(-scale, scale)?;
    }
    for (place, reference) in state.qvel.iter_mut().zip(&initial.qvel) {
        let noise = match velocity {
            VelocityNoise::Uniform => rng.uniform(-scale, scale)?,
            VelocityNoise::Normal => scale * rng.standard_normal(),
        };
        *place = reference + noise;
    }
    Ok(())
}
