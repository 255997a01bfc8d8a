//! Acting and sensing allocate nothing after the first reading.

use physics::{Data, forward};
use random::Generator;
use robohive_robot::{Config, Options, Robot};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;

#[global_allocator]
static HEAP: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

const ARM: &str = "<mujoco><worldbody><body><joint name='j' axis='0 1 0'/><geom size='.1'/></body></worldbody>
    <actuator><position name='servo' joint='j'/></actuator><sensor><jointpos name='q' joint='j'/></sensor></mujoco>";

const CONFIG: &str = "
    [[device]]
    name = 'arm'
    sensor = [{ name = 'q', range = [-1, 1], noise = 0.1 }]
    actuator = [{ name = 'servo', pos_range = [-1, 1], vel_range = [-9, 9] }]";

#[test]
fn acting_and_sensing_allocate_nothing() {
    let model = robohive_mjcf::load_str(ARM).unwrap().model;
    let config = Config::from_toml(CONFIG, "arm.toml").unwrap();
    let late = Options::default().with_noise_scale(1.0).with_delay_steps(3).with_jitter_steps(2);
    for (config, options) in
        [(None, Options::default()), (Some(&config), Options::default()), (Some(&config), late)]
    {
        let mut robot = Robot::new(&model, config, options).unwrap();
        let (mut data, mut observed, mut rng) =
            (Data::new(&model), Data::new(&model), Generator::pcg64(1_u64));
        forward(&model, &mut data).unwrap();
        robot.reset(&model, &data, &mut rng).unwrap();
        let region = Region::new(HEAP);
        for k in 0..1000 {
            data.state.time = 0.002 * f64::from(k);
            robot.control(&model, &data, &[0.5], 0.1).unwrap();
            robot.track(&data);
            robot.sense(&model, &data, &mut rng);
            robot.write_readings(&mut observed);
            if k % 100 == 0 {
                robot.reset(&model, &data, &mut rng).unwrap();
            }
        }
        let change = region.change();
        assert_eq!((change.allocations, change.reallocations, change.deallocations), (0, 0, 0));
    }
}
