//! Random draws beside numpy's, which `reference/draws.py` recorded as digests.

mod kinds;

use kinds::{Family, families};
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The recorded digests, in this repository.
pub const RECORDED: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/reference/draws.txt");

/// What numpy drew of one kind.
struct Recorded {
    name: String,
    count: usize,
    /// The first words of the first seed.
    first: Vec<u64>,
    /// One for each seed.
    digests: Vec<u64>,
}

/// How many seeds of one kind drew as numpy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Agreement {
    /// Family and kind.
    pub name: String,
    /// Draws of one seed.
    pub count: usize,
    /// Seeds whose draws are numpy's to the last bit.
    pub equal: usize,
    /// Seeds compared.
    pub seeds: usize,
}

/// The parameters of the recorded file: seeds, and the rows of the kinds.
fn read(text: &str) -> Result<(Vec<u64>, Vec<Recorded>), String> {
    let number = |word: &str, base| u64::from_str_radix(word, base).map_err(|e| format!("{word:?}: {e}"));
    let list = |words: &str, base| -> Result<Vec<u64>, String> {
        words.split([' ', ',']).map(|word| number(word, base)).collect()
    };
    let seeds =
        text.lines().find_map(|line| line.strip_prefix("# seeds ")).ok_or("the line of seeds is missing")?;
    let row = |line: &str| {
        let mut columns = line.splitn(4, ' ');
        let mut column = || columns.next().ok_or_else(|| format!("{line:?} has too few columns"));
        Ok::<_, String>(Recorded {
            name: column()?.to_owned(),
            count: number(column()?, 10)? as usize,
            first: list(column()?, 16)?,
            digests: list(column()?, 16)?,
        })
    };
    let rows: Result<Vec<_>, _> = text.lines().filter(|line| !line.starts_with('#')).map(row).collect();
    Ok((list(seeds, 10)?, rows?))
}

/// The digest of `draws.py`: a sum of mixed words times powers of an odd number, modulo 2⁶⁴.
fn digest(draws: &[u64]) -> u64 {
    draws.iter().fold(0, |sum: u64, &draw| {
        let mixed = (draw ^ (draw >> 32)).wrapping_mul(0xd134_2543_de82_ef95);
        sum.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(mixed ^ (mixed >> 29))
    })
}

/// Draws every kind with the first `seeds` of the recorded seeds, and compares.
///
/// # Errors
/// A file that cannot be read, or does not record the same kinds.
pub fn compare(recorded: &Path, seeds: usize) -> Result<Vec<Agreement>, String> {
    let text = std::fs::read_to_string(recorded).map_err(|e| format!("{}: {e}", recorded.display()))?;
    let (all_seeds, rows) = read(&text).map_err(|e| format!("{}: {e}", recorded.display()))?;
    let families = families();
    let names = |wanted: Vec<&str>| wanted.join(" ");
    let (ours, theirs) = (
        names(families.iter().map(|f| f.name.as_str()).collect()),
        names(rows.iter().map(|r| r.name.as_str()).collect()),
    );
    if ours != theirs {
        return Err(format!(
            "{} records other kinds\n  {theirs}\nthan are drawn here\n  {ours}",
            recorded.display()
        ));
    }
    let seeds = &all_seeds[..seeds.min(all_seeds.len())];
    let (next, results) = (AtomicUsize::new(0), Mutex::new(vec![None; rows.len()]));
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, |n| n.get()) {
            scope.spawn(|| {
                while let Some(k) = Some(next.fetch_add(1, Ordering::Relaxed)).filter(|&k| k < rows.len()) {
                    let result = agreement(&families[k], &rows[k], seeds);
                    results.lock().unwrap_or_else(|e| e.into_inner())[k] = Some(result);
                }
            });
        }
    });
    let results = results.into_inner().unwrap_or_else(|e| e.into_inner());
    results.into_iter().map(|r| r.ok_or("a kind was not drawn".to_owned())?).collect()
}

fn agreement(family: &Family, row: &Recorded, seeds: &[u64]) -> Result<Agreement, String> {
    let mut equal = 0;
    for (k, (&seed, &expected)) in seeds.iter().zip(&row.digests).enumerate() {
        let draws = (family.draw)(seed).map_err(|e| format!("{}: {e}", row.name))?;
        if draws.len() != row.count || k == 0 && !draws.starts_with(&row.first) {
            continue;
        }
        equal += usize::from(digest(&draws) == expected);
    }
    Ok(Agreement { name: row.name.clone(), count: row.count, equal, seeds: seeds.len() })
}

/// The table of families, and an error that names the kinds that differ from numpy with any seed.
pub fn render(rows: &[Agreement]) -> (String, Result<(), String>) {
    let mut table = String::from(
        "| family | kinds of draws | draws compared | kinds equal with every seed |\n|---|---|---|---|\n",
    );
    let family = |row: &Agreement| row.name.split('.').next().unwrap_or_default().to_owned();
    for same in rows.chunk_by(|a, b| family(a) == family(b)) {
        let draws: usize = same.iter().map(|row| row.count * row.seeds).sum();
        let equal = same.iter().filter(|row| row.equal == row.seeds).count();
        table += &format!("| {} | {} | {draws} | {equal} |\n", family(&same[0]), same.len());
    }
    let wrong: Vec<_> =
        rows.iter().filter(|row| row.equal < row.seeds).map(|row| row.name.as_str()).collect();
    let verdict = if wrong.is_empty() {
        Ok(())
    } else {
        Err(format!("these draws differ from numpy's: {}", wrong.join(", ")))
    };
    (table, verdict)
}
