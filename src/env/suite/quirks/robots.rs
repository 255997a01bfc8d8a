//! Arms, claws, laboratory robots, kitchen and quadrupeds.

use super::quirk::Quirk;

/// What RoboHive does otherwise than it means to in these suites.
pub const QUIRKS: &[Quirk] = &[
    Quirk {
        name: "bonus-of-truth-values",
        ids: &[
            "FrankaReach*",
            "FetchReach*",
            "FrankaPush*",
            "FrankaPickPlace*",
            "TrifingerReach*",
            "rpFranka*Pose*",
        ],
        original: "the bonus adds truth values of arrays, so it is 1 however many of its conditions hold",
        fixed: "it is the number of conditions that hold: a second threshold earns a second bonus",
    },
    Quirk {
        name: "one-sided-jitter",
        ids: &["FrankaPickPlaceRandom*"],
        original: "both bounds of the objects' shift are -1 cm, so that it is the same every time",
        fixed: "the shift is uniform within 1 cm on every axis",
    },
    Quirk {
        name: "poses-of-free-bodies",
        ids: &["FrankaPickPlaceRandom*"],
        original: "drawn places and orientations of objects are written to their bodies, whose free joints override \
                   them: objects always start at the pose of the model file",
        fixed: "the free joints start at the drawn poses",
    },
    Quirk {
        name: "bounds-of-drawn-shapes",
        ids: &["FrankaPickPlaceRandom*"],
        original: "drawn shapes keep the collision bounds of the shapes in the model file, so that contacts are missed",
        fixed: "bounds follow the shapes; mass and inertia are those that the model file states",
    },
    Quirk {
        name: "unused-target",
        ids: &["FrankaPickPlaceFixed*"],
        original: "`target_xyz_range` is ignored unless objects are randomised, and no number is drawn for it",
        fixed: "the target is drawn from it in every episode",
    },
    Quirk {
        name: "missing-proprioception",
        ids: &["FrankaPickPlace*"],
        original: "the keys of the proprioception are listed and not used: there is none",
        fixed: "the proprioception has these keys",
    },
    Quirk {
        name: "assembled-models-as-text",
        ids: &["rpFranka*"],
        original: "the hand is moved to the arm in a text of the compiled model, which keeps six digits of every number; \
                   reproduced for the frames of bodies and sites and the axes of joints",
        fixed: "it is moved before the model is compiled, at full precision",
    },
    Quirk {
        name: "controls-of-the-last-episode",
        ids: &["DKitty*"],
        original: "the first observation of an episode shows the last control of the episode before, or of the step \
                   at construction",
        fixed: "it shows zeros, as the cleared controls are",
    },
    Quirk {
        name: "height-in-centre-distance",
        ids: &["DKittyStand*"],
        original: "the distance from the centre takes the height of the torso in",
        fixed: "it is the horizontal distance",
    },
    Quirk {
        name: "score-never-positive",
        ids: &["DKittyStand*"],
        original: "the sparse reward is 1 - max(e/60°, 1), zero or less at any mean error e of the joints",
        fixed: "it is 1 - min(e/60°, 1), which rises from 0 to 1 as the error vanishes",
    },
];
