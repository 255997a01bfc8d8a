//! Wireframes, added transparency and backs of surfaces: what follows from their definitions, and colours that MuJoCo 3.12.0 draws on
//! Mesa's llvmpipe, in pictures of 64 x 64 pixels.

use physics::{Data, Model, forward};
use robohive_render::picture::Channels;
use robohive_render::scene::{Camera, Effects, Scene, SceneOptions};
use robohive_render::{Assets, Picture, Profile, Renderer, Settings};

/// Columns and rows of a picture.
const SIDE: usize = 64;

fn parse(text: &str) -> Model {
    robohive_mjcf::load_str(text).expect("a sound model").model
}

fn draw(model: &Model, effects: Effects) -> Picture {
    let mut data = Data::new(model);
    forward(model, &mut data).expect("a pass");
    let view = Camera::named(model, "eye").and_then(|camera| camera.view(model, &data)).expect("a view");
    let mut scene = Scene::new();
    let options = SceneOptions::default().with_effects(effects);
    scene.update(model, &data, view, &options).expect("a scene");
    let mut picture = Picture::new(SIDE, SIDE);
    let assets = Assets::new(model, Profile::Mujoco312).expect("sound assets");
    let mut renderer = Renderer::new(Settings::of(model));
    // What stands still is kept from picture to picture, but not in wireframes.
    for _ in 0..3 {
        renderer.draw(&assets, &scene, Channels::ALL, &mut picture).expect("a picture");
    }
    picture
}

fn pixel(picture: &Picture, x: usize, y: usize) -> [u8; 3] {
    let at = 3 * (y * picture.width + x);
    [picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]]
}

fn wires() -> Effects {
    Effects::default().with_wireframe(true).with_shadows(false)
}

/// A box of 2 m, each side a square of `quads` by `quads`, seen along -z by parallel rays: 8 pixels a metre.
fn square(quads: usize) -> Model {
    parse(&format!(
        "<mujoco><statistic extent='4'/><visual><quality numquads='{quads}' offsamples='0'/><headlight ambient='.6 .6 .6'
        diffuse='0 0 0' specular='0 0 0'/></visual><worldbody><camera name='eye' pos='.03125 .03125 5' projection='orthographic'
        fovy='8'/><geom type='box' size='2 2 1' rgba='1 .5 .25 1'/></worldbody></mujoco>"
    ))
}

#[test]
fn a_square_shows_its_sides_and_no_diagonal() {
    for quads in [1, 2] {
        let picture = draw(&square(quads), wires());
        let colour = [153, 77, 38];
        let drawn = |x: usize, y: usize| match pixel(&picture, x, y) {
            [0, 0, 0] => false,
            found => {
                assert_eq!(found, colour, "column {x}, row {y}");
                true
            }
        };
        let rows: Vec<usize> = (0..SIDE).filter(|&y| drawn(20, y)).collect();
        let columns: Vec<usize> = (0..SIDE).filter(|&x| drawn(x, 20)).collect();
        // Lines at -2 and 2, and where the side is cut in half.
        let expected = if quads == 1 { 2 } else { 3 };
        assert_eq!((rows.len(), columns.len()), (expected, expected), "{quads}: {rows:?} {columns:?}");
        assert_eq!((rows[expected - 1] - rows[0], columns[expected - 1] - columns[0]), (32, 32));
    }
}

#[test]
fn colours_run_from_end_to_end_of_a_line() {
    // A lamp beside the nearer corner: what lies between is between.
    let model = parse(
        "<mujoco><statistic extent='4'/><visual><quality numquads='1' offsamples='0'/><headlight active='0'/></visual><worldbody>
        <light pos='-2 -2 1.5' dir='0 0 -1' cutoff='180' diffuse='1 1 1' specular='0 0 0' attenuation='1 0 0' castshadow='false'/>
        <camera name='eye' pos='.03125 .03125 5' projection='orthographic' fovy='8'/>
        <geom type='box' size='2 2 1'/></worldbody></mujoco>",
    );
    let picture = draw(&model, wires());
    let row = (0..SIDE).rev().find(|&y| pixel(&picture, 20, y) != [0; 3]).expect("the lower side");
    let along: Vec<u8> = (17..47).map(|x| pixel(&picture, x, row)[0]).collect();
    assert!(along.windows(2).all(|pair| pair[0] >= pair[1]), "{along:?}");
    let (first, last) = (i32::from(along[0]), i32::from(along[29]));
    assert!(first > last + 40, "{along:?}");
    let middle = i32::from(along[14]) + i32::from(along[15]);
    assert!((middle - first - last).abs() <= 4, "{along:?}");
}

#[test]
fn depth_and_objects_are_those_of_surfaces() {
    let model = square(2);
    let (wire, filled) = (draw(&model, wires()), draw(&model, Effects::default()));
    assert_ne!(wire.rgb, filled.rgb);
    assert_eq!(wire.depth, filled.depth);
    assert_eq!(wire.segmentation, filled.segmentation);
    assert!(filled.segmentation.contains(&[0, 5]));
}

/// A pane of glass before a ball.
const GLASS: &str =
    "<mujoco><statistic extent='1' center='0 0 0'/><visual><headlight ambient='.5 .5 .5' diffuse='0 0 0'
    specular='0 0 0'/></visual><worldbody><camera name='eye' pos='0 0 2'/><geom size='.4' rgba='.2 .4 .6 1'/>
    <geom type='box' size='.3 .3 .01' pos='0 0 .8' rgba='.8 .4 .2 .5'/></worldbody></mujoco>";

#[test]
fn added_transparency_weakens_nothing() {
    let shown = |effects: Effects| pixel(&draw(&parse(GLASS), effects), 32, 32);
    // What MuJoCo draws; the two terms of a sum are rounded one by one.
    let near = |found: [u8; 3], theirs: [u8; 3]| found.iter().zip(theirs).all(|(a, b)| a.abs_diff(b) <= 1);
    // A ball of 51, 102, 153 under half a light, and half of the glass's 102, 51, 26.
    let added = shown(Effects::default().with_additive(true));
    assert!(near(added, [76, 77, 89]), "{added:?}");
    // Blended twice: a quarter of the ball is left.
    let blended = shown(Effects::default());
    assert!(near(blended, [82, 51, 38]), "{blended:?}");
}

#[test]
fn backs_are_seen_from_inside() {
    let text = "<mujoco><statistic extent='1' center='0 0 0'/><visual><headlight ambient='.5 .5 .5'/></visual><worldbody>
        <camera name='eye' pos='0 0 .5'/><geom type='box' size='1 1 1'/></worldbody></mujoco>";
    let shown = |culling: bool| pixel(&draw(&parse(text), Effects::default().with_culling(culling)), 32, 32);
    assert_eq!(shown(true), [0; 3]);
    assert_ne!(shown(false), [0; 3]);
}

#[test]
fn wireframes_mirror_lines() {
    let text = "<mujoco><statistic extent='1' center='0 0 0'/><visual><quality numquads='1'/></visual><asset>
        <material name='mirror' reflectance='.8' rgba='.3 .3 .3 1'/></asset><worldbody><camera name='eye' pos='0 -2 1.4' xyaxes='1 0 0 0 .6 .8'/>
        <geom type='plane' size='2 2 4' material='mirror'/><geom type='box' size='.3 .05 .3' pos='0 .2 .5' rgba='1 0 0 1'/></worldbody></mujoco>";
    let red = |picture: &Picture| {
        (0..SIDE * SIDE).filter(|at| picture.rgb[3 * at] > picture.rgb[3 * at + 1] + 40).count()
    };
    let (with, without) = (draw(&parse(text), wires()), draw(&parse(text), wires().with_reflections(false)));
    assert!(red(&with) > red(&without) + 20, "{} and {}", red(&with), red(&without));
}
