//! Bonuses for how near a goal is.

use robot::Compat;

/// How many of the conditions hold. The original adds truth values of arrays, which is one wherever any of them holds.
pub fn bonus(compat: Compat, conditions: &[bool]) -> f64 {
    let held = conditions.iter().filter(|&&held| held).count() as f64;
    match compat {
        Compat::RoboHive07 => held.min(1.0),
        Compat::Fixed => held,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn conditions_add_up_unless_the_original_is_asked_for() {
        for (conditions, sum, any) in
            [([false; 3], 0.0, 0.0), ([true, false, false], 1.0, 1.0), ([true, true, false], 2.0, 1.0)]
        {
            assert_eq!(bonus(Compat::Fixed, &conditions), sum);
            assert_eq!(bonus(Compat::RoboHive07, &conditions), any);
        }
    }
}
