//! Textures: mip levels and filters against Mesa's numbers, and what follows from their definition.

use physics::Model;
use physics::model::{ColorSpace, TextureType};
use robohive_render::texture::Texture;
use robohive_render::{Profile, RenderError};

/// A model with one texture of these pixels.
fn model(kind: TextureType, [width, height, channels]: [usize; 3], srgb: bool, data: &[u8]) -> Model {
    let text = "<mujoco><asset><texture name='picture' type='2d' builtin='flat' width='1' height='1'/></asset></mujoco>";
    let mut model = robohive_mjcf::load_str(text).unwrap().model;
    let arrays = model.unchecked_mut();
    arrays.tex_type[0] = kind as i32;
    arrays.tex_width[0] = width as i32;
    arrays.tex_height[0] = height as i32;
    arrays.tex_nchannel[0] = channels as i32;
    arrays.tex_colorspace[0] = if srgb { ColorSpace::Srgb } else { ColorSpace::Linear } as i32;
    arrays.tex_data = data.to_vec().into();
    model
}

fn texture(kind: TextureType, size: [usize; 3], srgb: bool, data: &[u8]) -> Texture {
    Texture::new(&model(kind, size, srgb, data), 0, Profile::Mujoco312).unwrap()
}

fn flat(width: usize, height: usize, data: &[u8]) -> Texture {
    texture(TextureType::Texture2d, [width, height, 3], false, data)
}

/// Bytes of a linear congruential generator, those that `mesa.txt` was recorded with.
fn noise(count: usize, seed: u32) -> Vec<u8> {
    let step = |x: &mut u32| {
        *x = x.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        Some((*x >> 24) as u8)
    };
    let mut state = seed;
    std::iter::from_fn(|| step(&mut state)).take(count).collect()
}

fn largest_difference(color: [f32; 4], expected: &[f32]) -> f32 {
    color.iter().zip(expected).map(|(x, y)| (255.0 * x - y).abs()).fold(0.0, f32::max)
}

/// Rows of `mesa.txt` that begin with a word: `2d width height channels srgb s t ds/dx dt/dx ds/dy dt/dy`, or
/// `cube width direction d/dx d/dy`, and the colour Mesa 22.3.6 (llvmpipe) draws, in units of 1/255.
fn recorded(word: &str) -> Vec<Vec<f32>> {
    let rows = include_str!("mesa.txt").lines().filter_map(|line| line.strip_prefix(word));
    rows.map(|row| row.split_whitespace().map(|x| x.parse().unwrap()).collect()).collect()
}

#[test]
fn flat_textures_have_mesas_colours() {
    let mut worst = [0f32; 2];
    let mut unequal = 0;
    for row in recorded("2d ") {
        let [width, height, channels] = [row[0] as usize, row[1] as usize, row[2] as usize];
        let data = noise(width * height * channels, (width * 100 + height) as u32);
        let srgb = row[3] == 1.0;
        let texture = texture(TextureType::Texture2d, [width, height, channels], srgb, &data);
        let lod = texture.lod_2d(row[6], row[7], row[8], row[9]);
        let difference = largest_difference(texture.sample_2d(row[4], row[5], lod), &row[10..]);
        worst[usize::from(srgb)] = worst[usize::from(srgb)].max(difference);
        unequal += usize::from(!srgb && difference > 0.01);
    }
    // Equal to the byte, but for one row whose coordinate lies in the middle of two weights. Mesa encodes the mip levels
    // of sRGB images by a polynomial, which may be off by one.
    assert!(unequal <= 1 && worst[0] < 1.01, "{unequal} {worst:?}");
    assert!(worst[1] < 1.2, "{worst:?}");
}

#[test]
fn cubes_have_mesas_colours() {
    for row in recorded("cube ") {
        let width = row[0] as usize;
        let data = noise(18 * width * width, 7 * width as u32);
        let texture = texture(TextureType::Cube, [width, 6 * width, 3], false, &data);
        let vector = |i: usize| [row[i], row[i + 1], row[i + 2]];
        let lod = texture.lod_cube(vector(1), vector(4), vector(7));
        let difference = largest_difference(texture.sample_cube(vector(1), lod), &row[10..]);
        // Corners of the cube hold rounded means.
        assert!(difference < 0.35, "{difference} {row:?}");
    }
}

#[test]
fn one_colour_stays_itself_at_every_place_and_level() {
    let colour = [200, 7, 99];
    let expected = [200.0, 7.0, 99.0, 255.0];
    for (width, height) in [(1, 1), (7, 3), (64, 32), (1, 9)] {
        let texture = flat(width, height, &colour.repeat(width * height));
        for i in 0..200 {
            let x = i as f32 * 0.137 - 9.0;
            let difference =
                largest_difference(texture.sample_2d(x, -1.7 * x, 0.05 * i as f32 - 1.0), &expected);
            assert!(difference < 1e-4);
        }
    }
    let cube = texture(TextureType::Cube, [4, 4, 3], false, &colour.repeat(16));
    for i in 0..200 {
        let angle = i as f32 * 0.37;
        let color = cube.sample_cube([angle.sin(), (1.3 * angle).cos(), 0.9 - 0.01 * angle], 0.02 * i as f32);
        assert!(largest_difference(color, &expected) < 1e-3);
    }
}

#[test]
fn magnification_is_bilinear_between_centres_and_repeats() {
    // Columns 0, 100, 200, 100: straight ramps between the centres at (i + 1/2) / 4.
    let data: Vec<u8> = [0, 100, 200, 100].into_iter().flat_map(|x| [x; 3]).collect();
    let texture = flat(4, 1, &data);
    let red = |s: f32| 255.0 * texture.sample_2d(s, 0.3, 0.0)[0];
    for (s, expected) in [(0.125, 0.0), (0.25, 50.0), (0.3125, 75.0), (0.625, 200.0), (0.0, 50.0)] {
        assert!((red(s) - expected).abs() < 0.01, "{s}");
        assert_eq!(red(s), red(s + 3.0));
        assert_eq!(red(s), red(s - 2.0));
    }
}

#[test]
fn levels_mix_between_the_two_nearest() {
    // 2x2 pixels whose mean, level 1, is (10 + 20 + 30 + 40) / 4, rounded up in each of two steps.
    let data: Vec<u8> = [10, 20, 30, 40].into_iter().flat_map(|x| [x; 3]).collect();
    let texture = flat(2, 2, &data);
    let red = |lod: f32| 255.0 * texture.sample_2d(0.25, 0.25, lod)[0];
    assert!((red(0.0) - 10.0).abs() < 0.01);
    assert!((red(0.5) - 18.0).abs() < 0.01);
    assert!((red(1.0) - 25.0).abs() < 0.01);
    assert!((red(9.0) - 25.0).abs() < 0.01);
}

/// A cube: each face has its own red; green and blue grow along the columns and rows of its image.
fn oriented_cube() -> Texture {
    let pixel = |i: usize| [(40 * (i / 64)) as u8, (30 * (i % 8)) as u8, (30 * (i / 8 % 8)) as u8];
    let data: Vec<u8> = (0..6 * 64).flat_map(pixel).collect();
    texture(TextureType::Cube, [8, 48, 3], false, &data)
}

#[test]
fn directions_find_faces_and_their_orientation() {
    let cube = oriented_cube();
    // Directions along an axis, and those in which columns and rows grow.
    let faces = [
        ([1, 0, 0], [0, 0, -1], [0, -1, 0]),
        ([-1, 0, 0], [0, 0, 1], [0, -1, 0]),
        ([0, 1, 0], [1, 0, 0], [0, 0, 1]),
        ([0, -1, 0], [1, 0, 0], [0, 0, -1]),
        ([0, 0, 1], [1, 0, 0], [0, -1, 0]),
        ([0, 0, -1], [-1, 0, 0], [0, -1, 0]),
    ];
    for (face, (axis, right, down)) in faces.into_iter().enumerate() {
        let [axis, right, down] = [axis, right, down].map(|v: [i32; 3]| v.map(|x| x as f32));
        for (s, t) in [(0.0, 0.0), (0.375, -0.625), (-0.875, 0.125)] {
            let direction = [0, 1, 2].map(|i| 3.0 * (axis[i] + s * right[i] + t * down[i]));
            let place = |x: f32| 30.0 * ((x + 1.0) * 4.0 - 0.5);
            let expected = [40.0 * face as f32, place(s), place(t), 255.0];
            let difference = largest_difference(cube.sample_cube(direction, 0.0), &expected);
            assert!(difference < 0.01, "face {face} {s} {t}: {difference}");
        }
    }
}

#[test]
fn cubes_have_no_seams() {
    let cube = oriented_cube();
    for lod in [0.0, 0.7, 2.0] {
        for i in 0..400 {
            let along = i as f32 / 200.0 - 1.0;
            for (u, v) in
                [([1.0, 1.0001, along], [1.0001, 1.0, along]), ([along, -1.0, 1.0001], [along, -1.0001, 1.0])]
            {
                let [a, b] = [u, v].map(|direction| cube.sample_cube(direction, lod));
                let step = largest_difference(a, &b.map(|x| 255.0 * x));
                assert!(step < 0.5, "{lod} {u:?}: {step}");
            }
        }
    }
}

#[test]
fn only_flat_images_of_mujoco_3_12_are_decoded() {
    let grey = [128; 3];
    let red = |kind, profile| {
        let texture = Texture::new(&model(kind, [1, 1, 3], true, &grey), 0, profile).unwrap();
        match kind {
            TextureType::Texture2d => texture.sample_2d(0.0, 0.0, 0.0)[0],
            _ => texture.sample_cube([1.0, 0.0, 0.0], 0.0)[0],
        }
    };
    let plain = 128.0 / 255.0;
    assert!((red(TextureType::Texture2d, Profile::Mujoco312) - 0.2158).abs() < 2e-3);
    assert_eq!(red(TextureType::Texture2d, Profile::Mujoco313), plain);
    assert_eq!(red(TextureType::Cube, Profile::Mujoco312), plain);
    assert_eq!(red(TextureType::Skybox, Profile::Mujoco312), plain);
}

#[test]
fn numbers_that_are_not_finite_still_find_a_texel() {
    let texture = flat(5, 3, &noise(45, 1));
    let cube = oriented_cube();
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, -1e-30] {
        assert!(texture.sample_2d(bad, bad, bad).iter().all(|x| (0.0..=1.0).contains(x)));
        assert!(
            texture.sample_2d(bad, 0.5, texture.lod_2d(bad, bad, bad, bad)).iter().all(|x| x.is_finite())
        );
        cube.sample_cube([bad, 0.0, bad], cube.lod_cube([bad; 3], [bad; 3], [bad; 3]));
    }
    cube.sample_cube([0.0; 3], 0.0);
}

#[test]
fn bad_images_are_refused_by_name_and_encoded_ones_left_empty() {
    let refused = |kind, size, bytes: usize, change: fn(&mut physics::model::Arrays)| {
        let mut model = model(kind, size, false, &noise(bytes, 1));
        change(model.unchecked_mut());
        match Texture::new(&model, 0, Profile::Mujoco312) {
            Err(RenderError::Model { message }) => {
                assert!(message.contains("texture \"picture\""), "{message}")
            }
            other => panic!("{size:?}: {other:?}"),
        }
    };
    let flat = TextureType::Texture2d;
    refused(flat, [4, 4, 3], 47, |_| {});
    refused(flat, [4, 4, 3], 48, |m| m.tex_adr[0] = 1);
    refused(flat, [4, 4, 3], 48, |m| m.tex_adr[0] = -1);
    refused(flat, [4, 4, 3], 48, |m| m.tex_adr[0] = i64::MAX);
    refused(flat, [0, 4, 3], 48, |_| {});
    refused(flat, [4, 4, 3], 48, |m| m.tex_height[0] = -4);
    refused(flat, [20_000, 1, 3], 60_000, |_| {});
    refused(TextureType::Cube, [4, 12, 3], 144, |_| {});
    let encoded = model(flat, [1000, 1, 1], false, &noise(1000, 1));
    assert!(Texture::new(&encoded, 0, Profile::Mujoco312).unwrap().is_empty());
}
