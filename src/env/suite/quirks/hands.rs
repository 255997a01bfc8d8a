//! The Adroit hand.

use super::quirk::Quirk;

/// What RoboHive does otherwise than it means to in these suites.
pub const QUIRKS: &[Quirk] = &[
    Quirk {
        name: "hand softened twice",
        ids: &["baoding-v1", "baoding4th-v1", "baoding8th-v1"],
        original: "gains and biases of all actuators are multiplied by 0.1 for the simulation and again for the observed \
                   simulation, which is the same one: 0.01 in all",
        fixed: "they are multiplied by 0.1",
    },
    Quirk {
        name: "targets of another episode",
        ids: &["baoding-v1", "baoding4th-v1", "baoding8th-v1"],
        original: "the first observation of an episode shows the targets where the step before the reset left them",
        fixed: "a reset places the targets where the first step will expect them",
    },
    Quirk {
        name: "targets run out",
        ids: &["baoding-v1", "baoding4th-v1", "baoding8th-v1"],
        original: "a step after the 1000th without a reset is an index error; the compatible mode goes on, too",
        fixed: "targets move on for as long as the episode lasts",
    },
    Quirk {
        name: "reward of a recorded path",
        ids: &["door*-v1"],
        original: "the distance to the handle is that of the environment's present state, not of the recorded one; the compatible \
                   mode takes the recorded one, too",
        fixed: "all terms follow from the recorded observation",
    },
    Quirk {
        name: "index of a reading",
        ids: &["hammer*-v1"],
        original: "the force on the nail is read at the sensor's number, not its address; the two are the same here",
        fixed: "it is read at the sensor's address",
    },
];
