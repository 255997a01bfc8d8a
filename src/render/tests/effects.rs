//! Fog on what is mirrored, on the sky and on haze, textures that let light through, and labels: colours that MuJoCo 3.12.0 draws
//! on Mesa's llvmpipe, in pictures of 64 x 64 pixels, and what follows from the definition.

use physics::{Data, Model, forward};
use robohive_render::picture::Channels;
use robohive_render::scene::{Camera, Effects, LabelChoice, Scene, SceneOptions};
use robohive_render::{Assets, Picture, Profile, Renderer, Settings};

/// Columns and rows of a picture.
const SIDE: usize = 64;
/// Columns, and rows from the top, of a grid of pixels.
const GRID: [usize; 4] = [8, 24, 40, 56];

fn parse(text: &str) -> Model {
    robohive_mjcf::load_str(text).expect("a sound model").model
}

/// What the model's camera sees.
fn scene(model: &Model, options: &SceneOptions) -> Scene {
    let mut data = Data::new(model);
    forward(model, &mut data).expect("a pass");
    let view = Camera::named(model, "eye").and_then(|camera| camera.view(model, &data)).expect("a view");
    let mut scene = Scene::new();
    scene.update(model, &data, view, options).expect("a scene");
    scene
}

fn draw(model: &Model, scene: &Scene, side: usize) -> Picture {
    let mut picture = Picture::new(side, side);
    let assets = Assets::new(model, Profile::Mujoco312).expect("sound assets");
    let mut renderer = Renderer::new(Settings::of(model));
    // The second picture takes what stands still from the first.
    for _ in 0..2 {
        renderer.draw(&assets, scene, Channels::RGB, &mut picture).expect("a picture");
    }
    picture
}

fn pixel(picture: &Picture, x: usize, y: usize) -> [u8; 3] {
    let at = 3 * (y * picture.width + x);
    [picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]]
}

/// Holds pixels of a picture to those that MuJoCo drew, but for the rounding of its sums.
fn check<const N: usize>(picture: &Picture, places: [usize; N], drawn: [[[u8; 3]; N]; N]) {
    for (row, y) in drawn.iter().zip(places) {
        for (expected, x) in row.iter().zip(places) {
            let found = pixel(picture, x, y);
            let far = found.iter().zip(expected).any(|(a, b)| a.abs_diff(*b) > 2);
            assert!(!far, "column {x}, row {y}: {found:?}, not {expected:?}");
        }
    }
}

fn foggy() -> SceneOptions {
    SceneOptions::default().with_effects(Effects::default().with_fog(true))
}

#[test]
fn fog_hides_what_is_mirrored_by_the_way_of_its_light() {
    let model = parse(
        "<mujoco><statistic extent='1' center='0 0 .3'/><visual><map fogstart='1' fogend='3'/><rgba fog='.7 .8 .9 1'/>
        </visual><asset><material name='mirror' reflectance='.8' rgba='.1 .1 .1 1'/></asset><worldbody>
        <camera name='eye' pos='0 -1.4 .8' xyaxes='1 0 0 0 .5 .86'/><geom type='plane' size='3 3 1' material='mirror'/>
        <geom type='box' size='.6 .05 .5' pos='0 .6 .6' rgba='.9 .2 .1 1'/></worldbody></mujoco>",
    );
    let drawn = [
        [[137, 106, 111], [138, 106, 112], [138, 106, 112], [168, 180, 200]],
        [[85, 97, 109], [207, 223, 245], [207, 223, 245], [85, 97, 109]],
        [[42, 47, 52], [207, 211, 231], [206, 210, 230], [40, 45, 49]],
        [[23, 24, 25], [23, 24, 25], [22, 23, 24], [20, 21, 23]],
    ];
    check(&draw(&model, &scene(&model, &foggy()), SIDE), GRID, drawn);
}

#[test]
fn fog_hides_the_sky_and_haze() {
    let model = parse(
        "<mujoco><statistic extent='1' center='0 0 .3'/><visual><map fogstart='10' fogend='60'/>
        <rgba fog='.7 .8 .2 1' haze='.1 .9 .3 1'/></visual><asset><texture name='sky' type='skybox' builtin='gradient'
        rgb1='.1 .2 .9' rgb2='.9 .1 .1' width='32' height='192'/></asset><worldbody><camera name='eye' pos='0 -2 .4'
        xyaxes='1 0 0 0 0 1' fovy='100'/><geom type='plane' size='0 0 .1' rgba='.4 .4 .4 1'/></worldbody></mujoco>",
    );
    let drawn = [
        [[109, 96, 137], [120, 120, 123], [119, 119, 124], [109, 94, 137]],
        [[131, 93, 115], [138, 118, 104], [138, 117, 105], [130, 92, 116]],
        [[10; 3]; 4],
        [[10; 3]; 4],
    ];
    check(&draw(&model, &scene(&model, &foggy()), SIDE), GRID, drawn);
    // Fog that is complete before the sky leaves nothing of it.
    let mut near = scene(&model, &foggy());
    near.fog.iter_mut().for_each(|fog| (fog.start, fog.end) = (1.0, 2.0));
    assert_eq!(pixel(&draw(&model, &near, SIDE), 20, 3), [179, 204, 51]);
}

#[test]
fn lamps_with_shadows_light_only_what_a_texture_makes_opaque() {
    let mut model = parse(
        "<mujoco><statistic extent='1' center='0 0 .3'/><asset><texture name='t' type='2d' builtin='flat' width='1' height='1'/>
        <material name='m' texture='t'/></asset><worldbody><light directional='true' pos='0 0 3' dir='.1 .15 -1'
        diffuse='.5 .5 .4'/><camera name='eye' pos='0 0 2'/><geom type='plane' size='1 1 .1' material='m'/></worldbody></mujoco>",
    );
    // Four quarters with their own opacity.
    let opacity = [[255, 252], [251, 0]];
    let texel = |at: usize| [200, 180, 160, opacity[at / 32][at % 8 / 4]];
    let arrays = model.unchecked_mut();
    (arrays.tex_width[0], arrays.tex_height[0], arrays.tex_nchannel[0]) = (8, 8, 4);
    arrays.tex_data = (0..64).flat_map(texel).collect::<Vec<u8>>().into();
    let drawn = [[[236, 212, 173], [230, 206, 168]], [[126, 113, 101], [125, 113, 100]]];
    check(&draw(&model, &scene(&model, &SceneOptions::default()), SIDE), [16, 48], drawn);
}

const LABELLED: &str = "<mujoco><worldbody><camera name='eye' pos='0 -2 0' xyaxes='1 0 0 0 0 1' fovy='45'/>
    <geom name='Ix' type='sphere' size='.1' pos='-.2 0 .3' rgba='.2 .3 .8 1'/>
    <geom type='sphere' size='.1' pos='.7 0 -.6'/>
    <geom name='behind' type='sphere' size='.1' pos='0 -4 0'/></worldbody></mujoco>";

#[test]
fn labels_begin_where_their_items_are() {
    let model = parse(LABELLED);
    let options = SceneOptions::default().with_label(LabelChoice::Geom);
    let (plain, labelled) = (scene(&model, &SceneOptions::default()), scene(&model, &options));
    assert_eq!(labelled.items[1].label, "geom 1");
    let (bare, written) = (draw(&model, &plain, 240), draw(&model, &labelled, 240));
    // Pixels of the middle of the first and the second ball.
    let scale = 120.0 / (2.0 * 22.5_f64.to_radians().tan());
    let place =
        |x: f64, z: f64| [(120.0 + scale * x).floor() as usize, 239 - (120.0 + scale * z).floor() as usize];
    let ([left, bottom], [right, low]) = (place(-0.2, 0.3), place(0.7, -0.6));
    let in_box = |x: usize, y: usize, [left, bottom]: [usize; 2], letters: usize| {
        (left - 1..=left + 8 * letters).contains(&x) && (bottom - 8..=bottom + 1).contains(&y)
    };
    let mut white = [0; 2];
    for (y, x) in (0..240).flat_map(|y| (0..240).map(move |x| (y, x))) {
        let boxes = [in_box(x, y, [left, bottom], 2), in_box(x, y, [right, low], 6)];
        let found = pixel(&written, x, y);
        match boxes.iter().position(|&inside| inside) {
            None => assert_eq!(found, pixel(&bare, x, y), "beside the labels, column {x}, row {y}"),
            Some(label) => white[label] += usize::from(found == [255; 3]),
        }
    }
    assert!(white[0] > 20 && white[1] > white[0], "{white:?}");
    // The upright of the capital is white with a black edge.
    assert_eq!(pixel(&written, left + 3, bottom - 3), [255; 3]);
    assert!((left..left + 3).any(|x| pixel(&written, x, bottom - 3) == [0; 3]));
}

#[test]
fn labels_may_be_long_or_in_letters_that_no_font_has() {
    let model = parse(LABELLED);
    let options = SceneOptions::default().with_label(LabelChoice::Geom);
    let mut scene = scene(&model, &options);
    scene.items[0].label = "é漢\n\u{202e}".repeat(5000);
    for side in [1, 7, 64, 700] {
        assert!(draw(&model, &scene, side).rgb.contains(&255) || side == 1, "side {side}");
    }
    scene.items[0].pos = [f32::NAN; 3];
    let mut picture = Picture::new(64, 64);
    picture.rgb = vec![9; 3 * 64 * 64];
    scene.items.truncate(1);
    robohive_render::raster::draw_labels(&scene, &mut picture);
    assert!(picture.rgb.iter().all(|&byte| byte == 9), "an item that is nowhere has no label");
}
