//! Every controller by its name.

use crate::controller::Controller;
use crate::error::ControlError;
use crate::tasks;
use crate::tasks::arms::arm::Arm;
use crate::tasks::arms::moves::Scripted;
use crate::tasks::arms::pick_place::PickPlace;
use crate::tasks::classical::balance::{self, Balance};
use crate::tasks::classical::ball_on_beam::BallOnBeam;
use crate::tasks::classical::car_trailer::CarTrailer;
use crate::tasks::classical::hopper_boom::HopperBoom;
use crate::tasks::classical::knife_edge::KnifeEdge;
use crate::tasks::classical::planar_arm::PlanarArm;
use crate::tasks::classical::swing_up::{self, SwingUp};
use crate::tasks::classical::tendon_finger::TendonFinger;
use crate::tasks::classical::unicycle::Unicycle;
use crate::tasks::deformable::cloth_fold::ClothFold;
use crate::tasks::deformable::cloth_hang::ClothHang;
use crate::tasks::deformable::cloth_spread::ClothSpread;
use crate::tasks::deformable::grain_flatten::GrainFlatten;
use crate::tasks::deformable::grain_pour::GrainPour;
use crate::tasks::deformable::grain_scoop::GrainScoop;
use crate::tasks::deformable::held::Attempts;
use crate::tasks::deformable::rope_straighten::RopeStraighten;
use crate::tasks::deformable::rope_thread::RopeThread;
use crate::tasks::deformable::rope_wrap::RopeWrap;
use crate::tasks::deformable::sponge_press::SpongePress;
use crate::tasks::deformable::sponge_wipe::SpongeWipe;
use crate::tasks::planner::{self, Planner};
use crate::tasks::tabletop::drawer::Drawer;
use crate::tasks::tabletop::insert::Insert;
use crate::tasks::tabletop::stack::Stack;
use crate::tasks::tabletop::zip::Zip;
use env::{Env, Spec};

/// A controller that is built in.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Entry {
    /// Its name.
    pub name: &'static str,
    /// What it does, in a line.
    pub summary: &'static str,
    /// What it serves: names of tasks, with all their ids and variants, and single ids.
    pub serves: &'static [&'static str],
    /// Number of feet of the bodies that it serves, if it matters.
    pub feet: Option<usize>,
    /// Makes it.
    build: fn(&Env) -> Result<Box<dyn Controller>, ControlError>,
}

impl Entry {
    /// Whether it serves an environment.
    pub fn serves(&self, spec: &Spec) -> bool {
        let named = self.serves.iter().any(|served| *served == spec.task || *served == spec.id);
        named && (self.feet.is_none() || self.feet == tasks::locomotion::feet(spec))
    }
}

/// Tasks of the suite `locomotion`, of which each body has those that its feet, or their lack, allow.
const LOCOMOTION: &[&str] = &["chase", "push_box", "stand", "turn", "velocity", "walk_to", "weave"];

/// Every controller. Of several that serve an id, the first is the best.
const ALL: &[Entry] = &[
    Entry {
        name: "reach",
        summary: "inverse kinematics once, then a minimum-jerk motion of the joints",
        serves: &["reach"],
        feet: None,
        build: |env| Ok(Box::new(tasks::arms::reach::Reach::new(env)?)),
    },
    Entry {
        name: "muscle_pose",
        summary: "joints as springs with dampers, whose torques static optimisation shares among the muscles",
        serves: &["muscle_pose"],
        feet: None,
        build: |env| Ok(Box::new(tasks::muscles::pose::MusclePose::new(env)?)),
    },
    Entry {
        name: "muscle_reach",
        summary: "inverse kinematics of all tips once, then as muscle_pose",
        serves: &["muscle_reach"],
        feet: None,
        build: |env| Ok(Box::new(tasks::muscles::reach::MuscleReach::new(env)?)),
    },
    Entry {
        name: "stack",
        summary: "grasp and place: inverse kinematics and minimum-jerk moves, one cube on the other",
        serves: &["stack"],
        feet: None,
        build: |env| Ok(Box::new(Scripted::new(Arm::new(env, "stack")?, Stack::new(env)?))),
    },
    Entry {
        name: "pick_place",
        summary: "grasp and place: an object across a narrow side, over the walls of the bins",
        serves: &["hive/FrankaPickPlaceFixed-v0"],
        feet: None,
        build: |env| {
            let arm = Scripted::new(Arm::new(env, "pick_place")?, PickPlace::new(env)?);
            Ok(Box::new(arm.with_pace(tasks::arms::pick_place::HASTY)))
        },
    },
    Entry {
        name: "drawer",
        summary: "grasp and pull, then grasp and place: a drawer by its handle, a brick into it",
        serves: &["drawer"],
        feet: None,
        build: |env| Ok(Box::new(Scripted::new(Arm::new(env, "drawer")?, Drawer::new(env)?))),
    },
    Entry {
        name: "insert",
        summary: "grasp and place: a peg, or a plug, along the faces of its hole",
        serves: &["insert"],
        feet: None,
        build: |env| Ok(Box::new(Scripted::new(Arm::new(env, "insert")?, Insert::new(env)?))),
    },
    Entry {
        name: "zip",
        summary: "grasp and pull: the slider along the teeth",
        serves: &["zip"],
        feet: None,
        build: |env| Ok(Box::new(Scripted::new(Arm::new(env, "zip")?, Zip::new(env)?))),
    },
    Entry {
        name: "swim",
        summary: "a wave along the body of a snake, bent to the side to which it turns",
        serves: LOCOMOTION,
        feet: Some(0),
        build: |env| Ok(Box::new(tasks::locomotion::swim::Swim::new(env)?)),
    },
    Entry {
        name: "claw_pose",
        summary: "servos that follow the goal, with what they stay behind a motion and under weight",
        serves: &["dclaw_pose"],
        feet: None,
        build: |env| Ok(Box::new(tasks::claws::pose::ClawPose::new(env)?)),
    },
    Entry {
        name: "servo_pose",
        summary: "servos told their places at once",
        serves: &["kitty_stand", "ee_pose", "robotiq_pose"],
        feet: None,
        build: |env| Ok(Box::new(tasks::pose::ServoPose::new(env)?)),
    },
    Entry {
        name: "claw_turn",
        summary: "three fingers in unison push the blades of a valve, go back over them and push again",
        serves: &["dclaw_turn", "dclaw_screw"],
        feet: None,
        build: |env| Ok(Box::new(tasks::claws::turn::ClawTurn::new(env)?)),
    },
    Entry {
        name: "reorient",
        summary: "model-predictive control by sampling, which turns a thing in the hand and keeps it there",
        serves: &["reorient"],
        feet: None,
        build: |env| Ok(Box::new(tasks::in_hand::reorient::Reorient::new(env)?)),
    },
    Entry {
        name: "pen",
        summary: "as reorient, for a pen that is to point as another one does",
        serves: &["adroit_pen"],
        feet: None,
        build: |env| Ok(Box::new(tasks::in_hand::pen::Pen::new(env)?)),
    },
    Entry {
        name: "baoding",
        summary: "as reorient, for two balls that are to go round each other",
        serves: &["hand_baoding"],
        feet: None,
        build: |env| Ok(Box::new(tasks::in_hand::baoding::Baoding::new(env)?)),
    },
    Entry {
        name: "soft_ball",
        summary: "a hand that closes until a soft ball is as narrow as asked for",
        serves: &["soft_ball"],
        feet: None,
        build: |env| Ok(Box::new(tasks::in_hand::soft_ball::SoftBall::new(env)?)),
    },
    Entry {
        name: "trot",
        summary: "a trot by Raibert's steps, legs by inverse kinematics",
        serves: LOCOMOTION,
        feet: Some(4),
        build: |env| Ok(Box::new(tasks::locomotion::trot::Trot::new(env)?)),
    },
    Entry {
        name: "pair_trot",
        summary: "each of two agents trots by what it observes itself",
        serves: &["pair_pass_ball", "pair_push_box", "pair_swap", "tag"],
        feet: Some(4),
        build: |env| Ok(Box::new(tasks::multi_agent::pair_trot::PairTrot::new(env)?)),
    },
    Entry {
        name: "pair_arms",
        summary: "two arms follow a plan of minimum-jerk motions, stage by stage",
        serves: &["carry_tray", "hand_over"],
        feet: None,
        build: |env| Ok(Box::new(tasks::multi_agent::pair_arms::PairArms::new(env)?)),
    },
    Entry {
        name: "pair_hands",
        summary: "one hand tips what it holds into the other",
        serves: &["hand_pass"],
        feet: None,
        build: |env| Ok(Box::new(tasks::multi_agent::pair_hands::PairHands::new(env)?)),
    },
    Entry {
        name: "acrobot",
        summary: "a swing found by iLQR over the model, then a linear-quadratic regulator",
        serves: &["acrobot"],
        feet: None,
        build: |env| Ok(Box::new(SwingUp::new(env, swing_up::ACROBOT)?)),
    },
    Entry {
        name: "furuta",
        summary: "a swing found by iLQR over the model, then a linear-quadratic regulator",
        serves: &["furuta"],
        feet: None,
        build: |env| Ok(Box::new(SwingUp::new(env, swing_up::FURUTA)?)),
    },
    Entry {
        name: "double_pole",
        summary: "a linear-quadratic regulator of the model's slopes",
        serves: &["double_pole"],
        feet: None,
        build: |env| Ok(Box::new(Balance::new(env, balance::DOUBLE_POLE)?)),
    },
    Entry {
        name: "ball_on_beam",
        summary: "a linear-quadratic regulator of a ball that rolls down a slope",
        serves: &["ball_on_beam"],
        feet: None,
        build: |env| Ok(Box::new(BallOnBeam::new(env)?)),
    },
    Entry {
        name: "car_trailer",
        summary: "iLQR over the kinematics of wheels that do not slip, from where the car is",
        serves: &["car_trailer"],
        feet: None,
        build: |env| Ok(Box::new(CarTrailer::new(env)?)),
    },
    Entry {
        name: "unicycle",
        summary: "steering by polar coordinates",
        serves: &["unicycle"],
        feet: None,
        build: |env| Ok(Box::new(Unicycle::new(env)?)),
    },
    Entry {
        name: "knife_edge",
        summary: "a turn towards the point, and speed along the edge",
        serves: &["knife_edge"],
        feet: None,
        build: |env| Ok(Box::new(KnifeEdge::new(env)?)),
    },
    Entry {
        name: "planar_arm",
        summary: "a spring at the tip in operational space, straight joints in the freedom that is left",
        serves: &["planar_arm"],
        feet: None,
        build: |env| Ok(Box::new(PlanarArm::new(env)?)),
    },
    Entry {
        name: "tendon_finger",
        summary: "springs at the joints, their torques shared among muscles by static optimisation",
        serves: &["tendon_finger"],
        feet: None,
        build: |env| Ok(Box::new(TendonFinger::new(env)?)),
    },
    Entry {
        name: "hopper_boom",
        summary: "Raibert's thrust and foot placement",
        serves: &["hopper_boom"],
        feet: None,
        build: |env| Ok(Box::new(HopperBoom::new(env)?)),
    },
    Entry {
        name: "rope_straighten",
        summary: "a grasp of the loose end, and a pull until the rope is taut",
        serves: &["rope_straighten"],
        feet: None,
        build: |env| {
            Ok(Box::new(Scripted::new(Arm::new(env, "rope_straighten")?, RopeStraighten::new(env)?)))
        },
    },
    Entry {
        name: "rope_thread",
        summary: "grasp and place: the stiff tip of a rope before a ring, and straight through",
        serves: &["rope_thread"],
        feet: None,
        build: |env| Ok(Box::new(Scripted::new(Arm::new(env, "rope_thread")?, RopeThread::new(env)?))),
    },
    Entry {
        name: "rope_wrap",
        summary: "a grasp of the loose end, which is led round the peg and let go of",
        serves: &["rope_wrap"],
        feet: None,
        build: |env| Ok(Box::new(Scripted::new(Arm::new(env, "rope_wrap")?, RopeWrap::new(env)?))),
    },
    Entry {
        name: "cloth_fold",
        summary: "grasp and place: one side of a cloth in an arc onto the other",
        serves: &["cloth_fold"],
        feet: None,
        build: |env| Ok(Box::new(Scripted::new(Arm::new(env, "cloth_fold")?, ClothFold::new(env)?))),
    },
    Entry {
        name: "cloth_hang",
        summary: "grasp and place: one side of a cloth over a bar, with the cloth behind",
        serves: &["cloth_hang"],
        feet: None,
        build: |env| Ok(Box::new(Scripted::new(Arm::new(env, "cloth_hang")?, ClothHang::new(env)?))),
    },
    Entry {
        name: "cloth_spread",
        summary: "grasp and place: one side of a cloth to where the cloth is taut",
        serves: &["cloth_spread"],
        feet: None,
        build: |env| Ok(Box::new(Scripted::new(Arm::new(env, "cloth_spread")?, ClothSpread::new(env)?))),
    },
    Entry {
        name: "grain_pour",
        summary: "a cup that is brought beside the bowl and tilted",
        serves: &["grain_pour"],
        feet: None,
        build: |env| {
            Ok(Box::new(Scripted::new(Arm::new(env, "grain_pour")?, Attempts::new(GrainPour::new(env)?))))
        },
    },
    Entry {
        name: "grain_scoop",
        summary: "a scoop that goes in nose first, along the floor of the tray, nose up and out",
        serves: &["grain_scoop"],
        feet: None,
        build: |env| {
            Ok(Box::new(Scripted::new(Arm::new(env, "grain_scoop")?, Attempts::new(GrainScoop::new(env)?))))
        },
    },
    Entry {
        name: "grain_flatten",
        summary: "a blade that is led to and fro at three heights",
        serves: &["grain_flatten"],
        feet: None,
        build: |env| {
            Ok(Box::new(Scripted::new(
                Arm::new(env, "grain_flatten")?,
                Attempts::new(GrainFlatten::new(env)?),
            )))
        },
    },
    Entry {
        name: "sponge_press",
        summary: "closed fingers that go down until the depth is right",
        serves: &["sponge_press"],
        feet: None,
        build: |env| Ok(Box::new(Scripted::new(Arm::new(env, "sponge_press")?, SpongePress::default()))),
    },
    Entry {
        name: "sponge_wipe",
        summary: "a sponge that is pressed on the board and led over all marks, to and fro",
        serves: &["sponge_wipe"],
        feet: None,
        build: |env| Ok(Box::new(Scripted::new(Arm::new(env, "sponge_wipe")?, SpongeWipe::default()))),
    },
    Entry {
        name: "muscle_stand",
        summary: "accelerations of mass, root and feet; static optimisation shares their forces among muscles and the ground",
        serves: &["hive/MuscleLegsStand-v0"],
        feet: Some(2),
        build: |env| Ok(Box::new(tasks::muscles::stand::MuscleStand::new(env)?)),
    },
    Entry {
        name: "walk",
        summary: "a walk on two feet by the divergent component of motion, legs by inverse kinematics",
        serves: LOCOMOTION,
        feet: Some(2),
        build: |env| Ok(Box::new(tasks::locomotion::walk::Walk::new(env)?)),
    },
    Entry {
        name: "push",
        summary: "as planner, with plans that look less far ahead and are less wild",
        serves: &["push"],
        feet: None,
        build: |env| Ok(Box::new(Planner::new(env, planner::GENTLE))),
    },
    Entry {
        name: PLANNER,
        summary: "predictive sampling over copies of the environment, by its dense reward; plays any environment",
        serves: &["kitchen", "appliance"],
        feet: None,
        build: |env| Ok(Box::new(Planner::new(env, planner::WIDE))),
    },
];

/// The controller that plays whatever it is asked to, beside the tasks that it is the choice for.
const PLANNER: &str = "planner";

/// Every controller.
pub fn controllers() -> &'static [Entry] {
    ALL
}

/// The controllers that serve an environment, the best first; the one named `planner` plays others, too.
pub fn serving(spec: &Spec) -> impl Iterator<Item = &'static Entry> {
    ALL.iter().filter(move |entry| entry.serves(spec))
}

/// Makes the controller of a name for an environment.
///
/// # Errors
/// There is no such controller; it serves other tasks; the environment lacks what it needs.
pub fn make(name: &str, env: &Env) -> Result<Box<dyn Controller>, ControlError> {
    let spec = env.spec();
    let names = || serving(spec).map(|entry| entry.name).collect();
    let Some(entry) = ALL.iter().find(|entry| entry.name == name) else {
        return Err(ControlError::Unknown { name: name.into(), id: spec.id.clone(), serving: names() });
    };
    if !entry.serves(spec) && entry.name != PLANNER {
        let (id, serving) = (spec.id.clone(), names());
        let (name, serves, feet) = (entry.name, entry.serves, entry.feet);
        return Err(ControlError::NotServed { name, id, serves, feet, serving });
    }
    (entry.build)(env)
}

#[cfg(test)]
mod tests {
    use super::*;
    use env::{Options, OwnModels, Registry};
    use std::collections::BTreeSet;

    #[test]
    fn names_differ_and_each_serves_an_id() {
        let names: BTreeSet<_> = ALL.iter().map(|entry| entry.name).collect();
        assert_eq!(names.len(), ALL.len());
        let registry = Registry::builtin();
        for entry in ALL {
            for served in entry.serves {
                let known = registry.specs().iter().any(|spec| *served == spec.task || *served == spec.id);
                assert!(known, "{} serves {served}, which is neither a task nor an id", entry.name);
            }
        }
    }

    #[test]
    fn errors_name_what_serves_the_id() {
        let error = |id, name| {
            let env = Env::make(id, &OwnModels, &Options::default()).unwrap();
            make(name, &env).err().unwrap().to_string()
        };
        let unknown = error("hive/FrankaReach-v0", "rech");
        assert_eq!(unknown, "there is no controller rech; hive/FrankaReach-v0 is served by reach");
        let other = error("hive/QuadrupedWalk-v0", "reach");
        assert!(other.contains("serves reach, not hive/QuadrupedWalk-v0"), "{other}");
        assert!(other.contains("no controller is made for hive/QuadrupedWalk-v0"), "{other}");
        let feet = error("hive/DarwinTurn-v0", "trot");
        assert!(feet.contains("of bodies with 4 feet, not hive/DarwinTurn-v0"), "{feet}");
        assert!(feet.ends_with("hive/DarwinTurn-v0 is served by walk"), "{feet}");
    }
}
