//! Meshes: hulls against brute force and MuJoCo, mass against closed forms, readers against inconsistent files.

use robohive_mjcf::asset::AssetErrorKind;
use robohive_mjcf::mesh::{
    Bvh, CompiledMesh, Format, MeshInertia, MeshSource, Primitive, RawMesh, Shape, builtin, convex_hull,
    decode, fit_primitive, process,
};

/// Binary STL of a box with half sizes (1, 2, 3) centred at (4, 5, 6), header "solid".
fn box_stl() -> Vec<u8> {
    let corner = |k: usize| {
        [
            4.0 + if k & 1 > 0 { 1.0f32 } else { -1.0 },
            5.0 + if k & 2 > 0 { 2.0 } else { -2.0 },
            6.0 + if k & 4 > 0 { 3.0 } else { -3.0 },
        ]
    };
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let mut bytes = b"solid box".to_vec();
    bytes.resize(80, b' ');
    bytes.extend(12u32.to_le_bytes());
    for [a, b, c, d] in quads {
        for triangle in [[a, b, c], [a, c, d]] {
            bytes.extend([0; 12]);
            for k in triangle {
                bytes.extend(corner(k).iter().flat_map(|x| x.to_le_bytes()));
            }
            bytes.extend([0; 2]);
        }
    }
    bytes
}

fn compile_box(adapt: impl Fn(&mut MeshSource)) -> CompiledMesh {
    let file = decode(&box_stl(), "box.stl", "").unwrap();
    let mut source = MeshSource { file: Some(file), needhull: true, ..MeshSource::default() };
    adapt(&mut source);
    process(source).unwrap()
}

fn assert_close(a: &[f64], b: &[f64], tolerance: f64) {
    assert_eq!(a.len(), b.len());
    assert!(a.iter().zip(b).all(|(x, y)| (x - y).abs() <= tolerance), "{a:?} != {b:?}");
}

#[test]
fn box_has_closed_form_mass_and_hull() {
    let mesh = compile_box(|_| {});
    assert_eq!((mesh.vert.len(), mesh.face.len()), (8, 12));
    assert_close(&[mesh.volume], &[48.0], 1e-12);
    assert_close(&mesh.pos, &[4.0, 5.0, 6.0], 1e-12);
    // Principal inertias decrease, so the longest side becomes z.
    assert_close(&mesh.boxsz, &[1.0, 2.0, 3.0], 1e-12);
    assert_close(&mesh.inertia(48.0), &[48.0 / 3.0 * 13.0, 48.0 / 3.0 * 10.0, 48.0 / 3.0 * 5.0], 1e-10);
    assert_close(&mesh.aabb(), &[0.0, 0.0, 0.0, 1.0, 2.0, 3.0], 1e-12);
    assert_eq!(mesh.graph[..2], [8, 12]);
    assert_eq!(mesh.poly_vertnum, [4; 6]);
    assert_eq!(mesh.poly_mapnum, [3; 8]);
    for normal in &mesh.poly_normal {
        assert_close(&[normal.iter().map(|x| x.abs()).sum()], &[1.0], 1e-12);
    }
}

#[test]
fn inertia_modes_agree_on_a_convex_mesh_and_shell_is_its_own() {
    for mode in [MeshInertia::Exact, MeshInertia::Convex] {
        let mesh = compile_box(|s| s.inertia = mode);
        assert_close(&[mesh.volume], &[48.0], 1e-12);
        assert_close(&mesh.boxsz, &[1.0, 2.0, 3.0], 1e-12);
    }
    let shell = compile_box(|s| s.inertia = MeshInertia::Shell);
    assert_close(&[shell.volume], &[88.0], 1e-12);
    let by_faces = |a: f64, b: f64, c: f64| {
        // Moment about the axis of half size a: two plates at each of the three distances.
        let plates =
            [(b * c, (b * b + c * c) / 3.0), (c * a, b * b + c * c / 3.0), (a * b, c * c + b * b / 3.0)];
        plates.iter().map(|(area, r2)| 8.0 * area * r2).sum::<f64>()
    };
    let expected = [by_faces(1.0, 2.0, 3.0), by_faces(2.0, 3.0, 1.0), by_faces(3.0, 1.0, 2.0)];
    assert_close(&shell.inertia(88.0), &expected, 1e-9);
}

#[test]
fn frame_and_mirror_move_the_mesh() {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let mesh = compile_box(|s| {
        s.refpos = [3.0, 5.0, 6.0];
        s.refquat = [2.0 * half, 0.0, 0.0, 2.0 * half];
        s.scale = [0.1, 0.1, -0.1];
    });
    // The centre (1, 0, 0) turned by -90 degrees about z, then scaled.
    assert_close(&mesh.pos, &[0.0, -0.1, 0.0], 1e-12);
    assert_close(&[mesh.volume], &[0.048], 1e-12);
}

#[test]
fn fits_contain_or_resemble_the_mesh() {
    let mesh = compile_box(|_| {});
    let (capsule, center) = fit_primitive(&mesh, Primitive::Capsule, true, 1.0, [0.0; 3]);
    assert_close(&capsule, &[2.0, 1.0, 0.0], 1e-12);
    assert_close(&center, &[0.0; 3], 1e-12);
    let (sphere, _) = fit_primitive(&mesh, Primitive::Sphere, false, 0.5, [0.0; 3]);
    assert_close(&sphere, &[1.0, 0.0, 0.0], 1e-12);
}

/// Every node encloses its children and every face is a leaf once.
fn check_tree(bvh: &Bvh, faces: usize) {
    let mut seen = vec![false; faces];
    for node in 0..bvh.depth.len() {
        if bvh.nodeid[node] >= 0 {
            assert!(!std::mem::replace(&mut seen[bvh.nodeid[node] as usize], true));
            continue;
        }
        for child in bvh.child[node].map(|c| c as usize) {
            assert_eq!(bvh.depth[child], bvh.depth[node] + 1);
            let (outer, inner) = (bvh.aabb[node], bvh.aabb[child]);
            for k in 0..3 {
                assert!((outer[k] - inner[k]).abs() + inner[k + 3] <= outer[k + 3] + 1e-12);
            }
        }
    }
    assert!(seen.iter().all(|&x| x));
}

#[test]
fn hierarchy_covers_the_faces() {
    let mesh = compile_box(|_| {});
    assert_eq!(mesh.bvh.depth.len(), 2 * 12 - 1);
    check_tree(&mesh.bvh, 12);
}

/// Uniform numbers in [-1, 1).
fn noise(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

#[test]
fn hull_is_closed_convex_and_contains_all_points() {
    let mut random = noise(7);
    let mut clouds = vec![(0..400).map(|_| [random(), random(), random()]).collect::<Vec<[f64; 3]>>()];
    // Many coplanar points, axis aligned and not.
    let grid = |f: &dyn Fn([f64; 3]) -> [f64; 3]| {
        (0..125).map(|k| f([k % 5, k / 5 % 5, k / 25].map(|x| 0.1 * x as f64))).collect::<Vec<_>>()
    };
    clouds.push(grid(&|p| p));
    clouds.push(grid(&|[x, y, z]| [0.6 * x - 0.8 * y, 0.8 * x + 0.6 * y + 0.3 * z, z - 0.2 * x]));
    for points in clouds {
        let hull = convex_hull(&points, -1).unwrap();
        let edges: usize = hull.neighbours.iter().map(Vec::len).sum();
        assert_eq!(hull.vert.len() + hull.face.len(), edges / 2 + 2, "Euler's formula");
        let at = |v: i32| points[v as usize];
        for &[a, b, c] in &hull.face {
            let sub = |p: [f64; 3], q: [f64; 3]| [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
            let (e, f) = (sub(at(b), at(a)), sub(at(c), at(a)));
            let n = [e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]];
            let size = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
            assert!(size > 0.0);
            for &p in &points {
                let d = sub(p, at(a));
                assert!(d[0] * n[0] + d[1] * n[1] + d[2] * n[2] <= 1e-13 * size);
            }
        }
    }
}

/// Rows recorded from MuJoCo 3.12 for a lattice without faces.
#[test]
fn lattice_hull_is_listed_as_in_mujoco() {
    let vert =
        (0..18).flat_map(|k| [0.1f32 * (k / 6) as f32, 0.2 * (k / 2 % 3) as f32, 0.3 * (k % 2) as f32]);
    let text: Vec<f32> = vert.map(|x| format!("{x:.9}").parse().unwrap()).collect();
    let inline = RawMesh { vert: text, ..RawMesh::default() };
    let mesh = process(MeshSource { inline, ..MeshSource::default() }).unwrap();
    assert_eq!(mesh.graph[..18], [8, 12, 0, 7, 11, 18, 22, 29, 33, 37, 16, 4, 0, 12, 13, 1, 17, 5]);
    let face: Vec<i32> = mesh.face.into_iter().flatten().collect();
    #[rustfmt::skip]
    assert_eq!(face, [
        4, 16, 0, 16, 12, 0, 12, 13, 0, 13, 1, 0, 16, 13, 12, 13, 16, 17,
        5, 4, 0, 1, 5, 0, 5, 16, 4, 16, 5, 17, 13, 5, 1, 5, 13, 17,
    ]);
    #[rustfmt::skip]
    assert_eq!(mesh.poly_vert, [
        5, 1, 13, 17, 16, 4, 5, 17, 5, 4, 0, 1, 13, 12, 16, 17, 12, 13, 1, 0, 4, 16, 12, 0,
    ]);
    #[rustfmt::skip]
    assert_eq!(mesh.extrema, [
        1, 1, 2, 1, 1, 2, 7, 5, 5, 0, 0, 2, 0, 0, 2, 6, 4, 4, 0, 0, 3, 0, 0, 3, 6, 4, 4,
    ]);
}

/// Checksums of graph and polygons recorded from MuJoCo 3.12: lattice points near a sphere, whose
/// coplanar facets are merged and removed again, so that the order of all lists shows.
#[test]
fn degenerate_hulls_are_listed_as_in_mujoco() {
    #[rustfmt::skip]
    const RECORDED: [(u64, u64); 8] = [
        (42, 0xb0a685e21446e175),
        (62, 0x9c5aa415c701de68),
        (74, 0x5405caa6d7911c74),
        (145, 0x8aad9128b6eab11c),
        (177, 0xf29ae3374a07c0ea),
        (190, 0xd342b39eac646dd4),
        (241, 0xa059bc9491a39097),
        (255, 0xff1052b94c71c86b),
    ];
    for (seed, recorded) in RECORDED {
        let mut random = noise(seed);
        let radius = 4.0 + (seed % 9) as f64;
        let mut vert = Vec::new();
        for _ in 0..80 {
            let p = [random(), random(), random()];
            let norm = (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]).sqrt();
            vert.extend(p.map(|x| (x / norm * radius + 0.5).floor() as f32));
        }
        let inline = RawMesh { vert, ..RawMesh::default() };
        let mesh = process(MeshSource { inline, ..MeshSource::default() }).unwrap();
        let sum = mesh
            .graph
            .iter()
            .chain(&mesh.poly_vert)
            .fold(14695981039346656037u64, |h, &v| (h ^ u64::from(v as u32)).wrapping_mul(1099511628211));
        assert_eq!(sum, recorded, "seed {seed}");
    }
}

#[test]
fn hull_vertices_can_be_limited() {
    let mut random = noise(3);
    let points: Vec<[f64; 3]> = (0..200).map(|_| [random(), random(), random()]).collect();
    let full = convex_hull(&points, -1).unwrap();
    let few = convex_hull(&points, 10).unwrap();
    assert!(full.vert.len() > 20);
    assert_eq!(few.vert.len(), 10);
}

#[test]
fn flat_and_inconsistent_meshes_are_refused() {
    let flat: Vec<[f64; 3]> = (0..9).map(|k| [(k % 3) as f64, (k / 3) as f64, 1.0]).collect();
    assert!(convex_hull(&flat, -1).unwrap_err().to_string().contains("plane"));
    let mut file = decode(&box_stl(), "box.stl", "").unwrap();
    file.face.swap(0, 1);
    let source = MeshSource { file: Some(file), inertia: MeshInertia::Exact, ..MeshSource::default() };
    assert_eq!(process(source).unwrap_err().kind, AssetErrorKind::Geometry);
}

#[test]
fn lying_files_are_errors() {
    let stl = box_stl();
    let kind = |bytes: &[u8], path: &str| decode(bytes, path, "").unwrap_err().kind;
    assert_eq!(kind(&stl[..200], "x.stl"), AssetErrorKind::Malformed, "text without a triangle");
    let mut claims_more = stl.clone();
    claims_more[0] = b'S';
    claims_more[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    assert_eq!(kind(&claims_more, "x.stl"), AssetErrorKind::Truncated);
    let mut not_a_number = stl.clone();
    not_a_number[96..100].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_eq!(kind(&not_a_number, "x.stl"), AssetErrorKind::Malformed);
    let msh: Vec<u8> = [i32::MAX, i32::MAX, 0, i32::MAX].iter().flat_map(|x| x.to_le_bytes()).collect();
    assert_eq!(kind(&msh, "x.msh"), AssetErrorKind::Truncated);
    assert_eq!(kind(b"", "x.stl"), AssetErrorKind::Truncated);
    assert_eq!(kind(b"v 1 2\n", "x.obj"), AssetErrorKind::Malformed);
    assert_eq!(kind(b"", "x.ply"), AssetErrorKind::Unsupported);
}

#[test]
fn obj_polygons_become_triangles() {
    let text =
        "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nvt 0 0.25\nf 1/1 2/1 3/1 4/1 5/1\nf -5/1 -4/1 -1/1\n";
    let raw = decode(text.as_bytes(), "x.obj", "").unwrap();
    assert_eq!(raw.format, Format::Obj);
    // The corner at (2, 1) is reflex, so the fan does not start at the first corner.
    assert_eq!(raw.face, [1, 2, 3, 3, 4, 0, 0, 1, 3, 0, 1, 4]);
    assert_eq!(raw.texcoord, [0.0, 0.75]);
    assert_eq!(raw.facetexcoord, [0; 12]);
}

/// Triangles recorded from MuJoCo 3.12.
#[test]
fn obj_polygons_are_cut_as_in_the_reference() {
    let cases: [(&str, &[[i32; 3]]); 6] = [
        // A simple polygon, reflex at most corners.
        (
            "15 -12, 3 -15, -14 -24, -15 -5, -12 4, -15 26, 1 8, 23 20, 18 0",
            &[[1, 2, 3], [1, 3, 4], [1, 4, 5], [1, 5, 6], [1, 6, 7], [1, 7, 8], [0, 1, 8]],
        ),
        // Polygons that cross themselves: the first ear begins at the last corner, no ear is left after a few.
        ("6 5, 4 6, 4 2, 1 0, 3 2, 6 2, 5 5", &[[6, 0, 1]]),
        ("4 6, 0 1, 0 7, 4 4, 4 7, 0 0, 0 5", &[[6, 0, 1]]),
        ("6 1, 2 6, 5 0, 2 7, 6 2, 0 0, 1 4", &[[2, 3, 4], [4, 5, 6]]),
        // Tiny convex polygons whose area in single precision has the wrong sign.
        (
            "1.639386 1.188743, 1.639583 1.188396, 1.639596 1.188403, 1.639602 1.188406, 1.63969 1.188521",
            &[[1, 2, 3]],
        ),
        ("1.374491 1.752589, 1.374378 1.752581, 1.374341 1.752508, 1.374456 1.752404", &[]),
    ];
    for (polygon, triangles) in cases {
        let vertices: Vec<String> = polygon.split(", ").map(|point| format!("v 0 {point}\n")).collect();
        let corners: Vec<String> = (1..=vertices.len()).map(|corner| corner.to_string()).collect();
        let text = format!("{}f {}\n", vertices.concat(), corners.join(" "));
        let raw = decode(text.as_bytes(), "x.obj", "").unwrap();
        assert_eq!(raw.face, triangles.concat(), "{polygon}");
    }
}

#[test]
fn computed_shapes_have_the_volume_of_their_solid() {
    let volume = |shape: Shape, params: &[f64]| {
        let inline = builtin(shape, params).unwrap();
        process(MeshSource { inline, inertia: MeshInertia::Exact, ..MeshSource::default() }).unwrap().volume
    };
    let ball = 4.0 / 3.0 * std::f64::consts::PI;
    // Inscribed polyhedra approach the solid from inside.
    for (value, solid) in [
        (volume(Shape::Sphere, &[4.0]), ball),
        (volume(Shape::Hemisphere, &[10.0]), ball / 2.0),
        (volume(Shape::Supersphere, &[60.0, 1.0, 1.0]), ball),
        (volume(Shape::Supertorus, &[80.0, 0.5, 1.0, 1.0]), 0.5 * std::f64::consts::PI.powi(2)),
    ] {
        assert!(value < solid && value > 0.97 * solid, "{value} {solid}");
    }
    assert_close(&[volume(Shape::Cone, &[4.0, 0.0])], &[4.0 / 3.0], 1e-6);
    assert!(builtin(Shape::Sphere, &[9.0]).is_err());
}

/// Lengths from 1 to 3e14: merging takes points from the hull that are then outside again, without end.
#[test]
fn hull_of_points_that_come_again_ends() {
    let bits: [[u32; 3]; 8] = [
        [0xbf800000, 0xbf800000, 0xbf800000],
        [0xbf800000, 0xbf800000, 0x3f800000],
        [0x2f800000, 0x3f800000, 0xaf800000],
        [0xbf800080, 0x3f800000, 0x3f800000],
        [0x3f800100, 0xbf800000, 0xbf800000],
        [0x3f800000, 0x48800400, 0x3f80fbff],
        [0x3f800000, 0x3f800000, 0xd7800000],
        [0x3f802600, 0x3f800000, 0x3f880000],
    ];
    let points = bits.map(|p| p.map(|x| f64::from(f32::from_bits(x))));
    let hull = convex_hull(&points, -1).unwrap();
    assert!(hull.vert.contains(&5) && hull.vert.contains(&6), "the two farthest points");
    let edges = || hull.face.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
    assert!(edges().all(|(a, b)| edges().filter(|&edge| edge == (b, a)).count() == 1), "a closed surface");
}

/// Corners within single precision whose centre of mass is so far from some that the difference is not.
#[test]
fn vertices_beyond_single_precision_are_refused() {
    let tetrahedron = |far: f32| {
        let vert = vec![far, 0.0, 0.0, -far, 0.0, 0.0, -far, far, 0.0, -far, 0.0, far];
        process(MeshSource { inline: RawMesh { vert, ..RawMesh::default() }, ..MeshSource::default() })
    };
    let error = tetrahedron(f32::MAX).unwrap_err();
    assert_eq!(error.kind, AssetErrorKind::Geometry);
    assert!(error.to_string().contains("beyond single precision"), "{error}");
    let mesh = tetrahedron(f32::MAX / 4.0).unwrap();
    assert!(mesh.vert.as_flattened().iter().any(|&x| x.abs() > f32::MAX / 4.0));
}
