//! Pictures of a simulation: colours, depth and what is seen, saved as PNG.

use robohive::physics::model::ObjType;
use robohive::render::picture::Channels;
use robohive::render::scene::{Camera, SceneOptions};
use robohive::render::{Assets, Profile, Scene, Settings};
use robohive::video::{Frame, depth_image, write_png};
use robohive::{Data, Picture, Renderer, forward, load_str};

const TABLE: &str = "
<mujoco>
  <worldbody>
    <light pos='0 0 3'/>
    <camera name='above' pos='0 0 2'/>
    <geom name='table' type='plane' size='1 1 .1' rgba='.3 .3 .3 1'/>
    <geom name='ball' size='.2' pos='0 0 .2' rgba='.9 .1 .1 1'/>
  </worldbody>
</mujoco>";

/// Draws a scene in colours, depth and segmentation.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let model = load_str(TABLE)?.model;
    let mut data = Data::new(&model);
    forward(&model, &mut data)?;

    // Triangles and textures are prepared once, what is to be seen is listed for every state.
    let assets = Assets::new(&model, Profile::Mujoco312)?;
    let view = Camera::named(&model, "above")?.view(&model, &data)?;
    let mut scene = Scene::new();
    scene.update(&model, &data, view, &SceneOptions::default())?;
    let (mut picture, mut renderer) = (Picture::new(80, 60), Renderer::new(Settings::of(&model)));
    renderer.draw(&assets, &scene, Channels::ALL, &mut picture)?;

    // The ball is in the middle, red, and its top is 1.6 m from the camera.
    let (middle, edge) = (30 * picture.width + 40, 40);
    let ball = model.geom("ball").ok_or("no ball")?;
    assert_eq!(picture.segmentation[middle], [ball.index() as i32, ObjType::Geom as i32]);
    assert!((picture.depth[middle] - 1.6).abs() < 0.01 && (picture.depth[edge] - 2.0).abs() < 0.01);
    let [red, green, _] = [0, 1, 2].map(|channel| picture.rgb[3 * middle + channel]);
    assert!(red > 2 * green, "red {red}, green {green}");

    let (width, height) = (picture.width as u32, picture.height as u32);
    let file = std::env::temp_dir().join(format!("robohive-picture-{}.png", std::process::id()));
    write_png(&file, &Frame::new(width, height, &picture.rgb)?)?;
    let depth = depth_image(width, height, &picture.depth, (1.5, 2.1))?;
    write_png(&file, &depth.frame())?;
    assert!(std::fs::read(&file)?.starts_with(b"\x89PNG"));
    std::fs::remove_file(&file)?;
    Ok(())
}
