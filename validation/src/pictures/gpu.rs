//! Pictures of a GPU beside the CPU renderer's, which are the reference, and beside MuJoCo's.

use super::Inputs;
use super::drawn::Drawn;
use super::measures::{Colours, Geometry, Shapes, compare_colours, compare_shapes, interior};
use super::plan::{Plan, SceneRow};
use super::recording::Recording;
use super::views::Views;
use render::picture::Channels;
use render::raster::Shot;
use render::scene::Scene;
use render::{Assets, Picture};
use render_gpu::{Choice, GpuRenderer};
use std::fmt::Write;
use std::time::Instant;

/// Least peak signal-to-noise ratio \[dB\].
const PSNR: f64 = 45.0;
/// Least share of interior pixels that show the same object. Where surfaces share a plane, rounding decides.
const INSIDE: f64 = 0.9995;
/// Largest 99th percentile of the relative difference of depth.
const DEPTH: f64 = 1e-4;
/// Pictures of the batch that is timed, and their columns and rows.
const BATCH: usize = 64;
const BATCH_SIDE: usize = 84;

/// One scene at one size.
struct Row {
    scene: String,
    side: usize,
    colours: Colours,
    no_shadow: Colours,
    shapes: Shapes,
    /// Peak signal-to-noise ratio of the GPU's and the CPU's picture beside MuJoCo's \[dB\].
    beside_mujoco: [f64; 2],
}

impl Row {
    fn holds(&self) -> bool {
        let Row { colours, no_shadow, shapes, .. } = self;
        let alike = colours.psnr >= PSNR && no_shadow.psnr >= PSNR;
        alike && shapes.ids_interior >= INSIDE && shapes.depth_p99 <= DEPTH
    }

    fn line(&self) -> String {
        let Row { scene, side, colours, no_shadow, shapes, beside_mujoco: [gpu, cpu] } = self;
        let mark = if self.holds() { "" } else { " **missed**" };
        format!(
            "| {scene}{mark} | {side} | {:.1} | {:.4} | {:.1} | {:.4} | {:.4} | {:.1e} | {gpu:.1} | {cpu:.1} |",
            colours.psnr, colours.ssim, no_shadow.psnr, shapes.ids, shapes.ids_interior, shapes.depth_p99
        )
    }
}

const HEADER: &str = "| scene | side | PSNR | SSIM | without shadows | equal ids | inside | depth p99 | GPU beside MuJoCo | CPU beside MuJoCo |
|---|---|---|---|---|---|---|---|---|---|
";

/// Draws the chosen scenes on any GPU and on the CPU; the table, and as verdict whether they are alike.
///
/// # Errors
/// There is no GPU, the list of scenes cannot be read, or nothing is chosen.
pub fn measure(inputs: &Inputs<'_>) -> Result<(String, Result<(), String>), String> {
    let plan = Plan::listed()?;
    let (mut text, mut missed, mut speeds) = (String::from(HEADER), 0, String::new());
    let mut adapter = None;
    let chosen = |scene: &&SceneRow| {
        // Other effects are left to the CPU.
        let drawn = scene.effects.is_empty();
        drawn && scene.name.contains(inputs.only) && (inputs.models.is_some() || scene.is_own())
    };
    for scene in plan.scenes.iter().filter(chosen) {
        let Ok(recorded) = Recording::open(inputs.references, scene) else { continue };
        let mut drawn = Drawn::open(inputs.models, scene, &recorded)?;
        let mut gpu = GpuRenderer::new(*drawn.settings(), &Choice::Any).map_err(|error| error.to_string())?;
        adapter.get_or_insert_with(|| gpu.adapter().to_string());
        for &side in &plan.sizes {
            let row = measure_side(scene, side, &recorded, &mut drawn, &mut gpu)?;
            missed += usize::from(!row.holds());
            let _ = writeln!(text, "{}", row.line());
        }
        if scene.is_own() {
            let rate = pictures_per_second(drawn.assets(), &drawn.scene(true)?, &mut gpu)?;
            let _ = writeln!(speeds, "- {}: {rate:.1}", scene.name);
        }
    }
    let Some(adapter) = adapter else {
        return Err(format!("no recorded scene of validation/pictures.toml contains {:?}", inputs.only));
    };
    let _ = writeln!(
        text,
        "\nThe GPU: {adapter}. Least PSNR {PSNR}, least share inside {INSIDE}, largest depth {DEPTH:.0e}."
    );
    let _ = write!(
        text,
        "\nPictures a second, in batches of {BATCH} at {BATCH_SIDE} x {BATCH_SIDE}:\n\n{speeds}"
    );
    Ok((text, if missed == 0 { Ok(()) } else { Err(format!("{missed} pictures are not alike")) }))
}

fn measure_side(
    scene: &SceneRow,
    side: usize,
    recorded: &Recording,
    drawn: &mut Drawn,
    gpu: &mut GpuRenderer,
) -> Result<Row, String> {
    let expected = drawn.geometry(side)?;
    let inside = interior(&expected.ids, side);
    let mut beside_mujoco = [0.0; 2];
    let mut compare = |shadows: bool, gpu: &mut GpuRenderer| -> Result<_, String> {
        let ours = draw(drawn.assets(), &drawn.scene(shadows)?, side, gpu)?;
        let theirs = drawn.colours(side, shadows)?;
        if shadows {
            let mujoco = recorded.colours(side, "rgb")?;
            beside_mujoco = [&ours.rgb, &theirs].map(|rgb| compare_colours(&mujoco, rgb, side, &inside).psnr);
        }
        Ok((compare_colours(&theirs, &ours.rgb, side, &inside), ours))
    };
    let (no_shadow, _) = compare(false, gpu)?;
    let (colours, Picture { depth, segmentation, .. }) = compare(true, gpu)?;
    let shapes = compare_shapes(&expected, &Geometry { width: side, depth, ids: segmentation }, &inside);
    Ok(Row { scene: scene.name.clone(), side, colours, no_shadow, shapes, beside_mujoco })
}

fn draw(assets: &Assets, scene: &Scene, side: usize, gpu: &mut GpuRenderer) -> Result<Picture, String> {
    let mut picture = Picture::new(side, side);
    gpu.draw(assets, scene, Channels::ALL, &mut picture).map_err(|error| error.to_string())?;
    Ok(picture)
}

/// The second of two batches: memory and pipelines are there.
fn pictures_per_second(assets: &Assets, scene: &Scene, gpu: &mut GpuRenderer) -> Result<f64, String> {
    let mut pictures = vec![Picture::new(BATCH_SIDE, BATCH_SIDE); BATCH];
    let mut seconds = 0.0;
    for _ in 0..2 {
        let began = Instant::now();
        let shots =
            pictures.iter_mut().map(|picture| Shot { assets, scene, channels: Channels::RGB, picture });
        gpu.draw_batch(&mut shots.collect::<Vec<_>>()).map_err(|error| error.to_string())?;
        seconds = began.elapsed().as_secs_f64();
    }
    Ok(BATCH as f64 / seconds)
}
