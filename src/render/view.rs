//! Where a picture is taken from: the pose of the eye and the frustum it sees.
//!
//! ```
//! # use physics as robohive_physics;
//! use robohive_physics::{Data, forward};
//! use robohive_render::scene::Camera;
//!
//! let text = "<mujoco><worldbody><camera name='above' pos='0 0 2'/><geom size='.1'/></worldbody></mujoco>";
//! let model = robohive_mjcf::load_str(text)?.model;
//! let mut data = Data::new(&model);
//! forward(&model, &mut data)?;
//! let view = Camera::named(&model, "above")?.view(&model, &data)?;
//! assert_eq!((view.eye, view.forward), ([0.0, 0.0, 2.0], [0.0, 0.0, -1.0]));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

/// The eye and its frustum, world frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Position of the eye \[m\].
    pub eye: [f64; 3],
    /// Unit vector of the gaze.
    pub forward: [f64; 3],
    /// Unit vector up, normal to the gaze.
    pub up: [f64; 3],
    /// What is seen.
    pub frustum: Frustum,
}

/// Window and depth range of a camera (documentation: programming guide, abstract camera). Lengths in metres; the window is
/// measured at the near plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frustum {
    /// Parallel rays instead of rays from the eye.
    pub orthographic: bool,
    /// Horizontal middle of the window.
    pub center: f64,
    /// Half the window's width; without it the picture's shape decides.
    pub half_width: Option<f64>,
    /// Lower edge of the window.
    pub bottom: f64,
    /// Upper edge of the window.
    pub top: f64,
    /// Distance of the near plane.
    pub near: f64,
    /// Distance of the far plane.
    pub far: f64,
}

impl Default for View {
    /// From the origin along x, a right angle high.
    fn default() -> Self {
        View {
            eye: [0.0; 3],
            forward: [1.0, 0.0, 0.0],
            up: [0.0, 0.0, 1.0],
            frustum: Frustum {
                orthographic: false,
                center: 0.0,
                half_width: None,
                bottom: -0.01,
                top: 0.01,
                near: 0.01,
                far: 100.0,
            },
        }
    }
}
