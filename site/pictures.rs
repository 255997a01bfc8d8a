//! Pictures that pages show, drawn by the command when the site is built.

use crate::own::own_models;
use std::path::Path;
use std::process::Command;

/// Columns and rows of a picture.
const SIZE: &str = "960x540";

/// Draws models of our own and environments on them into `folder`.
///
/// # Errors
/// The command fails.
pub fn draw(root: &Path, programs: &Path, folder: &Path) -> Result<(), String> {
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let robohive = |words: &[&str]| {
        let out = Command::new(programs.join("robohive")).current_dir(root).args(words).output();
        let out = out.map_err(|error| format!("robohive: {error}"))?;
        let well = out.status.success();
        if well {
            Ok(())
        } else {
            Err(format!("robohive {words:?}: {}", String::from_utf8_lossy(&out.stderr)))
        }
    };
    let place = |name: &str| folder.join(format!("{name}.png")).display().to_string();
    for own in own_models(root)?.iter().filter(|own| own.is_shown()) {
        let file = place(&own.name);
        let camera = own.camera.iter().flat_map(|camera| ["--camera", camera]);
        let words: Vec<&str> =
            ["render", &own.file, "--out", &file, "--size", SIZE].into_iter().chain(camera).collect();
        robohive(&words)?;
    }
    let (reach, sheet) = (place("reach"), place("environments"));
    robohive(&["render", "hive/FrankaReach-v0", "--camera", "front", "--out", &reach, "--size", SIZE])?;
    robohive(&["gallery", "hive", "--out", &sheet, "--size", "320x240", "--columns", "4", "--quiet"])
}
