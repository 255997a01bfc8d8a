//! `render`: one picture of a model or an environment.

use crate::failure::{Failure, unwritable};
use crate::pictures::drawing::{Drawing, Plan, frame};
use crate::pictures::look::{Look, Size, Viewpoint};
use crate::pictures::preview::{Choice, Screen};
use crate::pictures::renderer::RendererArguments;
use crate::pictures::subject::SubjectArguments;
use crate::terminal::show;
use clap::{Args, ValueEnum, ValueHint};
use dataset::{Array, Values};
use render::Picture;
use render::picture::Channels;
use std::path::{Path, PathBuf};
use video::{
    Frame, Image, depth_image, depth_range, object_number, segmentation_image, write_depth_png, write_png,
};

/// Draw a model or an environment: colours, depth or segmentation
#[derive(Args)]
#[command(
    after_help = "Pictures are those of MuJoCo 3.12's offscreen renderer, drawn on the CPU without a display: the same \
bits on every machine. --renderer gpu draws them on a GPU, where colours differ by rounding.

What the file holds follows from its name. A .png has colours, 8 bits each; depth in whole millimetres, 16 bits, 65535 \
for all that is farther than 65.5 m; or with --depth=colours and --segmentation false colours for people. A .npy \
has colours as uint8 of HEIGHT x WIDTH x 3, depth in metres as float32 of HEIGHT x WIDTH, segmentation as int32 of \
HEIGHT x WIDTH x 2: number and type (mjtObj) of the object, -1 and -1 where there is none. Depth is the distance \
along the camera's gaze; where nothing is seen, that of its far plane.

Without --out the terminal shows the picture, if it can.

Examples:
  robohive render assets/franka/franka_table.xml --camera front --out arm.png
  robohive render assets/pile/pile.xml --azimuth 120 --elevation -20 --out pile.png
  robohive render hive/FrankaReach-v0 --seed 3 --size 224 --depth --out depth.npy
  robohive render hive/FrankaReach-v0 --segmentation --out parts.png
  robohive render assets/pile/pile.xml --show contacts,forces --out forces.png
  robohive render assets/elbow/elbow.xml --label tendons --out tendons.png
  robohive render hive/FrankaReach-v0 --preview=blocks"
)]
pub struct Render {
    /// What is drawn
    #[command(flatten)]
    subject: SubjectArguments,
    /// From where
    #[command(flatten)]
    viewpoint: Viewpoint,
    /// Columns and rows of the picture, or one number for both
    #[arg(long, value_name = "WxH", default_value = "640x480")]
    size: Size,
    /// Draw distances instead of colours; --depth=colours writes them as false colours
    #[arg(
        long, value_name = "AS", num_args = 0..=1, require_equals = true, default_missing_value = "distances",
        conflicts_with = "segmentation"
    )]
    depth: Option<DepthFile>,
    /// Draw which object is seen instead of colours
    #[arg(long)]
    segmentation: bool,
    /// What is shown
    #[command(flatten)]
    look: Look,
    /// What draws
    #[command(flatten)]
    renderer: RendererArguments,
    /// Write the picture to this file, .png or .npy
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, value_parser = picture_file)]
    out: Option<PathBuf>,
    /// Show the picture in the terminal; a protocol that is named is sent to a pipe, too
    #[arg(long, value_name = "PROTOCOL", num_args = 0..=1, require_equals = true, default_missing_value = "auto")]
    preview: Option<Choice>,
}

/// How depth is written to a .png.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum DepthFile {
    /// The distances themselves
    Distances,
    /// Colours from the nearest to the farthest of the picture
    Colours,
}

/// What a file of this name holds.
fn is_npy(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("npy"))
}

/// A name that says what the file holds.
fn picture_file(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let is_png = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("png"));
    match is_png || is_npy(&path) {
        true => Ok(path),
        false => Err("pictures are .png or .npy files".into()),
    }
}

/// Runs the command.
pub fn run(a: &Render) -> Result<(), Failure> {
    let screen = match (a.preview, &a.out) {
        (None, Some(_)) => None,
        (choice, _) => {
            Some(Screen::require(choice.unwrap_or(Choice::Auto), "name a file with --out FILE.png")?)
        }
    };
    let options = a.look.options()?;
    let painters = a.renderer.painters()?;
    let subject = a.subject.find()?;
    let model = subject.model();
    let (camera, camera_name) = a.viewpoint.camera(model, &subject.camera())?;
    let plan = Plan { camera, size: a.size, options, settings: a.look.settings(model) };
    let channels = match (a.depth, a.segmentation) {
        (Some(_), _) => Channels::DEPTH,
        (None, true) => Channels::SEGMENTATION,
        (None, false) => Channels::RGB,
    };
    let mut drawing = Drawing::new(model, plan, &*painters)?;
    let picture = drawing.take(model, subject.data(), channels)?;
    let colours = false_colours(picture)?;
    let frame = colours.as_ref().map_or_else(|| frame(picture), |image| Ok(image.frame()))?;
    if let Some(path) = &a.out {
        let held = write(path, picture, &frame, a.depth)?;
        show!("written      {}, {held} of {}, camera {camera_name}", path.display(), a.size);
    }
    if let Some(screen) = screen {
        screen.show(&frame);
    }
    Ok(())
}

/// Writes what a picture has; what that is. `frame` has it in colours.
fn write(
    path: &Path,
    picture: &Picture,
    frame: &Frame<'_>,
    depth: Option<DepthFile>,
) -> Result<&'static str, Failure> {
    if is_npy(path) {
        std::fs::write(path, array(picture).encode()).map_err(unwritable(path))?;
        return Ok("numbers");
    }
    if depth == Some(DepthFile::Distances) {
        let (width, height) = (picture.width as u32, picture.height as u32);
        write_depth_png(path, width, height, &picture.depth).map_err(Failure::new)?;
        return Ok("millimetres");
    }
    write_png(path, frame).map_err(Failure::new)?;
    Ok(match (picture.depth.is_empty(), picture.segmentation.is_empty()) {
        (true, true) => "colours",
        (false, _) => "distances in colours",
        (true, false) => "objects in colours",
    })
}

/// What a picture has, as numbers.
fn array(picture: &Picture) -> Array {
    let Picture { width, height, rgb, depth, segmentation } = picture;
    let (channels, values) = match (rgb.is_empty(), depth.is_empty()) {
        (false, _) => (Some(3), Values::U8(rgb.clone())),
        (true, false) => (None, Values::F32(depth.clone())),
        (true, true) => (Some(2), Values::I32(segmentation.as_flattened().to_vec())),
    };
    Array { shape: [*height, *width].into_iter().chain(channels).collect(), values }
}

/// Depth or segmentation of a picture in false colours; none where it has colours of its own.
fn false_colours(picture: &Picture) -> Result<Option<Image>, Failure> {
    let (width, height) = (picture.width as u32, picture.height as u32);
    let image = if !picture.depth.is_empty() {
        depth_image(width, height, &picture.depth, depth_range(&picture.depth))
    } else if !picture.segmentation.is_empty() {
        let numbers: Vec<i32> = picture.segmentation.iter().map(|&seen| object_number(seen)).collect();
        segmentation_image(width, height, &numbers)
    } else {
        return Ok(None);
    };
    image.map(Some).map_err(Failure::new)
}
