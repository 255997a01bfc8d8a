//! Scenes of small models: what is in them, in which order, from which camera.

use physics::model::ObjType;
use physics::{Data, Model, forward};
use robohive_render::scene::{
    Camera, Category, FreeCamera, Item, LabelChoice, LightKind, Scene, SceneOptions, Shape, Show,
};
use robohive_render::{RenderError, View};

/// A model of this text, and its data after a forward pass.
fn model(world: &str) -> (Model, Data) {
    let model = robohive_mjcf::load_str(format!("<mujoco>{world}</mujoco>")).unwrap().model;
    let mut data = Data::new(&model);
    forward(&model, &mut data).unwrap();
    (model, data)
}

fn free_view(m: &Model, d: &Data) -> View {
    Camera::free(m).view(m, d).unwrap()
}

fn scene_of(m: &Model, d: &Data, options: &SceneOptions) -> Scene {
    let mut scene = Scene::new();
    scene.update(m, d, free_view(m, d), options).unwrap();
    scene
}

/// Kind and number of what an item stands for.
fn objects(scene: &Scene) -> Vec<(i32, i32)> {
    scene.items.iter().map(|item| (item.object.kind, item.object.id)).collect()
}

const GEOM: i32 = ObjType::Geom.code();
const SITE: i32 = ObjType::Site.code();
const TENDON: i32 = ObjType::Tendon.code();

const GROUPS: &str = "<worldbody>
    <geom name='floor' type='plane' size='1 1 .1'/>
    <body pos='0 0 1'><freejoint/>
        <geom size='.1'/><geom size='.1' group='2'/><geom size='.1' group='3'/><geom size='.1' rgba='1 0 0 0'/>
        <site name='a' group='1'/><site name='b' pos='.1 0 0' group='4'/>
    </body>
    <site name='c' pos='0 0 2'/>
    </worldbody>
    <tendon>
        <spatial rgba='1 0 0 0'><site site='a'/><site site='b'/><site site='c'/></spatial>
        <spatial group='5'><site site='a'/><site site='c'/></spatial>
    </tendon>";

#[test]
fn groups_and_opacity_choose_the_items() {
    let (m, d) = model(GROUPS);
    let mut options = SceneOptions::default();
    let scene = scene_of(&m, &d, &options);
    // A tendon without opacity stays, since it casts a shadow; a geom does not.
    let shown = [(GEOM, 0), (GEOM, 1), (GEOM, 2), (SITE, 0), (SITE, 1), (TENDON, 0), (TENDON, 0)];
    assert_eq!(objects(&scene), shown);
    assert_eq!(scene.items[5].rgba[3], 0.0);
    let categories =
        [Category::Static, Category::Dynamic, Category::Dynamic, Category::Static, Category::Dynamic];
    assert!(scene.items.iter().zip(categories).all(|(item, category)| item.category == category));

    options.groups.geoms = [false, false, false, true, false, false];
    options.groups.sites = [false; 6];
    options.groups.tendons = [false, false, false, false, false, true];
    assert_eq!(objects(&scene_of(&m, &d, &options)), [(GEOM, 3), (TENDON, 1)]);

    let options = SceneOptions::default().with_show(Show::NOTHING);
    assert_eq!(objects(&scene_of(&m, &d, &options)), [(GEOM, 1), (GEOM, 2), (SITE, 1)]);
}

#[test]
fn colors_come_from_element_or_material() {
    let (m, d) = model(
        "<asset><material name='m' rgba='.1 .2 .3 .4' emission='.5' specular='.6' shininess='.7' reflectance='.8'/></asset>
        <worldbody><geom size='.1' material='m'/><geom size='.1' material='m' rgba='1 0 0 1'/><geom size='.1'/></worldbody>",
    );
    let scene = scene_of(&m, &d, &SceneOptions::default());
    let rgba: Vec<_> = scene.items.iter().map(|item| item.rgba).collect();
    assert_eq!(rgba, [[0.1, 0.2, 0.3, 0.4], [1.0, 0.0, 0.0, 1.0], [0.5, 0.5, 0.5, 1.0]]);
    let look = |i: usize| {
        let look = scene.items[i].look;
        [look.emission, look.specular, look.shininess, look.reflectance]
    };
    assert_eq!(
        [look(0), look(1), look(2)],
        [[0.5, 0.6, 0.7, 0.8], [0.5, 0.6, 0.7, 0.8], [0.0, 0.5, 0.5, 0.0]]
    );
    let materials: Vec<_> = scene.items.iter().map(|item| item.material).collect();
    assert_eq!(materials, [Some(0), Some(0), None]);
}

#[test]
fn an_infinite_plane_follows_the_eye_by_whole_periods() {
    let (m, d) = model(
        "<asset><texture name='t' type='2d' builtin='checker' width='8' height='8'/>
        <material name='m' texture='t' texrepeat='5 0'/></asset>
        <worldbody><geom type='plane' size='0 3 .1' material='m' pos='.1 .2 0'/></worldbody>",
    );
    let mut scene = Scene::new();
    let mut place = |eye: f64| {
        let camera = FreeCamera { lookat: [eye, eye, 0.0], distance: 1.0, ..FreeCamera::of(&m) };
        let view = Camera::Free(camera).view(&m, &d).unwrap();
        scene.update(&m, &d, view, &SceneOptions::default()).unwrap();
        scene.items[0].pos
    };
    // The period is 2 / texrepeat along x; along y the plane is finite and stays.
    let period = 2.0 / 5.0;
    for k in 0..40 {
        let eye = -4.0 + 0.2 * f64::from(k) + 0.01;
        let [x, y, _] = place(eye).map(f64::from);
        let steps = (x - 0.1) / (2.0 * period);
        assert!((steps - steps.round()).abs() < 1e-6 && (x - eye).abs() <= period + 1e-6, "{x} for {eye}");
        assert!((y - 0.2).abs() < 1e-7);
    }
}

#[test]
fn a_slack_tendon_hangs() {
    let (m, d) = model(
        "<worldbody><site name='a' pos='0 0 1'/><body pos='.5 0 1'><freejoint/><geom size='.1'/><site name='b'/></body>
        </worldbody><tendon><spatial width='.01' limited='true' range='0 .8'><site site='a'/><site site='b'/></spatial>
        </tendon>",
    );
    let scene = scene_of(&m, &d, &SceneOptions::default());
    let rope: Vec<&Item> = scene.items.iter().filter(|item| item.object.kind == TENDON).collect();
    assert_eq!(rope.len(), 28);
    let length: f32 = rope.iter().map(|item| 2.0 * item.size[2]).sum();
    assert!((length - 0.8).abs() < 2e-3 && rope.iter().all(|item| item.size[0] == 0.01), "{length}");
    assert!(rope.iter().map(|item| item.pos[2]).fold(1.0, f32::min) < 0.75);
}

#[test]
fn the_headlight_is_first_and_eight_lights_light() {
    let lights = |head: i32, kind: &str, count: usize| {
        let lights = format!("<light type='{kind}' pos='0 0 3'/>").repeat(count);
        let (m, d) = model(&format!(
            "<visual><headlight active='{head}'/></visual><worldbody>{lights}<geom size='.1'/></worldbody>"
        ));
        let view = free_view(&m, &d);
        let scene = scene_of(&m, &d, &SceneOptions::default());
        let gaze = view.forward.map(|x| x as f32);
        let headlights = scene.lights.iter().filter(|light| light.headlight).count();
        assert_eq!(headlights, usize::from(head == 1));
        assert!(
            head == 0 || scene.lights[0].headlight && scene.lights[0].dir == gaze && !scene.lights[0].shadow
        );
        (scene.lights.len(), scene.ambient)
    };
    assert_eq!(lights(1, "spot", 12), (8, 0.0));
    assert_eq!(lights(0, "directional", 12), (8, 0.0));
    assert_eq!(lights(1, "point", 3), (1, 0.0));
    assert_eq!(lights(0, "point", 3), (0, 0.3));
    assert_eq!(lights(0, "spot", 0), (0, 0.3));
    let (m, d) =
        model("<worldbody><light active='false'/><light pos='0 0 2' castshadow='false'/></worldbody>");
    let scene = scene_of(&m, &d, &SceneOptions::default());
    assert!(scene.lights.len() == 2 && !scene.lights[1].shadow);
    assert!(matches!(scene.lights[1].kind, LightKind::Spot { cutoff: 45.0, .. }));
}

#[test]
fn cameras_are_found_by_name_and_unknown_ones_explained() {
    let (m, d) = model(
        "<worldbody><camera name='front' pos='0 -2 1' xyaxes='1 0 0 0 0 1'/><camera name='top' pos='0 0 3'/>
        <geom size='.1'/></worldbody>",
    );
    assert_eq!(Camera::named(&m, "top"), Ok(Camera::Fixed(1)));
    assert_eq!(Camera::named(&m, "free"), Ok(Camera::free(&m)));
    let view = Camera::named(&m, "front").unwrap().view(&m, &d).unwrap();
    let close = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6);
    assert!(
        close(view.eye, [0.0, -2.0, 1.0])
            && close(view.forward, [0.0, 1.0, 0.0])
            && close(view.up, [0.0, 0.0, 1.0])
    );
    let error = Camera::named(&m, "fornt").unwrap_err();
    let RenderError::UnknownCamera { cameras, .. } = &error else { panic!("{error}") };
    assert_eq!(cameras, &["front", "top"]);
    assert!(
        matches!(Camera::named(&m, "tops"), Err(RenderError::UnknownCamera { nearest: Some(n), .. }) if n == "top")
    );
    assert!(matches!(Camera::Fixed(2).view(&m, &d), Err(RenderError::UnknownCamera { .. })));
    let lost = FreeCamera { track: Some(7), ..FreeCamera::of(&m) };
    assert!(matches!(Camera::Free(lost).view(&m, &d), Err(RenderError::Model { .. })));
}

#[test]
fn windows_follow_field_of_view_sensor_and_projection() {
    let (m, d) = model(
        "<statistic extent='2' center='0 0 0'/><visual><map znear='.01' zfar='10'/></visual><worldbody>
        <camera name='angle' fovy='90'/><camera name='flat' fovy='3' projection='orthographic'/>
        <camera name='sensor' resolution='200 100' sensorsize='.02 .01' focal='.01 .01' principal='.002 .001'/>
        <geom size='.1'/></worldbody>",
    );
    let frustum = |name: &str| Camera::named(&m, name).unwrap().view(&m, &d).unwrap().frustum;
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-7 * b.abs().max(1.0), "{a} {b}");
    let angle = frustum("angle");
    near(angle.top, 0.02);
    near(angle.bottom, -0.02);
    near(angle.near, 0.02);
    near(angle.far, 20.0);
    assert!(angle.half_width.is_none() && !angle.orthographic);
    let flat = frustum("flat");
    near(flat.top, 1.5);
    near(flat.bottom, -1.5);
    assert!(flat.orthographic);
    let sensor = frustum("sensor");
    near(sensor.half_width.unwrap(), 0.02);
    near(sensor.center, 0.004);
    near(sensor.top, 0.008);
    near(sensor.bottom, -0.012);
    let shut = FreeCamera { fovy: 0.0, ..FreeCamera::of(&m) };
    assert!(matches!(Camera::Free(shut).view(&m, &d), Err(RenderError::Frustum { .. })));
}

#[test]
fn what_is_not_finite_is_named() {
    let (m, mut d) = model(
        "<worldbody><camera name='eye'/><light name='lamp'/><geom name='ball' size='.1'/><site name='mark'/></worldbody>",
    );
    let broken = |d: &Data| {
        let view = Camera::Fixed(0).view(&m, d)?;
        Scene::new().update(&m, d, view, &SceneOptions::default())
    };
    let named = |result: Result<(), RenderError>, name: &str| match result {
        Err(RenderError::NotFinite { what }) => assert_eq!(what, name),
        other => panic!("{other:?}"),
    };
    d.kin.light_xpos[0][2] = f64::INFINITY;
    named(broken(&d), "light \"lamp\"");
    d.kin.site_xmat[0][4] = f64::NAN;
    named(broken(&d), "site \"mark\"");
    d.kin.geom_xpos[0][1] = f64::NAN;
    named(broken(&d), "geom \"ball\"");
    d.kin.cam_xpos[0][0] = f64::NAN;
    named(broken(&d), "camera \"eye\"");
}

#[test]
fn sky_and_haze_belong_to_an_infinite_floor_below() {
    let world = |size: &str| {
        model(&format!(
            "<asset><texture type='2d' name='t' builtin='flat' width='2' height='2'/>
            <texture type='skybox' builtin='flat' width='2' height='12'/></asset>
            <worldbody><geom type='plane' size='{size} .1'/></worldbody>"
        ))
    };
    let (m, d) = world("0 0");
    let mut options = SceneOptions::default();
    let scene = scene_of(&m, &d, &options);
    assert!(scene.sky == Some(1) && scene.haze.is_some() && scene.fog.is_none());
    options.effects.fog = true;
    options.effects.haze = false;
    let scene = scene_of(&m, &d, &options);
    assert!(scene.haze.is_none() && scene.fog.is_some_and(|fog| fog.end > fog.start));
    options.effects.sky = false;
    assert_eq!(scene_of(&m, &d, &options).sky, None);
    let below = FreeCamera { elevation: 30.0, ..FreeCamera::of(&m) };
    let mut scene = Scene::new();
    scene.update(&m, &d, Camera::Free(below).view(&m, &d).unwrap(), &SceneOptions::default()).unwrap();
    assert!(scene.sky.is_some() && scene.haze.is_none());
    let (m, d) = world("0 5");
    assert!(scene_of(&m, &d, &SceneOptions::default()).haze.is_none());
}

#[test]
fn decorations_come_on_request_with_labels() {
    let (m, d) = model(
        "<worldbody><body name='arm' pos='0 0 1'><joint name='hinge' axis='0 1 0'/><geom size='.1'/></body></worldbody>",
    );
    let plain = scene_of(&m, &d, &SceneOptions::default()).items.len();
    let options = SceneOptions::default()
        .with_show(Show { joints: true, ..Show::default() })
        .with_label(LabelChoice::Joint);
    let scene = scene_of(&m, &d, &options);
    let joint = &scene.items[plain];
    assert_eq!(
        (scene.items.len(), joint.shape, joint.label.as_str()),
        (plain + 1, Shape::ThinArrow, "hinge")
    );
    assert_eq!(joint.category, Category::Decor);
    let axis = [joint.mat[2], joint.mat[5], joint.mat[8]];
    assert!(axis[1] > 0.999_999, "{axis:?}");
    let options = SceneOptions::default().with_label(LabelChoice::Geom);
    assert_eq!(scene_of(&m, &d, &options).items[0].label, "geom 0");
}
