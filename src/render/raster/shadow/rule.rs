//! How what casts shadows is drawn into a shadow map.

use crate::profile::Profile;

/// How casters are drawn into a shadow map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CasterRule {
    /// Only what faces away from the lamp is.
    pub averted: bool,
    /// Added to their depth, in slopes a texel.
    pub slopes: f32,
    /// Added to their depth.
    pub constant: f32,
}

impl CasterRule {
    /// That of a version of MuJoCo. `glPolygonOffset` of -1.5 and -4 in 3.12; pictures of Mesa fit best where its unit is
    /// two steps of the map's 24 bits. MuJoCo 3.1.3 draws what faces away from the lamp, as it is.
    pub fn of(profile: Profile) -> Self {
        match profile {
            Profile::Mujoco312 => CasterRule { averted: false, slopes: 1.5, constant: 8.0 / 16_777_216.0 },
            Profile::Mujoco313 => CasterRule { averted: true, slopes: 0.0, constant: 0.0 },
        }
    }

    /// How the lines of a wireframe are drawn, which nothing is added to: they lie in their own shadow in half of their texels, at
    /// random, as in MuJoCo's pictures.
    pub fn of_lines(self) -> Self {
        CasterRule { slopes: 0.0, constant: 0.0, ..self }
    }
}
