//! Sleep: what falls asleep, what wakes it, and that neither changes how the rest moves.

use robohive_physics::model::Enable;
use robohive_physics::{Data, Model, Snapshot, forward, step};

fn model(bodies: &str, rest: &str) -> Model {
    let text = format!(
        "<mujoco><option><flag sleep='enable'/></option><worldbody><geom name='floor' type='plane' size='5 5 1'/>{bodies}</worldbody>{rest}</mujoco>"
    );
    robohive_mjcf::load_str(&text).unwrap_or_else(|e| panic!("{e}")).model
}

/// A cube of half a side of 0.1 m, falling on the floor.
fn cube(name: &str, x: f64, attributes: &str) -> String {
    format!(
        "<body name='{name}' pos='{x} 0 .11' {attributes}><freejoint/><geom type='box' size='.1 .1 .1'/></body>"
    )
}

fn run(m: &Model, d: &mut Data, steps: usize) {
    (0..steps).for_each(|_| step(m, d).unwrap());
}

fn asleep(d: &Data) -> Vec<bool> {
    d.state.tree_asleep.iter().map(|&tree| tree >= 0).collect()
}

/// Two cubes apart after they have come to rest.
fn resting() -> (Model, Data) {
    let m = model(&(cube("a", 0.0, "") + &cube("b", 1.0, "")), "");
    let mut d = Data::new(&m);
    run(&m, &mut d, 500);
    assert_eq!(asleep(&d), [true, true]);
    (m, d)
}

#[test]
fn bodies_at_rest_stop_and_cost_no_contacts() {
    let (m, mut d) = resting();
    assert!(d.state.qvel.iter().all(|&v| v == 0.0));
    assert_eq!((d.state.ntree_awake, d.state.nv_awake, d.state.nbody_awake), (0, 0, 1));
    let there = d.state.qpos.clone();
    run(&m, &mut d, 10);
    assert_eq!((d.state.qpos.clone(), d.con.contact.len(), d.efc.nefc), (there, 0, 0));
}

#[test]
fn a_model_moves_the_same_until_something_sleeps() {
    let m = model(&(cube("a", 0.0, "") + &cube("b", 1.0, "")), "");
    let mut plain = m.clone();
    plain.options_mut().enableflags = Enable::default();
    let (mut with, mut without) = (Data::new(&m), Data::new(&plain));
    let mut steps = 0;
    while with.state.ntree_awake == 2 {
        assert_eq!((&with.state.qpos, &with.state.qvel), (&without.state.qpos, &without.state.qvel));
        run(&m, &mut with, 1);
        run(&plain, &mut without, 1);
        steps += 1;
    }
    assert!(steps > 20, "{steps}");
}

#[test]
fn the_user_wakes_what_he_moves_pushes_or_spins() {
    let changes: [fn(&mut Data); 4] = [
        |d| d.state.qpos[0] += 1e-3,
        |d| d.state.qvel[1] = 0.1,
        |d| d.state.qfrc_applied[2] = 1.0,
        |d| d.state.xfrc_applied[1][0] = 1.0,
    ];
    for change in changes {
        let (m, mut d) = resting();
        change(&mut d);
        run(&m, &mut d, 1);
        assert_eq!(asleep(&d), [false, true]);
    }
}

#[test]
fn a_moving_body_wakes_what_it_hits_and_only_that() {
    let m = model(
        &(cube("a", 0.0, "")
            + &cube("b", 1.0, "")
            + "<body pos='0 0 3'><freejoint/><geom size='.05'/></body>"),
        "",
    );
    let mut d = Data::new(&m);
    run(&m, &mut d, 300);
    assert_eq!(asleep(&d), [true, true, false]);
    while d.con.contact.is_empty() {
        run(&m, &mut d, 1);
    }
    assert_eq!(asleep(&d), [false, true, false]);
    // What has been woken stands on the floor again.
    assert!(d.con.contact.len() > 4, "{}", d.con.contact.len());
}

#[test]
fn mocap_bodies_wake_what_they_touch() {
    let m = model(&(cube("a", 0.0, "") + "<body mocap='true' pos='0 0 2'><geom size='.1'/></body>"), "");
    let mut d = Data::new(&m);
    run(&m, &mut d, 500);
    assert_eq!(asleep(&d), [true]);
    d.state.mocap_pos[0] = [0.0, 0.0, 0.25];
    run(&m, &mut d, 1);
    assert_eq!(asleep(&d), [false]);
}

#[test]
fn equalities_and_limits_of_tendons_wake_their_other_end() {
    let sites = "<body name='a' pos='0 0 .11'><freejoint/><geom type='box' size='.1 .1 .1'/><site name='sa'/></body>
                 <body name='b' pos='1 0 .11'><freejoint/><geom type='box' size='.1 .1 .1'/><site name='sb'/></body>";
    let weld = "<equality><weld body1='a' body2='b' active='false'/></equality>";
    let m = model(sites, weld);
    let mut d = Data::new(&m);
    run(&m, &mut d, 500);
    assert_eq!(asleep(&d), [true, true]);
    d.state.eq_active[0] = true;
    run(&m, &mut d, 1);
    assert_eq!(asleep(&d), [false, false]);
    let rope = "<tendon><spatial limited='true' range='0 1.001'><site site='sa'/><site site='sb'/></spatial></tendon>";
    let m = model(sites, rope);
    let mut d = Data::new(&m);
    run(&m, &mut d, 500);
    assert_eq!(asleep(&d), [true, true]);
    d.state.qvel[0] = -1.0;
    run(&m, &mut d, 1);
    assert_eq!(asleep(&d), [false, true]);
    run(&m, &mut d, 3);
    assert_eq!(asleep(&d), [false, false]);
}

#[test]
fn policies_decide_who_may_sleep() {
    let m = model(&(cube("a", 0.0, "sleep='never'") + &cube("b", 1.0, "sleep='allowed'")), "");
    let mut d = Data::new(&m);
    run(&m, &mut d, 500);
    assert_eq!(asleep(&d), [false, true]);
    let driven = "<actuator><motor site='s'/></actuator>";
    let body = "<body pos='0 0 .11'><freejoint/><geom type='box' size='.1 .1 .1'/><site name='s'/></body>";
    let m = model(body, driven);
    let mut d = Data::new(&m);
    run(&m, &mut d, 500);
    assert_eq!(asleep(&d), [false]);
}

#[test]
fn models_begin_asleep_as_whole_islands() {
    let pair = "<body name='low' pos='0 0 .1' sleep='init'><freejoint/><geom type='box' size='.1 .1 .1'/></body>
                <body name='high' pos='0 0 .3' sleep='init'><freejoint/><geom type='box' size='.1 .1 .1'/></body>";
    let m = model(&(pair.to_owned() + &cube("other", 1.0, "")), "");
    let mut d = Data::new(&m);
    assert_eq!(asleep(&d), [true, true, false]);
    run(&m, &mut d, 20);
    assert_eq!(asleep(&d), [true, true, false]);
    assert_eq!(d.state.qpos[..7], m.qpos0[..7]);
    run(&m, &mut d, 500);
    d.reset(&m);
    assert_eq!((asleep(&d), d.time()), (vec![true, true, false], 0.0));
    let half = pair.replacen(" sleep='init'", "", 1);
    let text = format!(
        "<mujoco><option><flag sleep='enable'/></option><worldbody><geom type='plane' size='5 5 1'/>{half}</worldbody></mujoco>"
    );
    let findings = robohive_mjcf::load_str(&text).unwrap_err().to_string();
    assert!(findings.contains("\"high\" cannot begin asleep"), "{findings}");
}

#[test]
fn saved_sleepers_go_on_in_other_data() {
    let m = model(&(cube("a", 0.0, "") + "<body pos='1 0 4'><freejoint/><geom size='.05'/></body>"), "");
    let mut d = Data::new(&m);
    run(&m, &mut d, 300);
    assert_eq!(asleep(&d), [true, false]);
    let mut saved = Snapshot::default();
    d.save(&mut saved);
    run(&m, &mut d, 400);
    let mut other = Data::new(&m);
    other.restore(&saved).unwrap();
    run(&m, &mut other, 400);
    assert_eq!((other.state.qpos, other.state.tree_asleep), (d.state.qpos, d.state.tree_asleep));
}

#[test]
fn without_the_flag_all_wake() {
    let (mut m, mut d) = resting();
    m.options_mut().enableflags = Enable::default();
    forward(&m, &mut d).unwrap();
    assert_eq!((asleep(&d), d.con.contact.len()), (vec![false, false], 8));
}

#[test]
fn islands_that_the_user_garbles_neither_panic_nor_hang() {
    let weld = "<equality><weld body1='a' body2='b' active='false'/></equality>";
    let m = model(&(cube("a", 0.0, "") + &cube("b", 1.0, "") + &cube("c", 2.0, "")), weld);
    let mut d = Data::new(&m);
    run(&m, &mut d, 500);
    assert_eq!(asleep(&d), [true; 3]);
    d.state.tree_asleep[1] = 3;
    let error = step(&m, &mut d).unwrap_err().to_string();
    assert!(error.contains("tree_asleep[1] is 3"), "{error}");
    // A cycle that does not come back to where it began, and one that ends at a tree that is awake.
    for cycle in [[1, 2, 1], [1, 2, -1]] {
        d.state.tree_asleep.copy_from_slice(&cycle);
        d.state.eq_active[0] = true;
        run(&m, &mut d, 2);
        assert!(d.state.qpos.iter().all(|x| x.is_finite()));
    }
}

#[test]
fn a_flex_sleeps_and_wakes_as_a_whole() {
    let m = robohive_mjcf::load_str(
        "<mujoco><option><flag sleep='enable' gravity='disable'/></option><worldbody><body name='holder'>
         <flexcomp name='sheet' type='grid' dim='2' count='3 3 1' spacing='.1 .1 .1' radius='.01' mass='.1'>
         <edge equality='true'/><contact selfcollide='none' internal='false'/></flexcomp></body></worldbody></mujoco>",
    )
    .unwrap_or_else(|e| panic!("{e}"))
    .model;
    let mut d = Data::new(&m);
    run(&m, &mut d, 20);
    assert_eq!((asleep(&d), d.efc.nefc), (vec![true; 9], 0));
    d.state.qfrc_applied[0] = 0.01;
    run(&m, &mut d, 1);
    assert_eq!(asleep(&d), vec![false; 9]);
    assert!(d.efc.nefc > 0);
}
