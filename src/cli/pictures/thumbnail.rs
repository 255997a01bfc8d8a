//! Small pictures of environments, in which the body is large and the background light.

use crate::failure::Failure;
use crate::pictures::drawing::{Drawing, Plan};
use crate::pictures::framing::{AZIMUTHS, Body};
use crate::pictures::look::{MAX_SIDE, Size};
use crate::pictures::subject::{FREE, camera_of};
use env::Env;
use physics::math::ops;
use physics::model::TextureType;
use physics::{Data, Model};
use render::picture::Channels;
use render::scene::{Camera, SceneOptions};
use render::{Painters, Picture, Settings};

/// Colour of the background where a model has no sky.
const PAPER: [u8; 3] = [226, 231, 237];

/// Least share of a picture that a body takes up in the camera that its environment observes.
const LEAST_SHARE: f64 = 0.01;
/// Brightness that darker pictures are raised to, of 1.
const BRIGHTNESS: f64 = 0.4;
/// Least exponent of the raise: what is nearly black stays dark.
const LEAST_EXPONENT: f64 = 0.5;

/// The picture of an environment after a reset: from the camera that it observes, if that shows the body, else from the
/// three-quarter view that shows the body most clearly.
///
/// # Errors
/// The environment cannot be drawn.
pub fn thumbnail(env: &Env, size: Size, painters: &dyn Painters) -> Result<Picture, Failure> {
    let (model, data) = (&env.scene().model, &env.scene().data);
    let name = camera_of(env);
    let camera = Camera::named(model, &name).map_err(Failure::new)?;
    let plan = Plan { camera, size, options: SceneOptions::default(), settings: Settings::of(model) };
    let mut drawing = Drawing::new(model, plan, painters)?;
    let body = Body::of(model, data).map_err(Failure::new)?;
    let mut shows_body = || -> Result<bool, Failure> {
        let seen = &drawing.take(model, data, Channels::SEGMENTATION)?.segmentation;
        Ok(body.share(seen) >= LEAST_SHARE)
    };
    let camera = match name != FREE && shows_body()? {
        true => camera,
        false => best(&mut drawing, &body, (model, data), size)?,
    };
    drawing.aim(camera, size);
    let mut picture = drawing.take(model, data, Channels::RGB)?.clone();
    if !model.tex_type.contains(&TextureType::Skybox.code()) {
        put_on_paper(&mut picture, &mut drawing, (model, data), camera)?;
    }
    raise(&mut picture.rgb);
    Ok(picture)
}

/// Makes dark colours lighter by a power, which keeps black and white, until their mean is bright enough.
fn raise(rgb: &mut [u8]) {
    let mean = rgb.iter().map(|&value| f64::from(value) / 255.0).sum::<f64>() / rgb.len() as f64;
    if mean == 0.0 || mean >= BRIGHTNESS {
        return;
    }
    let exponent = (ops::log(BRIGHTNESS) / ops::log(mean)).max(LEAST_EXPONENT);
    let raised: [u8; 256] =
        std::array::from_fn(|value| (255.0 * ops::pow(value as f64 / 255.0, exponent)).round() as u8);
    rgb.iter_mut().for_each(|value| *value = raised[usize::from(*value)]);
}

/// The view of a body, of those at [`AZIMUTHS`], that shows it most clearly; the first of equal ones.
fn best(
    drawing: &mut Drawing,
    body: &Body,
    (model, data): (&Model, &Data),
    size: Size,
) -> Result<Camera, Failure> {
    let mut best = (Camera::free(model), 0.0);
    for azimuth in AZIMUTHS {
        let camera = Camera::Free(body.camera(model, azimuth, size));
        drawing.aim(camera, size);
        let clarity = body.clarity(&drawing.take(model, data, Channels::SEGMENTATION)?.segmentation);
        if clarity > best.1 {
            best = (camera, clarity);
        }
    }
    Ok(best.0)
}

/// Puts paper behind what is drawn. Colours at the edges are means with a black background, which has as large a share there as
/// in a segmentation of twice the size.
fn put_on_paper(
    picture: &mut Picture,
    drawing: &mut Drawing,
    (model, data): (&Model, &Data),
    camera: Camera,
) -> Result<(), Failure> {
    let (width, height) = (picture.width, picture.height);
    let factor = if 2 * width.max(height) <= MAX_SIDE { 2 } else { 1 };
    drawing.aim(camera, Size { width: factor * width, height: factor * height });
    let seen = &drawing.take(model, data, Channels::SEGMENTATION)?.segmentation;
    for (pixel, colour) in picture.rgb.as_chunks_mut::<3>().0.iter_mut().enumerate() {
        let (row, column) = (factor * (pixel / width), factor * (pixel % width));
        let samples = (0..factor * factor).map(|k| (row + k / factor) * factor * width + column + k % factor);
        let empty = samples.filter(|&sample| seen[sample] == [-1; 2]).count();
        for (value, paper) in colour.iter_mut().zip(PAPER) {
            *value = value.saturating_add((usize::from(paper) * empty / (factor * factor)) as u8);
        }
    }
    Ok(())
}
