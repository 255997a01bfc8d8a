//! Laws of deformable bodies: stress of uniform strains, balance of internal forces, energy, and the shape of a hanging rope.

use robohive::physics::math::{Mat3, Vec3, add, cross, dot, mul_mat, mul_mat_t_mat, mul_mat_vec, sub};
use robohive::physics::{Data, Model, forward, step};

/// A model of one flexcomp without gravity, contacts or a place of its own.
fn load(flexcomp: &str) -> Model {
    let text = format!(
        "<mujoco><option timestep='1e-4'><flag gravity='disable' contact='disable'/></option>\
         <worldbody>{flexcomp}</worldbody></mujoco>"
    );
    robohive::mjcf::load_str(&text).unwrap_or_else(|error| panic!("{text}\n{error}")).model
}

/// Numbers that look drawn, from -1 to 1.
fn draw(k: usize) -> f64 {
    (12.9898 * k as f64 + 1.0).sin()
}

/// Bodies that slide along three axes, in order: where they are at rest.
fn points(m: &Model) -> Vec<Vec3> {
    let first = |b: usize| m.body_dofadr[b] as usize;
    let moving: Vec<usize> = (1..m.nbody).filter(|&b| m.body_dofnum[b] == 3).collect();
    assert!(moving.iter().enumerate().all(|(k, &b)| first(b) == 3 * k));
    moving.into_iter().map(|b| m.body_pos[b]).collect()
}

/// Moves the bodies to `place` with speeds `speed`, and returns the passive force on each.
fn forces(m: &Model, place: &[Vec3], speed: impl Fn(usize) -> f64) -> Vec<Vec3> {
    let mut d = Data::new(m);
    for (k, (to, from)) in place.iter().zip(points(m)).enumerate() {
        d.state.qpos[3 * k..3 * k + 3].copy_from_slice(&sub(*to, from));
    }
    d.state.qvel.iter_mut().enumerate().for_each(|(k, v)| *v = speed(k));
    forward(m, &mut d).unwrap();
    d.passive.qfrc_passive.as_chunks::<3>().0.to_vec()
}

fn trace(a: &Mat3) -> f64 {
    a[0] + a[4] + a[8]
}

/// Lamé's constants of a solid in MuJoCo's energy, `mu |E|² + lambda (tr E)²`; textbooks halve the second term, so that theirs
/// would be half of the first constant.
fn lame() -> [f64; 2] {
    let first = YOUNG * POISSON / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON));
    [2.0 * first, 0.5 * YOUNG / (1.0 + POISSON)]
}

/// Share of its thickness with which a triangle resists stretching in MuJoCo.
const SHEET: f64 = 0.25;

/// First Piola–Kirchhoff stress of a Saint Venant–Kirchhoff material with Lamé's constants under a uniform deformation; of a
/// sheet, in whose plane it lies, where the deformation has no part across.
fn stress(f: &Mat3, [lambda, mu]: [f64; 2], is_sheet: bool) -> Mat3 {
    let square = mul_mat_t_mat(f, f);
    let strain: Mat3 = std::array::from_fn(|k| 0.5 * (square[k] - f64::from(k % 4 == 0)));
    let volumetric = lambda * trace(&strain);
    let mut second = strain.map(|x| 2.0 * mu * x);
    (0..if is_sheet { 2 } else { 3 }).for_each(|k| second[4 * k] += volumetric);
    mul_mat(f, &second)
}

/// Under a uniform deformation, forces times places at rest add up to the stress times the volume.
fn check_patch(m: &Model, f: &Mat3, expected: &Mat3, tolerance: f64) {
    let rest = points(m);
    let place: Vec<Vec3> = rest.iter().map(|&p| mul_mat_vec(f, p)).collect();
    let force = forces(m, &place, |_| 0.0);
    let mut virial = [0.0; 9];
    for (force, p) in force.iter().zip(&rest) {
        virial.iter_mut().enumerate().for_each(|(k, sum)| *sum -= force[k / 3] * p[k % 3]);
    }
    let size = expected.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    assert!(size > 0.0);
    for (ours, theirs) in virial.iter().zip(expected) {
        assert!((ours - theirs).abs() < tolerance * size, "{virial:?}\n{expected:?}");
    }
}

const YOUNG: f64 = 5e3;
const POISSON: f64 = 0.3;

#[test]
fn triangles_have_the_stress_of_a_sheet() {
    const THICKNESS: f64 = 0.02;
    let m = load(&format!(
        "<flexcomp name='f' type='grid' dim='2' count='5 4 1' spacing='.1 .1 .1' radius='.001' mass='1'>\
         <elasticity young='{YOUNG}' poisson='{POISSON}' thickness='{THICKNESS}' elastic2d='stretch'/></flexcomp>"
    ));
    let volume = 0.4 * 0.3 * THICKNESS * SHEET;
    // Strain in the plane of the triangles alone: the third column is normal to the others and of length 1.
    let strained = [1.2, 0.15, 0.0, -0.1, 0.9, 0.0, 0.0, 0.0, 1.0];
    let turn = [0.36, 0.48, -0.8, -0.8, 0.6, 0.0, 0.48, 0.64, 0.6];
    for f in [strained, mul_mat(&turn, &strained)] {
        check_patch(&m, &f, &stress(&f, lame(), true).map(|x| x * volume), 1e-10);
    }
    // A stiff turn alone has no stress; vertices within the sheet feel none in a uniform strain.
    let rest = points(&m);
    let turned: Vec<Vec3> = rest.iter().map(|&p| mul_mat_vec(&turn, p)).collect();
    assert!(forces(&m, &turned, |_| 0.0).as_flattened().iter().all(|f| f.abs() < 1e-10));
    let place: Vec<Vec3> = rest.iter().map(|&p| mul_mat_vec(&strained, p)).collect();
    let force = forces(&m, &place, |_| 0.0);
    let inside = |p: &Vec3| p[0].abs() < 0.15 && p[1].abs() < 0.1;
    assert_eq!(rest.iter().filter(|p| inside(p)).count(), 6);
    let size = force.as_flattened().iter().fold(0.0_f64, |most, f| most.max(f.abs()));
    assert!(size > 1.0);
    for (_, force) in rest.iter().zip(&force).filter(|(p, _)| inside(p)) {
        assert!(force.iter().all(|f| f.abs() < 1e-10 * size), "{force:?}");
    }
}

#[test]
fn tetrahedra_have_the_stress_of_a_solid() {
    let flexcomp = |more: &str| {
        load(&format!(
            "<flexcomp name='f' type='grid' dim='3' count='4 3 3' spacing='.1 .1 .1' radius='.001' mass='1' {more}>\
             <elasticity young='{YOUNG}' poisson='{POISSON}'/><contact selfcollide='none'/></flexcomp>"
        ))
    };
    let volume = 0.3 * 0.2 * 0.2;
    let f = [1.1, 0.2, -0.05, 0.0, 0.85, 0.1, 0.03, -0.1, 1.05];
    let m = flexcomp("");
    check_patch(&m, &f, &stress(&f, lame(), false).map(|x| x * volume), 1e-10);
    // Lattices of nodes have half of that, for small strains.
    let small = [1.0 + 2e-6, 1e-6, 0.0, 1e-6, 1.0 - 1e-6, 5e-7, 0.0, 5e-7, 1.0 + 3e-7];
    for dof in ["trilinear", "quadratic"] {
        let m = flexcomp(&format!("dof='{dof}'"));
        check_patch(&m, &small, &stress(&small, lame(), false).map(|x| 0.5 * x * volume), 1e-4);
    }
}

/// Internal forces of every kind neither push nor turn the whole, however it is deformed and moves.
#[test]
fn internal_forces_balance() {
    let grid = "type='grid' count='4 3 3' spacing='.1 .1 .1' radius='.001' mass='1' dim='3'";
    let sheet = "type='grid' count='5 4 1' spacing='.1 .1 .1' radius='.001' mass='1' dim='2'";
    let line = "type='grid' count='6 1 1' spacing='.1 .1 .1' radius='.001' mass='1' dim='1'";
    let solid = "<elasticity young='5e3' poisson='.3' damping='.01'/><contact selfcollide='none'/>";
    let cloth = |what| {
        format!("<elasticity young='5e3' poisson='.3' thickness='.01' damping='.01' elastic2d='{what}'/>")
    };
    for (kind, parts) in [
        (line.to_owned(), "<edge stiffness='50' damping='.1'/>".to_owned()),
        (sheet.to_owned(), cloth("stretch")),
        (sheet.to_owned(), cloth("bend")),
        (sheet.to_owned(), cloth("both")),
        (grid.to_owned(), solid.to_owned()),
        (format!("{grid} dof='trilinear'"), solid.to_owned()),
        (format!("{grid} dof='quadratic'"), solid.to_owned()),
    ] {
        let m = load(&format!("<flexcomp name='f' {kind}>{parts}</flexcomp>"));
        let rest = points(&m);
        let place: Vec<Vec3> = (rest.iter().enumerate())
            .map(|(k, p)| std::array::from_fn(|x| p[x] + 0.02 * draw(3 * k + x)))
            .collect();
        let force = forces(&m, &place, draw);
        let (mut push, mut turn, mut size) = ([0.0; 3], [0.0; 3], 0.0);
        for (&f, &p) in force.iter().zip(&place) {
            (push, turn, size) = (add(push, f), add(turn, cross(p, f)), size + dot(f, f).sqrt());
        }
        assert!(size > 1e-3, "{kind} {parts}: no force");
        // Cells of a lattice turn back by a rotation found iteratively, which does not balance moments.
        let turns = if kind.contains("dof=") { 0.0 } else { dot(turn, turn).sqrt() };
        assert!(
            dot(push, push).sqrt() < 1e-11 * size && turns < 1e-11 * size,
            "{kind} {parts}: {push:?} {turn:?}"
        );
    }
}

/// Elastic energy of the triangles of a sheet.
fn elastic(m: &Model, rest: &[Vec3], points: &[Vec3], thickness: f64) -> f64 {
    let [lambda, mu] = lame();
    let sides = |at: &[Vec3], e: &[i32]| [1, 2].map(|k| sub(at[e[k] as usize], at[e[0] as usize]));
    let mut energy = 0.0;
    for element in m.flex_elem.chunks_exact(3) {
        let ([u, v], now) = (sides(rest, element), sides(points, element));
        let area = 0.5 * dot(cross(u, v), cross(u, v)).sqrt();
        // Sides at rest in a frame of the triangle, and back from them.
        let length = dot(u, u).sqrt();
        let (a, b) = (dot(u, v) / length, 2.0 * area / length);
        let along: [Vec3; 2] = [
            std::array::from_fn(|x| now[0][x] / length),
            std::array::from_fn(|x| (now[1][x] - now[0][x] * a / length) / b),
        ];
        let strain = |i: usize, j: usize| 0.5 * (dot(along[i], along[j]) - f64::from(i == j));
        let (xx, yy, xy) = (strain(0, 0), strain(1, 1), strain(0, 1));
        let density = 0.5 * lambda * (xx + yy) * (xx + yy) + mu * (xx * xx + yy * yy + 2.0 * xy * xy);
        energy += area * thickness * SHEET * density;
    }
    energy
}

#[test]
fn a_hanging_cloth_loses_energy() {
    const THICKNESS: f64 = 0.002;
    let text = format!(
        "<mujoco><option timestep='2e-4' integrator='implicitfast'><flag contact='disable' energy='enable'/></option>\
         <worldbody><flexcomp name='f' type='grid' dim='2' count='6 6 1' spacing='.05 .05 .05' radius='.001' mass='.1' \
         euler='70 0 0'><pin id='0 5'/><edge damping='.05'/>\
         <elasticity young='{YOUNG}' poisson='{POISSON}' thickness='{THICKNESS}' damping='.005' elastic2d='stretch'/>\
         </flexcomp></worldbody></mujoco>"
    );
    let m = robohive::mjcf::load_str(&text).unwrap().model;
    let mut d = Data::new(&m);
    forward(&m, &mut d).unwrap();
    let rest = d.flex.flexvert_xpos.to_vec();
    let mut before = f64::INFINITY;
    let (mut start, mut fastest) = (None, 0.0_f64);
    for _ in 0..2500 {
        step(&m, &mut d).unwrap();
        forward(&m, &mut d).unwrap();
        let total = d.energy[0] + d.energy[1] + elastic(&m, &rest, &d.flex.flexvert_xpos, THICKNESS);
        assert!(total < before, "energy rises from {before} to {total} at {} s", d.state.time);
        before = total;
        start.get_or_insert(total);
        fastest = fastest.max(d.energy[1]);
    }
    let lost = start.unwrap_or(0.0) - before;
    assert!(lost > 0.02 && fastest > 0.005, "lost {lost} J, at most {fastest} J of motion");
}

/// The rope between two pins at one height hangs like a catenary of its length.
#[test]
fn a_rope_hangs_as_a_catenary() {
    const LINKS: usize = 40;
    const LENGTH: f64 = 1.0;
    const SPAN: f64 = 0.7;
    let link = LENGTH / LINKS as f64;
    // Laid out as a triangle whose sides are half the length.
    let height = (LENGTH * LENGTH - SPAN * SPAN).sqrt() / 2.0;
    let place = |k: usize| {
        let share = k as f64 / LINKS as f64;
        (SPAN * (share - 0.5), height * (2.0 * share - 1.0).abs())
    };
    let points: String = (0..=LINKS).map(|k| format!("{} 0 {} ", place(k).0, place(k).1)).collect();
    let elements: String = (0..LINKS).map(|k| format!("{k} {} ", k + 1)).collect();
    let text = format!(
        "<mujoco><option timestep='1e-3' integrator='implicitfast'><flag contact='disable'/></option><worldbody>\
         <flexcomp name='f' type='direct' dim='1' radius='.001' mass='.5' \
         point='{points}' element='{elements}'><pin id='0 {LINKS}'/><edge equality='true' solref='.002 1' solimp='.999 .9999 .001'/>\
         </flexcomp></worldbody></mujoco>"
    );
    let mut m = robohive::mjcf::load_str(&text).unwrap().model;
    m.edit(|m| m.dof_damping.iter_mut().for_each(|damping| *damping = 0.05)).unwrap();
    let mut d = Data::new(&m);
    (0..5000).for_each(|_| step(&m, &mut d).unwrap());
    assert!(d.state.qvel.iter().all(|v| v.abs() < 1e-3), "it has not come to rest");
    let found = &d.flex.flexvert_xpos;
    // Half the length is a·sinh(half the span / a): a by bisection.
    let (mut low, mut high) = (0.05, 5.0);
    for _ in 0..100 {
        let a: f64 = 0.5 * (low + high);
        if a * (0.5 * SPAN / a).sinh() > 0.5 * LENGTH { low = a } else { high = a }
    }
    let curve = |x: f64| low * ((x / low).cosh() - (0.5 * SPAN / low).cosh());
    let sag = -curve(0.0);
    assert!((link * LINKS as f64 - LENGTH).abs() < 1e-12 && sag > 0.3);
    for point in found {
        let expected = found[0][2] + curve(point[0]);
        assert!((point[2] - expected).abs() < 0.01 * sag, "{point:?}: {expected}");
    }
}

/// The normal of the contact has no part along the slide; friction has.
#[test]
fn trees_that_friction_alone_couples_are_one_island() {
    let accelerations = |jacobian: &str, island: &str| {
        let text = format!(
            "<mujoco><option jacobian='{jacobian}'><flag island='{island}'/></option><worldbody>\
             <body><freejoint/><geom size='.3'/></body>\
             <body name='b'><joint type='slide'/><geom size='.01' contype='0' conaffinity='0'/>\
             <flexcomp name='f' type='direct' dim='2' point='.31 0 0 .5 .1 0 .5 -.1 0' element='0 1 2' radius='.02'\
             rigid='true'/></body></worldbody></mujoco>"
        );
        let m = robohive::mjcf::load_str(&text).unwrap_or_else(|error| panic!("{error}")).model;
        let mut d = Data::new(&m);
        d.state.qvel[6] = 1.0;
        forward(&m, &mut d).unwrap();
        assert_eq!((d.con.contact.len(), d.island.nisland), (1, usize::from(island == "enable")));
        d.acc.qacc.clone()
    };
    let whole = accelerations("dense", "disable");
    assert!((whole[6] + 9.81).abs() > 1.0, "friction brakes the slide: {whole:?}");
    for jacobian in ["dense", "sparse"] {
        for (a, b) in accelerations(jacobian, "enable").iter().zip(&whole) {
            assert!((a - b).abs() < 1e-7, "{jacobian}: {a} {b}");
        }
    }
}
