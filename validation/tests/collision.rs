//! Contacts from recorded poses, against recorded contacts: the same ones, in the same order, with the same numbers.

use physics::Data;
use physics::collision::{CollisionScratch, check, collide};
use robohive_validation::reference::recorded;

const POSES: [&str; 4] = ["geom_xpos", "geom_xmat", "xipos", "ximat"];

/// Metres and unit vectors: tens of operations in another order.
const POINT: f64 = 1e-9;

/// Contact fields and how far they may be from the recording; parameters are sums of two products.
const FIELDS: [(&str, f64); 12] = [
    ("contact.geom", 0.0),
    ("contact.dim", 0.0),
    ("contact.exclude", 0.0),
    ("contact.dist", POINT),
    ("contact.pos", POINT),
    ("contact.frame", POINT),
    ("contact.includemargin", 1e-15),
    ("contact.friction", 1e-15),
    ("contact.solref", 1e-12),
    ("contact.solreffriction", 1e-12),
    ("contact.solimp", 1e-15),
    ("contact.adhesion", 1e-15),
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
            collide(&m, &d.kin, &mut scratch, &mut d.con);
            total += d.con.contact.len();
            for (name, tolerance) in FIELDS {
                let theirs = reference.forward(name, row).unwrap();
                let mut ours = Vec::new();
                d.con.visit(&mut |n, _, s| {
                    if n == name {
                        ours = s.to_f64();
                    }
                });
                assert_eq!(ours.len(), theirs.len(), "{} state {row}: {name}", path.display());
                let worst = ours.iter().zip(&theirs).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(worst <= tolerance, "{} state {row}: {name} differs by {worst:e}", path.display());
            }
        }
    }
    assert!(total > 100);
}
