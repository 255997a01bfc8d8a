//! Contacts from recorded poses, against recorded contacts: the same ones, in the same order, with the same numbers.

use dataset::{NpzReader, NpzWriter, Values};
use physics::Data;
use physics::collision::{CollisionScratch, check, collide};
use robohive_validation::collide::{Tally, compare_stream, next_archive};
use robohive_validation::reference::recorded;
use robohive_validation::tolerance::{CONTACT, CONTACT_BAR};
use std::io::Cursor;

const POSES: [&str; 4] = ["geom_xpos", "geom_xmat", "xipos", "ximat"];
const FLEX_POSES: [&str; 3] = ["flexvert_xpos", "flexelem_aabb", "bvh_aabb_dyn"];

/// Contact fields, all equal to the recording: the poses are injected.
const FIELDS: [&str; 12] = [
    "contact.geom",
    "contact.dim",
    "contact.exclude",
    "contact.dist",
    "contact.pos",
    "contact.frame",
    "contact.includemargin",
    "contact.friction",
    "contact.solref",
    "contact.solreffriction",
    "contact.solimp",
    "contact.adhesion",
];

#[test]
fn contacts_are_those_recorded() {
    let mut total = 0;
    for (path, reference) in recorded().unwrap() {
        let m = reference.model().unwrap();
        check(&m).unwrap();
        let mut d = Data::new(&m);
        let mut scratch = CollisionScratch::default();
        for row in 0..reference.states().unwrap() {
            reference.inject(&mut d, &POSES, row).unwrap();
            if m.nflex > 0 {
                reference.inject(&mut d, &FLEX_POSES, row).unwrap();
            }
            collide(&m, &d.kin, &d.flex, d.budget, &mut scratch, &mut d.con).unwrap();
            total += d.con.contact.len();
            for name in FIELDS {
                let theirs = reference.forward(name, row).unwrap();
                let mut ours = Vec::new();
                d.con.visit(&mut |n, _, s| {
                    if n == name {
                        ours = s.to_f64();
                    }
                });
                assert_eq!(ours, theirs, "{} state {row}: {name}", path.display());
            }
        }
    }
    assert!(total > 100);
}

/// Random placements of every pair of geom types, with new height-field data for every few placements, on mocap and
/// free bodies that contact types tell apart; and rays.
const SMALL: &[u8] = include_bytes!("../reference/collide/small.bin");

#[test]
fn random_pairs_and_rays_are_those_recorded() {
    let report = compare_stream(&mut &*SMALL).unwrap();
    assert!(report.differences.is_empty(), "{}", report.differences.join("\n"));
    let mut contact = CONTACT.gauge();
    let pairs = report.pairs.values().flat_map(|t| t.worst.iter().chain(&t.distance_worst));
    pairs
        .chain(report.rays.values().flat_map(|t| &t.worst))
        .for_each(|&worst| contact.take(worst, "placements"));
    assert_eq!(report.variants, ["default", "nativeccd disabled"]);
    assert_eq!(report.pairs.len(), 2 * 33);
    let sum = |count: fn(&Tally) -> usize| report.pairs.values().map(count).sum::<usize>();
    assert!(2 * sum(|t| t.touching) > sum(|t| t.placements) && 5 * sum(|t| t.deep) > sum(|t| t.placements));
    assert!(5 * sum(|t| t.unstable) < sum(|t| t.placements));
    assert_eq!(report.rays.len(), 10);
    assert!(report.rays.values().all(|t| t.hits > 3));
}

#[test]
fn a_contact_off_by_more_than_the_bound_is_noticed() {
    let mut source = SMALL;
    let mut stream = Vec::new();
    for _ in 0..2 {
        let archive = next_archive(&mut source).unwrap().unwrap();
        let bytes = shifted(&archive, "contact.dist", 2.0 * CONTACT_BAR);
        stream.extend((bytes.len() as u64).to_le_bytes());
        stream.extend(bytes);
    }
    let report = compare_stream(&mut stream.as_slice()).unwrap();
    let sum = |count: fn(&Tally) -> usize| report.pairs.values().map(count).sum::<usize>();
    assert!(sum(|t| t.touching) > 100);
    assert_eq!(sum(|t| t.different + t.excepted), sum(|t| t.touching));
}

/// The archive with one array moved by `offset`.
fn shifted(archive: &NpzReader, name: &str, offset: f64) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut writer = NpzWriter::new(Cursor::new(&mut bytes));
    for member in archive.names() {
        let mut array = archive.require(member).unwrap();
        if let (true, Values::F64(values)) = (member == name, &mut array.values) {
            values.iter_mut().for_each(|x| *x += offset);
        }
        writer.add(member, &array).unwrap();
    }
    writer.finish().unwrap();
    bytes
}

/// Random placements of elements of flexes with every type of geom, with other flexes and with their own.
const FLEXES: &[u8] = include_bytes!("../reference/collide/flexes.bin");

#[test]
fn random_elements_of_flexes_are_those_recorded() {
    let report = compare_stream(&mut &*FLEXES).unwrap();
    assert!(report.differences.is_empty(), "{}", report.differences.join("\n"));
    assert_eq!(report.flexes.len(), 2 * (3 * 8 + 6 + 3));
    let mut contact = CONTACT.gauge();
    report.flexes.values().flat_map(|t| t.worst).for_each(|worst| contact.take(worst, "elements of flexes"));
    let sum = |count: fn(&Tally) -> usize| report.flexes.values().map(count).sum::<usize>();
    assert!(2 * sum(|t| t.touching) > sum(|t| t.placements), "{} touch", sum(|t| t.touching));
    assert!(20 * sum(|t| t.unstable) < sum(|t| t.placements));
}
