//! A moving picture.

/// Pixels of a scene at a time: a gradient, a moving disc with a hard edge, and a textured strip.
pub fn scene(width: u32, height: u32, time: u32) -> Vec<u8> {
    let centre = (10 + (5 * time) % width.max(11), height / 2 + time % 7);
    let pixel = |x: u32, y: u32| {
        if (x.abs_diff(centre.0)).pow(2) + (y.abs_diff(centre.1)).pow(2) < 400 {
            [200, 60, 40]
        } else if y * 4 > height * 3 {
            let texture = ((x + time) / 3 * 7 + y / 3 * 13) % 64;
            [(60 + texture) as u8, (90 + texture) as u8, 70]
        } else {
            [(x * 200 / width) as u8, (y * 200 / height) as u8, 120]
        }
    };
    (0..height).flat_map(|y| (0..width).flat_map(move |x| pixel(x, y))).collect()
}
