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
    let camera = Camera::free(model);
    let plan = Plan { camera, size, options: SceneOptions::default(), settings: Settings::of(model) };
    let mut drawing = Drawing::new(model, plan, painters)?;
    let camera = viewpoint(env, size, &mut drawing)?;
    drawing.aim(camera, size);
    let mut picture = drawing.take(model, data, Channels::RGB)?.clone();
    if !model.tex_type.contains(&TextureType::Skybox.code()) {
        put_on_paper(&mut picture, &mut drawing, (model, data), camera)?;
    }
    raise(&mut picture.rgb);
    Ok(picture)
}

/// The camera of a thumbnail.
fn viewpoint(env: &Env, size: Size, drawing: &mut Drawing) -> Result<Camera, Failure> {
    let (model, data) = (&env.scene().model, &env.scene().data);
    let body = Body::of(model, data).map_err(Failure::new)?;
    let name = camera_of(env);
    if name != FREE {
        let camera = Camera::named(model, &name).map_err(Failure::new)?;
        drawing.aim(camera, size);
        if body.share(&drawing.take(model, data, Channels::SEGMENTATION)?.segmentation) >= LEAST_SHARE {
            return Ok(camera);
        }
    }
    clearest(drawing, &body, (model, data), size)
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
fn clearest(
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

#[cfg(test)]
mod tests {
    use super::*;
    use env::{Options, OwnModels};
    use render::painter::Cpu;

    const SIZE: Size = Size { width: 240, height: 180 };

    /// An arm, an elbow, a quadruped and a hand after a reset.
    fn own() -> Vec<Env> {
        let ids = ["hive/FrankaReach-v0", "hive/ElbowPose-v0", "hive/QuadrupedWalk-v0", "hive/door-v1"];
        let make = |id| {
            let mut env = Env::make(id, &OwnModels, &Options::default()).ok().unwrap();
            env.reset(Some(0)).unwrap();
            env
        };
        ids.into_iter().map(make).collect()
    }

    /// What draws an environment.
    fn drawing(env: &Env) -> Drawing {
        let model = &env.scene().model;
        let (camera, settings) = (Camera::free(model), Settings::of(model));
        let plan = Plan { camera, size: SIZE, options: SceneOptions::default(), settings };
        Drawing::new(model, plan, &Cpu).ok().unwrap()
    }

    /// Share of the picture that the body takes up, and share of its width or height, whichever is larger, between the
    /// outermost pixels of the body.
    fn measured(env: &Env, drawing: &mut Drawing, size: Size) -> (f64, f64) {
        let (model, data) = (&env.scene().model, &env.scene().data);
        let body = Body::of(model, data).unwrap();
        let seen = drawing.take(model, data, Channels::SEGMENTATION).ok().unwrap().segmentation.clone();
        let shows = |row: usize, column: usize| body.share(&[seen[row * size.width + column]]) > 0.0;
        let rows: Vec<_> =
            (0..size.height).filter(|&row| (0..size.width).any(|column| shows(row, column))).collect();
        let columns: Vec<_> =
            (0..size.width).filter(|&column| (0..size.height).any(|row| shows(row, column))).collect();
        let across = |places: &[usize], side: usize| match places {
            [first, .., last] => (last - first + 1) as f64 / side as f64,
            _ => 0.0,
        };
        (body.share(&seen), across(&rows, size.height).max(across(&columns, size.width)))
    }

    #[test]
    fn a_body_fills_its_picture_from_every_side() {
        for env in own() {
            let mut drawing = drawing(&env);
            let body = Body::of(&env.scene().model, &env.scene().data).unwrap();
            for azimuth in AZIMUTHS {
                for size in [SIZE, Size { width: 60, height: 180 }] {
                    drawing.aim(Camera::Free(body.camera(&env.scene().model, azimuth, size)), size);
                    let (_, across) = measured(&env, &mut drawing, size);
                    assert!((0.7..=0.95).contains(&across), "{} {azimuth} {size}: {across}", env.spec().id);
                }
            }
        }
    }

    #[test]
    fn thumbnails_show_the_body_large_on_a_light_background() {
        for (env, least) in own().iter().zip([0.03, 0.025, 0.2, 0.03]) {
            let picture = thumbnail(env, SIZE, &Cpu).ok().unwrap();
            let mut drawing = drawing(env);
            let camera = viewpoint(env, SIZE, &mut drawing).ok().unwrap();
            drawing.aim(camera, SIZE);
            let (share, _) = measured(env, &mut drawing, SIZE);
            let mean =
                picture.rgb.iter().map(|&value| f64::from(value)).sum::<f64>() / picture.rgb.len() as f64;
            assert!(share >= least, "{}: {share}", env.spec().id);
            assert!(mean > 90.0, "{}: {mean}", env.spec().id);
        }
    }
}
