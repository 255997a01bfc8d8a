//! What Python says of cameras, options and overlays, and what it is told of them.

use crate::mujoco::Free;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use render::scene::{Camera, FreeCamera};
use viewer::remote::{Bytes, Figure, Image, Line, Opening, OptionCodes, Place, Sight, Text};
use viewer::{EFFECTS, SHOW};

/// What a window opens with.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct OpeningGiven {
    title: String,
    left: bool,
    right: bool,
    keys: bool,
    runs: bool,
    file: Option<String>,
}

impl From<OpeningGiven> for Opening {
    fn from(given: OpeningGiven) -> Self {
        let OpeningGiven { title, left, right, keys, runs, file } = given;
        Opening { title, left, right, keys, runs, file, ..Opening::default() }
    }
}

/// A camera of the model, or a free one; and options by MuJoCo's numbers.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct SightGiven {
    camera: Option<usize>,
    free: Option<Free>,
    /// Of geoms, sites, joints, tendons, actuators, flexes, skins.
    groups: [[bool; 6]; 7],
    /// By the values of `mjtVisFlag`; those that there are not are left out.
    show: Vec<bool>,
    /// By the order of `effect_names`.
    effects: Vec<bool>,
    label: usize,
    frame: usize,
    tree_depth: i32,
    flex_layer: i32,
}

impl SightGiven {
    /// The sight of this model.
    pub fn sight(self, model: &physics::Model) -> Sight {
        let camera = match (self.camera, self.free) {
            (Some(camera), _) => Camera::Fixed(camera),
            (None, Some(free)) => Camera::Free(free.of(model)),
            (None, None) => Camera::free(model),
        };
        let on = |all: &[bool], place: usize| all.get(place).copied().unwrap_or(false);
        let codes = OptionCodes {
            groups: self.groups,
            show: std::array::from_fn(|place| on(&self.show, place)),
            effects: std::array::from_fn(|place| on(&self.effects, place)),
            label: self.label,
            frame: self.frame,
            tree_depth: self.tree_depth,
            flex_layer: self.flex_layer,
        };
        Sight { camera, options: codes.options() }
    }
}

/// A sight as Python gives it.
pub fn describe<'py>(py: Python<'py>, sight: &Sight) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    let (camera, free) = match sight.camera {
        Camera::Fixed(camera) => (Some(camera), None),
        Camera::Free(free) => (None, Some(describe_free(py, &free)?)),
    };
    all.set_item("camera", camera)?;
    all.set_item("free", free)?;
    let codes = OptionCodes::of(&sight.options);
    all.set_item("groups", codes.groups.map(|groups| groups.to_vec()).to_vec())?;
    all.set_item("show", codes.show.to_vec())?;
    all.set_item("effects", codes.effects.to_vec())?;
    all.set_item("label", codes.label)?;
    all.set_item("frame", codes.frame)?;
    all.set_item("tree_depth", codes.tree_depth)?;
    all.set_item("flex_layer", codes.flex_layer)?;
    Ok(all)
}

fn describe_free<'py>(py: Python<'py>, free: &FreeCamera) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    all.set_item("lookat", free.lookat)?;
    all.set_item("track", free.track)?;
    all.set_item("distance", free.distance)?;
    all.set_item("azimuth", free.azimuth)?;
    all.set_item("elevation", free.elevation)?;
    all.set_item("orthographic", free.orthographic)?;
    Ok(all)
}

/// Names of the effects of pictures, in order, and the number of kinds of elements that can be shown.
#[pyfunction]
pub fn effect_names() -> (Vec<&'static str>, usize) {
    (EFFECTS.iter().map(|effect| effect.name).collect(), SHOW.len())
}

/// A rectangle: left, bottom, width, height [pixels].
pub type PlaceGiven = (i32, i32, i32, i32);

fn place((left, bottom, width, height): PlaceGiven) -> Place {
    Place { left, bottom, width, height }
}

/// Twice the size, corner, first and second column.
pub type TextGiven = (bool, u8, String, String);

/// A text over the picture.
pub fn text((big, corner, first, second): TextGiven) -> Text {
    Text { big, corner, first, second }
}

/// An image over the picture: its place, and three bytes for each pixel from the top.
pub fn image((at, rgb): (PlaceGiven, Vec<u8>)) -> Image {
    Image { place: place(at), rgb: Bytes(rgb) }
}

/// A figure over the picture.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct FigureGiven {
    place: PlaceGiven,
    title: String,
    across: String,
    bars: bool,
    legend: bool,
    grows: bool,
    range: [[f32; 2]; 2],
    background: [f32; 4],
    /// Names, colours, points.
    lines: Vec<(String, [f32; 3], Vec<[f32; 2]>)>,
}

impl From<FigureGiven> for Figure {
    fn from(given: FigureGiven) -> Self {
        let FigureGiven { place: at, title, across, bars, legend, grows, range, background, lines } = given;
        let line = |(name, rgb, points)| Line { name, rgb, points };
        let lines = lines.into_iter().map(line).collect();
        Figure { place: place(at), title, across, bars, legend, grows, range, background, lines }
    }
}
