//! One thing that every reset draws, and how its values are drawn.

use crate::draws::Rng;
use crate::error::EnvError;
use crate::rows::Rows;
use crate::scene::Scene;
use physics::Model;
use physics::math::{Quat, Vec3, norm, ops, scale};
use physics::model::{Draft, ObjType};

/// Most values that a dial has.
pub(super) const WIDTH: usize = 9;
/// How often a place is drawn that is too near to others.
const ATTEMPTS: usize = 1000;

/// What the values of a dial are written to.
pub(crate) trait Target: Clone + PartialEq {
    /// The setting of an environment that asks for draws of this kind.
    const SETTING: &'static str;
    /// Which descendant of an environment's seed they are drawn from.
    const STREAM: u64;

    /// Whether two targets are one, so that the later takes the place of the earlier.
    fn turns_same(&self, other: &Self) -> bool {
        self == other
    }

    /// Gives back what `base` has, where [`Target::write`] changes what it finds.
    fn restore(&self, base: &Model, m: &mut Draft<'_>);

    /// Writes values into a model; what they are added to is that of `base`.
    fn write(&self, values: &[f64], base: &Model, m: &mut Draft<'_>);

    /// Lets a change of this kind write into the model of a scene.
    ///
    /// # Errors
    /// The model refuses it.
    fn change(scene: &mut Scene, write: impl FnOnce(&mut Draft<'_>)) -> Result<(), EnvError>;
}

/// How values are drawn.
#[derive(Clone, Debug)]
pub(super) enum Draws {
    /// Each uniform between two bounds.
    Uniform(Vec<[f64; 2]>),
    /// One with this probability, otherwise zero.
    Chance(f64),
    /// One of the whole numbers from the first to the last.
    Whole([u64; 2]),
    /// Each uniform between two bounds, at a distance from what dials drew that are turned before.
    Apart { bounds: Vec<[f64; 2]>, distance: f64, others: Vec<String> },
    /// The number of a pattern, two colours, the squares of a checker and the seed of a noise.
    Pixels { patterns: Vec<u8>, color: [[f64; 2]; 3], squares: [f64; 2] },
}

/// One thing that is drawn at every reset.
#[derive(Clone, Debug)]
pub(super) struct Dial<T> {
    /// `light/NAME/pos` and the like.
    pub name: String,
    /// What the values are measured in.
    pub unit: &'static str,
    pub target: T,
    pub draws: Draws,
}

impl<T> Dial<T> {
    /// How many values it has.
    pub(super) fn width(&self) -> usize {
        match &self.draws {
            Draws::Uniform(bounds) | Draws::Apart { bounds, .. } => bounds.len(),
            Draws::Chance(_) | Draws::Whole(_) => 1,
            Draws::Pixels { .. } => WIDTH,
        }
    }

    /// Draws its values; `drawn` are those of the dials before.
    ///
    /// # Errors
    /// No place is far enough from the others: a message.
    pub(super) fn draw(&self, rng: &mut Rng, drawn: &Rows, values: &mut [f64]) -> Result<(), String> {
        let wrong = |error: random::RandomError| error.to_string();
        match &self.draws {
            Draws::Uniform(bounds) => uniform(rng, bounds, values)?,
            Draws::Chance(probability) => values[0] = f64::from(rng.random() < *probability),
            Draws::Whole([low, high]) => values[0] = rng.integer(*low..=*high).map_err(wrong)? as f64,
            Draws::Apart { bounds, distance, others } => {
                let near = |values: &[f64]| {
                    let places = others.iter().filter_map(|other| drawn.get(other));
                    places.into_iter().any(|place| {
                        let square = place.iter().zip(values).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
                        square < distance * distance
                    })
                };
                uniform(rng, bounds, values)?;
                let mut attempts = 1;
                while near(values) {
                    if attempts == ATTEMPTS {
                        return Err(format!(
                            "{} found no place {distance} m from the {} before it in {ATTEMPTS} draws; widen the range, or \
                             lower the distance",
                            self.name,
                            others.len()
                        ));
                    }
                    uniform(rng, bounds, values)?;
                    attempts += 1;
                }
            }
            Draws::Pixels { patterns, color, squares } => {
                values[0] = f64::from(*rng.choose(patterns).map_err(wrong)?);
                for (value, [low, high]) in values[1..7].iter_mut().zip(color.iter().chain(color)) {
                    *value = rng.uniform(*low, *high).map_err(wrong)?;
                }
                values[7] = rng.uniform(squares[0], squares[1]).map_err(wrong)?.round();
                values[8] = f64::from(rng.integer(0..u32::MAX).map_err(wrong)?);
            }
        }
        Ok(())
    }
}

fn uniform(rng: &mut Rng, bounds: &[[f64; 2]], values: &mut [f64]) -> Result<(), String> {
    for (value, [low, high]) in values.iter_mut().zip(bounds) {
        *value = rng.uniform(*low, *high).map_err(|error| error.to_string())?;
    }
    Ok(())
}

/// What a kind of elements is called in the names of dials and in messages.
pub(super) fn word(kind: ObjType) -> String {
    format!("{kind:?}").to_lowercase()
}

/// The first three values.
pub(super) fn three(values: &[f64]) -> Vec3 {
    [values[0], values[1], values[2]]
}

/// The quaternion of a rotation vector \[deg\].
pub(super) fn rotation(degrees: Vec3) -> Quat {
    let vector = degrees.map(f64::to_radians);
    let angle = norm(vector);
    if angle == 0.0 {
        return [1.0, 0.0, 0.0, 0.0];
    }
    let (sin, cos) = ops::sincos(angle / 2.0);
    let [x, y, z] = scale(vector, sin / angle);
    [cos, x, y, z]
}
