//! Pictures that plugins of a program change.

use physics::model::GeomType;
use physics::plugin::{Appearance, AppearanceInputs, AttributeError, Capability, Config};
use physics::plugin::{Instance, Mark, Plugin, Registry};
use physics::{Data, Model, forward};
use robohive_render::RenderError;
use robohive_render::scene::{Camera, Category, Scene, SceneOptions, Shape};

/// Colours its bodies' geoms by their height, and puts a mark of one shape above the first.
#[derive(Debug)]
struct Height(GeomType);

impl Plugin for Height {
    fn name(&self) -> &str {
        "test.height"
    }

    fn attributes(&self) -> &[&str] {
        &[]
    }

    fn capabilities(&self) -> &[Capability] {
        &[Capability::Passive]
    }

    fn instance(&self, _: &Config, _: &Model, _: usize) -> Result<Box<dyn Instance>, AttributeError> {
        Ok(Box::new(Height(self.0)))
    }
}

impl Instance for Height {
    fn appearance(&self, inputs: &AppearanceInputs, out: &mut Appearance) {
        for (geom, pos) in inputs.at.kin.geom_xpos.iter().enumerate() {
            out.colour_geom(geom, [pos[2] as f32, 0.0, 0.0, 1.0]);
        }
        // The last colour counts, and what is no geom changes nothing.
        out.colour_geom(1, [0.0, 1.0, 0.0, 0.5]);
        out.colour_geom(99, [1.0; 4]);
        let [x, y, z] = inputs.at.kin.geom_xpos[0];
        let mat = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        let (size, pos) = ([0.1, 0.2, 0.0], [x, y, z + 1.0]);
        out.add_mark(Mark { shape: self.0, size, pos, mat, rgba: [0.2; 4], id: 7 });
    }
}

const TEXT: &str = "<mujoco><extension><plugin plugin='test.height'><instance name='h'/></plugin></extension><worldbody>
    <body pos='0 0 .5'><plugin instance='h'/><joint type='slide' axis='0 0 1'/><geom size='.1' rgba='0 0 1 1'/></body>
    <body pos='0 1 .25'><geom size='.1' rgba='0 0 1 0'/></body></worldbody></mujoco>";

fn scene(shape: GeomType, height: f64) -> Result<Scene, RenderError> {
    let mut registry = Registry::default();
    registry.register(Height(shape)).expect("a new name");
    let model = robohive_mjcf::Loader::default().plugins(registry).load_str(TEXT).expect("a model").model;
    let mut data = Data::new(&model);
    data.state.qpos[0] = height;
    forward(&model, &mut data).expect("a state");
    let view = Camera::named(&model, "free").and_then(|camera| camera.view(&model, &data)).expect("a view");
    let mut scene = Scene::new();
    // The second update replaces what the first has made.
    scene.update(&model, &data, view, &SceneOptions::default())?;
    scene.update(&model, &data, view, &SceneOptions::default())?;
    assert_eq!(model.geom_rgba[0], [0.0, 0.0, 1.0, 1.0], "the model stays as it is");
    Ok(scene)
}

#[test]
fn a_plugin_colours_geoms_by_the_state() {
    for height in [0.0, 0.25] {
        let scene = scene(GeomType::Capsule, height).expect("a scene");
        let geoms: Vec<_> = scene.items.iter().filter(|item| item.shape == Shape::Sphere).collect();
        let colours: Vec<_> = geoms.iter().map(|item| (item.object.id, item.rgba)).collect();
        assert_eq!(colours.len(), 2, "{colours:?}");
        assert!(colours.contains(&(0, [0.5 + height as f32, 0.0, 0.0, 1.0])), "{colours:?}");
        assert!(colours.contains(&(1, [0.0, 1.0, 0.0, 0.5])), "one that the model hides: {colours:?}");
    }
}

#[test]
fn a_plugin_adds_marks_before_everything_else() {
    let scene = scene(GeomType::Capsule, 0.0).expect("a scene");
    let mark = &scene.items[0];
    assert_eq!((mark.shape, mark.category, mark.object.id), (Shape::Capsule, Category::Decor, 7));
    assert_eq!((mark.size, mark.pos, mark.rgba), ([0.1, 0.1, 0.2], [0.0, 0.0, 1.5], [0.2; 4]));
    assert_eq!(scene.items.len(), 3, "one mark, two geoms");
}

#[test]
fn a_mark_without_a_shape_is_an_error() {
    let error = scene(GeomType::Mesh, 0.0).expect_err("a mesh of nothing");
    assert!(error.to_string().contains("mark of shape Mesh: use a sphere"), "{error}");
}
