//! Recordings: trials in one HDF5 file, whose finished ones outlast a kill, read row by row.

use robohive::dataset::trace::{Layout, Precision, Recorder, TraceReader};
use robohive::{Data, load_str, step};
use std::path::Path;

const PENDULUM: &str = "
<mujoco>
  <option timestep='.01'/>
  <worldbody><body><joint name='hinge' axis='0 1 0'/><geom size='.1' pos='1 0 0'/></body></worldbody>
</mujoco>";

/// Steps of a trial.
const STEPS: usize = 50;

/// Records a pendulum that starts at an angle \[rad\].
fn trial(recorder: &mut Recorder, name: &str, angle: f64) -> Result<(), Box<dyn std::error::Error>> {
    let model = load_str(PENDULUM)?.model;
    let hinge = model.joint("hinge").ok_or("no hinge")?;
    let mut data = Data::new(&model);
    data.joint_mut(hinge).set_qpos([angle]);
    let mut trial = recorder.begin(name)?;
    for _ in 0..STEPS {
        trial.push("time", &[], &[data.time()])?;
        trial.push("env_infos/obs_dict/angle", &[1], data.joint(hinge).qpos())?;
        step(&model, &mut data)?;
    }
    trial.finish()?;
    Ok(())
}

fn record_and_read(file: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let mut recorder = Recorder::create(file, Layout::RoboHive, Precision::Full)?;
    trial(&mut recorder, "Trial0", 0.0)?;
    // Not finished, and so not part of the file.
    recorder.begin("Trial1")?.push("time", &[], &[0.0])?;
    recorder.close()?;

    // A program that starts again goes on behind what is there.
    let mut recorder = Recorder::append(file, Layout::RoboHive, Precision::Full)?;
    trial(&mut recorder, "Trial2", 0.5)?;
    recorder.close()?;

    let trace = TraceReader::open(file)?;
    assert_eq!(trace.trials(), ["Trial0", "Trial2"]);
    let angle = trace.entry("Trial2", "env_infos/obs_dict/angle")?;
    assert_eq!((angle.rows(), angle.shape.as_slice()), (STEPS, &[STEPS, 1][..]));
    let [first, last] = [0, STEPS - 1].map(|row| trace.rows(&angle, row..row + 1));
    assert_eq!(first?.values.to_f64(), [0.5]);
    assert!(last?.values.to_f64()[0] > 1.0, "the pendulum falls");
    Ok(())
}

/// Writes trials and reads them back.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let file = std::env::temp_dir().join(format!("robohive-recording-{}.h5", std::process::id()));
    let outcome = record_and_read(&file);
    std::fs::remove_file(&file)?;
    outcome
}
