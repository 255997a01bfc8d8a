//! Recorded constraint problems (`reference/solver.py`): our solvers from MuJoCo's inputs, beside its solutions.

use crate::reference::{Reference, ReferenceError};
use crate::tolerance::{COST_BAR, ITERATIONS_SHARE, STATISTIC_ABSOLUTE, STATISTIC_RELATIVE};
use dataset::NpzReader;
use physics::constraint::{IslandScratch, find_islands};
use physics::data::SolverStat;
use physics::inertia::mul_inertia_matrix;
use physics::model::{Cone, ConstraintType, Disable, Solver};
use physics::solver::{SolverInputs, SolverScratch, solve};
use physics::{Data, Model};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Solvers in the order in which they are recorded.
pub const SOLVERS: [Solver; 3] = [Solver::Pgs, Solver::Cg, Solver::Newton];
/// Friction cones in the order of their codes.
pub const CONES: [Cone; 2] = [Cone::Pyramidal, Cone::Elliptic];

/// Outcome of one solver with one kind of cone.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// Problems solved.
    pub problems: usize,
    /// Problems whose cost is not higher than MuJoCo's, up to the tolerance.
    pub not_higher: usize,
    /// Largest excess of our cost, relative to MuJoCo's.
    pub worst_excess: f64,
    /// Problems in which every island takes as many iterations, give or take one.
    pub within_one: usize,
    /// Problems in which every island takes as many iterations.
    pub equal_counts: usize,
    /// Problems in which every iteration has the same statistics (`SolverStat`).
    pub equal_statistics: usize,
    /// Problems with the same `qacc` to the last bit.
    pub bit_equal: usize,
    /// Largest difference of a `qacc`, relative to its largest component.
    pub worst_qacc: f64,
    /// The problem of the largest excess: archive and number.
    pub worst: (String, usize),
}

impl Tally {
    /// The bars: no cost is higher, and iteration counts agree.
    pub fn passes(&self) -> bool {
        self.problems > 0
            && self.not_higher == self.problems
            && self.within_one as f64 >= ITERATIONS_SHARE * self.problems as f64
    }

    fn add(&mut self, other: &Tally) {
        self.problems += other.problems;
        self.not_higher += other.not_higher;
        self.within_one += other.within_one;
        self.equal_counts += other.equal_counts;
        self.equal_statistics += other.equal_statistics;
        self.bit_equal += other.bit_equal;
        self.worst_qacc = self.worst_qacc.max(other.worst_qacc);
        if other.worst_excess > self.worst_excess {
            (self.worst_excess, self.worst) = (other.worst_excess, other.worst.clone());
        }
    }
}

/// All variants, `[solver][cone]`, and how many problems have each feature.
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    /// One tally for each solver and cone.
    pub tallies: [[Tally; 2]; 3],
    /// Features and the number of recorded problems that have them, for each kind of cone.
    pub features: BTreeMap<&'static str, [usize; 2]>,
}

/// One archive of problems, read once.
struct Problems {
    arrays: BTreeMap<String, (usize, Vec<f64>)>,
}

impl Problems {
    fn open(path: &Path) -> Result<Self, ReferenceError> {
        let archive = NpzReader::open(path)?;
        let mut arrays = BTreeMap::new();
        for name in archive.names() {
            let array = archive.require(name)?;
            let width = array.shape.iter().skip(1).product();
            arrays.insert(name.to_owned(), (width, array.values.to_f64()));
        }
        Ok(Problems { arrays })
    }

    /// Rows `rows` of an array, flat.
    fn rows(&self, name: &str, rows: std::ops::Range<usize>) -> Result<&[f64], ReferenceError> {
        self.arrays
            .get(name)
            .and_then(|(width, values)| values.get(rows.start * width..rows.end * width))
            .ok_or_else(|| ReferenceError::Shape(name.to_owned()))
    }

    fn row(&self, name: &str, row: usize) -> Result<&[f64], ReferenceError> {
        self.rows(name, row..row + 1)
    }

    fn count(&self, name: &str, problem: usize) -> Result<usize, ReferenceError> {
        Ok(self.row(&format!("count.{name}"), problem)?[0] as usize)
    }

    fn number(&self) -> usize {
        self.arrays.get("problem.cone").map_or(0, |(_, values)| values.len())
    }
}

/// Where the concatenated arrays of a problem begin.
#[derive(Clone, Copy, Default)]
struct Place {
    contact: usize,
    row: usize,
    entry: usize,
    statistics: usize,
}

/// Solves every problem of an archive with every solver.
///
/// # Errors
/// The archive is damaged or does not fit the model.
pub fn solve_archive(m: &mut Model, path: &Path) -> Result<Outcome, ReferenceError> {
    let problems = Problems::open(path)?;
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let mut out = Outcome::default();
    let mut place = Place::default();
    let mut scratch = SolverScratch::default();
    for k in 0..problems.number() {
        let start = inject(m, &problems, k, &mut place)?;
        let cone = usize::from(m.opt.cone == Cone::Elliptic);
        for feature in features(m, &start) {
            out.features.entry(feature).or_default()[cone] += 1;
        }
        let qacc = problems.row("solved.qacc", k)?;
        let niter = problems.row("solved.solver_niter", k)?;
        for (s, solver) in SOLVERS.into_iter().enumerate() {
            m.options_mut().solver = solver;
            let mut d = start.clone();
            let Data { state, inertia, con, efc, island, acc, solver, .. } = &mut d;
            solve(
                SolverInputs { m, state, inertia, effective: None, con, island },
                efc,
                acc,
                solver,
                &mut scratch,
            );
            let counts = niter.len() / SOLVERS.len();
            let theirs = &qacc[s * m.nv..(s + 1) * m.nv];
            let first = place.statistics;
            place.statistics += problems.row("count.statistics", k)?[s] as usize;
            let statistics = problems.rows("statistics", first..place.statistics)?;
            let mut tally = judge(m, &d, theirs, &niter[s * counts..(s + 1) * counts], statistics);
            tally.worst = (name.clone(), k);
            out.tallies[s][cone].add(&tally);
        }
    }
    Ok(out)
}

/// Sets the options of problem `k` and returns the solver's inputs; `place` moves on to the next problem.
fn inject(m: &mut Model, p: &Problems, k: usize, place: &mut Place) -> Result<Data, ReferenceError> {
    let option = |name: &str| Ok::<i32, ReferenceError>(p.row(name, k)?[0] as i32);
    let cone = option("problem.cone")?;
    m.options_mut().cone =
        Cone::from_code(cone).ok_or_else(|| ReferenceError::Shape("problem.cone".into()))?;
    m.options_mut().noslip_iterations = option("problem.noslip_iterations")?;
    m.options_mut().disableflags = Disable::from_bits(option("problem.disableflags")?);
    let mut d = Data::new(m);
    let mut set = |name: &str, values: &[f64]| match d.assign(name, values) {
        Some(true) => Ok(()),
        _ => Err(ReferenceError::Shape(name.to_owned())),
    };
    for name in ["qacc_warmstart", "qacc_smooth", "qfrc_smooth", "M", "qLD", "qLDiagInv"] {
        set(name, p.row(&format!("problem.{name}"), k)?)?;
    }
    let at = *place;
    let (contacts, rows, entries) = (p.count("ncon", k)?, p.count("nefc", k)?, p.count("entries", k)?);
    *place = Place { contact: at.contact + contacts, row: at.row + rows, entry: at.entry + entries, ..at };
    if contacts > 0 {
        for name in ["dim", "geom", "friction", "mu", "exclude", "efc_address"] {
            let name = format!("contact.{name}");
            set(&name, p.rows(&name, at.contact..place.contact)?)?;
        }
    }
    for name in ["type", "id", "frictionloss", "diagA", "D", "R", "aref", "J_rownnz"] {
        let name = format!("efc_{name}");
        set(&name, p.rows(&name, at.row..place.row)?)?;
    }
    for name in ["efc_J_colind", "efc_J"] {
        set(name, p.rows(name, at.entry..place.entry)?)?;
    }
    d.efc.efc_J_rowadr =
        d.efc.efc_J_rownnz.iter().scan(0, |sum, n| Some(std::mem::replace(sum, *sum + n))).collect();
    (d.efc.ne, d.efc.nf, d.efc.nl, d.efc.nefc) =
        (p.count("ne", k)?, p.count("nf", k)?, p.count("nl", k)?, rows);
    find_islands(m, &d.state, &d.con, &d.efc, &mut d.island, &mut IslandScratch::default());
    if d.island.nisland != p.count("nisland", k)? {
        return Err(ReferenceError::Shape("nisland".into()));
    }
    Ok(d)
}

/// What a problem contains, for the table of features.
fn features(m: &Model, d: &Data) -> Vec<&'static str> {
    let dim = |n: i32| d.con.contact.iter().any(|c| c.efc_address >= 0 && c.dim == n);
    let tendons = [ConstraintType::FrictionTendon, ConstraintType::LimitTendon].map(ConstraintType::code);
    [
        ("contacts without friction", dim(1)),
        ("contacts of dimension 3", dim(3)),
        ("contacts of dimension 4", dim(4)),
        ("contacts of dimension 6", dim(6)),
        ("equality rows", d.efc.ne > 0),
        ("friction loss", d.efc.nf > 0),
        ("limits", d.efc.nl > 0),
        ("tendon rows", d.efc.efc_type.iter().any(|t| tendons.contains(t))),
        ("equality, friction loss, limits and contacts at once", {
            d.efc.ne.min(d.efc.nf).min(d.efc.nl) > 0 && d.con.contact.iter().any(|c| c.efc_address >= 0)
        }),
        ("several islands", d.island.nisland > 1),
        ("islands off", m.opt.disableflags.contains(Disable::ISLAND)),
        ("cold start", m.opt.disableflags.contains(Disable::WARMSTART)),
        ("removal of slip", m.opt.noslip_iterations > 0),
        ("removal of slip, several islands", m.opt.noslip_iterations > 0 && d.island.nisland > 1),
        ("sparse storage", m.is_sparse()),
    ]
    .into_iter()
    .filter_map(|(name, present)| present.then_some(name))
    .collect()
}

/// True when the recorded rows, seven numbers each, are ours: counts equal, the scaled reals within the tolerance.
fn equal_statistics(ours: &[SolverStat], theirs: &[f64]) -> bool {
    let near = |a: f64, b: f64| (a - b).abs() <= STATISTIC_RELATIVE * b.abs() + STATISTIC_ABSOLUTE;
    ours.len() * 7 == theirs.len()
        && ours.iter().zip(theirs.chunks_exact(7)).all(|(a, b)| {
            let reals = [a.improvement, a.gradient, a.lineslope];
            let counts = [a.nactive, a.nchange, a.neval, a.nupdate].map(f64::from);
            reals.iter().zip(b).all(|(a, b)| near(*a, *b)) && counts == b[3..]
        })
}

/// Compares one solution with MuJoCo's.
fn judge(m: &Model, d: &Data, qacc: &[f64], niter: &[f64], statistics: &[f64]) -> Tally {
    let [ours, theirs] = [&d.acc.qacc[..], qacc].map(|qacc| cost(m, d, qacc));
    let excess = if ours > theirs { (ours - theirs) / theirs } else { 0.0 };
    let scale = qacc.iter().fold(0.0, |s: f64, x| s.max(x.abs()));
    let difference = d.acc.qacc.iter().zip(qacc).fold(0.0, |e: f64, (a, b)| e.max((a - b).abs()));
    let apart = niter
        .iter()
        .enumerate()
        .map(|(k, n)| (f64::from(*d.solver.solver_niter.get(k).unwrap_or(&0)) - n).abs())
        .fold(0.0, f64::max);
    Tally {
        problems: 1,
        not_higher: usize::from(excess <= COST_BAR),
        worst_excess: excess,
        within_one: usize::from(apart <= 1.0),
        equal_counts: usize::from(apart == 0.0),
        equal_statistics: usize::from(equal_statistics(&d.solver.solver, statistics)),
        bit_equal: usize::from(d.acc.qacc == qacc),
        worst_qacc: if difference > 0.0 { difference / scale } else { 0.0 },
        worst: Default::default(),
    }
}

/// The cost that the constraint solver minimises, at acceleration `qacc`: half the squared distance from the
/// unconstrained acceleration in the metric of the inertia, and the cost of each row (documentation: Computation,
/// "Primal problem"). Written apart from the solver, as the judge of it.
pub fn cost(m: &Model, d: &Data, qacc: &[f64]) -> f64 {
    let change: Vec<f64> = qacc.iter().zip(&d.acc.qacc_smooth).map(|(a, b)| a - b).collect();
    let mut force = vec![0.0; m.nv];
    mul_inertia_matrix(m, &d.inertia.M, &change, &mut force);
    let gauss: f64 = change.iter().zip(&force).map(|(a, b)| 0.5 * a * b).sum();
    let efc = &d.efc;
    let residual: Vec<f64> = (0..efc.nefc)
        .map(|i| {
            let start = efc.efc_J_rowadr[i] as usize;
            let row = start..start + efc.efc_J_rownnz[i] as usize;
            row.map(|e| efc.efc_J[e] * qacc[efc.efc_J_colind[e] as usize]).sum::<f64>() - efc.efc_aref[i]
        })
        .collect();
    gauss + (0..efc.nefc).map(|i| row_cost(d, &residual, i)).sum::<f64>()
}

/// Cost of row `i`; an elliptic cone's cost stands at its first row.
fn row_cost(d: &Data, residual: &[f64], i: usize) -> f64 {
    let (efc, x) = (&d.efc, residual[i]);
    let square = 0.5 * efc.efc_D[i] * x * x;
    match ConstraintType::from_code(efc.efc_type[i]) {
        Some(ConstraintType::Equality) => square,
        Some(ConstraintType::FrictionDof | ConstraintType::FrictionTendon) => {
            let (loss, bound) = (efc.efc_frictionloss[i], efc.efc_R[i] * efc.efc_frictionloss[i]);
            if x.abs() < bound { square } else { loss * (x.abs() - 0.5 * bound) }
        }
        Some(ConstraintType::ContactElliptic) => cone_cost(d, residual, i),
        _ => {
            if x < 0.0 {
                square
            } else {
                0.0
            }
        }
    }
}

fn cone_cost(d: &Data, residual: &[f64], i: usize) -> f64 {
    let contact = &d.con.contact[d.efc.efc_id[i] as usize];
    let (first, dim) = (contact.efc_address as usize, contact.dim as usize);
    if i != first {
        return 0.0;
    }
    let mu = contact.mu;
    let normal = residual[first] * mu;
    let tangent =
        (1..dim).map(|j| (residual[first + j] * contact.friction[j - 1]).powi(2)).sum::<f64>().sqrt();
    if normal >= mu * tangent {
        0.0
    } else if mu * normal + tangent <= 0.0 {
        (first..first + dim).map(|j| 0.5 * d.efc.efc_D[j] * residual[j] * residual[j]).sum()
    } else {
        let mass = d.efc.efc_D[first] / (mu * mu * (1.0 + mu * mu));
        0.5 * mass * (normal - mu * tangent).powi(2)
    }
}

/// Solves every archive of `problems`; the models are in `references`, or among our own. Returns the table, and as
/// verdict an error that names the variants short of the bars.
///
/// # Errors
/// A folder or an archive cannot be read.
pub fn measure(
    problems: &Path,
    references: &Path,
    only: &str,
) -> Result<(String, Result<(), String>), String> {
    let text = |e: &dyn std::fmt::Display, path: &Path| format!("{}: {e}", path.display());
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference/own");
    let entries = std::fs::read_dir(problems).map_err(|e| text(&e, problems))?;
    let mut paths: Vec<PathBuf> = entries.filter_map(|e| Some(e.ok()?.path())).collect();
    paths.sort();
    let mut total = Outcome::default();
    for path in paths.iter().filter(|p| p.to_string_lossy().contains(only)) {
        let file = path.file_name().unwrap_or_default();
        let [near, far] = [own.join(file), references.join(file)];
        let model = Reference::open(if near.exists() { &near } else { &far }).and_then(|r| r.model());
        let mut m = model.map_err(|e| text(&e, path))?;
        let outcome = solve_archive(&mut m, path).map_err(|e| text(&e, path))?;
        println!("{}: {}", path.display(), summary(&outcome));
        total.add(&outcome);
    }
    let short: Vec<String> = variants(&total).filter(|(_, t)| !t.passes()).map(|(name, _)| name).collect();
    let verdict =
        if short.is_empty() { Ok(()) } else { Err(format!("short of the bars: {}", short.join(", "))) };
    Ok((render(&total), verdict))
}

impl Outcome {
    fn add(&mut self, other: &Outcome) {
        for (sum, more) in self.tallies.iter_mut().flatten().zip(other.tallies.iter().flatten()) {
            sum.add(more);
        }
        for (feature, counts) in &other.features {
            let sum = self.features.entry(feature).or_default();
            (0..2).for_each(|cone| sum[cone] += counts[cone]);
        }
    }
}

fn variants(o: &Outcome) -> impl Iterator<Item = (String, &Tally)> {
    o.tallies.iter().zip(SOLVERS).flat_map(|(row, solver)| {
        row.iter()
            .zip(CONES)
            .map(move |(tally, cone)| (format!("{solver:?}, {cone:?}").to_lowercase(), tally))
    })
}

fn summary(o: &Outcome) -> String {
    let one = |(name, t): (String, &Tally)| {
        format!(
            "[{name}: {} {} {:.0e} {} {} {:.0e}]",
            t.problems, t.not_higher, t.worst_excess, t.within_one, t.bit_equal, t.worst_qacc
        )
    };
    variants(o).map(one).collect::<Vec<_>>().join(" ")
}

fn render(o: &Outcome) -> String {
    let mut text = String::from(
        "| solver, cone | problems | cost not higher | worst excess | iterations within one | equal | equal statistics | bit-equal `qacc` | worst `qacc` difference |\n|---|---|---|---|---|---|---|---|---|\n",
    );
    for (name, t) in variants(o) {
        let share = |n: usize| format!("{:.2} %", 100.0 * n as f64 / t.problems.max(1) as f64);
        let _ = writeln!(
            text,
            "| {name} | {} | {} | {:.0e} | {} | {} | {} | {} | {:.0e} |",
            t.problems,
            share(t.not_higher),
            t.worst_excess,
            share(t.within_one),
            share(t.equal_counts),
            share(t.equal_statistics),
            share(t.bit_equal),
            t.worst_qacc
        );
    }
    text.push_str("\n| problems with | pyramidal | elliptic |\n|---|---|---|\n");
    for (feature, [pyramidal, elliptic]) in &o.features {
        let _ = writeln!(text, "| {feature} | {pyramidal} | {elliptic} |");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever way it is nudged, MuJoCo's Newton solution costs more, and the judge says so.
    #[test]
    fn cost_is_least_at_the_solution() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference");
        let mut m = Reference::open(&folder.join("own/workbench.npz")).unwrap().model().unwrap();
        let problems = Problems::open(&folder.join("solver/workbench.npz")).unwrap();
        let mut place = Place::default();
        let mut nudged = 0;
        for k in 0..problems.number() {
            let mut d = inject(&mut m, &problems, k, &mut place).unwrap();
            if m.opt.noslip_iterations > 0 {
                continue;
            }
            let newton = &problems.row("solved.qacc", k).unwrap()[2 * m.nv..];
            let scale = newton.iter().fold(1.0, |s: f64, x| s.max(x.abs()));
            for dof in 0..m.nv {
                for step in [-1e-3, 1e-3] {
                    d.acc.qacc.copy_from_slice(newton);
                    d.acc.qacc[dof] += step * scale;
                    let tally = judge(&m, &d, newton, &[], &[]);
                    assert_eq!(tally.not_higher, 0, "problem {k}, degree of freedom {dof}: {tally:?}");
                    nudged += 1;
                }
            }
        }
        assert!(nudged > 100);
    }
}
