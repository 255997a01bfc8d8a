//! The tasks, one a file, by the suites of RoboHive, ROBEL's claw, and Gymnasium's locomotion.
//!
//! A row of the registry names a task, and gives the settings that the task asks for:
//!
//! ```
//! use robohive_env::{Env, Options, OwnModels};
//!
//! let shorter = Options::default().with_changes("pose_thd = 10.0".parse()?);
//! let mut env = Env::make("hive/ElbowPose-v0", &OwnModels, &shorter)?;
//! env.reset(Some(1))?;
//! env.step(&vec![0.0; env.action_len()])?;
//! assert!(env.verdict().solved, "every pose is within 10 rad of the wanted one");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod arms;
mod baoding;
mod body;
mod bonus;
mod circling;
pub mod classical;
pub mod claws;
pub mod coupling;
pub mod dclaw;
pub mod deformable;
mod fatigue;
pub mod fm;
pub mod gymnasium;
pub mod hands;
mod hold;
pub mod in_hand;
pub mod locomotion;
pub mod multi_agent;
pub mod multitask;
pub mod muscle;
pub mod myobase;
pub mod myochallenge;
pub mod myodm;
mod named;
pub mod quadrupeds;
pub mod quirks;
pub mod tabletop;

pub use bonus::bonus;

use crate::task_type::TaskType;

/// Every task, suite by suite.
pub(crate) fn tasks() -> Vec<TaskType> {
    let mut tasks = vec![
        TaskType::new("reach", arms::reach::Reach::new),
        TaskType::new("push", arms::push::Push::new),
        TaskType::new("pick_place", arms::pick_place::PickPlace::new),
        TaskType::new("acrobot", classical::acrobot::Acrobot::new),
        TaskType::new("ball_on_beam", classical::ball_on_beam::BallOnBeam::new),
        TaskType::new("car_trailer", classical::car_trailer::CarTrailer::new),
        TaskType::new("double_pole", classical::double_pole::DoublePole::new),
        TaskType::new("furuta", classical::furuta::Furuta::new),
        TaskType::new("knife_edge", classical::knife_edge::KnifeEdge::new),
        TaskType::new("hopper_boom", classical::hopper_boom::HopperBoom::new),
        TaskType::new("planar_arm", classical::planar_arm::PlanarArm::new),
        TaskType::new("tendon_finger", classical::tendon_finger::TendonFinger::new),
        TaskType::new("unicycle", classical::unicycle::Unicycle::new),
        TaskType::new("claw_reorient", claws::reorient::Reorient::new),
        TaskType::new("dclaw_pose", dclaw::pose::Posing::new),
        TaskType::new("dclaw_turn", dclaw::turn::Turn::new),
        TaskType::new("dclaw_screw", dclaw::screw::Screw::new),
        TaskType::new("cloth_fold", deformable::cloth_fold::ClothFold::new),
        TaskType::new("cloth_hang", deformable::cloth_hang::ClothHang::new),
        TaskType::new("cloth_spread", deformable::cloth_spread::ClothSpread::new),
        TaskType::new("grain_flatten", deformable::grain_flatten::GrainFlatten::new),
        TaskType::new("grain_pour", deformable::grain_pour::GrainPour::new),
        TaskType::new("grain_scoop", deformable::grain_scoop::GrainScoop::new),
        TaskType::new("rope_straighten", deformable::rope_straighten::RopeStraighten::new),
        TaskType::new("rope_thread", deformable::rope_thread::RopeThread::new),
        TaskType::new("rope_wrap", deformable::rope_wrap::RopeWrap::new),
        TaskType::new("sponge_press", deformable::sponge_press::SpongePress::new),
        TaskType::new("sponge_wipe", deformable::sponge_wipe::SpongeWipe::new),
        TaskType::new("ee_pose", fm::pose::Reach::of_robot),
        TaskType::new("robotiq_pose", fm::pose::Reach::of_robotiq),
        TaskType::new("robotiq_data", fm::data::Recording::new),
        TaskType::new("gymnasium_ant", gymnasium::ant::Ant::new),
        TaskType::new("gymnasium_humanoid", gymnasium::humanoid::Humanoid::new),
        TaskType::new("gymnasium_walker2d", gymnasium::planar::Planar::walker),
        TaskType::new("gymnasium_half_cheetah", gymnasium::planar::Planar::cheetah),
        TaskType::new("gymnasium_hopper", gymnasium::planar::Planar::hopper),
        TaskType::new("adroit_door", hands::door::Door::new),
        TaskType::new("adroit_hammer", hands::hammer::Hammer::new),
        TaskType::new("adroit_pen", hands::pen::Pen::new),
        TaskType::new("adroit_relocate", hands::relocate::Relocate::new),
        TaskType::new("adroit_baoding", hands::baoding::Baoding::new),
        TaskType::new("reorient", in_hand::reorient::Reorient::new),
        TaskType::new("hand_baoding", in_hand::baoding::Baoding::new),
        TaskType::new("soft_ball", in_hand::soft_ball::SoftBall::new),
        TaskType::new("chase", locomotion::chase::Chase::new),
        TaskType::new("push_box", locomotion::push_box::PushBox::new),
        TaskType::new("stand", locomotion::stand::Stand::new),
        TaskType::new("turn", locomotion::turn::Turn::new),
        TaskType::new("velocity", locomotion::velocity::Velocity::new),
        TaskType::new("walk_to", locomotion::walk_to::WalkTo::new),
        TaskType::new("weave", locomotion::weave::Weave::new),
        TaskType::new("drawer", tabletop::drawer::Drawer::new),
        TaskType::new("insert", tabletop::insert::Insert::new),
        TaskType::new("stack", tabletop::stack::Stack::new),
        TaskType::new("carry_tray", multi_agent::carry_tray::CarryTray::new),
        TaskType::new("hand_over", multi_agent::hand_over::HandOver::new),
        TaskType::new("pair_push_box", multi_agent::push_box::PushBox::new),
        TaskType::new("hand_pass", multi_agent::hand_pass::HandPass::new),
        TaskType::new("pair_pass_ball", multi_agent::pass_ball::PassBall::new),
        TaskType::new("pair_swap", multi_agent::swap::Swap::new),
        TaskType::new("tag", multi_agent::tag::Tag::new),
        TaskType::new("zip", tabletop::zip::Zip::new),
        TaskType::new("kitchen", multitask::kitchen::Kitchen::new),
        TaskType::new("appliance", multitask::appliance::Appliance::new),
        TaskType::new("free_walk", quadrupeds::free_walk::FreeWalk::new),
        TaskType::new("kitty_walk", quadrupeds::walk::Walk::new),
        TaskType::new("kitty_orient", quadrupeds::orient::Orient::new),
        TaskType::new("kitty_stand", quadrupeds::stand::Stand::new),
    ];
    tasks.extend(of_muscles());
    tasks
}

/// Tasks of bodies that muscles move.
fn of_muscles() -> Vec<TaskType> {
    vec![
        TaskType::new("muscle_pose", myobase::pose::Pose::new),
        TaskType::new("muscle_reach", myobase::reach::Reach::new),
        TaskType::new("key_turn", myobase::key_turn::KeyTurn::new),
        TaskType::new("object_hold", myobase::object_hold::ObjectHold::new),
        TaskType::new("pen_twirl", myobase::pen_twirl::PenTwirl::new),
        TaskType::new("shape_reorient", myobase::shape_reorient::ShapeReorient::new),
        TaskType::new("muscle_baoding", myobase::baoding::Baoding::new),
        TaskType::new("leg_stand", myobase::leg_stand::LegStand::new),
        TaskType::new("leg_walk", myobase::leg_walk::LegWalk::new),
        TaskType::new("rotate_balls", myochallenge::baoding::Baoding::new),
        TaskType::new("reorient_die", myochallenge::reorient::Reorient::new),
        TaskType::new("chase_tag", myochallenge::chase_tag::ChaseTag::new),
        TaskType::new("relocate_object", myochallenge::relocate::Relocate::new),
        TaskType::new("track", myodm::track::Track::new),
    ]
}
