//! Length ranges of muscles, measured again, against those MuJoCo compiled.

use physics::constants::length_range::{LengthRangeOptions, set_length_ranges};
use robohive_validation::reference::Reference;
use std::path::Path;

#[test]
fn muscle_ranges_agree() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference/own/elbow.npz");
    let mut m = Reference::open(&path).unwrap().model().unwrap();
    let theirs = m.actuator_lengthrange.clone();
    m.unchecked_mut().actuator_lengthrange.fill([0.0; 2]);
    set_length_ranges(&mut m, &LengthRangeOptions::default()).unwrap();
    assert_eq!(m.nout, 6);
    for (ours, theirs) in m.actuator_lengthrange.iter().zip(&theirs) {
        assert!(theirs[1] > theirs[0] + 0.01);
        for k in 0..2 {
            assert_eq!(ours[k], theirs[k]);
        }
    }
}
