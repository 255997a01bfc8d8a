//! Things that grow: sizes of primitives, and the mass that goes with them.

use super::config::Keeps;
use physics::Model;
use physics::geometry::shape;
use physics::model::{Draft, GeomType, ObjType};

/// Part by which moments of inertia may differ and be those of one shape.
const SAME: f64 = 1e-6;

/// The geoms of a body.
pub(super) fn geoms_of(m: &Model, body: usize) -> std::ops::Range<usize> {
    let first = m.body_geomadr[body].max(0) as usize;
    first..first + m.body_geomnum[body] as usize
}

/// Whether the size of a geom says how large it is.
fn is_primitive(m: &Model, geom: usize) -> bool {
    let kind = GeomType::from_code(m.geom_type[geom]).unwrap_or(GeomType::None);
    kind != GeomType::Plane && shape::size_count(kind) > 0
}

/// Refuses a geom that cannot grow by itself.
///
/// # Errors
/// It is no primitive; its body's mass is not its alone.
pub(super) fn check_geom(m: &Model, geom: usize, keeps: Keeps) -> Result<(), String> {
    let label = m.label_of(ObjType::Geom, geom);
    if !is_primitive(m, geom) {
        return Err(format!("the {label} is no sphere, capsule, cylinder, ellipsoid or box"));
    }
    let body = m.geom_bodyid[geom] as usize;
    if keeps == Keeps::Inertia || body == 0 || is_all_mass(m, geom, body) {
        return Ok(());
    }
    let body = m.label_of(ObjType::Body, body);
    Err(format!(
        "the mass of {body} is not that of its {label} alone; name the body under bodies, or say keeps = \"inertia\""
    ))
}

/// Whether the mass of a body is where one solid or shell has it.
fn is_all_mass(m: &Model, geom: usize, body: usize) -> bool {
    let kind = GeomType::from_code(m.geom_type[geom]).unwrap_or(GeomType::None);
    let sorted = |mut moments: [f64; 3]| {
        moments.sort_by(f64::total_cmp);
        moments
    };
    let found = sorted(m.body_inertia[body]);
    let near = |a: f64, b: f64, scale: f64| (a - b).abs() <= SAME * scale;
    let size = m.geom_size[geom];
    let there = m.geom_pos[geom].iter().zip(m.body_ipos[body]).all(|(a, b)| near(*a, b, m.geom_rbound[geom]));
    let of_shape = |shell: bool| {
        let moments = sorted(shape::inertia(kind, size, m.body_mass[body], shell));
        moments.iter().zip(found).all(|(a, b)| near(*a, b, found[2]))
    };
    there && (of_shape(false) || of_shape(true))
}

/// Refuses a body that cannot grow.
///
/// # Errors
/// It is the world; bodies hang on it; a geom that touches others is no primitive; nothing grows.
pub(super) fn check_body(m: &Model, body: usize) -> Result<(), String> {
    let label = m.label_of(ObjType::Body, body);
    if body == 0 {
        return Err("the world has no size".into());
    }
    if (1..m.nbody).any(|child| m.body_parentid[child] == body as i32) {
        return Err(format!("other bodies hang on the {label}; name its geoms instead"));
    }
    let touches = |&geom: &usize| m.geom_contype[geom] != 0 || m.geom_conaffinity[geom] != 0;
    if let Some(geom) = geoms_of(m, body).filter(touches).find(|&geom| !is_primitive(m, geom)) {
        let geom = m.label_of(ObjType::Geom, geom);
        return Err(format!("the {geom} of {label} is no sphere, capsule, cylinder, ellipsoid or box"));
    }
    if !geoms_of(m, body).any(|geom| is_primitive(m, geom)) {
        return Err(format!("the {label} has no sphere, capsule, cylinder, ellipsoid or box"));
    }
    Ok(())
}

/// Gives a geom the size that `base` has.
pub(super) fn restore_geom(geom: usize, base: &Model, m: &mut Draft<'_>) {
    m.geom_size[geom] = base.geom_size[geom];
    if m.geom_fluid[geom] != base.geom_fluid[geom] {
        m.geom_fluid[geom] = base.geom_fluid[geom];
    }
}

/// Gives a body the mass that `base` has.
pub(super) fn restore_mass(body: usize, base: &Model, m: &mut Draft<'_>) {
    m.body_mass[body] = base.body_mass[body];
    m.body_inertia[body] = base.body_inertia[body];
}

/// Gives a body the size that `base` has.
pub(super) fn restore_body(body: usize, base: &Model, m: &mut Draft<'_>) {
    restore_mass(body, base, m);
    if m.body_ipos[body] != base.body_ipos[body] {
        m.body_ipos[body] = base.body_ipos[body];
    }
    for geom in geoms_of(base, body).filter(|&geom| is_primitive(base, geom)) {
        restore_geom(geom, base, m);
        m.geom_pos[geom] = base.geom_pos[geom];
    }
    for site in sites_of(base, body) {
        m.site_pos[site] = base.site_pos[site];
        m.site_size[site] = base.site_size[site];
    }
}

/// Multiplies the lengths of a geom.
pub(super) fn grow_geom(geom: usize, factor: f64, m: &mut Draft<'_>) {
    m.geom_size[geom] = m.geom_size[geom].map(|size| factor * size);
    // Of an ellipsoid in a fluid: virtual mass and virtual inertia; the other coefficients are of shape alone.
    if m.geom_fluid[geom][0] > 0.0 {
        m.geom_fluid[geom][6..9].iter_mut().for_each(|mass| *mass *= power(factor, 3));
        m.geom_fluid[geom][9..12].iter_mut().for_each(|inertia| *inertia *= power(factor, 5));
    }
}

/// Multiplies mass and moments of inertia of a body by what its growth does to them.
pub(super) fn grow_mass(body: usize, factor: f64, keeps: Keeps, m: &mut Draft<'_>) {
    let (mass, inertia) = match keeps {
        Keeps::Density => (power(factor, 3), power(factor, 5)),
        Keeps::Mass => (1.0, power(factor, 2)),
        Keeps::Inertia => return,
    };
    m.body_mass[body] *= mass;
    m.body_inertia[body] = m.body_inertia[body].map(|moment| inertia * moment);
}

/// Multiplies all lengths of a body.
pub(super) fn grow_body(body: usize, factor: f64, keeps: Keeps, base: &Model, m: &mut Draft<'_>) {
    let longer = |place: [f64; 3]| place.map(|x| factor * x);
    grow_mass(body, factor, keeps, m);
    if base.body_ipos[body] != [0.0; 3] && keeps != Keeps::Inertia {
        m.body_ipos[body] = longer(base.body_ipos[body]);
    }
    for geom in geoms_of(base, body).filter(|&geom| is_primitive(base, geom)) {
        grow_geom(geom, factor, m);
        m.geom_pos[geom] = longer(base.geom_pos[geom]);
    }
    for site in sites_of(base, body) {
        m.site_pos[site] = longer(base.site_pos[site]);
        m.site_size[site] = longer(base.site_size[site]);
    }
}

fn sites_of(m: &Model, body: usize) -> impl Iterator<Item = usize> {
    (0..m.nsite).filter(move |&site| m.site_bodyid[site] == body as i32)
}

/// A power by multiplication alone.
fn power(factor: f64, exponent: usize) -> f64 {
    (0..exponent).fold(1.0, |product, _| product * factor)
}
