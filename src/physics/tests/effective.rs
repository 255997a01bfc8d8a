//! Stiffness of flexes in the inertia: forward and inverse dynamics agree, stiff cloth is stable, soft contacts carry it.

use robohive_physics::{Data, Model, forward, inverse, step};

fn model(option: &str, world: &str, flex: &str) -> Model {
    let text = format!(
        "<mujoco><option integrator='implicitfast' {option}/><worldbody>{world}{flex}</worldbody></mujoco>"
    );
    robohive_mjcf::load_str(&text).unwrap_or_else(|e| panic!("{e}")).model
}

fn sheet(attributes: &str, contact: &str) -> String {
    format!(
        "<body name='holder' euler='20 30 40'><flexcomp name='sheet' type='grid' dim='2' count='5 5 1'
         spacing='.1 .1 .1' radius='.01' mass='.5' {attributes}>
         <contact selfcollide='none' internal='false' {contact}/>
         <elasticity young='3e5' poisson='.2' thickness='2e-3' damping='1e-3' elastic2d='both'/></flexcomp></body>"
    )
}

const PRECISE: &str = "solver='CG' tolerance='1e-13' iterations='2000'";

/// Moves and pushes the vertices so that every term counts.
fn disturbed(m: &Model) -> Data {
    let mut d = Data::new(m);
    for (i, q) in d.state.qpos.iter_mut().enumerate() {
        *q += 0.01 * ((7 * i) as f64).sin();
    }
    for (i, v) in d.state.qvel.iter_mut().enumerate() {
        *v = 0.3 * ((3 * i) as f64).cos();
    }
    d
}

/// Largest force that inverse dynamics finds where none was applied, relative to the largest passive force.
fn disagreement(m: &Model) -> f64 {
    let mut d = disturbed(m);
    forward(m, &mut d).unwrap();
    inverse(m, &mut d).unwrap();
    let largest = |x: &[f64]| x.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    largest(&d.implicit.qfrc_inverse) / largest(&d.passive.qfrc_passive)
}

#[test]
fn inverse_dynamics_takes_the_stiffness_back() {
    for pin in ["", "<pin id='0 4'/>"] {
        let flex =
            sheet("", "contype='0' conaffinity='0'").replace("</flexcomp>", &format!("{pin}</flexcomp>"));
        assert!(disagreement(&model(PRECISE, "", &flex)) < 1e-9);
    }
    let lattice =
        "<body name='holder' euler='10 20 30'><flexcomp name='block' type='grid' dim='3' count='3 3 3' spacing='.1 .1 .1'
        radius='.01' mass='.5' dof='trilinear'><elasticity young='1e4' poisson='.2' damping='1e-2'/>
        <contact selfcollide='none' internal='false'/></flexcomp></body>";
    assert!(disagreement(&model(PRECISE, "", lattice)) < 1e-9);
}

#[test]
fn stiff_cloth_is_stable_where_explicit_elasticity_is_not() {
    let flex = sheet("", "contype='0' conaffinity='0'").replace("</flexcomp>", "<pin id='0 4'/></flexcomp>");
    let flex = flex.replace("young='3e5'", "young='3e6'");
    let runs = |option: &str| {
        let m = model(option, "", &flex);
        let mut d = disturbed(&m);
        (0..400).all(|_| step(&m, &mut d).is_ok()) && d.state.qpos.iter().all(|q| q.abs() < 1.0)
    };
    assert!(runs("timestep='.005' solver='CG'"));
    assert!(!runs("timestep='.005' solver='Newton'"));
}

#[test]
fn soft_contacts_carry_a_sheet_without_rows() {
    let flex = sheet("pos='0 0 .02'", "passive='true'").replace("euler='20 30 40'", "");
    let m = model("solver='CG'", "<geom type='plane' size='1 1 1'/>", &flex);
    let mut d = Data::new(&m);
    (0..2000).for_each(|_| step(&m, &mut d).unwrap());
    assert_eq!(d.efc.nefc, 0);
    assert!(!d.con.contact.is_empty() && d.con.contact.iter().all(|c| c.exclude == 4));
    assert!(d.flex.flexvert_xpos.iter().all(|p| (p[2] - 0.01).abs() < 1e-3));
    // The springs push up as much as gravity pulls down.
    forward(&m, &mut d).unwrap();
    let up: f64 = d.passive.qfrc_spring.iter().skip(2).step_by(3).sum();
    assert!((up - 0.5 * 9.81).abs() < 1e-3 * 0.5 * 9.81, "{up}");
}

#[test]
fn soft_contacts_are_refused_where_the_inertia_has_no_stiffness() {
    let flex = sheet("", "passive='true'");
    let text = format!("<mujoco><option solver='Newton'/><worldbody>{flex}</worldbody></mujoco>");
    let error = robohive_mjcf::load_str(&text).map(|_| ()).unwrap_err().to_string();
    assert!(error.contains("passive contacts"), "{error}");
}
