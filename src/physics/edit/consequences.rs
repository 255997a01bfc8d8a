//! What follows from an edit: which checks it needs, and which derived quantities change.

use super::error::EditError;
use super::follow::{Check, Follow};
use super::written::Written;
use crate::caches::Caches;
use crate::consistency::{check_actuators, check_consistency, check_geoms};
use crate::constants::bending_factor;
use crate::constants::reference::{has_damping_ratio, set_constants, set_pose_constants};
use crate::constants::set_const::{
    SetConstError, attached_frames, feature_flags, set_const, subtree_mass, wrap_body,
};
use crate::geometry::bounds::{ChangedGeoms, set_bounds};
use crate::model::array::Array;
use crate::model::{Arrays, GeomType, Model, Statistic, TrnType, WrapType};
use crate::pipeline::validity::check_model;
use crate::table::Row;
use std::sync::{Arc, OnceLock};

/// How much must be recomputed at `qpos0`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
enum Reference {
    #[default]
    Nothing,
    /// What follows from poses alone.
    Poses,
    /// All constants.
    All,
}

/// What an edit needs.
#[derive(Clone, Debug, Default)]
pub(super) struct Consequences {
    check: Check,
    features: bool,
    frames: bool,
    masses: bool,
    reference: Reference,
    changed: ChangedGeoms,
}

impl Consequences {
    /// What follows from the arrays that the edit under way wrote.
    pub(super) fn of(m: &Arrays, written: Written) -> Self {
        let mut c = Consequences {
            check: written.iter().map(Check::of).max().unwrap_or_default(),
            changed: changed_geoms(m),
            ..Consequences::default()
        };
        if !c.changed.shapes.is_empty() {
            c.reference = Reference::Poses;
        }
        for follow in written.iter().map(Follow::of) {
            c.features |= follow == Follow::Features;
            c.frames |= matches!(follow, Follow::Sites | Follow::Geoms);
            c.masses |= follow == Follow::Inertia;
            c.reference = c.reference.max(match follow {
                Follow::Nothing | Follow::Features | Follow::Bounds => Reference::Nothing,
                Follow::Viewpoints => Reference::Poses,
                Follow::Sites => of_sites(m),
                Follow::Geoms => of_geoms(m),
                Follow::Bodies => of_bodies(m),
                Follow::Servos if (0..m.nactuator).any(|i| has_damping_ratio(m, i)) => Reference::All,
                Follow::Servos => Reference::Nothing,
                Follow::Inertia | Follow::Structure => Reference::All,
            });
        }
        c
    }

    /// Recomputes all that follows.
    ///
    /// # Errors
    /// The compiled structure cannot represent the new numbers. Derived arrays are then as they were.
    pub(super) fn derive(&self, m: &mut Model) -> Result<(), EditError> {
        if self.check == Check::Structure {
            return self.derive_all(m);
        }
        let statistic = match self.reference {
            Reference::Nothing => None,
            _ => Some(computed_statistic(m)?),
        };
        if self.features {
            feature_flags(&mut m.arrays);
        }
        set_bounds(&mut m.arrays, &self.changed);
        if self.frames {
            attached_frames(&mut m.arrays);
        }
        if self.masses {
            subtree_mass(&mut m.arrays);
        }
        let Some(plain) = statistic else { return Ok(()) };
        let given = std::mem::replace(&mut m.arrays.stat, plain.clone());
        match self.reference {
            Reference::All => {
                set_constants(m);
                if !bending_factor::set(m) {
                    return Err(EditError::Structure(SetConstError::Bending));
                }
            }
            _ => set_pose_constants(m),
        }
        settle_statistic(m, &given, &plain);
        Ok(())
    }

    /// The same for an edit of the structure, by way of a copy, since it can fail halfway.
    fn derive_all(&self, m: &mut Model) -> Result<(), EditError> {
        let plain = computed_statistic(m)?;
        let mut next = m.clone();
        next.caches.drop_derived();
        let given = std::mem::replace(&mut next.arrays.stat, plain.clone());
        set_bounds(&mut next.arrays, &self.changed);
        set_const(&mut next).map_err(EditError::Structure)?;
        settle_statistic(&mut next, &given, &plain);
        check_model(&next).map_err(EditError::NotSimulated)?;
        *m = next;
        Ok(())
    }
}

/// Checks that what the edit under way wrote leads to elements and, but for edits of the structure, is simulated.
pub(super) fn check(m: &Model, written: Written) -> Result<(), EditError> {
    match written.iter().map(Check::of).max().unwrap_or_default() {
        Check::Nothing => return Ok(()),
        Check::Elements => {
            check_geoms(m).and_then(|()| check_actuators(m)).map_err(EditError::Inconsistent)?;
        }
        Check::Structure => check_consistency(m).map_err(EditError::Inconsistent)?,
    }
    check_model(m).map_err(EditError::NotSimulated)
}

/// Drops the caches that what was overwritten may have made stale.
pub(super) fn drop_caches(caches: &mut Caches, written: Written) {
    if written.iter().any(|array| Follow::of(array) == Follow::Structure) {
        caches.drop_derived();
    } else if written.iter().any(|array| Follow::of(array) != Follow::Nothing) {
        match Arc::get_mut(&mut caches.statistic) {
            Some(own) => *own = OnceLock::new(),
            None => caches.statistic = Arc::default(),
        }
    }
}

/// Statistics that follow from the arrays before the edit under way.
pub(super) fn computed_statistic(m: &Model) -> Result<Statistic, EditError> {
    if let Some(known) = m.caches.statistic.get() {
        return Ok(known.clone());
    }
    let mut plain = Model::unchecked(m.arrays.previous());
    set_const(&mut plain).map_err(EditError::Structure)?;
    Ok(m.caches.statistic.get_or_init(|| plain.arrays.stat).clone())
}

/// Keeps the computed statistics in the cache, and in the model those given: that are not `plain`, the statistics
/// computed before the edit.
fn settle_statistic(m: &mut Model, given: &Statistic, plain: &Statistic) {
    let computed = m.arrays.stat.clone();
    let stat = &mut m.arrays.stat;
    let pick = |given: f64, plain: f64, computed: f64| if given == plain { computed } else { given };
    stat.meaninertia = pick(given.meaninertia, plain.meaninertia, stat.meaninertia);
    stat.meanmass = pick(given.meanmass, plain.meanmass, stat.meanmass);
    stat.meansize = pick(given.meansize, plain.meansize, stat.meansize);
    stat.extent = pick(given.extent, plain.extent, stat.extent);
    if given.center != plain.center {
        stat.center = given.center;
    }
    m.caches.statistic = Arc::new(OnceLock::from(computed));
}

/// Rows that the edit under way changed.
fn changed<R: Row, N>(array: &Array<R, N>) -> impl Iterator<Item = usize> + '_ {
    let pairs = array.before().iter().zip(array.iter()).enumerate();
    pairs.filter(|_| array.is_written()).filter(|(_, (before, now))| before != now).map(|(row, _)| row)
}

/// Geoms and bodies whose bounds may change.
fn changed_geoms(m: &Arrays) -> ChangedGeoms {
    // Those of a mesh follow from its vertices.
    let sized =
        |&g: &usize| !matches!(GeomType::from_code(m.geom_type[g]), Some(GeomType::Mesh | GeomType::Sdf));
    let mut shapes: Vec<usize> = changed(&m.geom_size).filter(sized).collect();
    shapes.extend(changed(&m.geom_type).chain(changed(&m.geom_dataid)));
    let fields: Vec<usize> = changed(&m.hfield_size).collect();
    if !fields.is_empty() {
        let of_field = |&g: &usize| {
            let field = usize::try_from(m.geom_dataid[g]);
            m.geom_type[g] == GeomType::Hfield.code() && field.is_ok_and(|f| fields.contains(&f))
        };
        shapes.extend((0..m.ngeom).filter(of_field));
    }
    let mut geoms = shapes.clone();
    geoms.extend(changed(&m.geom_pos).chain(changed(&m.geom_quat)).chain(changed(&m.geom_aabb)));
    geoms.extend(changed(&m.geom_margin).chain(changed(&m.geom_gap)));
    geoms.extend(changed(&m.geom_contype).chain(changed(&m.geom_conaffinity)));
    let mut bodies: Vec<usize> = geoms.into_iter().map(|g| m.geom_bodyid[g] as usize).collect();
    bodies.extend(changed(&m.body_ipos).chain(changed(&m.body_iquat)));
    bodies.sort_unstable();
    bodies.dedup();
    ChangedGeoms { shapes, bodies }
}

/// Sites carry tendons and actuators.
fn of_sites(m: &Arrays) -> Reference {
    let carries = |site: usize| {
        let is = |id: i32| usize::try_from(id) == Ok(site);
        let in_path = |w: usize| match WrapType::from_code(m.wrap_type[w]) {
            Some(WrapType::Site) => is(m.wrap_objid[w]),
            Some(WrapType::Sphere | WrapType::Cylinder) => m.wrap_prm[w] == site as f64,
            _ => false,
        };
        (0..m.nwrap).any(in_path) || (0..m.nactuator).any(|i| actuator_sites(m, i).any(is))
    };
    pose_or_all(changed(&m.site_pos).chain(changed(&m.site_quat)), carries)
}

/// Sites that an actuator pulls on.
fn actuator_sites(m: &Arrays, i: usize) -> impl Iterator<Item = i32> {
    let [target, second] = m.actuator_trnid[i];
    let sites = match TrnType::from_code(m.actuator_trntype[i]) {
        Some(TrnType::So3) if second < 0 => [-1; 2],
        Some(TrnType::Site | TrnType::Slidercrank | TrnType::So3) => [target, second],
        _ => [-1; 2],
    };
    sites.into_iter()
}

/// Tendons wrap around geoms.
fn of_geoms(m: &Arrays) -> Reference {
    let wrapped = |geom: usize| {
        let around = |w: usize| {
            let kind = WrapType::from_code(m.wrap_type[w]);
            matches!(kind, Some(WrapType::Sphere | WrapType::Cylinder)) && m.wrap_objid[w] as usize == geom
        };
        (0..m.nwrap).any(around)
    };
    let poses = changed(&m.geom_pos).chain(changed(&m.geom_quat));
    pose_or_all(poses.chain(changed(&m.geom_size)).chain(changed(&m.geom_type)), wrapped)
}

/// Inertia and lengths follow from the poses of bodies that move, or that carry tendons or sites of actuators.
fn of_bodies(m: &Arrays) -> Reference {
    let mut moved = vec![false; m.nbody];
    changed(&m.body_pos).chain(changed(&m.body_quat)).for_each(|b| moved[b] = true);
    for b in 1..m.nbody {
        moved[b] |= moved[m.body_parentid[b] as usize];
    }
    let dynamic = (0..m.nbody).any(|b| moved[b] && m.body_treeid[b] >= 0);
    let in_path = || (0..m.nwrap).filter_map(|w| wrap_body(m, w)).any(|b| moved[b]);
    let site_moved = |id: i32| usize::try_from(id).is_ok_and(|s| moved[m.site_bodyid[s] as usize]);
    let pulled = || (0..m.nactuator).any(|i| actuator_sites(m, i).any(site_moved));
    let any = moved.iter().any(|&moved| moved);
    pose_or_all(any.then_some(0).into_iter(), |_| dynamic || in_path() || pulled())
}

/// Poses alone, unless one of what changed has a part in dynamics.
fn pose_or_all(mut changed: impl Iterator<Item = usize>, dynamic: impl Fn(usize) -> bool) -> Reference {
    let Some(first) = changed.next() else { return Reference::Nothing };
    if dynamic(first) || changed.any(dynamic) { Reference::All } else { Reference::Poses }
}
