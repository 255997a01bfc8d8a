//! Comparison of recorded rays (`reference/rays.py`): against single geoms, and through scenes.

use super::archive::{largest, numbers, rows};
use super::report::{Report, SCENE, TOGETHER};
use crate::reference::ReferenceError;
use crate::tolerance::CONTACT_BAR;
use dataset::NpzReader;
use physics::math::Vec3;
use physics::ray::{Hit, Ray, RayFilter, multi_ray, ray, ray_geom};
use physics::{Data, Model};

/// What a ray met: the geom, -1 for none; the distance, -1 for none; the normal.
type Answer = (i32, f64, Vec3);

fn answer(found: Option<(usize, Hit)>) -> Answer {
    found.map_or((-1, -1.0, [0.0; 3]), |(geom, hit)| (geom as i32, hit.distance, hit.normal))
}

fn count(report: &mut Report, target: usize, ours: Answer, theirs: Answer, unstable: bool) {
    let tally = report.rays.entry(target).or_default();
    tally.rays += 1;
    tally.hits += usize::from(theirs.1 >= 0.0);
    tally.unstable += usize::from(unstable);
    let error = [(ours.1 - theirs.1).abs() / theirs.1.max(1.0), largest(&ours.2, &theirs.2)];
    if ours.0 == theirs.0 && error.iter().all(|&e| e <= CONTACT_BAR) {
        tally.worst = std::array::from_fn(|k| tally.worst[k].max(error[k]));
    } else if unstable {
        tally.excepted += 1;
    } else {
        tally.different += 1;
        let number = tally.rays;
        report.note(|| format!("ray {number} against {target}: {ours:?} (MuJoCo {theirs:?})"));
    }
}

/// Rays against the last geom of the model, in the shape that each ray finds it.
pub(crate) fn compare_geom(
    m: &mut Model,
    d: &mut Data,
    archive: &NpzReader,
    report: &mut Report,
) -> Result<(), ReferenceError> {
    let g = m.ngeom - 1;
    let kind = numbers(archive, "ray")?[0];
    if m.unchecked_mut().assign("hfield_data", &numbers(archive, "hfield_data")?) != Some(true) {
        return Err(ReferenceError::Shape("hfield_data".into()));
    }
    m.unchecked_mut().geom_type[g] = kind as i32;
    let (size, dataid) = (rows::<3>(archive, "size")?, numbers(archive, "dataid")?);
    let (xpos, xmat) = (rows::<3>(archive, "xpos")?, rows::<9>(archive, "xmat")?);
    let (pnt, vec) = (rows::<3>(archive, "pnt")?, rows::<3>(archive, "vec")?);
    let (distance, normal) = (numbers(archive, "distance")?, rows::<3>(archive, "normal")?);
    let unstable = numbers(archive, "unstable")?;
    for i in 0..distance.len() {
        let arrays = m.unchecked_mut();
        (arrays.geom_size[g], arrays.geom_dataid[g]) = (size[i], dataid[i] as i32);
        (d.kin.geom_xpos[g], d.kin.geom_xmat[g]) = (xpos[i], xmat[i]);
        let found = ray_geom(m, &d.kin, g, Ray { origin: pnt[i], direction: vec[i] }).map(|hit| (0, hit));
        let theirs = (if distance[i] < 0.0 { -1 } else { 0 }, distance[i], normal[i]);
        count(report, kind as usize, answer(found), theirs, unstable[i] != 0.0);
    }
    Ok(())
}

/// Rays from one point through all geoms.
pub(crate) fn compare_scene(
    m: &mut Model,
    d: &mut Data,
    archive: &NpzReader,
    report: &mut Report,
) -> Result<(), ReferenceError> {
    for name in archive.names().filter_map(|n| n.strip_prefix("model.")) {
        if m.unchecked_mut().assign(name, &numbers(archive, &format!("model.{name}"))?) != Some(true) {
            return Err(ReferenceError::Shape(name.to_owned()));
        }
    }
    d.kin.geom_xpos = rows(archive, "xpos")?;
    d.kin.geom_xmat = rows(archive, "xmat")?;
    let groups = if archive.contains("groups") {
        Some(rows::<6>(archive, "groups")?[0].map(|x| x != 0.0))
    } else {
        None
    };
    let exclude = numbers(archive, "exclude")?[0];
    let filter = RayFilter {
        groups,
        skip_static: numbers(archive, "skip_static")?[0] != 0.0,
        exclude_body: (exclude >= 0.0).then_some(exclude as usize),
    };
    let (origin, vec) = (rows::<3>(archive, "pnt")?[0], rows::<3>(archive, "vec")?);
    let answers = |prefix: &str| -> Result<Vec<Answer>, ReferenceError> {
        let geom = numbers(archive, &format!("{prefix}geom"))?;
        let distance = numbers(archive, &format!("{prefix}distance"))?;
        let normal = rows::<3>(archive, &format!("{prefix}normal"))?;
        Ok((0..geom.len()).map(|i| (geom[i] as i32, distance[i], normal[i])).collect())
    };
    let unstable = numbers(archive, "unstable")?;
    for ((&direction, theirs), &unstable) in vec.iter().zip(answers("")?).zip(&unstable) {
        let found = ray(m, &d.kin, Ray { origin, direction }, filter);
        count(report, SCENE, answer(found), theirs, unstable != 0.0);
    }
    let (cutoff, culled) = (numbers(archive, "cutoff")?[0], numbers(archive, "culled")?);
    let together = multi_ray(m, &d.kin, origin, &vec, filter, cutoff);
    let doubtful = unstable.iter().zip(culled).map(|(unstable, culled)| unstable + culled != 0.0);
    for ((found, theirs), doubtful) in together.into_iter().zip(answers("multi_")?).zip(doubtful) {
        count(report, TOGETHER, answer(found), theirs, doubtful);
    }
    Ok(())
}
