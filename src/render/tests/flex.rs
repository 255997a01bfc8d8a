//! Flexes in pictures: skins, faces, edges and vertices where MuJoCo 3.12.0 puts them, followed and hidden.

use physics::{Data, Model, forward};
use robohive_render::geometry::{Part, Surface};
use robohive_render::picture::Channels;
use robohive_render::scene::{Camera, Item, SceneOptions, Shape, Show};
use robohive_render::{Assets, Picture, Profile, RenderError, Renderer, Scene, Settings};

/// Three corners that stand and one on a hinge, as two triangles, a tetrahedron and two lines.
const MODEL: &str = "<mujoco>
  <statistic extent='2'/>
  <worldbody>
    <camera name='above' pos='0 0 4'/>
    <body name='a' pos='-1 -1 1'/>
    <body name='b' pos='1 -1 1'/>
    <body name='c' pos='-1 0 1'/>
    <body name='flap' pos='0 0 1'><joint axis='1 0 0'/><geom size='.01' mass='1'/>
      <body name='d' pos='1 1 0'/></body>
  </worldbody>
  <deformable>
    <flex name='cloth' dim='2' radius='.1' rgba='1 0 0 1' body='a b c d' element='0 1 2 1 3 2' texcoord='0 0 1 0 0 1 1 1'><contact contype='0' conaffinity='0'/></flex>
    <flex name='wedge' dim='3' radius='.1' rgba='0 1 0 1' group='1' body='a b c d' element='0 1 2 3'><contact contype='0' conaffinity='0'/></flex>
    <flex name='rope' dim='1' radius='.1' rgba='0 0 1 1' group='2' body='a b c' element='0 1 1 2'><contact contype='0' conaffinity='0'/></flex>
  </deformable>
</mujoco>";

/// What is shown of flexes.
fn showing(vertices: bool, edges: bool, faces: bool, skins: bool) -> SceneOptions {
    let show = Show {
        flex_vertices: vertices,
        flex_edges: edges,
        flex_faces: faces,
        flex_skins: skins,
        ..Show::default()
    };
    SceneOptions::default().with_show(show)
}

fn world(text: &str, angle: f64) -> (Model, Data, Assets) {
    let model = robohive_mjcf::load_str(text).unwrap().model;
    let mut data = Data::new(&model);
    data.state.qpos[0] = angle;
    forward(&model, &mut data).unwrap();
    let assets = Assets::new(&model, Profile::Mujoco312).unwrap();
    (model, data, assets)
}

/// Items and parts of the flexes.
fn drawn(m: &Model, d: &Data, assets: &mut Assets, options: &SceneOptions) -> Vec<(Item, Vec<Part>)> {
    assets.pose(m, d, options).unwrap();
    let view = Camera::named(m, "above").unwrap().view(m, d).unwrap();
    let mut scene = Scene::new();
    scene.update(m, d, view, options).unwrap();
    let flexes = scene.items.iter().filter(|item| matches!(item.shape, Shape::Flex { .. }));
    let parts = |item: &Item| {
        let mut parts = Vec::new();
        assets.parts(item, &mut parts);
        (item.clone(), parts)
    };
    flexes.map(parts).collect()
}

/// The sum of numbers, each times its place.
fn moment(numbers: impl Iterator<Item = f32>) -> f64 {
    numbers.zip(1..).map(|(x, place)| f64::from(x) * f64::from(place)).sum()
}

/// Moments of the positions, normals and texture coordinates of all corners of a surface.
fn moments(surface: &Surface) -> [f64; 3] {
    let normals = surface.corners.iter().flat_map(|corners| corners.normal);
    let coordinates = surface.corners.iter().flat_map(|corners| corners.texcoord);
    [
        moment(surface.faces.iter().flatten().flat_map(|&row| surface.positions[row as usize])),
        moment(normals.flat_map(|row| surface.normals[row as usize])),
        moment(coordinates.filter_map(|row| surface.texcoords.get(row as usize)).flat_map(|&c| c)),
    ]
}

/// Triangles and moments of the cloth's and the wedge's surface.
type Expected = [(usize, [f64; 3]); 2];

fn check(text: &str, options: &SceneOptions, expected: Expected) {
    let (m, d, mut assets) = world(text, 0.7);
    let items = drawn(&m, &d, &mut assets, options);
    for ((_, parts), (triangles, theirs)) in items.iter().zip(expected) {
        let surface = &assets.surfaces[parts[parts.len() - 1].surface];
        assert_eq!(surface.faces.len(), triangles);
        for (ours, theirs) in moments(surface).into_iter().zip(theirs) {
            assert!((ours - theirs).abs() < 1e-4, "{ours} {theirs}");
        }
    }
}

/// Triangles of skins and of faces are those of `mjv_updateScene` (`flexface`, `flexnormal`, `flextexcoord`), in the order
/// of drawing.
#[test]
fn triangles_are_mujocos() {
    let skins = showing(false, true, false, true);
    check(MODEL, &skins, [(12, [2194.58578, 202.16796, 1488.0]), (4, [279.50419, 21.19229, 0.0])]);
    let faces = showing(false, true, true, false);
    check(MODEL, &faces, [(4, [265.18284, -38.31067, 180.0]), (4, [285.04995, -13.35018, 0.0])]);
    let flat = MODEL.replace("<flex ", "<flex flatskin='true' ");
    check(&flat, &skins, [(12, [2194.58578, 378.74321, 1488.0]), (4, [279.50419, -14.66694, 0.0])]);
}

/// Ropes are tubes along their edges; of what has a skin or faces, edges and vertices are drawn when asked for, unless its
/// skin hides them.
#[test]
fn edges_and_vertices_are_parts() {
    let (m, d, mut assets) = world(MODEL, 0.0);
    let counts = |assets: &mut Assets, options| -> Vec<usize> {
        drawn(&m, &d, assets, &options).iter().map(|(_, parts)| parts.len() - 1).collect()
    };
    assert_eq!(counts(&mut assets, SceneOptions::default()), [0, 0, 2]);
    assert_eq!(counts(&mut assets, showing(true, true, true, false)), [4 + 5, 4 + 6, 3 + 2]);
    assert_eq!(counts(&mut assets, showing(false, false, false, true)), [0, 0, 0]);
    assert_eq!(counts(&mut assets, showing(true, false, false, false)), [4, 4, 3]);
    let items = drawn(&m, &d, &mut assets, &SceneOptions::default());
    let (item, parts) = &items[2];
    let near = |ours: [f32; 3], theirs: [f32; 3]| ours.iter().zip(theirs).all(|(a, b)| (a - b).abs() < 1e-6);
    assert!(near(item.pos, [-1.0, -1.0, 1.0]) && item.size[0] == 0.1);
    // From (-1, -1, 1) to (1, -1, 1): the tube's axis is x.
    assert!(near(parts[0].offset, [1.0, 0.0, 0.0]));
    let axis: [f32; 3] = std::array::from_fn(|k| parts[0].linear[k][2]);
    assert!(near(axis, [1.0, 0.0, 0.0]), "{axis:?}");
}

#[test]
fn a_surface_changes_only_when_the_flex_moves() {
    let (m, mut d, mut assets) = world(MODEL, 0.3);
    let options = SceneOptions::default();
    assets.pose(&m, &d, &options).unwrap();
    let (before, count) = (assets.clone(), assets.surfaces.len());
    let same = |assets: &Assets, flex: usize| {
        let surface = count - 3 + flex;
        std::sync::Arc::ptr_eq(&before.surfaces[surface], &assets.surfaces[surface])
    };
    assets.pose(&m, &d, &options).unwrap();
    assert!((0..3).all(|flex| same(&assets, flex)));
    d.state.qpos[0] = 0.4;
    forward(&m, &mut d).unwrap();
    assets.pose(&m, &d, &options).unwrap();
    assert_eq!([0, 1, 2].map(|flex| same(&assets, flex)), [false, false, true]);
    d.flex.flexvert_xpos[0][0] = f64::NAN;
    let found = assets.pose(&m, &d, &options);
    assert!(matches!(found, Err(RenderError::NotFinite { what }) if what.contains("cloth")));
}

#[test]
fn flexes_are_seen_where_they_are_and_can_be_hidden() {
    let (model, data, mut assets) = world(MODEL, 0.0);
    let view = Camera::named(&model, "above").unwrap().view(&model, &data).unwrap();
    let mut shown = |options: &SceneOptions| {
        assets.pose(&model, &data, options).unwrap();
        let mut scene = Scene::new();
        scene.update(&model, &data, view, options).unwrap();
        let mut picture = Picture::new(32, 32);
        let mut renderer = Renderer::new(Settings::of(&model));
        renderer.draw(&assets, &scene, Channels { depth: true, ..Channels::RGB }, &mut picture).unwrap();
        let pixel = 32 * 17 + 14;
        (scene.items.len(), picture.depth[pixel], picture.rgb[3 * pixel..3 * pixel + 3].to_vec())
    };
    let (items, depth, rgb) = shown(&SceneOptions::default());
    assert_eq!(items, 4, "three flexes and the hinge's geom");
    assert!((depth - 2.9).abs() < 0.02, "the upper side lies a radius above 1 m: {depth}");
    assert!(rgb[0] > 50 || rgb[1] > 50, "{rgb:?}");
    let mut options = SceneOptions::default();
    options.groups.flexes = [false; 6];
    assert_eq!((shown(&options).0, shown(&options).2), (1, vec![0; 3]));
    assert_eq!(shown(&showing(false, false, false, false)).0, 1);
}
