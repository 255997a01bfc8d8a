//! Comparison with a stream of random placements and rays (`reference/collide.py`): contacts and distances of pairs of
//! geoms, geom poses injected. Elements of flexes (`reference/flex_pairs.py`) come in the same stream.

pub mod archive;
mod flex_pairs;
mod rays;
pub mod report;
pub mod table;

pub use archive::next_archive;
pub use report::{RayTally, Report, Tally};

use crate::reference::{Reference, ReferenceError};
use crate::tolerance::{CONTACT_BAR, CONTACT_PARAMETER};
use archive::{largest, numbers, rows};
use dataset::NpzReader;
use physics::collision::distance::{DistanceScratch, geom_distance};
use physics::collision::{CollisionScratch, collide};
use physics::data::Contact;
use physics::model::Options;
use physics::{Data, Model};
use std::io::Read;

/// A contact is deep when it goes further than this share of the smaller bounding radius.
const DEEP: f64 = 0.1;

/// Reads a stream to its end.
///
/// # Errors
/// The stream is damaged, or an array is missing or does not fit.
pub fn compare_stream(source: &mut impl Read) -> Result<Report, ReferenceError> {
    let mut report = Report::default();
    let mut scene: Option<Scene> = None;
    while let Some(archive) = next_archive(source)? {
        if archive.contains("size.ngeom") {
            scene = Some(Scene::new(Reference::new(archive).model()?));
            continue;
        }
        let scene = scene.as_mut().ok_or_else(|| ReferenceError::Shape("model".into()))?;
        if archive.contains("flexes") {
            flex_pairs::compare(&mut scene.m, &mut scene.d, &archive, &mut report)?;
        } else if archive.contains("ray") {
            rays::compare_geom(&mut scene.m, &mut scene.d, &archive, &mut report)?;
        } else if archive.contains("scene") {
            rays::compare_scene(&mut scene.m, &mut scene.d, &archive, &mut report)?;
        } else {
            scene.compare_pairs(&Placements::new(&archive)?, &mut report)?;
        }
    }
    Ok(report)
}

/// One chunk of placements: what was placed where, and MuJoCo's answers.
struct Placements {
    variant: String,
    pair: Vec<[usize; 2]>,
    slots: usize,
    options: Vec<(String, Vec<f64>)>,
    parameters: Vec<(String, Vec<f64>)>,
    hfield_data: Vec<f64>,
    size: Vec<[f64; 3]>,
    rbound: Vec<f64>,
    aabb: Vec<[f64; 6]>,
    dataid: Vec<f64>,
    margin: Vec<f64>,
    gap: Vec<f64>,
    xpos: Vec<[f64; 3]>,
    xmat: Vec<[f64; 9]>,
    ncon: Vec<f64>,
    contacts: Vec<Contact>,
    has_parameters: bool,
    unstable: Vec<f64>,
    distmax: Vec<f64>,
    flip: Vec<f64>,
    distance: Vec<f64>,
    fromto: Vec<[f64; 6]>,
    unstable_distance: Vec<f64>,
}

impl Placements {
    fn new(archive: &NpzReader) -> Result<Self, ReferenceError> {
        let text = numbers(archive, "variant")?.iter().map(|&x| x as u8 as char).collect();
        let named = |prefix: &str| -> Result<Vec<(String, Vec<f64>)>, ReferenceError> {
            let names = archive.names().filter(|n| n.starts_with(prefix));
            names.map(|n| Ok((n[prefix.len()..].to_owned(), numbers(archive, n)?))).collect()
        };
        let pair = rows::<2>(archive, "pair")?.iter().map(|p| p.map(|t| t as usize)).collect();
        let has_field = archive.contains("hfield_data");
        let p = Placements {
            variant: text,
            pair,
            slots: numbers(archive, "slots")?[0] as usize,
            options: named("opt.")?,
            parameters: named("parameter.")?,
            hfield_data: if has_field { numbers(archive, "hfield_data")? } else { Vec::new() },
            size: rows(archive, "size")?,
            rbound: numbers(archive, "rbound")?,
            aabb: rows(archive, "aabb")?,
            dataid: numbers(archive, "dataid")?,
            margin: numbers(archive, "margin")?,
            gap: numbers(archive, "gap")?,
            xpos: rows(archive, "xpos")?,
            xmat: rows(archive, "xmat")?,
            ncon: numbers(archive, "ncon")?,
            contacts: contacts(archive)?,
            has_parameters: archive.contains("contact.friction"),
            unstable: numbers(archive, "unstable")?,
            distmax: numbers(archive, "distmax")?,
            flip: numbers(archive, "flip")?,
            distance: numbers(archive, "distance")?,
            fromto: rows(archive, "fromto")?,
            unstable_distance: numbers(archive, "unstable_distance")?,
        };
        let (n, contacts) = (p.ncon.len(), p.ncon.iter().sum::<f64>() as usize);
        let twice = [p.size.len(), p.rbound.len(), p.aabb.len(), p.dataid.len(), p.margin.len(), p.gap.len()];
        let fits = twice.iter().chain([&p.xpos.len(), &p.xmat.len()]).all(|&l| l == 2 * n)
            && [&p.unstable, &p.distmax, &p.flip, &p.distance, &p.unstable_distance]
                .iter()
                .all(|a| a.len() == n)
            && p.fromto.len() == n
            && p.contacts.len() == contacts
            && p.slots > 0
            && n.is_multiple_of(p.slots)
            && p.pair.len() == n / p.slots;
        if fits { Ok(p) } else { Err(ReferenceError::Shape("placements".into())) }
    }
}

/// The recorded contacts, in order.
fn contacts(archive: &NpzReader) -> Result<Vec<Contact>, ReferenceError> {
    let mut con = physics::data::Contacts::default();
    for name in archive.names().filter(|n| n.starts_with("contact.")) {
        if con.assign(name, &numbers(archive, name)?) != Some(true) {
            return Err(ReferenceError::Shape(name.to_owned()));
        }
    }
    Ok(con.contact)
}

/// A model of independent pairs, and where they are.
struct Scene {
    m: Model,
    d: Data,
    options: Options,
    collision: CollisionScratch,
    distance: DistanceScratch,
}

impl Scene {
    fn new(m: Model) -> Self {
        let (d, options) = (Data::new(&m), m.opt.clone());
        Scene { m, d, options, collision: CollisionScratch::default(), distance: DistanceScratch::default() }
    }

    fn compare_pairs(&mut self, p: &Placements, report: &mut Report) -> Result<(), ReferenceError> {
        if 2 * p.slots > self.m.ngeom {
            return Err(ReferenceError::Shape("slots".into()));
        }
        *self.m.options_mut() = self.options.clone();
        for (name, values) in &p.options {
            if self.m.options_mut().assign(name, values) != Some(true) {
                return Err(ReferenceError::Shape(format!("opt.{name}")));
            }
        }
        let variant = report.variant(p.variant.clone());
        let mut theirs = p.contacts.as_slice();
        for group in 0..p.ncon.len() / p.slots {
            let key = (variant, p.pair[group]);
            let mut tally = report.pairs.remove(&key).unwrap_or_default();
            self.place(p, group)?;
            collide(&self.m, &self.d.kin, &self.d.flex, self.d.budget, &mut self.collision, &mut self.d.con)
                .map_err(|_| ReferenceError::Shape("contacts".into()))?;
            let first = self.m.ngeom - 2 * p.slots;
            for slot in 0..p.slots {
                let row = group * p.slots + slot;
                let (expected, rest) = theirs.split_at(p.ncon[row] as usize);
                theirs = rest;
                let base = (first + 2 * slot) as i32;
                let of_slot = |c: &&Contact| (base..base + 2).contains(&c.geom[0]);
                let ours: Vec<Contact> = self.d.con.contact.iter().filter(of_slot).copied().collect();
                count_contacts(p, row, &ours, expected, &mut tally, report);
                self.count_distance(p, row, base as usize, &mut tally, report);
            }
            report.pairs.insert(key, tally);
        }
        Ok(())
    }

    /// Injects the geometry of one group of pairs.
    fn place(&mut self, p: &Placements, group: usize) -> Result<(), ReferenceError> {
        let (m, kin) = (self.m.unchecked_mut(), &mut self.d.kin);
        let first = m.ngeom - 2 * p.slots;
        for k in 0..2 * p.slots {
            let (g, row) = (first + k, 2 * group * p.slots + k);
            m.geom_type[g] = p.pair[group][k % 2] as i32;
            m.geom_size[g] = p.size[row];
            m.geom_rbound[g] = p.rbound[row];
            m.geom_aabb[g] = p.aabb[row];
            m.geom_dataid[g] = p.dataid[row] as i32;
            m.geom_margin[g] = p.margin[row];
            m.geom_gap[g] = p.gap[row];
            kin.geom_xpos[g] = p.xpos[row];
            kin.geom_xmat[g] = p.xmat[row];
        }
        let part = |values: &[f64], count: usize| {
            values.get(group * count..(group + 1) * count).map(<[f64]>::to_vec)
        };
        let fields = (!p.hfield_data.is_empty()).then_some(("hfield_data", &p.hfield_data, m.nhfielddata));
        let pairs = p.parameters.iter().map(|(name, v)| (name.as_str(), v, v.len() / p.ncon.len() * p.slots));
        for (name, values, count) in fields.into_iter().chain(pairs) {
            if part(values, count).and_then(|v| m.assign(name, &v)) != Some(true) {
                return Err(ReferenceError::Shape(name.to_owned()));
            }
        }
        Ok(())
    }

    fn count_distance(
        &mut self,
        p: &Placements,
        row: usize,
        base: usize,
        tally: &mut Tally,
        report: &mut Report,
    ) {
        let (g1, g2) = if p.flip[row] == 0.0 { (base, base + 1) } else { (base + 1, base) };
        let (dist, ends) = geom_distance(&self.m, &self.d.kin, g1, g2, p.distmax[row], &mut self.distance);
        let error = [(dist - p.distance[row]).abs(), largest(ends.as_flattened(), &p.fromto[row])];
        let unstable = p.unstable_distance[row] != 0.0;
        tally.distance_unstable += usize::from(unstable);
        if error.iter().all(|&e| e <= CONTACT_BAR) {
            tally.distance_worst = std::array::from_fn(|k| tally.distance_worst[k].max(error[k]));
        } else if unstable {
            tally.distance_excepted += 1;
        } else {
            tally.distance_different += 1;
            report.note(|| {
                let (place, theirs, limit) = (describe(p, row), p.distance[row], p.distmax[row]);
                format!(
                    "{place}: distance {dist:e} (MuJoCo {theirs:e}, limit {limit}), points differ by {:e}",
                    error[1]
                )
            });
        }
    }
}

fn count_contacts(
    p: &Placements,
    row: usize,
    ours: &[Contact],
    theirs: &[Contact],
    tally: &mut Tally,
    report: &mut Report,
) {
    let unstable = p.unstable[row] != 0.0;
    let bound = &p.rbound[2 * row..2 * row + 2];
    let length = if p.pair[row / p.slots][0] < 2 { bound[1] } else { bound[0].min(bound[1]) };
    tally.placements += 1;
    tally.touching += usize::from(!theirs.is_empty());
    tally.deep += usize::from(theirs.iter().any(|c| c.dist < -DEEP * length));
    tally.unstable += usize::from(unstable);
    let mut error = [0.0_f64; 3];
    let mut alike = ours.len() == theirs.len();
    for (a, b) in ours.iter().zip(theirs) {
        alike &= a.geom == b.geom && (!p.has_parameters || same_parameters(a, b));
        let apart = [(a.dist - b.dist).abs(), largest(&a.pos, &b.pos), largest(&a.frame, &b.frame)];
        alike &= apart.iter().all(|&e| e <= CONTACT_BAR);
        error = std::array::from_fn(|k| error[k].max(apart[k]));
    }
    if alike {
        tally.worst = std::array::from_fn(|k| tally.worst[k].max(error[k]));
    } else if unstable {
        tally.excepted += 1;
    } else {
        tally.different += 1;
        report.note(|| {
            let (place, found, expected) = (describe(p, row), ours.len(), theirs.len());
            format!("{place}: {found} contacts (MuJoCo {expected}), dist, pos, frame differ by {error:?}")
        });
    }
}

fn describe(p: &Placements, row: usize) -> String {
    format!("{}, types {:?}, placement {row} of its chunk", p.variant, p.pair[row / p.slots])
}

fn same_parameters(a: &Contact, b: &Contact) -> bool {
    let near = |a: &[f64], b: &[f64]| largest(a, b) <= CONTACT_PARAMETER;
    near(&[a.includemargin], &[b.includemargin])
        && near(&a.friction, &b.friction)
        && near(&a.solref, &b.solref)
        && near(&a.solreffriction, &b.solreffriction)
        && near(&a.solimp, &b.solimp)
        && a.dim == b.dim
        && a.exclude == b.exclude
}
