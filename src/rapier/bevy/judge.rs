//! The crates in the way, what becomes of them and of the robot, and the verdict.

use crate::physics::{Follows, Phase, Physics, Simulated};
use bevy_app::prelude::*;
use bevy_ecs::prelude::*;
use bevy_transform::prelude::Transform;
use rapier::rapier::prelude::*;
use std::collections::BTreeSet;

/// Simulated time \[s\].
const END: f64 = 6.0;
/// Time between two lines of the report \[s\].
const REPORT: f64 = 1.0;
/// Places of crates, ahead of the robot, which walks along y \[m\].
const CRATES: [[f64; 2]; 3] = [[-0.12, 0.55], [0.1, 0.6], [0.0, 0.9]];
/// Half of an edge of a crate \[m\].
const HALF: f64 = 0.06;
/// Density of a crate \[kg/m³\].
const DENSITY: f64 = 60.0;
/// Heights of a torso that stands \[m\].
const UPRIGHT: std::ops::Range<f64> = 0.2..0.35;
/// Ways that the robot must go and that each crate must be pushed \[m\].
const WALKED: f64 = 0.6;
const PUSHED: f64 = 0.05;

/// A crate, and where it began.
#[derive(Component)]
struct Crate(Vector);

/// What has been seen.
#[derive(Resource)]
struct Seen {
    /// Lowest and highest place of the torso \[m\].
    heights: [f64; 2],
    /// Geoms of the robot that have touched a crate.
    touched: BTreeSet<usize>,
    /// Time of the next line of the report \[s\].
    next: f64,
}

/// Puts crates in the way, reports, and ends the program.
pub struct JudgePlugin;

impl Plugin for JudgePlugin {
    fn build(&self, app: &mut App) {
        app.insert_resource(Seen { heights: [f64::MAX, f64::MIN], touched: BTreeSet::new(), next: 0.0 })
            .add_systems(Startup, place)
            .add_systems(FixedUpdate, (look, judge).chain().in_set(Phase::Look));
    }
}

/// The program's own bodies.
fn place(mut commands: Commands, mut physics: ResMut<Physics>) {
    for [x, y] in CRATES {
        let at = Vector::new(x, y, HALF);
        let (_, collider) = physics.0.insert(
            RigidBodyBuilder::dynamic().translation(at),
            ColliderBuilder::cuboid(HALF, HALF, HALF).density(DENSITY).friction(0.4),
        );
        commands.spawn((Crate(at), Follows(collider), Transform::IDENTITY));
    }
}

/// Notes the torso's height, and what touches a crate.
fn look(
    physics: Res<Physics>,
    robot: Single<&Simulated>,
    crates: Query<&Follows, With<Crate>>,
    mut seen: ResMut<Seen>,
) {
    let height = robot.0.data.state.qpos[2];
    seen.heights = [seen.heights[0].min(height), seen.heights[1].max(height)];
    let colliders = (0..robot.0.model().ngeom).filter_map(|geom| Some((geom, robot.0.collider(geom)?)));
    let parts: Vec<_> = colliders.filter(|(geom, _)| robot.0.model().geom_bodyid[*geom] > 0).collect();
    for follows in &crates {
        for pair in physics.0.narrow_phase.contact_pairs_with(follows.0) {
            let touching = parts.iter().filter(|(_, part)| [pair.collider1, pair.collider2].contains(part));
            let active = touching.filter(|_| pair.has_any_active_contact());
            seen.touched.extend(active.map(|(geom, _)| geom));
        }
    }
}

/// Reports every second, and says at the end whether all went as it should.
fn judge(
    robot: Single<&Simulated>,
    crates: Query<(&Crate, &Transform)>,
    mut seen: ResMut<Seen>,
    mut exit: MessageWriter<AppExit>,
) {
    let data = &robot.0.data;
    if data.time() < seen.next {
        return;
    }
    seen.next += REPORT;
    let [_, walked, height] = data.state.qpos[..3] else { return };
    // Where Bevy would draw them.
    let pushed: Vec<f64> = crates
        .iter()
        .map(|(start, now)| (now.translation.as_dvec3() - start.0).truncate().length())
        .collect();
    println!(
        "{:.1} s: torso {height:.3} m high, {walked:.2} m ahead; {} contacts with the floor; crates pushed {pushed:.2?} m by {} parts",
        data.time(),
        data.con.contact.len(),
        seen.touched.len()
    );
    if data.time() < END {
        return;
    }
    let stood = seen.heights.iter().all(|height| UPRIGHT.contains(height));
    let done = stood && walked > WALKED && pushed.iter().all(|way| *way > PUSHED) && !seen.touched.is_empty();
    println!("{}", if done { "it walked through the crates" } else { "it did not walk through the crates" });
    exit.write(if done { AppExit::Success } else { AppExit::error() });
}
