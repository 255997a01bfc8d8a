//! A forward pass right after the first half of a step keeps what that half found, and is a whole one to the last bit.

mod models;
mod state;

use models::assets;
use robohive::physics::{Data, forward, forward_after_step1, step1, step2};
use state::bits;

const STEPS: usize = 150;

#[test]
fn a_forward_pass_after_the_first_half_is_a_whole_one() {
    for (name, m) in assets() {
        let mut d = Data::new(&m);
        for i in 0..STEPS {
            step1(&m, &mut d).unwrap();
            for (k, (ctrl, [low, high])) in d.state.ctrl.iter_mut().zip(&m.actuator_ctrlrange).enumerate() {
                *ctrl = low + (high - low) * (0.5 + 0.4 * (0.07 * i as f64 + k as f64).sin());
            }
            let mut whole = d.clone();
            forward(&m, &mut whole).unwrap();
            forward_after_step1(&m, &mut d);
            assert_eq!(bits(&m, &d), bits(&m, &whole), "{name}, step {i}");
            step2(&m, &mut d).unwrap();
        }
    }
}
