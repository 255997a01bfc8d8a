//! The description of an FR3 that its server gives: what clients need of it, in our own words.

use protocol::franka::FR3;
use std::fmt::Write;

/// Joints with their limits; masses, shapes and inertias are those of nobody.
pub(super) fn text() -> String {
    let mut text =
        String::from("<?xml version=\"1.0\"?>\n<robot name=\"fr3\">\n  <link name=\"fr3_link0\"/>\n");
    for k in 0..7 {
        let [low, high] = FR3.position[k];
        let (offset, deceleration) = FR3.approach(k);
        // A string takes every write.
        write!(
            text,
            "  <link name=\"fr3_link{child}\"/>\n  <joint name=\"fr3_joint{child}\" type=\"revolute\">\n    \
             <parent link=\"fr3_link{k}\"/>\n    <child link=\"fr3_link{child}\"/>\n    <axis xyz=\"0 0 1\"/>\n    \
             <limit lower=\"{low}\" upper=\"{high}\" velocity=\"{velocity}\" effort=\"{effort}\"/>\n    \
             <position_based_velocity_limits velocity_offset=\"{offset}\" deceleration_limit=\"{deceleration}\"/>\n  \
             </joint>\n",
            child = k + 1,
            velocity = FR3.velocity[k],
            effort = protocol::franka::TORQUE[k],
        )
        .unwrap_or_default();
    }
    text.push_str("</robot>\n");
    text
}
