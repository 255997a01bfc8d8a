//! The driver that the documentation shows drives its device.

#[path = "../examples/own_driver.rs"]
mod own_driver;

#[test]
fn the_turntable_arrives_and_is_made_safe_when_it_is_left_alone() {
    own_driver::main().unwrap();
}
