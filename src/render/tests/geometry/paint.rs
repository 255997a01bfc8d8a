//! How textures are put onto items.

use super::*;
use robohive_render::geometry::Paint;

const MODEL: &str = "<mujoco><asset>
    <texture name='flat' type='2d' builtin='flat' width='2' height='2'/>
    <texture name='cube' type='cube' builtin='flat' width='2'/>
    <material name='flat' texture='flat' texrepeat='3 0'/>
    <material name='uniform' texture='flat' texrepeat='3 2' texuniform='true'/>
    <material name='cube' texture='cube'/>
    <material name='uniform cube' texture='cube' texuniform='true'/>
    <material name='plain'/>
    <mesh name='bare' vertex='0 0 0  1 0 0  0 1 0  0 0 1'/>
    <mesh name='mapped' vertex='0 0 0  1 0 0  0 1 0  0 0 1' face='0 2 1  0 1 3  1 2 3  2 0 3' texcoord='0 0 1 0 0 1 1 1'/>
    </asset><worldbody><geom type='plane' size='0 0 1'/><geom type='plane' size='1 2 1'/>
    <geom type='mesh' mesh='bare'/><geom type='mesh' mesh='mapped'/></worldbody></mujoco>";

const FLAT: usize = 0;
const UNIFORM: usize = 1;
const CUBE: usize = 2;
const UNIFORM_CUBE: usize = 3;
const PLAIN: usize = 4;
const BARE: Shape = Shape::Mesh { mesh: 0 };
const MAPPED: Shape = Shape::Mesh { mesh: 1 };

fn paint(profile: Profile, shape: Shape, size: [f32; 3], material: usize) -> Paint {
    let assets = Assets::new(&load(MODEL), profile).unwrap();
    let mut out = Vec::new();
    assets.parts(&item(shape, size, Some(material)), &mut out);
    assert!(out.iter().all(|part| part.paint == out[0].paint));
    out[0].paint
}

#[test]
fn primitives_and_mapped_meshes_have_coordinates_of_their_own() {
    let explicit = |shape, size, material| match paint(Profile::Mujoco312, shape, size, material) {
        Paint::Explicit { texture: 0, scale, offset } => [scale[0], scale[1], offset[0], offset[1]],
        other => panic!("{other:?}"),
    };
    let size = [0.5, 4.0, 2.0];
    for shape in
        [Shape::Box, Shape::Capsule, Shape::Sphere, Shape::Cylinder, MAPPED, Shape::Plane { geom: 1 }]
    {
        assert_eq!(explicit(shape, size, FLAT), [3.0, 1.0, 0.0, 0.0]);
        assert_eq!(explicit(shape, size, UNIFORM), [1.5, 8.0, 0.0, 0.0]);
    }
    let plane = Shape::Plane { geom: 0 };
    assert_eq!(explicit(plane, [0.0, 4.0, 1.0], UNIFORM), [3.0, 8.0, -0.5, -0.5]);
    assert_eq!(explicit(plane, [0.0, 0.0, 1.0], FLAT), [3.0, 1.0, -0.5, -0.5]);
}

#[test]
fn other_meshes_are_projected_along_z() {
    let planar = |profile, shape, size, material| match paint(profile, shape, size, material) {
        Paint::Planar { texture: 0, scale } => scale,
        other => panic!("{other:?}"),
    };
    let size = [0.5, 4.0, 2.0];
    assert_eq!(planar(Profile::Mujoco312, BARE, size, FLAT), [3.0, -0.0]);
    assert_eq!(planar(Profile::Mujoco312, BARE, size, UNIFORM), [1.5, -1.0]);
    // MuJoCo 3.1.3 projects onto primitives too: planes in metres, the others in units of their size.
    assert_eq!(planar(Profile::Mujoco313, Shape::Box, size, UNIFORM), [0.75, -4.0]);
    assert_eq!(planar(Profile::Mujoco313, Shape::Plane { geom: 1 }, size, UNIFORM), [1.5, -1.0]);
    assert_eq!(planar(Profile::Mujoco313, Shape::Plane { geom: 0 }, [0.0, 0.0, 1.0], UNIFORM), [1.5, -1.0]);
}

#[test]
fn coordinates_of_a_file_ignore_repetitions_in_mujoco_3_1_3() {
    let plain = Paint::Explicit { texture: 0, scale: [1.0; 2], offset: [0.0; 2] };
    assert_eq!(paint(Profile::Mujoco313, MAPPED, [0.5, 4.0, 2.0], UNIFORM), plain);
}

#[test]
fn cubes_are_looked_up_by_position_and_not_at_all_on_mapped_meshes() {
    let cube = |shape, material| match paint(Profile::Mujoco312, shape, [0.5, 4.0, 2.0], material) {
        Paint::Cube { texture: 1, scale } => scale,
        other => panic!("{other:?}"),
    };
    assert_eq!(cube(Shape::Box, CUBE), [1.0; 3]);
    assert_eq!(cube(Shape::Capsule, UNIFORM_CUBE), [0.5, 4.0, 2.0]);
    assert_eq!(cube(BARE, CUBE), [1.0; 3]);
    assert_eq!(paint(Profile::Mujoco312, MAPPED, [1.0; 3], CUBE), Paint::Plain);
}

#[test]
fn without_texture_the_colour_of_the_item_stays() {
    assert_eq!(paint(Profile::Mujoco312, Shape::Box, [1.0; 3], PLAIN), Paint::Plain);
    assert_eq!(paint(Profile::Mujoco312, Shape::Box, [1.0; 3], 99), Paint::Plain);
}
