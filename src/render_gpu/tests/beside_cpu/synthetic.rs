//! Models in text, each with what one step of a picture adds.

use super::{Measures, Shot};
use physics::Model;
use render::raster::Samples;
use render::scene::{Effects, Fog, LabelChoice, SceneOptions, Show};

/// Around the worldbody of every model here.
const HEAD: &str = "<mujoco><statistic extent='1.2' center='0 0 .3'/><asset>
    <texture name='sky' type='skybox' builtin='gradient' rgb1='.3 .5 .7' rgb2='0 0 .1' width='32' height='32'/>
    <texture name='squares' type='2d' builtin='checker' rgb1='.9 .2 .1' rgb2='.1 .3 .8' width='50' height='50'/>
    <texture name='dice' type='cube' builtin='checker' rgb1='.9 .8 .1' rgb2='.2 .6 .3' mark='edge' markrgb='1 1 1'
        width='40' height='40'/>
    <material name='floor' texture='squares' texrepeat='3 3' texuniform='true'/>
    <material name='mirror' texture='squares' reflectance='.4'/>
    <material name='dice' texture='dice' shininess='.9' specular='.8'/>
    <material name='glow' rgba='.1 .6 .2 1' emission='.7'/>
    <hfield name='hills' nrow='4' ncol='5' size='.3 .3 .2 .05' elevation='0 1 0 2 0 1 3 1 0 2 0 2 1 3 0 1 0 2 0 1'/>
  </asset>";

/// Things of every shape, one of them transparent.
const THINGS: &str = "<geom type='box' size='.12 .1 .15' pos='-.4 .1 .2' euler='20 30 10' material='dice'/>
    <geom type='sphere' size='.15' pos='0 .3 .25' material='squares_ball'/>
    <geom type='capsule' size='.06 .2' pos='.35 -.1 .3' euler='60 20 0' rgba='.8 .5 .2 1'/>
    <geom type='cylinder' size='.1 .15' pos='.1 -.4 .3' euler='10 40 0' material='glow'/>
    <geom type='ellipsoid' size='.2 .1 .12' pos='-.2 -.3 .3' rgba='.2 .7 .9 .4'/>
    <geom type='sphere' size='.1' pos='-.3 -.5 .3' rgba='.9 .2 .9 .5'/>
    <geom type='hfield' hfield='hills' pos='.5 .5 .1' rgba='.5 .6 .4 1'/>
    <camera name='near' pos='.9 -1.4 1.1' xyaxes='.84 .54 0 -.27 .42 .87' fovy='50'/>
    <camera name='flat' projection='orthographic' pos='0 -2 1.6' xyaxes='1 0 0 0 .62 .78' fovy='1.8'/>
    <camera name='below' pos='0 -1 -.6' xyaxes='1 0 0 0 -.5 .87'/>";

fn model(world: &str) -> Model {
    let head =
        HEAD.replace("<hfield", "<material name='squares_ball' texture='squares' texrepeat='2 1'/><hfield");
    let text = format!("{head}<worldbody>{world}{THINGS}</worldbody></mujoco>");
    mjcf::load_str(&text).unwrap_or_else(|error| panic!("{error}")).model
}

fn options() -> SceneOptions {
    SceneOptions::default()
}

fn check(world: &str, camera: &str, options: &SceneOptions) {
    let shot = Shot::of(&model(world), camera, options);
    shot.measure([150, 111]).iter().for_each(|found: &Measures| found.check(camera));
}

const FLOOR: &str = "<geom type='plane' size='2 2 .1' material='floor'/>";
const LAMP: &str = "<light pos='.5 -.5 2' dir='-.15 .15 -1' cutoff='40' exponent='3' ambient='.1 .1 .1'
    attenuation='1 .1 .05'/>";
const SUN: &str = "<light directional='true' pos='0 0 3' dir='.1 .15 -1' diffuse='.5 .5 .4'/>";

#[test]
fn textures_and_the_headlight() {
    check(FLOOR, "near", &options());
}

#[test]
fn a_spot_and_the_sun_with_shadows() {
    check(&format!("{FLOOR}{LAMP}{SUN}"), "near", &options());
}

#[test]
fn lights_without_shadows() {
    let options = options().with_effects(Effects::default().with_shadows(false));
    check(&format!("{FLOOR}{LAMP}{SUN}"), "near", &options);
}

#[test]
fn parallel_rays() {
    check(&format!("{FLOOR}{LAMP}"), "flat", &options());
}

#[test]
fn a_mirroring_plane_and_a_mirroring_box() {
    let plane = "<geom type='plane' size='2 2 .1' material='mirror'/>";
    check(&format!("{plane}{LAMP}"), "near", &options());
    let cuboid = "<geom type='box' size='.8 .8 .05' pos='0 0 .05' euler='5 0 0' material='mirror'/>";
    check(&format!("{FLOOR}{cuboid}{SUN}"), "near", &options());
}

#[test]
fn a_plane_from_behind() {
    check(&format!("{FLOOR}{SUN}"), "below", &options());
}

#[test]
fn an_infinite_plane_with_haze() {
    let plane = "<geom type='plane' size='0 0 .1' material='floor'/>";
    check(&format!("{plane}{SUN}"), "near", &options());
}

#[test]
fn lines() {
    let ray = "<site name='ray' pos='0 0 1.2' zaxis='.2 .1 -1'/>";
    let text = format!(
        "{HEAD}<worldbody>{FLOOR}{ray}<camera name='near' pos='.9 -1.4 1.1' xyaxes='.84 .54 0 -.27 .42 .87'/>
        </worldbody><sensor><rangefinder site='ray'/></sensor></mujoco>"
    );
    let model = mjcf::load_str(&text).expect("a model").model;
    let shot = Shot::of(&model, "near", &options());
    shot.measure([150, 111]).iter().for_each(|found| found.check("lines"));
}

#[test]
fn decorations() {
    let show = Show { cameras: true, lights: true, centers_of_mass: true, ..Show::default() };
    check(&format!("{FLOOR}{LAMP}"), "near", &options().with_show(show));
}

#[test]
fn fog() {
    let mirror = "<geom type='plane' size='2 2 .1' material='mirror'/>";
    let endless = "<geom type='plane' size='0 0 .1' material='floor'/>";
    for (plane, camera, end) in
        [(FLOOR, "near", 3.0), (mirror, "near", 3.0), (endless, "near", 60.0), (FLOOR, "flat", 60.0)]
    {
        let effects = Effects::default().with_fog(true);
        let options = options().with_effects(effects);
        let mut shot = Shot::of(&model(&format!("{plane}{LAMP}")), camera, &options);
        let set = |fog: &mut Fog| *fog = Fog { start: 1.0, end, rgb: [0.7, 0.8, 0.9] };
        shot.scene.fog.iter_mut().for_each(set);
        assert!(shot.scene.fog.is_some() && shot.scene.sky.is_some());
        shot.measure([150, 111]).iter().for_each(|found| found.check("fog"));
    }
}

#[test]
fn labels_are_those_of_the_cpu() {
    check(FLOOR, "near", &options().with_label(LabelChoice::Geom));
}

#[test]
fn a_texture_that_lets_light_through() {
    let mut model = model(&format!("{FLOOR}{LAMP}{SUN}"));
    let arrays = model.unchecked_mut();
    let count = arrays.tex_data.len() / 3;
    let opacity = |pixel: usize| [255, 253, 250, 0][pixel / 7 % 4];
    let data = arrays.tex_data.as_chunks::<3>().0.iter().enumerate();
    arrays.tex_data = data.flat_map(|(k, &[r, g, b])| [r, g, b, opacity(k)]).collect::<Vec<u8>>().into();
    arrays.tex_nchannel.iter_mut().for_each(|channels| *channels = 4);
    arrays.tex_adr.iter_mut().for_each(|address| *address = *address / 3 * 4);
    assert_eq!(arrays.tex_data.len(), 4 * count);
    let shot = Shot::of(&model, "near", &options());
    shot.measure([150, 111]).iter().for_each(|found| found.check("opacity"));
}

#[test]
fn one_sample() {
    let mut shot = Shot::of(&model(&format!("{FLOOR}{LAMP}")), "near", &options());
    shot.settings = shot.settings.with_samples(Samples::One);
    shot.measure([150, 111]).iter().for_each(|found| found.check("one sample"));
}
