//! Random draws are numpy's: every recorded kind, with the first of the recorded seeds.

use robohive_validation::draws::{RECORDED, compare};
use std::path::Path;

#[test]
fn draws_equal_numpys() {
    let rows = compare(Path::new(RECORDED), 3).unwrap();
    assert_eq!(rows.len(), 131);
    for row in &rows {
        assert_eq!((row.equal, row.seeds), (3, 3), "{}", row.name);
    }
}
