//! Controllers of the suite `deformable`: they solve their tasks, doing nothing does not, their episodes repeat, and what they handle obeys
//! its laws meanwhile.

mod playing;

use env::{Env, Options, OwnModels, Registry};
use physics::Data;
use physics::position::kinematics::kinematics;
use playing::{play, watch};

/// Height of the table's top \[m\].
const TABLE: f64 = 0.76;

#[test]
fn every_task_has_a_controller() {
    let specs = Registry::builtin().specs().iter().filter(|spec| spec.suite == "deformable");
    let tasks: std::collections::BTreeSet<&str> = specs.map(|spec| spec.task.as_str()).collect();
    assert_eq!(
        tasks.into_iter().collect::<Vec<_>>(),
        [
            "cloth_fold",
            "cloth_hang",
            "cloth_spread",
            "grain_flatten",
            "grain_pour",
            "grain_scoop",
            "rope_straighten",
            "rope_thread",
            "rope_wrap",
            "sponge_press",
            "sponge_wipe"
        ]
    );
}

/// A rope of 0.48 m whose joints hold it together by themselves keeps its length to rounding, and sinks into the table by less than half of
/// its radius of 5 mm, while it is pulled taut, led round a peg and threaded.
#[test]
fn ropes_keep_their_length_and_stay_on_the_table() {
    for id in ["hive/RopeStraighten-v0", "hive/RopeThread-v0", "hive/RopeWrap-v0"] {
        let solved = watch(id, 0, true, |env| {
            let places = env.rows()["rope"].as_chunks::<3>().0;
            let pieces =
                places.windows(2).map(|pair| (0..3).map(|i| (pair[1][i] - pair[0][i]).powi(2)).sum::<f64>());
            let length: f64 = pieces.map(f64::sqrt).sum();
            assert!((length - 0.48).abs() < 1e-9, "{id}: {length} m");
            let lowest = places.iter().map(|place| place[2]).fold(f64::INFINITY, f64::min);
            assert!(lowest > TABLE + 0.0025, "{id}: the rope is {lowest} m up");
        });
        assert!(solved.0, "{id} is not solved");
        assert!(solved.1.iter().all(|value| (-1.0..=1.0).contains(value)), "{id}");
        assert!(!play(id, 0, false).0, "{id} is solved by zero actions");
    }
}

/// Nodes stay over the table, and none of the sponge's upright edges of 60 mm is stretched by more than a tenth or pressed to less than half.
#[test]
fn a_sponge_is_pressed_and_not_torn() {
    for id in ["hive/SpongePress-v0", "hive/AdroitSpongePress-v0"] {
        let press = |each: fn(&env::Env)| watch(id, 3, true, each);
        let (solved, actions) = press(|env| {
            let nodes = env.rows()["sponge"].as_chunks::<3>().0;
            assert_eq!(nodes.len(), 8);
            let heights = nodes.iter().map(|node| node[2] - TABLE);
            let (low, high) = (heights.clone().fold(f64::INFINITY, f64::min), heights.fold(0.0, f64::max));
            assert!(low > -0.001 && (0.03..0.066).contains(&(high - low)), "{low} {high}");
        });
        assert!(solved, "{id} is not solved");
        assert!(!play(id, 3, false).0, "{id} is solved by zero actions");
        assert!(actions == press(|_| ()).1, "{id} acts otherwise in the same episode");
    }
}

/// Gap between the tips of the thumb and of two fingers, in the mean, and between the heights of their lowest points, of the Adroit hand as a gripper \[m\]: what
/// `assets/adroit/README.md` says.
#[test]
fn thumb_and_fingers_open_and_close_level() {
    let env = Env::make("hive/AdroitSpongePress-v0", &OwnModels, &Options::default()).unwrap();
    let m = &env.scene().model;
    let roles = robot::Roles::from_toml(
        assets::text("deformable/adroit/roles.toml").unwrap(),
        "deformable/adroit/roles.toml",
    )
    .unwrap();
    for (pose, expected) in [("open", 0.05), ("closed", -0.02)] {
        let mut data = Data::new(m);
        roles.cast(m, "", "pinch").pose(pose, &mut data.state.qpos).unwrap();
        kinematics(m, &data.state, &mut data.kin);
        // The lower end of a capsule, and its radius: the palm looks down, and fingers close along y.
        let [thumb, fore, middle] = ["C_thdistal", "C_ffdistal", "C_mfdistal"].map(|name| {
            let geom = m.geom(name).unwrap().index();
            let [radius, half, _] = m.geom_size[geom];
            let (place, turn) = (data.kin.geom_xpos[geom], data.kin.geom_xmat[geom]);
            let down = -half * turn[8].signum();
            [place[1] + down * turn[5], place[2] + down * turn[8] - radius, radius]
        });
        let gap = 0.5 * (fore[0] + middle[0]) - thumb[0] - fore[2] - thumb[2];
        assert!((gap - expected).abs() < 0.001, "{pose}: {gap}");
        for finger in [fore, middle] {
            assert!((finger[1] - thumb[1]).abs() < 0.005, "{pose}: {finger:?} {thumb:?}");
        }
    }
}

/// Marks go, and do not come back, only in states in which the sponge presses by 4 N, never by more than 40 N. An environment that goes on from a
/// saved state knows which are gone.
#[test]
fn marks_are_wiped_by_a_sponge_that_presses() {
    ["hive/SpongeWipe-v0", "hive/AdroitSpongeWipe-v0"].into_iter().for_each(marks_are_wiped);
}

fn marks_are_wiped(id: &str) {
    let (mut before, mut kept, mut after) = (1.0, None, Vec::new());
    let (solved, _) = watch(id, 1, true, |env| {
        let (remaining, force) = (env.rows()["remaining"][0], env.rows()["force"][0]);
        assert!(remaining == before || remaining < before && force >= 4.0, "{remaining} {before} {force} N");
        assert!(force <= 40.0, "{force} N");
        let gone = env.rows()["wiped"].iter().filter(|wiped| **wiped == 1.0).count();
        assert_eq!(gone as f64, (15.0 * (1.0 - remaining)).round());
        before = remaining;
        if kept.is_none() && remaining < 0.5 {
            kept = Some((env.state(), env.rows()["wiped"].to_vec()));
        }
        after = env.rows()["wiped"].to_vec();
    });
    assert!(solved && after == [1.0; 15], "{id} is not solved");
    let (state, wiped) = kept.unwrap();
    let mut env = env::Env::make(id, &env::OwnModels, &env::Options::default()).unwrap();
    env.reset(Some(2)).unwrap();
    env.set_state(&state).unwrap();
    assert_eq!(env.rows()["wiped"], wiped);
    env.step(&vec![0.0; env.action_len()]).unwrap();
    assert!(env.rows()["wiped"].iter().zip(&wiped).all(|(now, before)| now >= before), "a mark came back");
    assert!(!play(id, 1, false).0, "{id} is solved by zero actions");
}

/// What is in the scoop in the end came from the tray, and is as high as is wanted.
#[test]
fn grains_are_scooped_and_carried_up() {
    ["hive/GrainScoop-v0", "hive/AdroitGrainScoop-v0"].into_iter().for_each(grains_are_scooped);
}

fn grains_are_scooped(id: &str) {
    let mut last = (0, 0.0, 0.0);
    let (solved, _) = watch(id, 0, true, |env| {
        let rows = env.rows();
        let grains = rows["grains"].as_chunks::<3>().0;
        assert_eq!(grains.len(), 80);
        // The rim of the tray is 34 mm over the table, and the inside of the scoop 32 mm high.
        let high = grains.iter().filter(|grain| grain[2] > TABLE + 0.034 + 0.05 - 0.032).count();
        last = (high, rows["scooped"][0], rows["height"][0]);
    });
    assert!(solved && last.1 >= 0.125 && last.2 >= 0.05, "{id} is not solved: {last:?}");
    assert!(last.0 as f64 >= 80.0 * last.1 - 0.5, "{last:?}");
    assert!(!play(id, 0, false).0, "{id} is solved by zero actions");
}

/// A heap of 64 grains of 12 mm stays one when it is left alone, and is one layer when it is solved, as most are.
#[test]
fn grains_are_flattened_and_stay_a_heap_otherwise() {
    ["hive/GrainFlatten-v0", "hive/AdroitGrainFlatten-v0"].into_iter().for_each(grains_are_flattened);
}

fn grains_are_flattened(id: &str) {
    let spread = |env: &env::Env| {
        let heights: Vec<f64> = env.rows()["grains"].chunks(3).map(|place| place[2]).collect();
        let mean = heights.iter().sum::<f64>() / heights.len() as f64;
        (heights.iter().map(|height| (height - mean).powi(2)).sum::<f64>() / heights.len() as f64).sqrt()
    };
    let (mut last, mut held, mut count) = (f64::INFINITY, 0.0, 0);
    for seed in 0..3 {
        let (solved, _) = watch(id, seed, true, |env| {
            (last, held) = (spread(env), env.rows()["held"][0]);
            assert!((last - env.rows()["spread"][0]).abs() < 1e-12);
            assert!(held == 0.0 || last < 0.0025, "{id}, seed {seed}: {last} m for {held} s");
        });
        // A heap that is flat only when time is up is not solved.
        assert_eq!(solved, held >= 0.5, "{id}, seed {seed}: {last} m for {held} s");
        count += usize::from(solved);
    }
    assert!(count >= 2, "{count} of 3 heaps are flattened");
    let left = watch(id, 0, false, |env| last = spread(env)).0;
    assert!(!left && last > 0.003, "{id}: {last} m by zero actions");
}

/// Every grain is over the table or beside it over the floor, and all are counted: in the bowl, spilled, or over its rim.
#[test]
fn grains_are_poured_and_none_is_lost() {
    ["hive/GrainPour-v0", "hive/AdroitGrainPour-v0"].into_iter().for_each(grains_are_poured);
}

fn grains_are_poured(id: &str) {
    let (solved, _) = watch(id, 0, true, |env| {
        let rows = env.rows();
        let grains = rows["grains"].as_chunks::<3>().0;
        assert_eq!(grains.len(), 100);
        for [x, y, z] in grains {
            let over_table = x.abs() < 0.6 && (y - 0.475).abs() < 0.375;
            // Half of a grain's radius of 6 mm.
            let ground = if over_table { TABLE } else { 0.0 };
            assert!(*z > ground + 0.003, "a grain is at {x} {y} {z}");
        }
        let high = grains.iter().filter(|grain| grain[2] > TABLE + 0.054).count();
        let counted = 100.0 * (rows["poured"][0] + rows["spilled"][0]);
        assert!((counted + high as f64 - 100.0).abs() < 1e-9, "{counted} grains and {high} over the rim");
    });
    assert!(solved, "{id} is not solved");
    assert!(!play(id, 0, false).0, "{id} is solved by zero actions");
}

/// A cloth of 7 by 7 points, 30 mm apart, on a felt 1 mm thick: while it is handled no edge is stretched by more than a tenth, and no point is
/// pressed through the felt.
#[test]
fn cloths_are_handled_and_keep_their_shape() {
    for id in ["hive/ClothFold-v0", "hive/ClothHang-v0", "hive/ClothSpread-v0"] {
        let (solved, actions) = watch(id, 2, true, |env| {
            let places = env.rows()["cloth"].as_chunks::<3>().0;
            assert_eq!(places.len(), 49);
            let lowest = places.iter().map(|place| place[2]).fold(f64::INFINITY, f64::min);
            assert!(lowest > TABLE, "{id}: a point of the cloth is {lowest} m up");
            let stretch = stretch(places);
            assert!(stretch < 0.1, "{id}: an edge is stretched by {stretch}");
        });
        assert!(solved, "{id} is not solved");
        assert!(actions.iter().all(|value| (-1.0..=1.0).contains(value)), "{id}");
        assert!(!play(id, 2, false).0, "{id} is solved by zero actions");
    }
}

/// A cloth that lies flat and free counts as spread where its flat side lay, and not where it has been dragged to.
#[test]
fn a_cloth_is_spread_where_it_lay() {
    let mut env = Env::make("hive/ClothSpread-v0", &OwnModels, &Options::default()).unwrap();
    let zero = vec![0.0; env.action_len()];
    for (dragged, spread) in [(0.0, true), (0.04, true), (0.06, false), (0.2, false)] {
        env.reset(Some(0)).unwrap();
        let (m, mut world) = (&env.scene().model, env.world());
        let qpos = world.qpos.as_mut().unwrap();
        let start = |body: usize| m.jnt_qposadr[m.body_jntadr[body] as usize] as usize;
        let [handle, flat] = ["rod_0", "rod_1"].map(|name| start(m.body(name).unwrap().index()));
        // The cloth of the scene lies flat: it is put down turned and moved as its flat side is.
        let place = |qpos: &[f64], joint: usize| [qpos[joint], qpos[joint + 1]];
        let turned =
            2.0 * (qpos[flat + 6].atan2(qpos[flat + 3]) - m.qpos0[flat + 6].atan2(m.qpos0[flat + 3]));
        let (lay, origin) = (place(qpos, flat), place(&m.qpos0, flat));
        let moved = |[x, y]: [f64; 2]| {
            let (sine, cosine) = turned.sin_cos();
            let [x, y] = [x - origin[0], y - origin[1]];
            [lay[0] + dragged + cosine * x - sine * y, lay[1] + sine * x + cosine * y]
        };
        for body in m.flex_vertbodyid.iter().map(|body| *body as usize) {
            let [x, y, _] = m.body_pos[body];
            let [to_x, to_y] = moved([x, y]);
            qpos[start(body)..start(body) + 3].copy_from_slice(&[to_x - x, to_y - y, 0.0]);
        }
        for joint in [handle, flat] {
            let to = moved(place(&m.qpos0, joint));
            let turn: [f64; 4] = qpos[flat + 3..flat + 7].try_into().unwrap();
            qpos[joint..joint + 3].copy_from_slice(&[to[0], to[1], m.qpos0[joint + 2]]);
            qpos[joint + 3..joint + 7].copy_from_slice(&turn);
        }
        world.qvel.as_mut().unwrap().fill(0.0);
        env.set_world(&world).unwrap();
        (0..4).for_each(|_| drop(env.step(&zero).unwrap()));
        let rows = ["covered", "moved", "touched", "held"].map(|row| env.rows()[row][0]);
        let [covered, moved, touched, held] = rows;
        assert!(covered > 0.97 && touched == 0.0, "{dragged}: {rows:?}");
        assert!((moved - dragged).abs() < 0.005, "{dragged}: {rows:?}");
        assert_eq!(held > 0.2, spread, "{dragged}: {rows:?}");
    }
}

/// The Adroit hand does with a post what the Panda does with rope and rod themselves. It lifts the post of a cloth by more than its height to
/// fold it, and to spread it so high, 41 mm over the table, that half of the post's diagonal of 64 mm is clear of that in whatever way the post is turned. It lifts that of a rope over the
/// rope or to the height of a ring, and drags it to pull the rope straight: it stays within a quarter of its height of the table.
#[test]
fn thumb_and_fingers_take_a_post() {
    let tasks = [
        ("RopeStraighten", -0.01..0.01),
        ("RopeWrap", 0.02..0.06),
        ("ClothFold", 0.04..0.2),
        ("ClothSpread", 0.02..0.2),
        ("RopeThread", 0.03..0.07),
    ];
    for (task, rise) in tasks {
        let id = &format!("hive/Adroit{task}-v0");
        let (mut first, mut highest) = (None, f64::NEG_INFINITY);
        let (solved, actions) = watch(id, 2, true, |env| {
            let scene = env.scene();
            let height = scene.data.geom(scene.model.geom("handle").unwrap()).xpos()[2];
            first = first.or(Some(height));
            highest = highest.max(height);
        });
        assert!(solved, "{id} is not solved");
        assert!(actions.iter().all(|value| (-1.0..=1.0).contains(value)), "{id}");
        let risen = highest - first.unwrap();
        assert!(rise.contains(&risen), "{id}: the post rises by {risen} m");
    }
}

/// The largest share by which a point of a cloth is farther than 30 mm from the next in its row or its column.
fn stretch(places: &[[f64; 3]]) -> f64 {
    let length = |a: usize, b: usize| {
        (0..3).map(|i| (places[a][i] - places[b][i]).powi(2)).sum::<f64>().sqrt() / 0.03 - 1.0
    };
    let rows = (0..49).filter(|k| k % 7 < 6).map(|k| length(k, k + 1));
    let columns = (0..42).map(|k| length(k, k + 7));
    rows.chain(columns).fold(0.0, f64::max)
}
