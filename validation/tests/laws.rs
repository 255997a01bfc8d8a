//! Laws of mechanics, on systems made for them and on the recorded states.

use robohive_validation::laws::{Bound, Piles, measure, render};
use robohive_validation::reference::recorded;

#[test]
fn laws_hold() {
    let references: Vec<_> = recorded().unwrap().into_iter().map(|(_, reference)| reference).collect();
    let laws = measure("models", &references, Piles::One).unwrap();
    assert!(laws.len() > 25 && laws.iter().any(|law| law.measured > 1e-16), "nothing was measured");
    for law in &laws {
        if let Bound::Within(tolerance) = law.bound {
            tolerance.gauge().take(law.measured, &law.law);
        }
    }
    let (_, verdict) = render(&laws);
    verdict.unwrap_or_else(|broken| panic!("{broken}"));
}
