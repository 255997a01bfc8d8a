//! A step allocates no memory once its buffers have grown: heap traffic would make its duration unpredictable.

use robohive::physics::{Data, step};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;

#[global_allocator]
static HEAP: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// One test, since others in this process would be counted too.
#[test]
fn steps_do_not_allocate() {
    for name in ["franka/franka_table", "quadruped/quadruped"] {
        let path = format!("{}/assets/{name}.xml", env!("CARGO_MANIFEST_DIR"));
        let model = robohive::mjcf::load(&path).unwrap().model;
        let mut data = Data::new(&model);
        for _ in 0..500 {
            step(&model, &mut data).unwrap();
        }
        let region = Region::new(HEAP);
        for _ in 0..2500 {
            step(&model, &mut data).unwrap();
        }
        let stats = region.change();
        assert!(data.con.contact.capacity() > 0, "{name} never touched anything");
        assert_eq!((stats.allocations, stats.reallocations), (0, 0), "{name}");
    }
}
