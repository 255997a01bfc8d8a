//! Instructions of one step, counted by valgrind: a measure of speed that does not depend on the machine's load.
//! A rise over the recorded count fails.

use crate::builds::{STATIC_TARGET, static_programs};
use crate::command::{compiler, installed, output};
use crate::outcome::{Missing, Outcome};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;
use std::process::Command;

/// What decides the counts.
pub const INPUTS: &[&str] = &["src/physics", "mjcf", "src/cli", "assets", "benches/instructions.txt"];

/// What is stepped: a name, the model and controls of an asset, and what stands in its text for another.
struct Case {
    name: &'static str,
    asset: &'static str,
    define: Option<&'static str>,
}

static CASES: [Case; 8] = [
    Case { name: "franka_table", asset: "franka/franka_table", define: None },
    Case { name: "elbow", asset: "elbow/elbow", define: None },
    Case { name: "quadruped", asset: "quadruped/quadruped", define: None },
    Case { name: "humanoid", asset: "humanoid/humanoid", define: None },
    Case { name: "pile", asset: "pile/pile", define: None },
    Case { name: "workbench", asset: "workbench/workbench", define: None },
    Case {
        name: "humanoid_implicitfast_elliptic",
        asset: "humanoid/humanoid",
        define: Some("timestep=integrator=\"implicitfast\" cone=\"elliptic\" timestep"),
    },
    Case { name: "pile_pgs", asset: "pile/pile", define: Some("timestep=solver=\"PGS\" timestep") },
];

/// The steps counted are those after the first number, up to the second.
const STEPS: [u64; 2] = [150, 350];
/// A rise by more than this part fails.
const TOLERANCE: f64 = 0.03;
const FILE: &str = "benches/instructions.txt";

/// Counts, prints the table, and compares with the recorded counts, or records these instead.
pub fn run(update: bool) -> Outcome {
    let missing =
        |what: &str, get: &str| Ok(vec![Missing::new(format!("instructions of a step ({what})"), get)]);
    if !installed("valgrind") {
        return missing("valgrind is not installed", "install valgrind, https://valgrind.org");
    }
    let Some(folder) = static_programs()? else {
        return missing("they are those of a static build", &format!("run on {STATIC_TARGET}"));
    };
    let counted = count(&folder.join("robohive"))?;
    let recorded = std::fs::read_to_string(FILE).unwrap_or_default();
    let before = parse(&recorded)?;
    let mut risen = Vec::new();
    println!("{:32} {:>10} {:>10} {:>8}", "instructions of a step", "recorded", "now", "change");
    for case in &CASES {
        let now = counted[case.name];
        let Some(&old) = before.get(case.name) else {
            println!("{:32} {:>10} {now:>10}", case.name, "-");
            risen.push(case.name);
            continue;
        };
        let change = now as f64 / old as f64 - 1.0;
        println!("{:32} {old:>10} {now:>10} {:>+7.2} %", case.name, 100.0 * change);
        if change > TOLERANCE {
            risen.push(case.name);
        }
    }
    if update {
        let text = format(&counted)?;
        return std::fs::write(FILE, text).map(|()| Vec::new()).map_err(|e| format!("{FILE}: {e}"));
    }
    let arch = std::env::consts::ARCH;
    if !recorded.contains(arch) {
        return missing(
            "those recorded are of another kind of processor",
            "run on the processor that the file names",
        );
    }
    if risen.is_empty() {
        return Ok(Vec::new());
    }
    let compiler = compiler()?;
    Err(format!(
        "instructions of {} rose by more than {} %, or are not recorded; this is {compiler}. If that is meant: cargo xtask instructions --update",
        risen.join(", "),
        100.0 * TOLERANCE
    ))
}

/// Counts all cases, on all cores.
fn count(binary: &Path) -> Result<BTreeMap<&'static str, u64>, String> {
    let counts = std::thread::scope(|scope| {
        let cores = std::thread::available_parallelism().map_or(1, |cores| cores.get());
        let parts = CASES.chunks(CASES.len().div_ceil(cores));
        let work = |part: &'static [Case]| part.iter().map(|case| per_step(binary, case)).collect::<Vec<_>>();
        let threads: Vec<_> = parts.map(|part| scope.spawn(move || work(part))).collect();
        threads.into_iter().map(|thread| thread.join()).collect::<Result<Vec<_>, _>>()
    });
    let counts = counts.map_err(|_| "a thread that counts ended")?.concat();
    CASES.iter().zip(counts).map(|(case, count)| Ok((case.name, count?))).collect()
}

/// Instructions of one step: what a longer run executes beyond a shorter one, so that loading cancels.
fn per_step(binary: &Path, case: &Case) -> Result<u64, String> {
    let [few, many] = STEPS;
    Ok((collected(binary, case, many)? - collected(binary, case, few)?) / (many - few))
}

/// Instructions of a whole run.
fn collected(binary: &Path, case: &Case, steps: u64) -> Result<u64, String> {
    let stem = case.asset.rsplit('/').next().unwrap_or_default();
    let mut command = Command::new("valgrind");
    command.args(["--tool=callgrind", "--callgrind-out-file=/dev/null"]).arg(binary);
    command.args(["bench", &format!("assets/{}.xml", case.asset), "--steps", &steps.to_string()]);
    command.args(["--hold", "25", "--controls", &format!("validation/reference/own/{stem}.npz")]);
    command.args(case.define.iter().flat_map(|text| ["--define", text]));
    // The C library picks its copying loops by processor: the plain ones everywhere.
    command.env("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2,-AVX_Fast_Unaligned_Load,-ERMS,-FSRM");
    let (_, stderr) = output(&mut command)?;
    let found = stderr.lines().find_map(|line| line.split_once("Collected : ")?.1.trim().parse().ok());
    found.ok_or_else(|| format!("valgrind collected nothing for {}", case.name))
}

/// Names and counts of the file.
fn parse(text: &str) -> Result<BTreeMap<&str, u64>, String> {
    let rows = text.lines().filter(|line| !line.starts_with('#'));
    rows.map(|line| {
        let row = line.split_once(' ').and_then(|(name, count)| Some((name, count.trim().parse().ok()?)));
        row.ok_or_else(|| format!("{FILE}: {line:?} is not a name and a count"))
    })
    .collect()
}

fn format(counted: &BTreeMap<&str, u64>) -> Result<String, String> {
    let mut text = format!(
        "# Instructions of one step, recorded by `cargo xtask instructions --update`: {}, {}.\n",
        compiler()?,
        std::env::consts::ARCH
    );
    for case in &CASES {
        let _ = writeln!(text, "{:32} {:>9}", case.name, counted[case.name]);
    }
    Ok(text)
}
