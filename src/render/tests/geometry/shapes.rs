//! Triangles of every shape.

use super::*;
use std::f64::consts::PI;

fn near(measured: f64, exact: f64, share: f64) -> bool {
    (measured / exact - 1.0).abs() < share
}

#[test]
fn round_shapes_are_closed_count_as_by_formula_and_measure_as_they_should() {
    for (slices, stacks) in [(28, 16), (7, 5), (3, 2)] {
        let text = format!(
            "<mujoco><visual><quality numslices='{slices}' numstacks='{stacks}'/></visual><worldbody/></mujoco>"
        );
        let assets = assets(&text);
        let half = stacks / 2;
        let disk = slices + 2 * slices * (half - 1);
        let sphere = 2 * (slices + 2 * slices * (half - 1));
        let wall = 2 * slices * stacks;
        let count = |shape| triangles(&assets, shape, [0.5, 0.5, 0.75]).len();
        assert_eq!(count(Shape::Sphere), sphere);
        assert_eq!(count(Shape::Cylinder), wall + 2 * disk);
        assert_eq!(count(Shape::Capsule), wall + sphere);
        let cone = 2 * (slices + 2 * slices * (stacks - 1));
        assert_eq!(count(Shape::Arrow), wall + 2 * disk + cone);
        assert_eq!(count(Shape::ThinArrow), wall + 2 * disk + cone);
        assert_eq!(count(Shape::DoubleArrow), wall + 2 * cone);
        for shape in [Shape::Sphere, Shape::Cylinder, Shape::Capsule, Shape::Box, Shape::Arrow] {
            assert!(is_closed(&triangles(&assets, shape, [0.5, 0.6, 0.75])), "{shape:?} {slices} {stacks}");
        }
        assets.surfaces.iter().for_each(|surface| check_surface(surface));
    }
}

#[test]
fn sizes_are_those_of_the_shapes() {
    let assets = assets(EMPTY);
    let of = |shape, size| measure(&triangles(&assets, shape, size));
    let [area, volume] = of(Shape::Sphere, [2.0; 3]);
    assert!(near(area, 16.0 * PI, 0.03) && near(volume, 32.0 / 3.0 * PI, 0.03));
    let [_, volume] = of(Shape::Sphere, [1.0, 2.0, 3.0]);
    assert!(near(volume, 8.0 * PI, 0.03));
    let [area, volume] = of(Shape::Cylinder, [0.5, 0.5, 2.0]);
    assert!(near(area, 4.5 * PI, 0.02) && near(volume, PI, 0.02));
    let [area, volume] = of(Shape::Capsule, [0.5, 0.5, 2.0]);
    assert!(near(area, 5.0 * PI, 0.02) && near(volume, PI + PI / 6.0, 0.02));
    let [area, volume] = of(Shape::Box, [1.0, 2.0, 3.0]);
    assert!(near(area, 88.0, 1e-6) && near(volume, 48.0, 1e-6));
}

#[test]
fn capsules_end_at_their_poles_and_arrows_at_half_their_size() {
    let assets = assets(EMPTY);
    let reach = |shape, size| {
        let heights = triangles(&assets, shape, size).into_iter().flatten().map(|p| p[2]);
        heights.fold([f64::MAX, f64::MIN], |[low, high], z| [low.min(z), high.max(z)])
    };
    let close = |[low, high]: [f64; 2], expected: [f64; 2]| {
        assert!((low - expected[0]).abs() < 1e-6 && (high - expected[1]).abs() < 1e-6, "{low} {high}");
    };
    close(reach(Shape::Capsule, [0.25, 0.25, 2.0]), [-2.25, 2.25]);
    close(reach(Shape::Capsule, [0.25, 0.25, 0.0]), [-0.25, 0.25]);
    close(reach(Shape::Arrow, [0.1, 0.1, 3.0]), [0.0, 1.5]);
    close(reach(Shape::ThinArrow, [0.1, 0.1, 3.0]), [0.0, 1.5]);
    close(reach(Shape::DoubleArrow, [0.1, 0.1, 3.0]), [-1.5, 1.5]);
}

#[test]
fn lines_have_no_surface_and_triangles_two_sides() {
    let assets = assets(EMPTY);
    assert!(parts(&assets, Shape::Line, [1.0; 3]).is_empty());
    assert!(parts(&assets, Shape::LineBox, [1.0; 3]).is_empty());
    assert!(parts(&assets, Shape::Mesh { mesh: 0 }, [1.0; 3]).is_empty());
    assert!(parts(&assets, Shape::Plane { geom: 3 }, [1.0; 3]).is_empty());
    assert!(parts(&assets, Shape::Triangle, [1.0; 3])[0].two_sided);
    let corners = triangles(&assets, Shape::Triangle, [2.0, 3.0, 7.0]);
    assert_eq!(corners, [[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 3.0, 0.0]]]);
}

#[test]
fn planes_have_even_strips_and_padding_or_two_hundred_cells() {
    let text = "<mujoco><asset><texture name='t' type='2d' builtin='flat' width='2' height='2'/>
        <material name='m' texture='t' texrepeat='4 4'/></asset>
        <statistic extent='1'/><worldbody><geom type='plane' size='1 .5 .3'/><geom type='plane' size='0 0 1'/>
        <geom type='plane' size='3 0 .001' material='m'/></worldbody></mujoco>";
    let assets = assets(text);
    let grid = |geom: usize| {
        let part = parts(&assets, Shape::Plane { geom }, [1.0; 3])[0];
        let surface = &assets.surfaces[part.surface];
        check_surface(surface);
        let lines = |axis: usize| {
            let mut values: Vec<f32> = surface.positions.iter().map(|p| p[axis]).collect();
            values.sort_by(f32::total_cmp);
            values.dedup();
            values
        };
        assert!(surface.positions.iter().all(|p| p[2] == 0.0));
        [lines(0), lines(1)]
    };
    let close = |lines: &[f32], expected: &[f32]| {
        assert_eq!(lines.len(), expected.len());
        assert!(lines.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6), "{lines:?}");
    };
    // floor(1 / .3) = 3, made even: 2 strips of .6, and 1 - .6 at both ends; floor(.5 / .3) = 1 leaves the padding alone.
    let [x, y] = grid(0);
    close(&x, &[-1.0, -0.6, 0.0, 0.6, 1.0]);
    close(&y, &[-0.5, 0.0, 0.5]);
    let [x, y] = grid(1);
    let half = 0.5 * (2.1 * 50.0 + 2.0 * 2.1 * 50.0 / 198.0);
    assert_eq!([x.len(), y.len()], [201, 201]);
    assert!((x[200] - half).abs() < 1e-4 && (x[0] + half).abs() < 1e-4);
    let [x, y] = grid(2);
    // 3 / 198 divides 3 without a rest: 198 strips and no padding.
    assert_eq!([x.len(), y.len()], [199, 201]);
    assert!((y[200] - (0.5 * (2.1 * 50.0 + 2.0 * 0.5))).abs() < 1e-4);
}

#[test]
fn height_fields_are_closed_and_flat() {
    let text = "<mujoco><asset><hfield name='h' nrow='3' ncol='4' size='2 1 .5 .25'
        elevation='0 1 2 1  0 3 2 0  1 1 0 2'/></asset>
        <visual><quality numquads='1'/></visual>
        <worldbody><geom type='hfield' hfield='h'/></worldbody></mujoco>";
    let assets = assets(text);
    let triangles = triangles(&assets, Shape::Hfield { hfield: 0 }, [2.0, 1.0, 0.5]);
    let (rows, columns) = (2, 3);
    assert_eq!(triangles.len(), 2 * rows * columns + 4 * (rows + columns) + 2);
    let [_, volume] = measure(&triangles);
    assert!(volume > 2.0 && volume < 4.0 * 2.0 * 0.75);
    let part = parts(&assets, Shape::Hfield { hfield: 0 }, [2.0, 1.0, 0.5])[0];
    let surface = &assets.surfaces[part.surface];
    assert!(surface.texcoords.is_empty());
    assert!(surface.corners.iter().all(|t| t.normal == [t.normal[0]; 3]));
    let [middle, half] = surface.bounds;
    assert_eq!([middle, half], [[0.0, 0.0, 0.125], [2.0, 1.0, 0.375]]);
}

const TENT: &str = "<mujoco><asset><mesh name='m' smoothnormal='SMOOTH'
    vertex='0 0 0  1 0 0  0 1 0  0 0 1' face='0 2 1  0 1 3  1 2 3  2 0 3' TEXCOORD/></asset>
    <worldbody><geom type='mesh' mesh='m'/></worldbody></mujoco>";

fn tent(smooth: &str, texcoord: &str) -> (Model, Assets) {
    let model = load(&TENT.replace("SMOOTH", smooth).replace("TEXCOORD", texcoord));
    let assets = Assets::new(&model, Profile::Mujoco312).unwrap();
    (model, assets)
}

#[test]
fn meshes_keep_their_order_and_shade_sharp_edges_flat() {
    let shape = Shape::Mesh { mesh: 0 };
    let (model, assets) = tent("true", "");
    assert!(is_closed(&triangles(&assets, shape, [1.0; 3])));
    let [_, volume] = measure(&triangles(&assets, shape, [1.0; 3]));
    assert!((volume - 1.0 / 6.0).abs() < 1e-6);
    let surface = &assets.surfaces[parts(&assets, shape, [1.0; 3])[0].surface];
    check_surface(surface);
    for (rows, face) in surface.faces.iter().zip(&model.mesh_face) {
        assert_eq!(*rows, face.map(|i| i as u32));
    }
    // The vertex normals lie 45 degrees or more off every face: none is used.
    assert_eq!(surface.normals.len(), 4);

    let (model, assets) = tent("true", "texcoord='0 0 1 0 0 1 1 1'");
    let surface = &assets.surfaces[parts(&assets, shape, [1.0; 3])[0].surface];
    assert_eq!(surface.texcoords.len(), 4);
    for (corners, face) in surface.corners.iter().zip(&surface.faces) {
        for (normal, &vertex) in corners.normal.into_iter().zip(face) {
            assert_eq!(surface.normals[normal as usize], model.mesh_normal[vertex as usize]);
        }
    }
}

#[test]
fn hulls_are_closed_and_convex() {
    let text = "<mujoco><asset><mesh name='m' vertex='-1 -1 -1  1 -1 -1  -1 1 -1  1 1 -1  -1 -1 1  1 -1 1  -1 1 1  1 1 1
        0 0 0' face='0 2 1  1 2 3  0 1 4  1 5 4  8 4 5'/></asset>
        <worldbody><geom type='mesh' mesh='m'/></worldbody></mujoco>";
    let assets = assets(text);
    let shape = Shape::Hull { mesh: 0 };
    let hull = triangles(&assets, shape, [1.0; 3]);
    assert!(is_closed(&hull) && hull.len() == 12);
    let [area, volume] = measure(&hull);
    assert!(near(area, 24.0, 1e-5) && near(volume, 8.0, 1e-5));
    check_surface(&assets.surfaces[parts(&assets, shape, [1.0; 3])[0].surface]);
}

#[test]
fn bad_meshes_and_qualities_are_refused_by_name() {
    let (model, _) = tent("false", "");
    let refused = |change: fn(&mut physics::model::Arrays), word: &str| {
        let mut model = model.clone();
        change(model.unchecked_mut());
        let message = message(Assets::new(&model, Profile::Mujoco312));
        assert!(message.contains(word), "{message}");
    };
    refused(|m| m.mesh_face[1][0] = 4, "mesh \"m\": triangle 1");
    refused(|m| m.mesh_face[1][0] = -1, "mesh \"m\": triangle 1");
    refused(|m| m.mesh_facenormal[0][2] = 99, "mesh \"m\": triangle 0");
    refused(|m| m.mesh_facenum[0] = 5, "mesh \"m\": 5 triangles");
    refused(|m| m.mesh_vertadr[0] = i32::MAX, "mesh \"m\": 4 vertices");
    refused(|m| m.mesh_vertnum[0] = -1, "mesh \"m\": -1 vertices");
    refused(|m| m.mesh_graph[0] = -1, "mesh \"m\": its convex hull");
    refused(|m| m.mesh_graph[1] = i32::MAX, "mesh \"m\": its convex hull");
    refused(|m| m.mesh_graphadr[0] = i32::MAX, "mesh \"m\": its convex hull");
    refused(|m| m.vis.quality.numslices = 2, "numslices is 2");
    refused(|m| m.vis.quality.numstacks = 0, "numstacks is 0");
    refused(|m| m.vis.quality.numquads = 100_000, "numquads is 100000");
}
