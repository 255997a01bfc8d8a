//! The MyoChallenge and MyoDM.

use super::quirk::Quirk;

/// What RoboHive does otherwise than it means to in these suites.
pub const QUIRKS: &[Quirk] = &[
    Quirk {
        name: "stale inertia of the die",
        ids: &["myoChallengeDieReorientP2-v0"],
        original: "a reset writes mass and sizes of the die; its inertia, and all that is derived from both, stays",
        fixed: "moments of inertia grow with the mass, and all that follows is derived again",
    },
    Quirk {
        name: "missing joint of the hand",
        ids: &["myoChallengeDieReorient*", "myoChallengeRelocate*"],
        original: "the rows hand_qpos_noMD5 and hand_qpos, which are observed, lack the last joint of the hand",
        fixed: "the same, since policies have learned it; hand_qpos and hand_qpos_corrected have all joints and can be \
                asked for in obs_keys",
    },
    Quirk {
        name: "stale inertia of the object",
        ids: &["myoChallengeRelocateP2-v0", "myoChallengeRelocateP2eval-v0"],
        original: "a reset gives the object's geoms random shapes and its body a mass; its inertia stays that of the model",
        fixed: "centre of mass and moments of inertia are those of the shapes, of equal density",
    },
    Quirk {
        name: "noise without chance",
        ids: &["myoChallengeRelocateP2-v0", "myoChallengeRelocateP2eval-v0"],
        original: "every joint starts away from the key frame by qpos_noise_range times its whole range",
        fixed: "by a part of that, uniform from -1 to 1, and within its range",
    },
    Quirk {
        name: "first observation of a repeated reset",
        ids: &["myoChallengeRelocate*"],
        original: "a reset that begins in contact is drawn again, and returns the observation of the first attempt",
        fixed: "the returned observation is that of the state (also under compat: only the returned vector differed)",
    },
    Quirk {
        name: "stale inertia of the balls",
        ids: &["myoChallengeBaodingP2-v1"],
        original: "a reset writes mass, friction and size of the balls; their inertia stays",
        fixed: "moments of inertia are those of balls of this mass and size",
    },
    Quirk {
        name: "targets of the episode before",
        ids: &["myoChallengeBaoding*"],
        original: "until the first step, the targets are where the episode before left them, at first where the step of the \
                   constructor put them",
        fixed: "a reset moves the targets to where the episode begins",
    },
    Quirk {
        name: "opponent of the episode before",
        ids: &["myoChallengeChaseTag*"],
        original: "the opponent is drawn after the first observation, which shows it where the model has it, with the velocity \
                   of the step before",
        fixed: "the first observation shows where the opponent is",
    },
    Quirk {
        name: "place of the relief",
        ids: &["myoChallengeChaseTagP2-v0", "myoChallengeChaseTagP2eval-v0"],
        original: "numpy's global generator draws it, which env.seed does not seed; under compat a seed restarts that \
                   generator, too, as numpy.random.seed does",
        fixed: "the environment's generator draws it",
    },
    Quirk {
        name: "orientation of a noisy start",
        ids: &["myoChallengeChaseTagP2-v0", "myoChallengeChaseTagP2eval-v0"],
        original: "the root should keep its orientation when noise is added to the key frame; it is kept as a view of the noisy \
                   numbers, so it does not",
        fixed: "the root keeps its orientation",
    },
    Quirk {
        name: "random targets that jump",
        ids: &["MyoHand*Random-v0"],
        original: "every observation draws another target, from the generator of the constructor, which env.seed does not \
                   reach",
        fixed: "every reset draws one target, from the environment's generator",
    },
    Quirk {
        name: "between frames of a motion",
        ids: &["MyoHand*"],
        original: "the share of the second frame is time minus a quotient, and what is left of one is raised to the power of the \
                   first frame's joints",
        fixed: "both frames are blended linearly, orientations normalised",
    },
    Quirk {
        name: "another object than the motion's",
        ids: &["MyoHandPiggybankPass-v0"],
        original: "the hand passes a wineglass along the motion of a piggy bank",
        fixed: "the same: ids and their settings are the original's; object_name and define choose another",
    },
];
