//! The muscle suite.

use super::quirk::Quirk;

/// What RoboHive does otherwise than it means to in these suites.
pub const QUIRKS: &[Quirk] = &[
    Quirk {
        name: "muscle excitations",
        ids: &["myo*"],
        original: "The sigmoid that maps actions to excitations looks for the code of another kind of actuator: actions \
                   go to muscles as they are, without clipping to -1..1, and MuJoCo clamps them to 0..1; so do those \
                   to the motors and servos of models that have muscles.",
        fixed: "Muscles get 1 / (1 + exp(-5 (a - 0.5))) of the clipped action; other actuators get the action scaled to \
                their control range, or the action itself where they have none.",
    },
    Quirk {
        name: "fatigue",
        ids: &["myoFati*"],
        original: "The load of a muscle is how far its moment arm about the second degree of freedom is below its largest \
                   value so far, summed over every step since the environment was made: legs never fatigue (the arm is \
                   zero), and the same seed gives another episode each time.",
        fixed: "The load is the force of the muscle, integrated over time at the rate of one per minute that the cited \
                model states; every episode begins rested.",
    },
    Quirk {
        name: "conditions of muscles without a stated force",
        ids: &["myoSarcFinger*", "myoFatiFinger*"],
        original: "The peak force of these muscles is -1, which stands for a force that follows from the model; half of it, \
                   or any other share, still does: neither condition changes anything.",
        fixed: "The share is taken of the force that follows from the model.",
    },
    Quirk {
        name: "weight in the hand",
        ids: &["myo*ElbowPose1D6MExoRandom-v0"],
        original: "The drawn mass and size leave inertia, and what follows from both, as compiled.",
        fixed: "Inertia is that of a ball of this mass and size, and all that follows is derived.",
    },
    Quirk {
        name: "object to hold",
        ids: &["myo*HandObjHoldRandom-v0"],
        original: "The drawn size leaves mass and inertia as compiled.",
        fixed: "The object keeps its density; mass and inertia follow from the size.",
    },
    Quirk {
        name: "shapes to turn",
        ids: &["myo*HandReorient*"],
        original: "The drawn shape gets a mass of 1.2 kg and keeps the compiled inertia; the axes in `obj_rot` and \
                   `obj_des_rot` are divided by the compiled length, so that they are no unit vectors.",
        fixed: "Inertia is that of the shape with this mass; axes are unit vectors.",
    },
    Quirk {
        name: "Baoding targets after a reset",
        ids: &["myo*HandBaoding*"],
        original: "Until the first step, targets stay where the last step of the episode before left them.",
        fixed: "Targets are at their first places from the reset on.",
    },
    Quirk {
        name: "standing legs",
        ids: &["myo*LegStandRandom-v0"],
        original: "The first coordinate of the pelvis counts as a joint with the range 0..0: it becomes zero.",
        fixed: "Hinges and slides alone are bent.",
    },
    Quirk {
        name: "phase of walking",
        ids: &["myo*Leg*Walk-v0"],
        original: "A step is counted after its observation and reward: the first step has the phase of the reset. Angles \
                   wanted of the hips are rounded to single precision.",
        fixed: "The phase is that of the steps taken; nothing is rounded.",
    },
    Quirk {
        name: "drawn start of walking",
        ids: &["myo*Leg*Walk-v0"],
        original: "With `reset_type = \"random\"`, which no id has, the rotation of the pelvis that is to be kept is a view of \
                   the array that noise is added to: it gets the noise.",
        fixed: "The rotation is kept.",
    },
];
