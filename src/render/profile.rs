//! Which MuJoCo's pictures are drawn.
//!
//! ```
//! use robohive_render::Profile;
//!
//! assert_eq!(Profile::default(), Profile::Mujoco312);
//! ```

/// The version of MuJoCo whose way of texturing is followed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Profile {
    /// MuJoCo 3.12: sRGB images are decoded, primitives have texture coordinates of their own.
    #[default]
    Mujoco312,
    /// MuJoCo 3.1.3: no image is decoded, two-dimensional textures are projected along z onto whatever has no texture
    /// coordinates in its file, and coordinates of a file ignore `texrepeat` and `texuniform`. Policies trained on
    /// RoboHive's pictures know these.
    Mujoco313,
}
