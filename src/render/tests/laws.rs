//! What geometry says of pictures: areas, distances, shadows, mirror images, and that they do not depend on where a scene lies.

use physics::math::{Mat3, Vec3, dot, mul_mat_vec};
use physics::model::ObjType;
use physics::ray::{Ray, RayFilter, ray};
use physics::{Data, Model, forward, step};
use robohive_render::picture::Channels;
use robohive_render::raster::Samples;
use robohive_render::scene::{Camera, FreeCamera, Scene, SceneOptions};
use robohive_render::view::Frustum;
use robohive_render::{Assets, Picture, Profile, Renderer, Settings, View};

/// A model ready to be drawn.
struct World {
    model: Model,
    data: Data,
    assets: Assets,
}

impl World {
    fn of(model: Model, steps: usize) -> World {
        let mut data = Data::new(&model);
        (0..steps).for_each(|_| step(&model, &mut data).unwrap());
        forward(&model, &mut data).unwrap();
        let assets = Assets::new(&model, Profile::Mujoco312).unwrap();
        World { model, data, assets }
    }

    fn text(text: &str) -> World {
        World::of(robohive_mjcf::load_str(format!("<mujoco>{text}</mujoco>")).unwrap().model, 0)
    }

    fn scene(&self, view: View) -> Scene {
        let mut scene = Scene::new();
        scene.update(&self.model, &self.data, view, &SceneOptions::default()).unwrap();
        scene
    }

    fn draw(&self, scene: &Scene, [width, height]: [usize; 2]) -> Picture {
        let mut picture = Picture::new(width, height);
        let settings = Settings::of(&self.model).with_samples(Samples::One);
        Renderer::new(settings).draw(&self.assets, scene, Channels::ALL, &mut picture).unwrap();
        picture
    }
}

/// Looks along `forward` from `eye` with parallel rays, `height` metres high.
fn parallel(eye: Vec3, forward: Vec3, up: Vec3, height: f64) -> View {
    let (bottom, top) = (-0.5 * height, 0.5 * height);
    let frustum =
        Frustum { orthographic: true, center: 0.0, half_width: None, bottom, top, near: 0.1, far: 20.0 };
    View { eye, forward, up, frustum }
}

fn pixel(picture: &Picture, x: usize, y: usize) -> [u8; 3] {
    let at = 3 * (y * picture.width + x);
    [picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]]
}

#[test]
fn a_box_covers_the_area_of_its_shadow() {
    const SIDE: usize = 512;
    for angles in ["0 0 0", "10 20 30", "45 35 10", "80 -60 15", "5 3 1"] {
        let world = World::text(&format!(
            "<worldbody><geom type='box' size='.3 .2 .4' euler='{angles}'/></worldbody>"
        ));
        let view = parallel([0.0, -3.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], 2.0);
        let picture = world.draw(&world.scene(view), [SIDE, SIDE]);
        let covered = picture.segmentation.iter().filter(|ids| ids[0] == 0).count();
        // Each pair of sides shows its area times the cosine between its normal and the gaze.
        let mat: &Mat3 = &world.data.kin.geom_xmat[0];
        let sides: Vec3 = [0.2 * 0.4, 0.3 * 0.4, 0.3 * 0.2].map(|x| 4.0 * x);
        let area: f64 = (0..3).map(|k| sides[k] * mat[3 + k].abs()).sum();
        let found = covered as f64 * (2.0 / SIDE as f64).powi(2);
        assert!((found / area - 1.0).abs() < 5e-3, "{angles}: {found} m2 instead of {area}");
    }
}

#[test]
fn the_distance_of_a_plane_is_that_of_its_formula() {
    let world = World::text("<worldbody><geom type='plane' size='0 0 .1' pos='0 0 .25'/></worldbody>");
    let (sine, cosine) = (0.6, 0.8);
    let view = View {
        eye: [0.5, -1.0, 2.0],
        forward: [0.0, cosine, -sine],
        up: [0.0, sine, cosine],
        frustum: Frustum {
            orthographic: false,
            center: 0.0,
            half_width: None,
            bottom: -0.05,
            top: 0.05,
            near: 0.1,
            far: 40.0,
        },
    };
    const SIDE: usize = 100;
    let picture = world.draw(&world.scene(view), [SIDE, SIDE]);
    let mut seen = 0;
    for (index, &depth) in picture.depth.iter().enumerate() {
        // Height of the window one metre ahead is 1 m: a point that far along the gaze is `fall` m below the eye.
        let up = 0.5 - ((index / SIDE) as f64 + 0.5) / SIDE as f64;
        let fall = sine - up * cosine;
        let expected = 1.75 / fall;
        if fall > 0.0 && expected < 39.0 {
            assert!(
                (f64::from(depth) / expected - 1.0).abs() < 1e-5,
                "{index}: {depth} instead of {expected}"
            );
            seen += 1;
        } else if fall <= 0.0 {
            assert_eq!(depth, 40.0);
        }
    }
    assert!(seen > SIDE * SIDE / 2);
}

/// Whether all pixels up to two away show the same.
fn is_inside(picture: &Picture, x: usize, y: usize) -> bool {
    let (w, h) = (picture.width, picture.height);
    let here = picture.segmentation[y * w + x];
    (2..w - 2).contains(&x)
        && (2..h - 2).contains(&y)
        && (y - 2..=y + 2).all(|j| (x - 2..=x + 2).all(|i| picture.segmentation[j * w + i] == here))
}

#[test]
fn rays_hit_what_is_seen() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/");
    for file in
        ["franka/franka_table.xml", "humanoid/humanoid.xml", "quadruped/quadruped.xml", "pile/pile.xml"]
    {
        let world = World::of(robohive_mjcf::load(format!("{folder}{file}")).unwrap().model, 50);
        let (m, d) = (&world.model, &world.data);
        let free = FreeCamera::of(m);
        let camera = FreeCamera { distance: 0.8 * free.distance, ..free };
        let view = Camera::Free(camera).view(m, d).unwrap();
        const SIDE: usize = 96;
        let picture = world.draw(&world.scene(view), [SIDE, SIDE]);
        let right = physics::math::cross(view.forward, view.up);
        let scale = view.frustum.top / view.frustum.near / (0.5 * SIDE as f64);
        let (mut compared, mut wrong) = (0, Vec::new());
        for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
            let [id, kind] = picture.segmentation[y * SIDE + x];
            if !is_inside(&picture, x, y) || (kind != ObjType::Geom.code() && id >= 0) {
                continue;
            }
            let (across, up) =
                ((x as f64 + 0.5 - 0.5 * SIDE as f64) * scale, (0.5 * SIDE as f64 - y as f64 - 0.5) * scale);
            let direction = std::array::from_fn(|k| view.forward[k] + across * right[k] + up * view.up[k]);
            let visible =
                RayFilter { groups: Some([true, true, true, false, false, false]), ..RayFilter::default() };
            let hit = ray(m, &d.kin, Ray { origin: view.eye, direction }, visible);
            // Depth is along the gaze, as the direction's length is.
            let far = hit.as_ref().is_none_or(|(_, hit)| hit.distance >= view.frustum.far);
            let expected = if far { -1 } else { hit.map_or(-1, |(geom, _)| geom as i32) };
            compared += 1;
            if id != expected {
                wrong.push((x, y, id, expected));
            }
        }
        assert!(compared > SIDE * SIDE / 4, "{file}: {compared} pixels");
        assert!(wrong.is_empty(), "{file}: {} of {compared}: {wrong:?}", wrong.len());
    }
}

const MIXED: &str = "<asset><texture name='t' type='2d' builtin='checker' width='16' height='16' rgb1='1 .5 0' rgb2='0 .5 1'/>
    <material name='m' texture='t' texrepeat='4 4'/></asset>
    <worldbody><light pos='1 -1 3' dir='-.3 .3 -1'/>
    <geom type='plane' size='2 2 .1' material='m'/><geom type='box' size='.25 .5 .25' pos='.5 .25 .25' material='m'/>
    <geom size='.5' pos='-.5 .5 .5' rgba='.9 .2 .2 1'/><geom type='capsule' size='.125 .25' pos='0 -.5 .5' euler='0 60 0'/>
    </worldbody>";

fn mixed_view() -> View {
    let wide = View::default().frustum;
    let frustum = Frustum { bottom: -0.0035, top: 0.0035, ..wide };
    View { eye: [0.5, -3.0, 1.5], forward: [0.0, 0.96, -0.28], up: [0.0, 0.28, 0.96], frustum }
}

#[test]
fn where_a_scene_lies_does_not_matter() {
    let world = World::text(MIXED);
    let mut scene = world.scene(mixed_view());
    // Beside the texels of a shadow map any rounding decides.
    scene.shadows = false;
    let here = world.draw(&scene, [120, 90]);
    let mut moved = scene.clone();
    let shift = [32.0_f32, -16.0, 8.0];
    let all = moved.items.iter_mut().map(|item| &mut item.pos);
    for pos in all.chain(moved.lights.iter_mut().map(|light| &mut light.pos)) {
        (0..3).for_each(|k| pos[k] += shift[k]);
    }
    (0..3).for_each(|k| moved.view.eye[k] += f64::from(shift[k]));
    let there = world.draw(&moved, [120, 90]);
    let pixels = here.depth.len();
    let differ = |same: &dyn Fn(usize) -> bool| (0..pixels).filter(|&i| !same(i)).count();
    let ids = differ(&|i| here.segmentation[i] == there.segmentation[i]);
    let depths = differ(&|i| (here.depth[i] / there.depth[i] - 1.0).abs() < 1e-4);
    let colours = differ(&|i| (0..3).all(|k| here.rgb[3 * i + k].abs_diff(there.rgb[3 * i + k]) <= 2));
    assert!(
        ids <= pixels / 500 && depths <= pixels / 500 && colours <= pixels / 500,
        "{ids} {depths} {colours}"
    );
}

#[test]
fn distances_do_not_depend_on_the_order_of_items() {
    let world = World::text(MIXED);
    let scene = world.scene(mixed_view());
    let forwards = world.draw(&scene, [120, 90]);
    let mut reversed = scene.clone();
    reversed.items.reverse();
    assert!(world.draw(&reversed, [120, 90]).depth == forwards.depth);
    reversed.items.swap(0, 2);
    assert!(world.draw(&reversed, [120, 90]).depth == forwards.depth);
}

#[test]
fn a_mirror_shows_what_would_stand_below_it() {
    // Nothing lights: ambient light is 0.3 of each colour, emission the rest.
    let world = |floor: &str, height: f64, roll: f64| {
        World::text(&format!(
            "<visual><headlight active='0'/></visual>
            <asset><material name='floor' rgba='0 0 0 1' reflectance='.5'/>
            <material name='glow' emission='.7' specular='0'/></asset>
            <worldbody>{floor}<geom type='box' size='.3 .2 .1' pos='0 0 {height}' euler='{roll} 0 0' rgba='.8 .4 .2 1'
            material='glow'/></worldbody>"
        ))
    };
    let floor = "<geom type='plane' size='3 3 .1' material='floor'/>";
    let (above, below) = (world(floor, 0.5, 25.0), world("", -0.5, -25.0));
    let view = View { eye: [0.25, -3.0, 0.7], ..mixed_view() };
    let [mirrored, real] = [&above, &below].map(|world| world.draw(&world.scene(view), [160, 120]));
    let (mut shown, mut wrong) = (0, 0);
    for (x, y) in (0..120).flat_map(|y| (0..160).map(move |x| (x, y))) {
        if above.model.geom_type[0] != 0 || mirrored.segmentation[y * 160 + x][0] != 0 {
            continue;
        }
        let expected = pixel(&real, x, y).map(|c| (f64::from(c) * 0.5).round() as u8);
        let found = pixel(&mirrored, x, y);
        shown += usize::from(found != [0; 3]);
        wrong += usize::from((0..3).any(|k| found[k].abs_diff(expected[k]) > 1));
    }
    assert!(shown > 400 && wrong <= shown / 100, "{wrong} of {shown}");
}

#[test]
fn a_shadow_ends_where_light_passes_the_box() {
    let world = World::text(
        "<visual><headlight active='0'/><quality shadowsize='2048'/><map shadowclip='2'/></visual>
        <statistic extent='1' center='0 0 0'/><worldbody><light type='directional' dir='1 0 -1' pos='-1 0 3'/>
        <geom type='plane' size='3 3 .1'/><geom type='box' size='.2 .3 .1' pos='0 0 .5'/></worldbody>",
    );
    const SIDE: usize = 200;
    let view = parallel([0.0, 0.0, 5.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0], 4.0);
    let picture = world.draw(&world.scene(view), [SIDE, SIDE]);
    let metres = |pixels: usize| (pixels as f64 - 0.5 * SIDE as f64) * 4.0 / SIDE as f64;
    let dark = |x: usize, y: usize| pixel(&picture, x, y)[0] < pixel(&picture, 5, 5)[0] / 2;
    // Light falls along +x by 45 degrees: the top edge at x = 0.2 and z = 0.6 ends the shadow at x = 0.8.
    let row = SIDE / 2;
    let last = (0..SIDE).filter(|&x| dark(x, row)).max().expect("there is a shadow");
    assert!((metres(last + 1) - 0.8).abs() < 0.03, "{}", metres(last + 1));
    let column = (0.6 * SIDE as f64 / 4.0) as usize + SIDE / 2;
    let lines: Vec<usize> = (0..SIDE).filter(|&y| dark(column, y)).collect();
    let [first, last] = [lines[0], lines[lines.len() - 1]];
    assert!((metres(first) + 0.3).abs() < 0.03 && (metres(last + 1) - 0.3).abs() < 0.03, "{first} {last}");
    assert_eq!(lines.len(), last - first + 1);
}

#[test]
fn transparent_colours_are_laid_over_twice() {
    for alpha in [0.1, 0.25, 0.5, 0.9] {
        let world = World::text(&format!(
            "<visual><headlight active='0'/></visual>
            <asset><material name='glow' emission='.7' specular='0'/></asset>
            <worldbody><geom type='plane' size='3 3 .1' rgba='.2 .6 1 1' material='glow'/>
            <geom type='box' size='1 1 .1' pos='0 0 .5' rgba='.9 .3 .1 {alpha}' material='glow'/></worldbody>"
        ));
        let view = parallel([0.0, 0.0, 5.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0], 1.0);
        let found = pixel(&world.draw(&world.scene(view), [8, 8]), 4, 4);
        for (k, (top, below)) in [(0.9, 0.2), (0.3, 0.6), (0.1, 1.0)].into_iter().enumerate() {
            let over = |below: f64| alpha * top + (1.0 - alpha) * below;
            let expected = 255.0 * over(over(below));
            assert!((f64::from(found[k]) - expected).abs() < 2.0, "{alpha}: {found:?}, {expected}");
        }
    }
}

#[test]
fn rotating_scene_and_camera_together_changes_no_distance() {
    let world = World::text(MIXED);
    let scene = world.scene(mixed_view());
    let here = world.draw(&scene, [100, 75]);
    // A quarter turn about z is exact.
    let turn: Mat3 = [0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    let mut turned = scene.clone();
    for item in &mut turned.items {
        item.pos = mul_mat_vec(&turn, item.pos.map(f64::from)).map(|x| x as f32);
        let mat = item.mat;
        for k in 0..3 {
            let column = mul_mat_vec(&turn, [mat[k], mat[3 + k], mat[6 + k]].map(f64::from));
            (0..3).for_each(|i| item.mat[3 * i + k] = column[i] as f32);
        }
    }
    let view = &mut turned.view;
    for v in [&mut view.eye, &mut view.forward, &mut view.up] {
        *v = mul_mat_vec(&turn, *v);
    }
    assert!(dot(view.forward, view.up).abs() < 1e-12);
    let there = world.draw(&turned, [100, 75]);
    let same = here.depth.iter().zip(&there.depth).filter(|(a, b)| (*a / *b - 1.0).abs() < 1e-5).count();
    assert!(same >= here.depth.len() * 998 / 1000, "{same}");
}
