//! Scenes that are assembled for pictures, compared with those that `reference/items.py` recorded: items in their order,
//! lights, cameras.

use crate::reference::{Reference, ReferenceError};
use crate::status::open;
use physics::math::{Quat, Vec3};
use physics::model::{GeomType, ObjType};
use physics::{Data, Model, forward};
use render::RenderError;
use render::View;
use render::scene::{
    Camera, Category, FrameChoice, FreeCamera, GROUPS, Groups, Item, LabelChoice, Light, LightKind, Pull,
    Scene, SceneOptions, Selection, Shape, Show,
};
use std::fmt::Write;
use std::path::Path;

/// Largest difference of numbers of single precision that come out of sums in another order, relative to the length of
/// the vector, at least 1.
pub const BAR: f64 = 1e-6;

/// Columns of the recorded codes and numbers of an item.
const CODES: usize = 7;
const NUMBERS: [usize; 6] = [3, 9, 3, 4, 4, 1];
const LABEL: usize = 100;

/// What the numbers of an item, a light and a view are called in the report.
const PARTS: [&str; 8] = ["pos", "mat", "size", "rgba", "look", "rbound", "light", "view"];

/// How the scenes of a model compare.
#[derive(Clone, Debug, Default)]
pub struct SceneReport {
    /// Scenes.
    pub scenes: usize,
    /// Items in all of them.
    pub items: usize,
    /// Lights in all of them.
    pub lights: usize,
    /// Scenes with another list of items or lights, or with a number outside the bar.
    pub different: usize,
    /// Largest differences of `PARTS`.
    pub worst: [f64; PARTS.len()],
    /// The first scenes that differ, and how.
    pub notes: Vec<String>,
}

/// Path of a model in the list, and how its scenes compare.
pub type Compared = (String, Result<SceneReport, String>);

/// Most differences that are told of one model.
const MAX_NOTES: usize = 12;

impl SceneReport {
    /// The row as a table line.
    pub fn line(&self, model: &str) -> String {
        let numbers = self.worst.map(|x| if x == 0.0 { "0".to_owned() } else { format!("{x:.0e}") });
        let equal = self.scenes - self.different;
        format!(
            "| {model} | {equal}/{} | {} | {} | {} |",
            self.scenes,
            self.items,
            self.lights,
            numbers.join(" | ")
        )
    }
}

/// Why the scenes of a model cannot be compared.
fn told(error: impl std::fmt::Display) -> String {
    error.to_string()
}

/// Compares all scenes of a recorded model.
///
/// # Errors
/// The model or its record is missing or damaged, or the model does not step.
pub fn measure(model: &Path, reference: &Path) -> Result<SceneReport, String> {
    let (m, reference) = open(model, reference)?;
    let recorded = Recorded::read(&reference).map_err(told)?;
    let selection = selection(&reference).map_err(told)?;
    let (mut report, mut scene, mut d) = (SceneReport::default(), Scene::new(), Data::new(&m));
    let mut state = usize::MAX;
    let (mut item, mut light) = (0, 0);
    for k in 0..recorded.state.len() {
        if state != recorded.state[k] {
            state = recorded.state[k];
            reference.set_state(&mut d, &m, state).map_err(told)?;
            forward(&m, &mut d).map_err(told)?;
        }
        let options = variant(recorded.variant[k], selection);
        let items = item..item + recorded.items[k];
        let lights = light..light + recorded.lights[k];
        (item, light) = (items.end, lights.end);
        report.scenes += 1;
        report.items += items.len();
        report.lights += lights.len();
        let assembled = camera(&m, recorded.camera[k], &selection)
            .view(&m, &d)
            .and_then(|view| scene.update(&m, &d, view, &options));
        let difference = match assembled {
            Err(error) => Some(RenderError::to_string(&error)),
            Ok(()) => recorded.compare(&m, &scene, (k, items, lights), &mut report.worst),
        };
        if let Some(difference) = difference {
            report.different += 1;
            if report.notes.len() < MAX_NOTES {
                let (camera, variant) = (recorded.camera[k], recorded.variant[k]);
                report.notes.push(format!("state {state}, camera {camera}, variant {variant}: {difference}"));
            }
        }
    }
    Ok(report)
}

/// The table of all models, and an error when a scene differs.
pub fn render(rows: &[Compared]) -> (String, Result<(), String>) {
    let mut text =
        format!("| model | equal scenes | items | lights | {} |\n|---|---|---|---|", PARTS.join(" | "));
    text.push_str(&"---|".repeat(PARTS.len()));
    text.push('\n');
    let mut wrong = 0;
    for (model, row) in rows {
        wrong += usize::from(!row.as_ref().is_ok_and(|report| report.different == 0));
        let _ = match row {
            Ok(report) => writeln!(text, "{}", report.line(model)),
            Err(error) => writeln!(text, "| {model} | {} |", error.replace('|', "/")),
        };
    }
    let total =
        |count: fn(&SceneReport) -> usize| rows.iter().flat_map(|(_, row)| row).map(count).sum::<usize>();
    let (scenes, items) = (total(|r| r.scenes), total(|r| r.items));
    let head = format!(
        "Of {} models: {} with all scenes equal; {} of {scenes} scenes, {items} items.\n\n",
        rows.len(),
        rows.len() - wrong,
        scenes - total(|r| r.different),
    );
    let verdict = if wrong == 0 { Ok(()) } else { Err(format!("{wrong} models have scenes that differ")) };
    (head + &text, verdict)
}

/// The arrays of a record.
struct Recorded {
    state: Vec<usize>,
    camera: Vec<i32>,
    variant: Vec<usize>,
    view: Vec<[f64; 16]>,
    items: Vec<usize>,
    lights: Vec<usize>,
    item_code: Vec<[f64; CODES]>,
    item_number: Vec<[f64; 24]>,
    item_label: Vec<[f64; LABEL]>,
    light_code: Vec<[f64; 3]>,
    light_number: Vec<[f64; 20]>,
}

fn rows<const N: usize>(reference: &Reference, name: &str) -> Result<Vec<[f64; N]>, ReferenceError> {
    Ok(reference.rows(name, N)?.0.as_chunks::<N>().0.to_vec())
}

impl Recorded {
    fn read(reference: &Reference) -> Result<Self, ReferenceError> {
        let column = |name: &str| {
            Ok::<Vec<usize>, ReferenceError>(
                rows::<1>(reference, name)?.into_iter().map(|[x]| x as usize).collect(),
            )
        };
        Ok(Recorded {
            state: column("scene.state")?,
            camera: rows::<1>(reference, "scene.camera")?.into_iter().map(|[x]| x as i32).collect(),
            variant: column("scene.variant")?,
            view: rows(reference, "scene.view")?,
            items: column("scene.items")?,
            lights: column("scene.lights")?,
            item_code: rows(reference, "item.code")?,
            item_number: rows(reference, "item.number")?,
            item_label: rows(reference, "item.label")?,
            light_code: rows(reference, "light.code")?,
            light_number: rows(reference, "light.number")?,
        })
    }

    /// What differs in scene `k`, whose items and lights have these rows.
    fn compare(
        &self,
        m: &Model,
        scene: &Scene,
        (k, items, lights): (usize, std::ops::Range<usize>, std::ops::Range<usize>),
        worst: &mut [f64; PARTS.len()],
    ) -> Option<String> {
        let mut seen = [0.0; PARTS.len()];
        seen[7] = view_difference(&scene.view, &self.view[k]);
        for (i, (item, row)) in scene.items.iter().zip(items.clone()).enumerate() {
            let (ours, theirs) = (codes(m, item, i), self.item_code[row]);
            if let Some(what) = code_difference(&ours, &theirs.map(|x| x as i32)) {
                return Some(format!("item {i}: {what}"));
            }
            let label: String = self.item_label[row].iter().map(|&c| c as u8 as char).collect();
            if item.label.chars().take(LABEL - 1).collect::<String>() != label.trim_end_matches('\0') {
                return Some(format!("item {i}: label {:?} (MuJoCo {label:?})", item.label));
            }
            let differences = number_differences(item, &self.item_number[row]);
            for (part, difference) in differences.into_iter().enumerate() {
                if difference > BAR {
                    return Some(format!("item {i}: {} by {difference:e}, {item:?}", PARTS[part]));
                }
                seen[part] = seen[part].max(difference);
            }
        }
        if scene.items.len() != items.len() {
            return Some(format!("{} items (MuJoCo {})", scene.items.len(), items.len()));
        }
        match self.light_difference(scene, lights) {
            Ok(difference) => seen[6] = difference,
            Err(what) => return Some(what),
        }
        for (part, difference) in seen.into_iter().enumerate() {
            worst[part] = worst[part].max(difference);
        }
        (6..8).find(|&part| seen[part] > BAR).map(|part| format!("{} by {:e}", PARTS[part], seen[part]))
    }

    /// Largest difference of the first eight lights, those left out that do not light.
    fn light_difference(&self, scene: &Scene, lights: std::ops::Range<usize>) -> Result<f64, String> {
        let lights_here = |row: &usize| self.light_code[*row][0] <= 1.0;
        let theirs: Vec<usize> = lights.clone().take(8).filter(lights_here).collect();
        let ambient = if lights.clone().any(|row| lights_here(&row)) { 0.0 } else { 0.3_f32 };
        if scene.lights.len() != theirs.len() || scene.ambient != ambient {
            let ours = (scene.lights.len(), scene.ambient);
            return Err(format!("lights and ambience {ours:?} (MuJoCo {:?})", (theirs.len(), ambient)));
        }
        let pairs = scene.lights.iter().zip(theirs);
        pairs.enumerate().try_fold(0.0, |worst, (i, (light, row))| {
            let code = [light_type(light), f64::from(light.headlight), f64::from(light.shadow)];
            if code != self.light_code[row] {
                return Err(format!("light {i}: {code:?} (MuJoCo {:?})", self.light_code[row]));
            }
            Ok(f64::max(worst, distance(&light_numbers(light), &self.light_number[row])))
        })
    }
}

/// Largest difference of elements, relative to the largest element, at least 1; infinite where one is not a number.
fn distance(ours: &[f32], theirs: &[f64]) -> f64 {
    let scale = theirs.iter().fold(1.0_f64, |s, x| s.max(x.abs()));
    let worst = |w: f64, (a, b): (&f32, &f64)| {
        let d = (f64::from(*a) - b).abs();
        if d.is_nan() { f64::INFINITY } else { w.max(d) }
    };
    ours.iter().zip(theirs).fold(0.0, worst) / scale
}

fn light_type(light: &Light) -> f64 {
    if light.kind == LightKind::Directional { 1.0 } else { 0.0 }
}

fn light_numbers(light: &Light) -> Vec<f32> {
    let (attenuation, exponent, cutoff) = match light.kind {
        LightKind::Directional => ([0.0; 3], 0.0, 0.0),
        LightKind::Spot { cutoff, exponent, attenuation } => (attenuation, exponent, cutoff),
    };
    let colors = [light.ambient, light.diffuse, light.specular];
    [light.pos, light.dir, attenuation]
        .concat()
        .into_iter()
        .chain([exponent, cutoff])
        .chain(colors.concat())
        .collect()
}

/// Type, data, object, category, place and material of an item, in MuJoCo's codes; ellipsoids are spheres.
fn codes(m: &Model, item: &Item, place: usize) -> [i32; CODES] {
    let plane = |geom: usize| (0..geom).filter(|&g| m.geom_type[g] == GeomType::Plane.code()).count();
    let (code, data) = match item.shape {
        Shape::Plane { geom } => (0, plane(geom) as i32),
        Shape::Skin { .. } => (106, -1),
        Shape::Flex { .. } => (105, -1),
        Shape::Hfield { hfield } => (1, hfield as i32),
        Shape::Sphere => (2, -1),
        Shape::Capsule => (3, -1),
        Shape::Cylinder => (5, -1),
        Shape::Box => (6, -1),
        Shape::Mesh { mesh } => (7, 2 * mesh as i32),
        Shape::Hull { mesh } => (7, 2 * mesh as i32 + 1),
        Shape::Arrow => (100, -1),
        Shape::ThinArrow => (101, -1),
        Shape::DoubleArrow => (102, -1),
        Shape::Line => (103, -1),
        Shape::LineBox => (104, -1),
        Shape::Label => (107, -1),
        Shape::Triangle => (108, -1),
    };
    let category = match item.category {
        Category::Static => 1,
        Category::Dynamic => 2,
        Category::Decor => 4,
    };
    let material = item.material.map_or(-1, |k| k as i32);
    [code, data, item.object.kind, item.object.id, category, place as i32, material]
}

fn code_difference(ours: &[i32; CODES], theirs: &[i32; CODES]) -> Option<String> {
    let mut wanted = *theirs;
    if wanted[0] == GeomType::Ellipsoid.code() {
        wanted[0] = GeomType::Sphere.code();
    }
    // MuJoCo copies the unused mesh of a primitive that was fitted to it.
    if matches!(wanted[0], 2..=6) {
        wanted[1] = -1;
    }
    (*ours != wanted).then(|| format!("{ours:?} (MuJoCo {theirs:?})"))
}

fn number_differences(item: &Item, theirs: &[f64; 24]) -> [f64; 6] {
    let look = item.look;
    let look = [look.emission, look.specular, look.shininess, look.reflectance];
    let ours: [&[f32]; 6] = [&item.pos, &item.mat, &item.size, &item.rgba, &look, &[item.rbound]];
    // A label has no size; MuJoCo reckons the radius of what is no geom when it draws.
    let skipped = match (item.shape, item.object.kind == ObjType::Geom.code()) {
        (Shape::Label, _) => [2, 5],
        (_, false) => [5, 5],
        (_, true) => [6, 6],
    };
    let mut start = 0;
    std::array::from_fn(|part| {
        let theirs = &theirs[start..start + NUMBERS[part]];
        start += NUMBERS[part];
        if skipped.contains(&part) { 0.0 } else { distance(ours[part], theirs) }
    })
}

fn view_difference(view: &View, theirs: &[f64; 16]) -> f64 {
    let f = &view.frustum;
    let vector = |v: Vec3, at: usize| distance(&v.map(|x| x as f32), &theirs[at..at + 3]);
    let window = [f.center, f.half_width.unwrap_or(0.0), f.bottom, f.top, f.near, f.far].map(|x| x as f32);
    let windows =
        window.iter().zip(&theirs[9..15]).fold(0.0, |w, (a, b)| f64::max(w, distance(&[*a], &[*b])));
    let kind = if f64::from(f.orthographic) == theirs[15] { 0.0 } else { f64::INFINITY };
    [vector(view.eye, 0), vector(view.forward, 3), vector(view.up, 6), windows, kind]
        .into_iter()
        .fold(0.0, f64::max)
}

/// The camera of a recorded scene: -1 the free one, -2 the free one that follows the selected body.
fn camera(m: &Model, code: i32, selection: &Selection) -> Camera {
    match usize::try_from(code) {
        Ok(camera) => Camera::Fixed(camera),
        Err(_) if code == -1 => Camera::free(m),
        Err(_) => FreeCamera { track: Some(selection.body), ..FreeCamera::of(m) }.into(),
    }
}

fn selection(reference: &Reference) -> Result<Selection, ReferenceError> {
    let numbers = |name: &str| Ok::<_, ReferenceError>(reference.archive().require(name)?.values.to_f64());
    let misfit = |name: &str| ReferenceError::Shape(name.to_owned());
    let vector = |name: &str| Vec3::try_from(numbers(name)?).map_err(|_| misfit(name));
    let orientation = "selection.orientation";
    Ok(Selection {
        body: numbers("selection.body")?[0] as usize,
        point: vector("selection.point")?,
        pull: Pull::default(),
        second_pull: Pull::default(),
        target: vector("selection.target")?,
        orientation: Quat::try_from(numbers(orientation)?).map_err(|_| misfit(orientation))?,
    })
}

/// Options of row `k` of the variants in `reference/items.py`.
fn variant(k: usize, selection: Selection) -> SceneOptions {
    let d = Show::default();
    let show = match k {
        1 => Show { convex_hulls: true, ..d },
        2 => Show { textures: false, ..d },
        3 | 39 => Show { joints: true, ..d },
        4 | 33 | 42 => Show { cameras: true, ..d },
        5 | 45 => Show { actuators: true, ..d },
        6 => Show { actuators: true, activations: true, ..d },
        7 | 34 | 43 => Show { lights: true, ..d },
        8 => Show { tendons: false, ..d },
        9 => Show { rangefinders: false, ..d },
        10 | 46 => Show { constraints: true, ..d },
        11 | 26 | 30 | 38 => Show { inertias: true, ..d },
        12 => Show { inertias: true, scaled_inertias: true, ..d },
        13 => Show { applied_forces: true, ..d },
        14 | 49 => Show { contact_points: true, ..d },
        15 => Show { contact_points: true, islands: true, ..d },
        16 | 50 => Show { contact_forces: true, ..d },
        17 => Show { contact_forces: true, split_forces: true, ..d },
        18 => Show { transparent: true, ..d },
        19 => Show { connections: true, ..d },
        20 => Show { centers_of_mass: true, ..d },
        21 => Show { static_bodies: false, ..d },
        22 => Show { body_trees: true, ..d },
        23 => Show { mesh_trees: true, ..d },
        27 | 48 => Show { selected_point: true, ..d },
        28 => Show { perturbation: false, ..d },
        52..=54 => Show { joints: true, actuators: true, ..d },
        _ => d,
    };
    let hands = |pull: u8| Pull { translation: pull & 1 != 0, rotation: pull & 2 != 0 };
    let (first, second) = match k {
        24 => (1, 0),
        25 => (2, 1),
        26 => (3, 3),
        27 => (1, 2),
        _ => (0, 0),
    };
    SceneOptions::default()
        .with_groups(groups(k))
        .with_show(show)
        .with_label(label(k))
        .with_frame(frame(k))
        .with_selection(Some(Selection { pull: hands(first), second_pull: hands(second), ..selection }))
        .with_tree_depth(if k == 23 { 2 } else { 1 })
}

fn groups(k: usize) -> Groups {
    let shown: &[usize] = match k {
        52 => &[0],
        53 => &[1, 2],
        54 => &[3, 4, 5],
        _ => return Groups::default(),
    };
    let visible: [bool; GROUPS] = std::array::from_fn(|group| shown.contains(&group));
    Groups {
        geoms: visible,
        sites: visible,
        joints: visible,
        tendons: visible,
        actuators: visible,
        skins: visible,
        flexes: Groups::default().flexes,
    }
}

fn label(k: usize) -> LabelChoice {
    use LabelChoice as L;
    let labels = [
        L::Body,
        L::Body,
        L::Joint,
        L::Geom,
        L::Site,
        L::Camera,
        L::Light,
        L::Tendon,
        L::Actuator,
        L::Constraint,
        L::Selection,
        L::SelectedPoint,
        L::ContactPoint,
        L::ContactForce,
        L::Island,
    ];
    k.checked_sub(37).and_then(|i| labels.get(i).copied()).unwrap_or_default()
}

fn frame(k: usize) -> FrameChoice {
    use FrameChoice as F;
    let frames = [F::Body, F::Body, F::Geom, F::Site, F::Camera, F::Light, F::Contact, F::World];
    k.checked_sub(29).and_then(|i| frames.get(i).copied()).unwrap_or_default()
}
