//! What two OpenGL implementations differ by: the bars of scenes that are held to the noise floor.

use super::measures::{EQUAL, compare_colours, compare_shapes, interior};
use super::plan::{Bars, Plan};
use super::recording::Recording;

/// Bars of a scene from what the other rasteriser reaches beside the recorded one, both with one sample a pixel.
///
/// The floor is that of all sizes together, since which pixels happen to lie on edges is chance: of colours the squared error over
/// all bytes, else the worst. Without shadows two implementations are nearer to each other, so that the bar with shadows holds
/// there too; of segmentation and depth the listed bars are asked, or less where the two differ by more.
///
/// # Errors
/// A picture is missing.
pub fn bars(plan: &Plan, recorded: &Recording, other: &Recording) -> Result<Bars, String> {
    let (mut squares, mut bytes) = (0.0, 0.0);
    let mut bars = Bars { ssim: 1.0, ..plan.bars };
    for &side in &plan.sizes {
        let (shown, shown_by_other) = (recorded.geometry(side)?, other.geometry(side)?);
        let inside = interior(&shown.ids, side);
        let rgb = [recorded, other].map(|recording| recording.colours(side, "rgb_1"));
        let [theirs, others] = rgb;
        let colours = compare_colours(&theirs?, &others?, side, &inside);
        let shapes = compare_shapes(&shown, &shown_by_other, &inside);
        let count = (side * side) as f64;
        squares += count * if colours.psnr == EQUAL { 0.0 } else { 10_f64.powf(-colours.psnr / 10.0) };
        bytes += count;
        bars.ssim = bars.ssim.min(colours.ssim);
        bars.ids = bars.ids.min(shapes.ids);
        bars.ids_interior = bars.ids_interior.min(shapes.ids_interior);
        bars.iou = bars.iou.min(shapes.iou);
        bars.depth_p99 = bars.depth_p99.max(shapes.depth_p99);
        bars.depth_median = bars.depth_median.max(shapes.depth_median);
    }
    let margin = 10_f64.powf(plan.floor_margin / 10.0);
    bars.psnr = (-10.0 * (squares / bytes).log10()).min(EQUAL) - plan.floor_margin;
    bars.psnr_no_shadow = bars.psnr;
    // As many times the distance from likeness as the margin is in squared error.
    bars.ssim = 1.0 - margin * (1.0 - bars.ssim);
    Ok(bars)
}
