//! Recordings whose process is killed at a random moment: no trial that was finished is lost.
//!
//! Without a harness, so that the program can be its own victim: `crash record FILE` records trials without end and says
//! after each that it is finished. `crash [KILLS] [--keep FOLDER]` kills such processes and reads what they leave; a kept
//! recording has beside it, in JSON, how many trials were finished.

use robohive_dataset::trace::{Layout, Precision, Recorder, TraceReader};
use std::error::Error;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

/// Recordings killed unless a number is given.
const KILLS: usize = 10;

/// Height and width of an image: a row has more bytes than a chunk of numbers.
const IMAGE: [usize; 3] = [120, 200, 3];

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let outcome = match words[..] {
        ["record", path] => record(Path::new(path)),
        [] => kill(KILLS, None),
        [kills] if kills.parse::<usize>().is_ok() => kill(kills.parse().unwrap_or(KILLS), None),
        [kills, "--keep", folder] => kill(kills.parse().unwrap_or(KILLS), Some(folder.into())),
        // Flags of the usual harness, as in `cargo test -- --list`.
        _ => Ok(()),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// Rows of a trial; they differ, so that there are trials of one chunk and of several.
fn rows(trial: usize) -> usize {
    3 + 7 * (trial % 5)
}

/// Records trials until the process ends.
fn record(path: &Path) -> Result<(), Box<dyn Error>> {
    let mut recorder = Recorder::create(path, Layout::RoboHive, Precision::Full)?;
    let mut out = std::io::stdout();
    for number in 0.. {
        let mut trial = recorder.begin(&format!("Trial{number}"))?;
        for row in 0..rows(number) {
            let time = number as f64 + 0.01 * row as f64;
            trial.push("time", &[], &[time])?;
            trial.push("env_infos/obs_dict/qp", &[30], &[time; 30])?;
            trial.push("env_infos/solved", &[], &[row > 2])?;
            trial.push("image", &IMAGE, &vec![row as u8; IMAGE.iter().product()])?;
        }
        trial.finish()?;
        // One byte a trial: what was said is what was finished.
        out.write_all(b".")?;
        out.flush()?;
    }
    Ok(())
}

fn kill(kills: usize, keep: Option<PathBuf>) -> Result<(), Box<dyn Error>> {
    let folder = keep.clone().unwrap_or_else(|| Path::new(env!("CARGO_TARGET_TMPDIR")).join("crash"));
    std::fs::create_dir_all(&folder)?;
    // Moments differ from run to run; the test holds at all of them.
    let mut random = SystemTime::now().duration_since(UNIX_EPOCH)?.as_nanos() as u64 | 1;
    let (mut finished, mut found) = (0, 0);
    let mut killed = 0;
    while killed < kills {
        let path = folder.join(format!("{killed}.h5"));
        _ = std::fs::remove_file(&path);
        let mut child =
            Command::new(std::env::current_exe()?).arg("record").arg(&path).stdout(Stdio::piped()).spawn()?;
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        // In a quarter of the runs the moments in which the file is made; a run that is killed before that does not count.
        let most = if killed % 4 == 0 { 10_000 } else { 250_000 };
        std::thread::sleep(Duration::from_micros((random >> 33) % most));
        child.kill()?;
        child.wait()?;
        let mut said = Vec::new();
        child.stdout.take().ok_or("no pipe")?.read_to_end(&mut said)?;
        finished += said.len();
        if !path.exists() && said.is_empty() {
            continue;
        }
        killed += 1;
        found += check(&path, said.len())?;
        match keep {
            Some(_) => {
                std::fs::write(path.with_extension("json"), format!("{{\"finished\": {}}}", said.len()))?
            }
            None => std::fs::remove_file(&path)?,
        }
    }
    println!(
        "{kills} recordings killed: {finished} trials were finished, {found} are in the files, 0 are lost"
    );
    if finished == 0 { Err("no trial was finished before its process was killed".into()) } else { Ok(()) }
}

/// Reads a recording with `finished` finished trials, and returns how many it has.
fn check(path: &Path, finished: usize) -> Result<usize, Box<dyn Error>> {
    let trace = TraceReader::open(path)?;
    let trials = trace.trials().len();
    // One more may be in the file: the process was killed before it could report it.
    if !(finished..=finished + 1).contains(&trials) {
        return Err(format!("{}: {finished} trials were finished, {trials} are there", path.display()).into());
    }
    for number in 0..trials {
        let name = format!("Trial{number}");
        let time = trace.read(&trace.entry(&name, "time")?)?.values.to_f64();
        let expected: Vec<f64> = (0..rows(number)).map(|row| number as f64 + 0.01 * row as f64).collect();
        let image = trace.read(&trace.entry(&name, "image")?)?;
        let rows = (0..rows(number)).flat_map(|row| vec![row as f64; IMAGE.iter().product()]);
        if time != expected || !image.values.to_f64().into_iter().eq(rows) || trace.entries(&name)?.len() != 4
        {
            return Err(format!("{}, {name}: not what was recorded", path.display()).into());
        }
    }
    Ok(trials)
}
