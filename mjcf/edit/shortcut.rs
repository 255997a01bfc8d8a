//! Actuators given by a shortcut of MJCF, such as `position` with its gain.

use super::add::element;
use super::reading;
use crate::diagnostic::{Diagnostics, Sources};
use crate::spec::{Actuator, Spec};

/// Gives `actuator` the gain, bias and dynamics that the shortcut `tag` means with these attributes, as
/// `("position", &[("kp", "20"), ("dampratio", "1")])`. What the shortcut does not decide stays.
///
/// # Errors
/// The attributes contradict each other or what the actuator has; a value is none of the attribute's.
pub fn set_shortcut(
    actuator: &mut Actuator,
    tag: &str,
    attributes: &[(&str, &str)],
) -> Result<(), Diagnostics> {
    let one = element(tag, attributes);
    let mut changed = actuator.clone();
    reading(Spec::default(), Sources::default(), |reader| {
        reader.actuator_parameters(&one, &mut changed, true);
    })?;
    *actuator = changed;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use physics::model::BiasType;

    #[test]
    fn a_position_servo_has_its_gains() {
        let mut actuator = Actuator::default();
        set_shortcut(&mut actuator, "position", &[("kp", "20"), ("kv", "3")]).unwrap();
        assert_eq!((actuator.gainprm[0], actuator.biastype), (20.0, BiasType::Affine));
        assert_eq!(actuator.biasprm[..3], [0.0, -20.0, -3.0]);
        let both = set_shortcut(&mut actuator, "position", &[("kv", "3"), ("dampratio", "1")]);
        assert!(both.is_err());
        assert_eq!(actuator.gainprm[0], 20.0);
    }
}
