//! What cannot be drawn is refused in words or drawn as something defined: sizes, cameras, numbers, assets.

use physics::{Data, Model, forward};
use robohive_render::picture::Channels;
use robohive_render::raster::{Samples, ShadowSettings};
use robohive_render::scene::{
    Camera, Category, FreeCamera, Item, Light, LightKind, Look, Object, Scene, SceneOptions, Shape, Show,
};
use robohive_render::{Assets, Picture, Profile, RenderError, Renderer, Settings, View};

fn load(text: &str) -> Model {
    robohive_mjcf::load_str(format!("<mujoco>{text}</mujoco>")).unwrap().model
}

fn state(model: &Model) -> Data {
    let mut data = Data::new(model);
    forward(model, &mut data).unwrap();
    data
}

fn scene(model: &Model, camera: Camera) -> Result<Scene, RenderError> {
    let data = state(model);
    let mut scene = Scene::new();
    scene.update(model, &data, camera.view(model, &data)?, &SceneOptions::default())?;
    Ok(scene)
}

/// A picture with all channels.
fn draw(model: &Model, scene: &Scene, settings: Settings) -> Result<Picture, RenderError> {
    let mut picture = Picture::new(32, 24);
    Renderer::new(settings).draw(
        &Assets::new(model, Profile::Mujoco312)?,
        scene,
        Channels::ALL,
        &mut picture,
    )?;
    let Picture { rgb, depth, segmentation, .. } = &picture;
    assert_eq!([rgb.len(), depth.len(), segmentation.len()], [32 * 24 * 3, 32 * 24, 32 * 24]);
    assert!(depth.iter().all(|z| z.is_finite()));
    Ok(picture)
}

fn from_free(model: &Model) -> Result<Picture, RenderError> {
    draw(model, &scene(model, Camera::free(model))?, Settings::of(model))
}

fn nothing(picture: &Picture) -> bool {
    picture.segmentation.iter().all(|ids| *ids == [-1; 2]) && picture.rgb.iter().all(|&c| c == 0)
}

fn message<T: std::fmt::Debug>(result: Result<T, RenderError>) -> String {
    result.expect_err("an error").to_string()
}

const BALL: &str = "<worldbody><light pos='0 0 3'/><geom name='floor' type='plane' size='1 1 .1'/>
    <body name='b' pos='0 0 1'><freejoint/><geom name='ball' size='.2'/></body></worldbody>";

#[test]
fn sizes_are_one_to_the_largest() {
    let model = load(BALL);
    let scene = scene(&model, Camera::free(&model)).unwrap();
    let assets = Assets::new(&model, Profile::Mujoco312).unwrap();
    let mut renderer = Renderer::new(Settings::of(&model));
    for (width, height) in [(0, 10), (10, 0), (0, 0), (4097, 1), (1, 4097), (usize::MAX, usize::MAX)] {
        let result = renderer.draw(&assets, &scene, Channels::ALL, &mut Picture::new(width, height));
        assert_eq!(result, Err(RenderError::Size { width, height }));
        assert!(message(result).contains("give 1 to 4096 columns and rows"));
    }
    for (width, height) in [(1, 1), (4096, 1), (1, 4096), (3, 5)] {
        let mut picture = Picture::new(width, height);
        renderer.draw(&assets, &scene, Channels::ALL, &mut picture).unwrap();
        assert_eq!(picture.rgb.len(), 3 * width * height);
    }
}

#[test]
fn unknown_cameras_are_answered_by_those_there_are() {
    let model = load("<worldbody><camera name='front'/><camera name='top'/><geom size='.1'/></worldbody>");
    let text = message(Camera::named(&model, "frnt"));
    let parts = ["frnt", "did you mean front?", "front, top", "`free`"];
    assert!(parts.iter().all(|part| text.contains(part)), "{text}");
    assert!(message(scene(&model, Camera::Fixed(9))).contains("no camera named 9"));
}

#[test]
fn a_model_of_nothing_is_a_black_picture() {
    let model = load("<worldbody/>");
    let view = View::default();
    let picture = draw(&model, &Scene { view, ..Scene::new() }, Settings::of(&model)).unwrap();
    assert!(nothing(&picture) && picture.depth.iter().all(|&z| z == view.frustum.far as f32));
    let dark = load("<visual><headlight active='0'/></visual><worldbody><geom size='1'/></worldbody>");
    assert!(from_free(&dark).unwrap().rgb.iter().any(|&c| c > 0));
}

#[test]
fn a_camera_inside_a_geom_looks_through_its_back() {
    let model = load("<worldbody><geom type='box' size='1 1 1'/><camera name='in'/></worldbody>");
    let picture = draw(&model, &scene(&model, Camera::Fixed(0)).unwrap(), Settings::of(&model)).unwrap();
    assert!(nothing(&picture));
}

#[test]
fn what_lies_beyond_the_far_plane_is_not_seen() {
    let model = load(
        "<statistic extent='1'/><visual><map zfar='10'/></visual><worldbody><geom size='1'/>
        <camera pos='0 0 9'/><camera pos='0 0 10.5'/><camera pos='0 0 12'/></worldbody>",
    );
    let seen = |camera: usize| {
        let scene = scene(&model, Camera::Fixed(camera)).unwrap();
        let picture = draw(&model, &scene, Settings::of(&model)).unwrap();
        picture.segmentation.iter().filter(|ids| ids[0] == 0).count()
    };
    assert!(seen(0) > 4 && seen(1) > 0 && seen(2) == 0);
}

#[test]
fn states_that_are_not_finite_are_refused() {
    let model = load(BALL);
    let view = Camera::free(&model).view(&model, &state(&model)).unwrap();
    for bad in [f64::NAN, f64::INFINITY, -1e300] {
        let mut data = state(&model);
        data.kin.geom_xpos[1][0] = bad;
        let result = Scene::new().update(&model, &data, view, &SceneOptions::default());
        assert_eq!(result, Err(RenderError::NotFinite { what: "geom \"ball\"".into() }));
        let mut data = state(&model);
        data.kin.light_xdir[0][1] = bad;
        let result = Scene::new().update(&model, &data, view, &SceneOptions::default());
        assert!(matches!(result, Err(RenderError::NotFinite { .. })), "{result:?}");
    }
}

#[test]
fn sizes_and_colours_of_any_number_are_drawn_or_refused() {
    for size in [0.0, 1e-300, 1e-20, 1e10, 1e30, 1e37, 1e300, f64::INFINITY, -1.0] {
        let mut model = load(BALL);
        let camera = Camera::free(&model);
        model.overwrite(|draft| draft.geom_size[1] = [size; 3]).unwrap();
        match scene(&model, camera) {
            Ok(scene) => assert!(draw(&model, &scene, Settings::of(&model)).is_ok(), "{size}"),
            Err(error) => assert!(error.to_string().contains("ball"), "{size}: {error}"),
        }
    }
    for colour in [-1.0, 2.0, 1e30, f32::INFINITY] {
        let mut model = load(BALL);
        model.overwrite(|draft| draft.geom_rgba[1] = [colour; 4]).unwrap();
        from_free(&model).unwrap();
    }
}

#[test]
fn planes_of_any_size_are_drawn_or_refused() {
    for size in [-1.0, 1e-300, 1e30, 1e300, f64::INFINITY] {
        let mut model = load(BALL);
        let camera = Camera::free(&model);
        model.overwrite(|draft| draft.geom_size[0] = [size, 1.0, size]).unwrap();
        match scene(&model, camera) {
            Ok(scene) => assert!(draw(&model, &scene, Settings::of(&model)).is_ok(), "{size}"),
            Err(error) => assert!(error.to_string().contains("floor"), "{size}: {error}"),
        }
    }
}

#[test]
fn frustums_without_room_are_refused() {
    let model = load(BALL);
    let free = FreeCamera::of(&model);
    for fovy in [0.0, -10.0, 181.0, 360.0, f64::NAN, f64::INFINITY] {
        let result = scene(&model, Camera::Free(FreeCamera { fovy, ..free }));
        assert!(matches!(result, Err(RenderError::Frustum { .. })), "{fovy}: {result:?}");
    }
    for fovy in [1e-3, 179.99, 180.0] {
        let scene = scene(&model, Camera::Free(FreeCamera { fovy, ..free })).unwrap();
        draw(&model, &scene, Settings::of(&model)).unwrap();
    }
    for distance in [0.0, 1e-30, 1e30, -1.0] {
        let scene = scene(&model, Camera::Free(FreeCamera { distance, ..free })).unwrap();
        draw(&model, &scene, Settings::of(&model)).unwrap();
    }
    for distance in [f64::NAN, f64::INFINITY, 1e300] {
        let result = scene(&model, Camera::Free(FreeCamera { distance, ..free }));
        assert!(matches!(result, Err(RenderError::NotFinite { .. })), "{result:?}");
    }
}

#[test]
fn extents_without_room_are_refused() {
    for extent in [0.0, -1.0, 1e-30, 1e30, f64::INFINITY, f64::NAN] {
        let mut model = load(BALL);
        model.overwrite(|draft| draft.stat.extent = extent).unwrap();
        let result = from_free(&model);
        assert!(
            matches!(result, Err(RenderError::Frustum { .. } | RenderError::NotFinite { .. })),
            "{extent}: {result:?}"
        );
    }
}

#[test]
fn meshes_without_area_are_drawn_as_nothing_and_those_without_numbers_refused() {
    let text = "<asset><mesh name='m' vertex='0 0 0  1 0 0  0 1 0  0 0 1'/></asset>
        <worldbody><geom type='mesh' mesh='m'/></worldbody>";
    let mut model = load(text);
    let camera = Camera::free(&model);
    model.overwrite(|draft| draft.mesh_vert.fill([0.5; 3])).unwrap();
    let flat = scene(&model, camera).unwrap();
    assert!(draw(&model, &flat, Settings::of(&model)).unwrap().segmentation.iter().all(|ids| ids[0] == -1));
    let mut model = load(text);
    model.overwrite(|draft| draft.mesh_vert[2][1] = f32::INFINITY).unwrap();
    let error = message(Assets::new(&model, Profile::Mujoco312));
    assert_eq!(error, "the model cannot be drawn: mesh \"m\": vertex 2 is not finite");
    let mut model = load(text);
    model.overwrite(|draft| draft.mesh_vert[2] = [1e38, -1e38, 1e38]).unwrap();
    let scene = scene(&model, camera).unwrap();
    draw(&model, &scene, Settings::of(&model)).unwrap();
}

#[test]
fn height_fields_without_numbers_are_refused() {
    let text = "<asset><hfield name='h' nrow='2' ncol='2' size='1 1 1 .1'/></asset>
        <worldbody><geom type='hfield' hfield='h'/></worldbody>";
    for height in [f32::INFINITY, f32::NEG_INFINITY] {
        let mut model = load(text);
        model.overwrite(|draft| draft.hfield_data[3] = height).unwrap();
        let error = message(Assets::new(&model, Profile::Mujoco312));
        assert!(error.contains("elevation 3 of hfield \"h\" is"), "{error}");
        let mut assets = Assets::new(&load(text), Profile::Mujoco312).unwrap();
        let error = message(assets.refresh(&model));
        assert!(error.contains("elevation 3 of hfield \"h\" is"), "{error}");
    }
    let mut model = load(text);
    let error = model.overwrite(|draft| draft.hfield_data[3] = f32::NAN).expect_err("no number").to_string();
    assert!(error.contains("hfield_data"), "{error}");
}

#[test]
fn textures_of_one_pixel_are_drawn_and_those_too_long_refused() {
    let model = |width: usize| {
        load(&format!(
            "<asset><texture name='t' type='2d' builtin='flat' rgb1='1 0 0' width='{width}' height='1'/>
            <texture type='skybox' builtin='flat' width='1' height='1'/><material name='m' texture='t'/></asset>
            <worldbody><geom type='box' size='.2 .2 .2' material='m'/></worldbody>"
        ))
    };
    assert!(from_free(&model(1)).unwrap().rgb.iter().any(|&c| c > 0));
    from_free(&model(16384)).unwrap();
    assert!(message(from_free(&model(16385))).contains("has a side longer than 16384 pixels"));
}

#[test]
fn materials_and_textures_that_do_not_exist_are_refused_or_plain() {
    let text = "<asset><texture name='t' type='2d' builtin='flat' width='2' height='2'/><material name='m' texture='t'/>
        </asset><worldbody><geom name='g' size='.2' material='m'/></worldbody>";
    for id in [-5, -1, 1, i32::MAX] {
        let mut model = load(text);
        if model.overwrite(|draft| draft.mat_texid[0] = [id; 10]).is_ok() {
            let found = from_free(&model);
            match id > 0 {
                true => assert!(matches!(found, Err(RenderError::Model { .. })), "{id}: {found:?}"),
                false => assert!(found.is_ok(), "{id}: {found:?}"),
            }
        }
        let mut model = load(text);
        if model.overwrite(|draft| draft.geom_matid[0] = id).is_ok() {
            assert!(id < 0, "material {id} is accepted");
            from_free(&model).unwrap();
        }
    }
}

/// A ball at the origin.
fn item(shape: Shape) -> Item {
    Item {
        shape,
        pos: [0.0; 3],
        mat: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        size: [0.2; 3],
        rgba: [0.5, 0.5, 0.5, 1.0],
        look: Look::default(),
        material: None,
        rbound: 0.2,
        object: Object { kind: 5, id: 0 },
        category: Category::Dynamic,
        unlisted: false,
        label: String::new(),
    }
}

#[test]
fn items_of_assets_that_do_not_exist_show_nothing() {
    let model = load(BALL);
    let base = scene(&model, Camera::free(&model)).unwrap();
    for number in [1, 77, usize::MAX] {
        let shapes = [
            Shape::Plane { geom: number },
            Shape::Hfield { hfield: number },
            Shape::Mesh { mesh: number },
            Shape::Hull { mesh: number },
        ];
        let scene = Scene { items: shapes.map(item).to_vec(), ..base.clone() };
        assert!(nothing(&draw(&model, &scene, Settings::of(&model)).unwrap()));
        let painted = Item { material: Some(number), ..item(Shape::Sphere) };
        draw(&model, &Scene { items: vec![painted], ..base.clone() }, Settings::of(&model)).unwrap();
    }
}

#[test]
fn items_that_are_not_finite_show_nothing() {
    let model = load(BALL);
    let base = scene(&model, Camera::free(&model)).unwrap();
    let shapes =
        [Shape::Sphere, Shape::Box, Shape::Line, Shape::LineBox, Shape::Arrow, Shape::Plane { geom: 0 }];
    for (shape, bad) in shapes.iter().flat_map(|s| [f32::NAN, f32::INFINITY, -f32::MAX].map(|bad| (*s, bad)))
    {
        let mut broken = [(); 3].map(|()| item(shape));
        broken[0].pos[1] = bad;
        broken[1].mat[4] = bad;
        broken[2].size[2] = bad;
        for mut broken in broken {
            for alpha in [1.0, 0.3, bad] {
                broken.rgba[3] = alpha;
                broken.look.reflectance = 0.5;
                let items = vec![broken.clone(), item(Shape::Sphere), broken.clone()];
                let picture = draw(&model, &Scene { items, ..base.clone() }, Settings::of(&model)).unwrap();
                assert!(!nothing(&picture), "{shape:?} {bad}");
            }
        }
    }
}

#[test]
fn many_shadows_and_many_mirrors_are_drawn() {
    let lights = "<light pos='0 0 3' dir='.1 .2 -1'/>".repeat(20);
    let mirrors = "<geom type='box' size='.1 .1 .1' pos='0 0 .5' material='m'/>".repeat(5);
    let model = load(&format!(
        "<asset><material name='m' reflectance='.7'/></asset><worldbody>{lights}{mirrors}
        <geom type='plane' size='1 1 .1' material='m'/></worldbody>"
    ));
    from_free(&model).unwrap();
    // A scene made by hand may have more lamps than a fragment has bits.
    let mut scene = scene(&model, Camera::free(&model)).unwrap();
    let lamp = Light {
        kind: LightKind::Directional,
        pos: [0.0, 0.0, 3.0],
        dir: [0.0, 0.0, -1.0],
        ambient: [0.0; 3],
        diffuse: [0.1; 3],
        specular: [0.0; 3],
        shadow: true,
        headlight: false,
    };
    scene.lights = vec![lamp; 30];
    draw(&model, &scene, Settings::of(&model)).unwrap();
    let broken = [f32::NAN, 0.0, f32::INFINITY].map(|x| Light { dir: [x; 3], pos: [x; 3], ..lamp });
    let spots = broken.map(|light| Light {
        kind: LightKind::Spot {
            cutoff: light.dir[0],
            exponent: -light.dir[0],
            attenuation: [light.dir[0]; 3],
        },
        ..light
    });
    scene.lights = [broken, spots].concat();
    draw(&model, &scene, Settings::of(&model)).unwrap();
}

#[test]
fn a_hundred_thousand_items_are_drawn_and_a_billion_triangles_refused() {
    let model = load(&format!("<visual><quality numslices='8' numstacks='4' numquads='1'/></visual>{BALL}"));
    let base = scene(&model, Camera::free(&model)).unwrap();
    let place =
        |i: usize| [(i % 100) as f32 * 0.02, (i / 100 % 100) as f32 * 0.02, (i / 10_000) as f32 * 0.1];
    let items = (0..100_000).map(|i| Item { pos: place(i), size: [0.005; 3], ..item(Shape::Box) }).collect();
    let settings = Settings::of(&model).with_samples(Samples::One);
    let picture = draw(&model, &Scene { items, shadows: false, ..base.clone() }, settings).unwrap();
    assert!(!nothing(&picture));
    let fine = load(&format!("<visual><quality numslices='200' numstacks='100'/></visual>{BALL}"));
    let items = vec![item(Shape::Sphere); 5000];
    let error = message(draw(&fine, &Scene { items, ..base }, Settings::of(&fine)));
    assert!(error.contains("its 5000 items have more than 134217728 triangles"), "{error}");
}

#[test]
fn settings_of_any_number_draw() {
    let mut model = load(BALL);
    for (shadowsize, offsamples) in [(0, 0), (1, 1), (2, 2), (3, 3), (777, 8), (1 << 20, 64), (-5, -1)] {
        let settings = model.overwrite(|draft| {
            draft.vis.quality.shadowsize = shadowsize;
            draft.vis.quality.offsamples = offsamples;
        });
        if settings.is_ok() {
            assert_eq!(Settings::of(&model).samples == Samples::Four, offsamples > 1);
            from_free(&model).unwrap();
        }
    }
    let model = load(BALL);
    let mut options = SceneOptions::default();
    options.show = Show { body_trees: true, ..options.show };
    let data = state(&model);
    let mut scene = Scene::new();
    let view = Camera::free(&model).view(&model, &data).unwrap();
    scene.update(&model, &data, view, &options).unwrap();
    for bad in [f32::NAN, f32::INFINITY, -1.0, 0.0, 1e30] {
        for size in [0, 1, 2, 3, 16, usize::MAX] {
            let shadow = ShadowSettings { size, clip: bad, scale: bad };
            let settings = Settings::default()
                .with_samples(Samples::Four)
                .with_shadow(shadow)
                .with_slices(size)
                .with_line_width(bad)
                .with_keep(size == 3);
            draw(&model, &scene, settings).unwrap();
        }
    }
}
