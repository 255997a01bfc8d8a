//! `--solver`: models and environments under rapier, in builds with the feature `rapier`.

mod command;

use command::{ROOT, robohive, text};

fn model(name: &str) -> String {
    format!("{ROOT}/assets/{name}")
}

#[test]
fn an_engine_that_is_not_there_is_refused() {
    let said = robohive(&["sim", &model("pile/pile.xml"), "--solver", "bullet"]);
    assert_eq!(said.status.code(), Some(2));
    assert!(text(&said.stderr).contains("bullet"), "{}", text(&said.stderr));
    #[cfg(not(feature = "rapier"))]
    for arguments in [
        &["sim", &model("pile/pile.xml"), "--quiet"][..],
        &["bench", &model("pile/pile.xml"), "--steps", "1"],
        &["check", &model("pile/pile.xml")],
        &["run", "hive/FrankaReach-v0", "--episodes", "1"],
        &["check-env", "hive/FrankaReach-v0", "--steps", "1"],
    ] {
        let said = robohive(&[arguments, &["--solver", "rapier"]].concat());
        assert_eq!(said.status.code(), Some(2));
        assert!(text(&said.stderr).contains("--features rapier"), "{}", text(&said.stderr));
    }
}

#[cfg(feature = "rapier")]
mod rapier {
    use super::*;

    fn done(arguments: &[&str]) -> String {
        let output = robohive(arguments);
        assert!(output.status.success(), "{}", text(&output.stderr));
        text(&output.stdout)
    }

    fn refused(arguments: &[&str]) -> String {
        let output = robohive(arguments);
        assert!(!output.status.success());
        text(&output.stderr)
    }

    #[test]
    fn models_move_under_rapier_and_refusals_name_an_element() {
        let said =
            done(&["sim", &model("pile/pile.xml"), "--quiet", "--seconds", "0.5", "--solver", "rapier"]);
        assert!(said.contains("after 250 steps") && !said.contains("contacts     0 now"), "{said}");
        let said = refused(&["sim", &model("drape/drape.xml"), "--quiet", "--solver", "rapier"]);
        assert!(said.contains("flex \"cloth\" asks for a deformable body under rapier"), "{said}");
        let said = done(&["bench", &model("elbow/elbow.xml"), "--steps", "50", "--solver", "rapier"]);
        assert!(said.contains("steps/s"), "{said}");
        let said = refused(&["bench", &model("elbow/elbow.xml"), "--batch", "2", "--solver", "rapier"]);
        assert!(said.contains("remove --batch"), "{said}");
    }

    #[test]
    fn a_check_says_whether_a_model_becomes_a_world_or_names_all_that_keeps_it_from_that() {
        let said = done(&["check", &model("quadruped/quadruped.xml"), "--solver", "rapier"]);
        assert!(said.contains("19 positions of 19, 18 degrees of freedom of 18"), "{said}");
        assert!(said.contains("passed: quadruped becomes a world of rapier"), "{said}");
        let output = robohive(&["check", &model("workbench/workbench.xml"), "--solver", "rapier"]);
        assert_eq!(output.status.code(), Some(1));
        let said = text(&output.stdout);
        let named = said.lines().filter(|line| line.starts_with("refused"));
        assert!(named.count() > 1 && said.contains("geom \"block\" asks for adhesion"), "{said}");
        let reference = format!("{ROOT}/validation/reference/own/pile.npz");
        let said = refused(&["check", &model("pile/pile.xml"), &reference, "--solver", "rapier"]);
        assert!(said.contains("remove the reference"), "{said}");
    }

    #[test]
    fn environments_keep_their_contract_under_rapier() {
        let said = done(&["check-env", "hive", "--steps", "20", "--solver", "rapier"]);
        assert!(said.contains("passed"), "{said}");
        let reward = |solver| done(&["run", "hive/ElbowPose-v0", "--episodes", "1", "--solver", solver]);
        let ([own, other], mean) = ([reward("own"), reward("rapier")], |text: &str| {
            text.lines().find(|line| line.starts_with("return")).map(str::to_owned)
        });
        assert!(mean(&own).is_some(), "{own}");
        assert_eq!(mean(&own), mean(&other), "no contacts: the same motion to more digits than are shown");
    }
}
