//! Edits of a model: what changed is prepared again, what did not is kept.

use super::*;
use std::sync::Arc;

const MODEL: &str = "<mujoco><asset>
    <texture name='a' type='2d' builtin='flat' width='2' height='2'/>
    <texture name='b' type='2d' builtin='flat' width='2' height='2'/>
    <material name='m' texture='a'/>
    <hfield name='h' nrow='2' ncol='2' size='1 1 1 1' elevation='0 1 1 0'/>
    </asset><worldbody><geom type='plane' size='1 1 .5' material='m'/><geom type='plane' size='1 2 .5'/>
    <geom type='hfield' hfield='h'/></worldbody></mujoco>";

fn kept<T>(before: &[Arc<T>], after: &[Arc<T>]) -> Vec<bool> {
    before.iter().zip(after).map(|(a, b)| Arc::ptr_eq(a, b)).collect()
}

/// What a refresh after an edit keeps of the last surfaces (two planes, a height field) and of the textures.
fn after(edit: impl FnOnce(&mut Model)) -> (Vec<bool>, Vec<bool>, Assets) {
    let mut model = load(MODEL);
    let before = Assets::new(&model, Profile::Mujoco312).unwrap();
    let mut assets = before.clone();
    edit(&mut model);
    assets.refresh(&model).unwrap();
    let fresh = Assets::new(&model, Profile::Mujoco312).unwrap();
    assert_eq!(assets.surfaces, fresh.surfaces);
    let all = kept(&before.surfaces, &assets.surfaces);
    (all[all.len() - 3..].to_vec(), kept(&before.textures, &assets.textures), assets)
}

#[test]
fn a_refresh_rebuilds_what_changed_alone() {
    let edited = |edit: fn(&mut physics::model::Draft)| {
        let (surfaces, textures, _) = after(|model| {
            model.edit(edit).unwrap();
        });
        (surfaces, textures)
    };
    let (yes, no) = (true, false);
    assert_eq!(edited(|_| {}), (vec![yes; 3], vec![yes; 2]));
    assert_eq!(edited(|m| m.geom_rgba[0] = [0.0; 4]), (vec![yes; 3], vec![yes; 2]));
    assert_eq!(edited(|m| m.geom_size[1][0] = 3.0), (vec![yes, no, yes], vec![yes; 2]));
    assert_eq!(edited(|m| m.tex_data[13] = 99), (vec![yes; 3], vec![yes, no]));
    assert_eq!(edited(|m| m.hfield_data[1] = 0.5), (vec![yes, yes, no], vec![yes; 2]));
    assert_eq!(edited(|m| m.mat_texrepeat[0] = [2.0; 2]), (vec![no, yes, yes], vec![yes; 2]));
    assert_eq!(edited(|m| m.vis.map.zfar = 20.0), (vec![no, no, yes], vec![yes; 2]));
    assert_eq!(edited(|m| m.vis.quality.numquads = 3), (vec![no; 3], vec![no; 2]));
}

#[test]
fn a_refresh_follows_materials_and_textures() {
    let (.., assets) = after(|model| {
        model
            .edit(|m| {
                m.mat_texid[0][1] = 1;
                m.tex_data[12] = 255;
            })
            .unwrap();
    });
    let mut out = Vec::new();
    assets.parts(&item(Shape::Box, [1.0; 3], Some(0)), &mut out);
    assert!(matches!(out[0].paint, robohive_render::geometry::Paint::Explicit { texture: 1, .. }));
    assert_eq!(assets.textures[1].sample_2d(0.25, 0.25, 0.0)[0], 1.0);
}

#[test]
fn edits_one_after_the_other_are_all_seen() {
    let mut model = load(MODEL);
    let mut assets = Assets::new(&model, Profile::Mujoco312).unwrap();
    for value in [10, 20, 30, 10, 20] {
        model.edit(|m| m.tex_data[0] = value).unwrap();
        assets.refresh(&model).unwrap();
        assert_eq!(assets.textures[0].sample_2d(0.25, 0.25, 0.0)[0], f32::from(value) * (1.0 / 255.0));
    }
}

#[test]
fn a_refused_edit_changes_nothing() {
    let model = load(MODEL);
    let mut assets = Assets::new(&model, Profile::Mujoco312).unwrap();
    let before = assets.clone();
    let mut bad = model.clone();
    bad.unchecked_mut().mat_texid[0][1] = 7;
    assert!(message(assets.refresh(&bad).map(|()| before.clone())).contains("material \"m\" has texture 7"));
    assert!(kept(&before.surfaces, &assets.surfaces).into_iter().all(|kept| kept));
    assets.refresh(&model).unwrap();
}
