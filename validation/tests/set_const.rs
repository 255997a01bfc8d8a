//! Quantities derived at `qpos0` equal MuJoCo's on the own models, after they have been wiped.

use physics::constants::set_const::set_const;
use robohive_validation::compare::{compare, compiled, exact};
use robohive_validation::reference::recorded;

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
        let wiped = ours.unchecked_mut();
        wiped.dof_M0.fill(0.0);
        wiped.body_invweight0.fill([0.0; 2]);
        wiped.dof_invweight0.fill(0.0);
        wiped.tendon_length0.fill(0.0);
        wiped.actuator_acc0.fill(0.0);
        wiped.stat = physics::model::Statistic::default();
        set_const(&mut ours).unwrap();
        assert!(ours.nv == 0 || ours.dof_invweight0.iter().all(|&w| w > 0.0), "{}", path.display());
        let mut expected = Vec::new();
        theirs.visit(&mut |name, _, v| expected.push((name, v.to_f64(), v.is_float())));
        theirs.stat.visit(&mut |name, v| expected.push((name, v.to_f64(), true)));
        let mut got = Vec::new();
        ours.visit(&mut |_, _, v| got.push(v.to_f64()));
        ours.stat.visit(&mut |_, v| got.push(v.to_f64()));
        for ((name, theirs, float), ours) in expected.iter().zip(&got) {
            let statistic = ["meaninertia", "meanmass", "meansize", "extent"].contains(name);
            if derived.contains(name) || statistic {
                let worst = compare(name, ours, theirs, if *float { compiled } else { exact });
                assert!(worst.error <= 1.0, "{}: {worst}, {} x tolerance", path.display(), worst.error);
            }
        }
    }
}
