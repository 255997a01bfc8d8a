//! The choice of a camera, and the view that it has.

use crate::RenderError;
use crate::view::{Frustum, View};
use physics::elements::CameraId;
use physics::math::{Vec3, add, add_scaled, column, dot, norm, ops, scale};
use physics::model::{ObjType, Projection, Suggestions};
use physics::{Data, Model};

/// A camera that looks at a point from a distance (documentation: `mjvCamera`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeCamera {
    /// Where it looks, world frame \[m\].
    pub lookat: Vec3,
    /// Body at whose subtree's centre of mass it looks instead.
    pub track: Option<usize>,
    /// Distance of the eye from where it looks \[m\].
    pub distance: f64,
    /// Azimuth of the gaze about z, from x \[deg\].
    pub azimuth: f64,
    /// Elevation of the gaze above the horizon \[deg\].
    pub elevation: f64,
    /// Parallel rays.
    pub orthographic: bool,
    /// Vertical field of view, or vertical extent where rays are parallel \[deg, m\].
    pub fovy: f64,
}

impl FreeCamera {
    /// The one that the model starts with: it looks at the middle of the model and sees most of it.
    pub fn of(model: &Model) -> Self {
        let global = &model.vis.global;
        FreeCamera {
            lookat: model.stat.center,
            track: None,
            distance: 1.5 * model.stat.extent,
            azimuth: f64::from(global.azimuth),
            elevation: f64::from(global.elevation),
            orthographic: global.orthographic != 0,
            fovy: f64::from(global.fovy),
        }
    }

    /// The pose of its eye.
    fn pose(&self, model: &Model, data: &Data) -> Result<Pose, RenderError> {
        let (sin_azimuth, cos_azimuth) = ops::sincos(self.azimuth.to_radians());
        let (sin_elevation, cos_elevation) = ops::sincos(self.elevation.to_radians());
        let forward = [cos_elevation * cos_azimuth, cos_elevation * sin_azimuth, sin_elevation];
        let target = match self.track {
            None => self.lookat,
            Some(body) => *data.com.subtree_com.get(body).ok_or_else(|| RenderError::Model {
                message: format!("a camera follows body {body}, but there are {} bodies", model.nbody),
            })?,
        };
        Ok(Pose {
            eye: add_scaled(target, forward, -self.distance),
            forward,
            up: [-sin_elevation * cos_azimuth, -sin_elevation * sin_azimuth, cos_elevation],
            right: [sin_azimuth, -cos_azimuth, 0.0],
            between_eyes: f64::from(model.vis.global.ipd),
        })
    }
}

/// Which camera a picture is taken with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Camera {
    /// One that stands free.
    Free(FreeCamera),
    /// A camera of the model, by its number.
    Fixed(usize),
}

impl From<FreeCamera> for Camera {
    fn from(camera: FreeCamera) -> Self {
        Camera::Free(camera)
    }
}

impl From<CameraId> for Camera {
    fn from(camera: CameraId) -> Self {
        Camera::Fixed(camera.index())
    }
}

/// Name of the free camera.
const FREE: &str = "free";

impl Camera {
    /// The free camera that the model starts with.
    pub fn free(model: &Model) -> Self {
        Camera::Free(FreeCamera::of(model))
    }

    /// The camera of the model called `name`, or the free one for `free` where no camera has that name.
    ///
    /// # Errors
    /// The model has no such camera; the error lists those that there are.
    pub fn named(model: &Model, name: &str) -> Result<Self, RenderError> {
        match model.id_of(ObjType::Camera, name) {
            Some(camera) => Ok(Camera::Fixed(camera)),
            None if name == FREE => Ok(Camera::free(model)),
            None => Err(unknown(model, name)),
        }
    }

    /// What this camera sees in the present state, whose poses must have been computed.
    ///
    /// # Errors
    /// The model has no such camera, its pose is not finite, or its frustum is empty.
    pub fn view(&self, model: &Model, data: &Data) -> Result<View, RenderError> {
        let (pose, window) = match self {
            Camera::Free(free) => (free.pose(model, data)?, Window::upright(free.orthographic, free.fovy)),
            &Camera::Fixed(camera) => {
                if camera >= model.ncam {
                    return Err(unknown(model, &camera.to_string()));
                }
                (Pose::of_fixed(model, data, camera), Window::of_fixed(model, camera))
            }
        };
        let view = pose.view(window.frustum(model)?);
        let finite = [view.eye, view.forward, view.up].as_flattened().iter().all(|x| x.is_finite());
        let what = || match *self {
            Camera::Free(_) => "the free camera".to_owned(),
            Camera::Fixed(camera) => model.label_of(ObjType::Camera, camera),
        };
        if finite { Ok(view) } else { Err(RenderError::NotFinite { what: what() }) }
    }
}

/// The error for a camera that does not exist.
fn unknown(model: &Model, name: &str) -> RenderError {
    let cameras: Vec<String> = model.camera_names().map(|(_, name)| name.to_owned()).collect();
    let candidates = cameras.iter().map(String::as_str).chain([FREE]);
    let nearest = Suggestions::default().nearest(name, candidates).map(str::to_owned);
    RenderError::UnknownCamera { name: name.to_owned(), cameras, nearest }
}

/// The pose of a pair of eyes; the picture is taken from the middle between them.
struct Pose {
    eye: Vec3,
    forward: Vec3,
    up: Vec3,
    right: Vec3,
    between_eyes: f64,
}

impl Pose {
    fn of_fixed(model: &Model, data: &Data, camera: usize) -> Self {
        let mat = &data.kin.cam_xmat[camera];
        Pose {
            eye: data.kin.cam_xpos[camera],
            forward: scale(column(mat, 2), -1.0),
            up: column(mat, 1),
            right: column(mat, 0),
            between_eyes: model.cam_ipd[camera],
        }
    }

    /// The view between both eyes. MuJoCo rounds the pose of each eye to single precision and their mean once more; the
    /// same here, since infinite planes jump where the eye passes the middle between two of their places.
    fn view(&self, frustum: Frustum) -> View {
        let eyes = [-0.5, 0.5].map(|side| single(add_scaled(self.eye, self.right, side * self.between_eyes)));
        let (forward, up) = (unit(single(self.forward)), single(self.up));
        View {
            eye: single(scale(add(eyes[0], eyes[1]), 0.5)),
            forward: single(forward),
            up: single(unit(add_scaled(up, forward, -dot(up, forward)))),
            frustum,
        }
    }
}

/// Direction of `v`, not finite where it has none.
fn unit(v: Vec3) -> Vec3 {
    scale(v, 1.0 / norm(v))
}

/// Rounded to single precision.
fn single(v: Vec3) -> Vec3 {
    v.map(|x| f64::from(x as f32))
}

/// The opening of a camera.
enum Window {
    /// Symmetric, as wide as the picture: parallel rays of this vertical extent \[m\].
    Parallel(f64),
    /// Symmetric, as wide as the picture: this vertical field of view \[deg\].
    Angle(f64),
    /// A sensor: its sides, focal lengths and offset of the principal point \[m\].
    Sensor { side: [f32; 2], focal: [f32; 2], offset: [f32; 2] },
}

impl Window {
    fn upright(orthographic: bool, fovy: f64) -> Self {
        if orthographic { Window::Parallel(fovy) } else { Window::Angle(fovy) }
    }

    fn of_fixed(model: &Model, camera: usize) -> Self {
        let (side, [fx, fy, cx, cy]) = (model.cam_sensorsize[camera], model.cam_intrinsic[camera]);
        let orthographic = model.cam_projection[camera] == Projection::Orthographic.code();
        if orthographic || side[1] == 0.0 {
            Window::upright(orthographic, model.cam_fovy[camera])
        } else {
            Window::Sensor { side, focal: [fx, fy], offset: [cx, cy] }
        }
    }

    /// The frustum of this opening, in numbers of single precision.
    fn frustum(&self, model: &Model) -> Result<Frustum, RenderError> {
        let near = (f64::from(model.vis.map.znear) * model.stat.extent) as f32;
        let far = (f64::from(model.vis.map.zfar) * model.stat.extent) as f32;
        let symmetric = |half: f64| ([half as f32; 2], None);
        let (vertical, horizontal) = match *self {
            Window::Parallel(extent) => symmetric(extent / 2.0),
            Window::Angle(fovy) => symmetric(f64::from(near) * ops::tan(fovy.to_radians() / 2.0)),
            Window::Sensor { side, focal, offset } => {
                let edges =
                    |k: usize| [-offset[k], offset[k]].map(|c: f32| near / focal[k] * (side[k] / 2.0 + c));
                (edges(1), Some(edges(0)))
            }
        };
        let width = horizontal.map_or(1.0, |[left, right]| left + right);
        let ordered = far > near && near > 0.0 && vertical[0] + vertical[1] > 0.0 && width > 0.0;
        let finite = [near, far, vertical[0], vertical[1], width].iter().all(|x| x.is_finite());
        if !(ordered && finite) {
            let [above, below] = vertical;
            return Err(RenderError::Frustum {
                message: format!(
                    "its window reaches {above} m up and {below} m down, from {near} m to {far} m; check its field of \
                     view or sensor, visual/map znear and zfar, and statistic extent"
                ),
            });
        }
        Ok(Frustum {
            orthographic: matches!(self, Window::Parallel(_)),
            center: horizontal.map_or(0.0, |[left, right]| f64::from((right - left) / 2.0)),
            half_width: horizontal.map(|[left, right]| f64::from((right + left) / 2.0)),
            bottom: f64::from(-vertical[1]),
            top: f64::from(vertical[0]),
            near: f64::from(near),
            far: f64::from(far),
        })
    }
}
