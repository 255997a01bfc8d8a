//! Many pictures at once.

use super::{Measures, Shot, batch, renderer};
use render::picture::Channels;
use render::raster::Samples;
use render::scene::SceneOptions;
use render::{Assets, Picture, Profile};

const WORLD: &str = "<mujoco><asset><texture name='t' type='2d' builtin='checker' width='16' height='16' rgb1='1 1 1'/>
    <material name='m' texture='t'/></asset><worldbody>
    <light pos='0 0 2'/><light directional='true' pos='0 0 3' dir='.2 .3 -1'/>
    <geom type='plane' size='1 1 .1' material='m'/><geom type='capsule' size='.1 .2' pos='0 0 .4' rgba='1 .3 .2 1'/>
    <geom type='box' size='.1 .1 .1' pos='.3 .2 .2' rgba='.2 .3 1 .5'/>
    <camera name='a' pos='0 -1.5 1' xyaxes='1 0 0 0 .6 .8'/>
    <camera name='b' pos='0 0 2'/>
    <camera name='c' pos='.5 -1 .5' xyaxes='.9 .4 0 -.1 .3 .9'/></worldbody></mujoco>";

fn shots() -> Vec<Shot> {
    let model = mjcf::load_str(WORLD).expect("a model").model;
    ["a", "b", "c"].map(|camera| Shot::of(&model, camera, &SceneOptions::default())).into()
}

/// The place in an atlas may change the last bit of a position in the window.
#[test]
fn a_batch_holds_single_pictures_of_any_size() {
    let shots = shots();
    let Some(mut gpu) = renderer(shots[0].settings) else { return };
    let sizes = [[64, 48], [33, 61], [97, 19], [100, 30], [64, 64]];
    let shown: Vec<&Shot> = (0..40).map(|k| &shots[k % 3]).collect();
    let empty: Vec<Picture> = (0..40).map(|k| Picture::new(sizes[k % 5][0], sizes[k % 5][1])).collect();
    let mut pictures = empty.clone();
    batch(&mut gpu, &shown, Channels::ALL, &mut pictures);
    for (k, picture) in pictures.iter().enumerate() {
        let single = shots[k % 3].on_gpu(&mut gpu, sizes[k % 5]);
        Measures::of(&single, picture).check_small(&format!("picture {k}"));
    }
    // The memory of the first batch is used for another one.
    let mut again = empty;
    batch(&mut gpu, &shown, Channels::ALL, &mut again);
    assert!(pictures == again);
}

#[test]
fn more_pixels_than_an_atlas_holds_are_drawn_in_turn() {
    let shots = shots();
    let Some(mut gpu) = renderer(shots[0].settings) else { return };
    let shown: Vec<&Shot> = shots.iter().collect();
    let mut pictures = vec![Picture::new(1700, 1300); 3];
    batch(&mut gpu, &shown, Channels::SEGMENTATION, &mut pictures);
    for (shot, picture) in shots.iter().zip(&pictures) {
        assert!(
            picture.segmentation.len() == 1700 * 1300 && picture.rgb.is_empty() && picture.depth.is_empty()
        );
        let expected = shot.on_cpu([1700, 1300]);
        let other = expected.segmentation.iter().zip(&picture.segmentation).filter(|(a, b)| a != b).count();
        assert!(other < 40, "{other} pixels");
    }
}

#[test]
fn edits_of_a_model_reach_the_gpu() {
    let mut model = mjcf::load_str(WORLD).expect("a model").model;
    let mut shot = Shot::of(&model, "a", &SceneOptions::default());
    let Some(mut gpu) = renderer(shot.settings) else { return };
    let before = shot.on_gpu(&mut gpu, [64, 48]);
    let edit = |draft: &mut physics::model::Draft<'_>| {
        draft.tex_data.iter_mut().for_each(|byte| *byte /= 2);
        draft.geom_size[0] = [0.5, 0.6, 0.05];
    };
    model.overwrite(edit).expect("a sound edit");
    shot.assets.refresh(&model).expect("sound assets");
    shot.scene = Shot::of(&model, "a", &SceneOptions::default()).scene;
    let after = shot.on_gpu(&mut gpu, [64, 48]);
    assert!(Measures::of(&before, &after).psnr < 30.0, "the edit is seen");
    Measures::of(&shot.on_cpu([64, 48]), &after).check_small("after the edit");
}

#[test]
fn another_model_takes_the_place_of_the_last_one() {
    let shots = shots();
    let Some(mut gpu) = renderer(shots[0].settings) else { return };
    let first = shots[0].on_gpu(&mut gpu, [40, 40]);
    let text = "<mujoco><worldbody><geom size='.3' pos='0 0 .2'/><camera name='a' pos='0 0 2'/></worldbody></mujoco>";
    let other = mjcf::load_str(text).expect("a model").model;
    let mut ball = Shot::of(&other, "a", &SceneOptions::default());
    ball.assets = Assets::new(&other, Profile::default()).expect("sound assets");
    ball.settings = shots[0].settings;
    Measures::of(&ball.on_cpu([40, 40]), &ball.on_gpu(&mut gpu, [40, 40])).check("another model");
    assert!(first == shots[0].on_gpu(&mut gpu, [40, 40]));
}

/// Pictures of one state share shadow maps; pictures of different states do not.
#[test]
fn cameras_of_two_states_keep_their_own_shadows() {
    let model = mjcf::load_str(WORLD).expect("a model").model;
    let mut moved = model.clone();
    moved.overwrite(|draft| draft.geom_pos[1][0] = 0.4).expect("a sound edit");
    let cameras = ["a", "b", "c"];
    let shots: Vec<Shot> = [&model, &moved]
        .into_iter()
        .flat_map(|model| cameras.map(|camera| Shot::of(model, camera, &SceneOptions::default())))
        .collect();
    let Some(mut gpu) = renderer(shots[0].settings) else { return };
    let shown: Vec<&Shot> = shots.iter().collect();
    let mut pictures = vec![Picture::new(64, 48); shown.len()];
    batch(&mut gpu, &shown, Channels::ALL, &mut pictures);
    for (shot, picture) in shots.iter().zip(&pictures) {
        Measures::of(&shot.on_cpu([64, 48]), picture).check_small("a state");
    }
}

/// Environments of a batch each have their own edits of textures and shapes, and may be of different models.
#[test]
fn a_batch_shows_every_model_with_its_own_edits() {
    let model = mjcf::load_str(WORLD).expect("a model").model;
    let (mut darker, mut other) = (model.clone(), model.clone());
    darker.overwrite(|draft| draft.tex_data.iter_mut().for_each(|byte| *byte /= 3)).expect("a sound edit");
    other.overwrite(|draft| draft.geom_size[0] = [0.4, 0.6, 0.05]).expect("a sound edit");
    let ball = "<mujoco><worldbody><light pos='0 0 2'/><geom size='.3' pos='0 0 .2'/><camera name='a' pos='0 -1 2'/></worldbody></mujoco>";
    let ball = mjcf::load_str(ball).expect("a model").model;
    let base = Shot::of(&model, "a", &SceneOptions::default());
    let mut shots = vec![Shot::of(&ball, "a", &SceneOptions::default())];
    for edited in [&model, &darker, &other, &model] {
        let mut shot = Shot::of(edited, "a", &SceneOptions::default());
        shot.assets = base.assets.clone();
        shot.assets.refresh(edited).expect("sound assets");
        shots.push(shot);
    }
    shots.iter_mut().for_each(|shot| shot.settings = base.settings);
    let Some(mut gpu) = renderer(base.settings) else { return };
    let shown: Vec<&Shot> = shots.iter().collect();
    for round in 0..2 {
        let mut pictures = vec![Picture::new(64, 48); shown.len()];
        batch(&mut gpu, &shown, Channels::ALL, &mut pictures);
        for (k, (shot, picture)) in shots.iter().zip(&pictures).enumerate() {
            Measures::of(&shot.on_cpu([64, 48]), picture).check_small(&format!("round {round}, model {k}"));
        }
        assert!(pictures[1].rgb != pictures[2].rgb && pictures[1].rgb != pictures[3].rgb, "edits are seen");
    }
}

#[test]
fn a_renderer_takes_other_settings() {
    let shot = &shots()[0];
    let Some(mut gpu) = renderer(shot.settings) else { return };
    let before = shot.on_gpu(&mut gpu, [64, 48]);
    let mut coarse = Shot::of(&mjcf::load_str(WORLD).expect("a model").model, "a", &SceneOptions::default());
    coarse.settings = shot.settings.with_samples(Samples::One);
    coarse.settings.shadow.size = 256;
    gpu.set(&coarse.settings).expect("settings");
    let after = coarse.on_gpu(&mut gpu, [64, 48]);
    assert!(before != after);
    Measures::of(&coarse.on_cpu([64, 48]), &after).check_small("one sample");
    gpu.set(&shot.settings).expect("settings");
    assert!(before == shot.on_gpu(&mut gpu, [64, 48]));
}
