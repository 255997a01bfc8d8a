//! Pictures beside those that MuJoCo's offscreen renderer drew.
//!
//! `reference/pictures.py` records, for each scene of `validation/pictures.toml`, a pose, what MuJoCo assembled to draw, and
//! pictures of three sizes. Here the same pose is drawn and compared: first the list of what is to be drawn, then colours
//! with and without shadows, then depth and segmentation.

pub mod drawn;
pub mod dump;
pub mod floor;
#[cfg(feature = "gpu")]
pub mod gpu;
pub mod items;
pub mod measures;
pub mod plan;
pub mod recording;
pub mod similarity;
pub mod table;
pub mod views;

use drawn::Drawn;
use items::Differences;
use measures::{compare_colours, compare_shapes, interior};
use plan::{Bars, Held, Plan, SceneRow};
use recording::Recording;
use render::Profile;
use std::path::Path;
use table::{Remark, Row};
use views::Views;

/// What is compared with what.
pub struct Inputs<'a> {
    /// Folder with RoboHive's `envs` and `simhive` and MuJoCo's `model`; scenes of own models alone without it.
    pub models: Option<&'a Path>,
    /// Folder of recordings.
    pub references: &'a Path,
    /// Scenes whose name contains this.
    pub only: &'a str,
    /// Folder of other recordings, compared in place of our pictures.
    pub other: Option<&'a Path>,
    /// Folder for pictures to look at.
    pub dump: Option<&'a Path>,
}

/// Compares the chosen scenes; the table, and as verdict whether every bar is reached.
///
/// # Errors
/// The list of scenes cannot be read, or nothing is chosen.
pub fn measure(inputs: &Inputs<'_>) -> Result<(String, Result<(), String>), String> {
    let plan = Plan::listed()?;
    let (mut rows, mut remarks) = (Vec::new(), Vec::new());
    // Of RoboHive's version of MuJoCo its own scenes are recorded alone.
    let first = plan.scenes.iter().find_map(|scene| Recording::open(inputs.references, scene).ok());
    let profile = first.map_or(Ok(Profile::default()), |recorded| recorded.profile())?;
    let chosen = |scene: &&SceneRow| {
        scene.name.contains(inputs.only)
            && (inputs.models.is_some() || scene.is_own())
            && (profile == Profile::Mujoco312 || scene.is_of_robohive())
    };
    for scene in plan.scenes.iter().filter(chosen) {
        let mut remark = Remark { scene: scene.name.clone(), note: scene.note.clone(), ..Remark::default() };
        match Recording::open(inputs.references, scene).and_then(|recorded| {
            let compared = Compared { plan: &plan, scene, recorded: &recorded, inputs };
            compared.measure()
        }) {
            Ok((found, differences)) => {
                rows.extend(found);
                remark.differences = differences;
            }
            Err(error) => remark.failure = Some(error),
        }
        remarks.push(remark);
    }
    if remarks.is_empty() {
        return Err(format!("no scene of validation/pictures.toml contains {:?}", inputs.only));
    }
    Ok(table::render(&plan, &rows, &remarks))
}

/// One scene and its recording.
struct Compared<'a> {
    plan: &'a Plan,
    scene: &'a SceneRow,
    recorded: &'a Recording,
    inputs: &'a Inputs<'a>,
}

impl Compared<'_> {
    /// Every size, and how the list of what is drawn differs.
    fn measure(&self) -> Result<(Vec<Row>, Option<Differences>), String> {
        let Compared { scene, recorded, inputs, .. } = *self;
        let mut views: Box<dyn Views> = match inputs.other {
            Some(folder) => Box::new(Recording::open(folder, scene)?),
            None => Box::new(Drawn::open(inputs.models, scene, recorded)?),
        };
        let bars = match scene.bars {
            Held::Floor => {
                let other = Recording::open(&inputs.references.join("floor"), scene)?;
                floor::bars(self.plan, recorded, &other)?
            }
            Held::Listed => self.plan.bars_of(scene)?,
        };
        let differences = views.differences(recorded)?;
        let sides = self.plan.sizes.iter().filter(|side| recorded.has(&format!("{side}/rgb")));
        let rows = sides.map(|&side| self.measure_side(&mut *views, side, bars));
        Ok((rows.collect::<Result<_, _>>()?, differences))
    }

    fn measure_side(&self, views: &mut dyn Views, side: usize, bars: Bars) -> Result<Row, String> {
        let Compared { scene, recorded, inputs, .. } = *self;
        let shown = recorded.geometry(side)?;
        let inside = interior(&shown.ids, side);
        let mut compare = |shadows: bool, kind: &str| -> Result<_, String> {
            let (theirs, ours) = (recorded.colours(side, kind)?, views.colours(side, shadows)?);
            if let Some(folder) = inputs.dump {
                dump::side_by_side(folder, &format!("{}_{side}_{kind}", scene.name), side, &ours, &theirs)?;
            }
            Ok(compare_colours(&theirs, &ours, side, &inside))
        };
        let (colours, no_shadow) = (compare(true, "rgb")?, compare(false, "rgb_no_shadow")?);
        let ours = views.geometry(side)?;
        if let Some(folder) = inputs.dump {
            let [ours, theirs] = [&ours.ids, &shown.ids].map(|ids| dump::false_colours(ids));
            dump::side_by_side(folder, &format!("{}_{side}_ids", scene.name), side, &ours, &theirs)?;
        }
        let shapes = compare_shapes(&shown, &ours, &inside);
        Ok(Row { scene: scene.name.clone(), side, colours, no_shadow, shapes, held: scene.bars, bars })
    }
}
