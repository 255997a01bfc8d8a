//! Quantities derived at `qpos0` equal MuJoCo's on the own models, after they have been wiped.

use physics::Model;
use physics::constants::set_const::set_const;
use robohive_validation::compare::{compare, compiled, exact};
use robohive_validation::reference::{is_own, recorded};

/// Read as well as derived: lengths, anchors and policies that the text gives are kept.
const READ_TOO: [&str; 3] = ["eq_data", "tendon_lengthspring", "tree_sleep_policy"];

/// Fills the arrays `names` with what means nothing: not a number, or -7 in arrays of integers. Rows of the world, which
/// is as it is in every model, stay.
fn poison(m: &mut Model, names: &[&str]) {
    let mut arrays = Vec::new();
    m.visit(&mut |name, shape, v| {
        if names.contains(&name) && !READ_TOO.contains(&name) {
            let world = if name.starts_with("body_") { shape[1..].iter().product() } else { 0 };
            let mut values = v.to_f64();
            values[world..].fill(if v.is_float() { f64::NAN } else { -7.0 });
            arrays.push((name, values));
        }
    });
    assert_eq!(arrays.len(), names.len() - READ_TOO.len());
    let m = m.unchecked_mut();
    arrays.iter().for_each(|(name, values)| assert_eq!(m.assign(name, values), Some(true), "{name}"));
}

#[test]
fn derived_quantities_are_restored() {
    let derived = [
        "body_sameframe",
        "geom_sameframe",
        "site_sameframe",
        "body_subtreemass",
        "body_treeid",
        "tree_bodyadr",
        "tree_bodynum",
        "tree_dofadr",
        "tree_dofnum",
        "tree_sleep_policy",
        "tendon_treenum",
        "tendon_treeid",
        "ten_J_rownnz",
        "ten_J_rowadr",
        "ten_J_colind",
        "body_invweight0",
        "dof_invweight0",
        "dof_M0",
        "dof_length",
        "tendon_length0",
        "tendon_invweight0",
        "tendon_lengthspring",
        "actuator_length0",
        "actuator_acc0",
        "eq_data",
        "cam_pos0",
        "cam_poscom0",
        "cam_mat0",
        "light_pos0",
        "light_poscom0",
        "light_dir0",
        "jnt_actuatorid",
    ];
    for (path, reference) in recorded().unwrap() {
        let theirs = reference.model().unwrap();
        let mut ours = theirs.clone();
        poison(&mut ours, &derived);
        ours.unchecked_mut().stat = physics::model::Statistic::default();
        set_const(&mut ours).unwrap();
        assert!(ours.nv == 0 || ours.dof_invweight0.iter().all(|&w| w > 0.0), "{}", path.display());
        let mut expected = Vec::new();
        theirs.visit(&mut |name, _, v| expected.push((name, v.to_f64(), v.is_float())));
        theirs.stat.visit(&mut |name, v| expected.push((name, v.to_f64(), true)));
        let mut got = Vec::new();
        ours.visit(&mut |_, _, v| got.push(v.to_f64()));
        ours.stat.visit(&mut |_, v| got.push(v.to_f64()));
        for ((name, theirs, float), ours) in expected.iter().zip(&got) {
            // Other models may give statistics in their text, which stand above what is derived.
            let own = is_own(&path);
            let statistic = own && ["meaninertia", "meanmass", "meansize", "extent"].contains(name);
            if derived.contains(name) || statistic {
                let worst = compare(name, ours, theirs, if *float { compiled } else { exact });
                // In units of the bar; on the own models nothing differs.
                let bound = if own { 0.0 } else { 1.0 };
                assert!(worst.error <= bound, "{}: {worst}, {:e} x bar", path.display(), worst.error);
            }
        }
    }
}
