//! Where the time of steps goes, and how the solver converges.

use super::table;
use crate::profile::{Frame, Profile, convergence};
use crate::session::Session;
use eframe::egui::Ui;
use egui_plot::{Legend, Line, Plot, PlotPoints};
use physics::pipeline::watch::Stage;

/// What is plotted of a frame.
type Value<'a> = &'a dyn Fn(&Frame) -> f64;

/// Time of each stage, sizes of the problem, and convergence of the last step.
pub fn profiler(ui: &mut Ui, session: &mut Session) {
    let mut on = session.profile.is_some();
    if ui.checkbox(&mut on, "Measure steps").changed() {
        session.profile = on.then(Profile::default);
    }
    let Some(profile) = &session.profile else { return };
    let mean = profile.mean();
    if mean.steps == 0 {
        ui.label("Run to measure");
        return;
    }
    let whole = mean.whole();
    let mut rows = vec![("step", format!("{:9.2} µs", whole * 1e6))];
    rows.extend(Stage::ALL.iter().map(|&stage| {
        let seconds = mean.stages[stage as usize];
        (name(stage), format!("{:9.2} µs {:5.1} %", seconds * 1e6, 100.0 * seconds / whole))
    }));
    table(ui, "stages", rows);
    let lines = |ui: &mut Ui, id: &str, series: &[(&str, Value<'_>)]| {
        ui.label(id);
        Plot::new(id).height(120.0).legend(Legend::default()).show(ui, |plot| {
            for (name, value) in series {
                let points: PlotPoints<'_> =
                    profile.frames().enumerate().map(|(i, frame)| [i as f64, value(frame)]).collect();
                plot.line(Line::new(*name, points));
            }
        });
    };
    let part = |stages: &'static [Stage]| {
        move |frame: &Frame| stages.iter().map(|&stage| frame.stages[stage as usize]).sum::<f64>() * 1e6
    };
    lines(
        ui,
        "Time of a step, by frame [µs]",
        &[
            ("whole", &|frame: &Frame| frame.whole() * 1e6),
            ("collision", &part(&[Stage::Collision])),
            ("constraint", &part(&[Stage::Constraint, Stage::Islands])),
            ("solver", &part(&[Stage::Solver])),
        ],
    );
    lines(
        ui,
        "Sizes",
        &[
            ("contacts", &|frame: &Frame| frame.contacts as f64),
            ("rows", &|frame: &Frame| frame.rows as f64),
            ("iterations", &|frame: &Frame| frame.iterations as f64),
            ("islands", &|frame: &Frame| frame.islands as f64),
        ],
    );
    ui.label("Convergence of the last step, powers of ten");
    let gains = convergence(session.data());
    Plot::new("convergence").height(120.0).legend(Legend::default()).show(ui, |plot| {
        for (column, name) in ["improvement", "gradient"].into_iter().enumerate() {
            let points: PlotPoints<'_> =
                gains.iter().enumerate().map(|(i, gain)| [i as f64, gain[column]]).collect();
            plot.line(Line::new(name, points));
        }
    });
}

fn name(stage: Stage) -> &'static str {
    match stage {
        Stage::Checks => "checks",
        Stage::Kinematics => "kinematics",
        Stage::Tendons => "tendons",
        Stage::Inertia => "inertia",
        Stage::Collision => "collision",
        Stage::Constraint => "constraint",
        Stage::Islands => "islands",
        Stage::Transmission => "transmission",
        Stage::Velocity => "velocity",
        Stage::Actuation => "actuation",
        Stage::Acceleration => "acceleration",
        Stage::Solver => "solver",
        Stage::Sensors => "sensors",
        Stage::Integration => "integration",
    }
}
