//! scratch
use robohive_validation::{compile::compare_compiled, reference::Reference};
use std::time::Instant;
fn main() {
    let filter = std::env::args().nth(1).unwrap_or_default();
    let refs = std::env::args().nth(2).unwrap_or("/tmp/ref/npz".into());
    let root = std::env::args().nth(3).unwrap_or("/tmp/ref".into());
    let mut files: Vec<_> = std::fs::read_dir(&refs).unwrap().map(|e| e.unwrap().path()).collect();
    files.sort();
    let (mut ok, mut total) = (0, 0);
    for f in files {
        let stem = f.file_stem().unwrap().to_string_lossy().into_owned();
        if !stem.contains(&filter) {
            continue;
        }
        total += 1;
        let path = format!("{root}/{}.xml", stem.replace("__", "/"));
        let t = Instant::now();
        let loader = mjcf::loader::Loader::default().substitute("OBJECT_NAME", "airplane");
        let parsed = match loader.parse(&path) {
            Ok(p) => p,
            Err(e) => {
                println!(
                    "{stem}: PARSE {}",
                    e.errors().take(4).map(|d| d.to_string()).collect::<Vec<_>>().join(" | ")
                );
                continue;
            }
        };
        let mut d = mjcf::diagnostic::Diagnostics::default();
        let tp = t.elapsed().as_secs_f64();
        let Some(m) = mjcf::compile::compile(&parsed.spec, loader.provider(), &parsed.sources, &mut d) else {
            println!(
                "{stem}: COMPILE {}",
                d.errors().take(4).map(|d| d.to_string()).collect::<Vec<_>>().join(" | ")
            );
            continue;
        };
        let tc = t.elapsed().as_secs_f64();
        let reference = Reference::open(&f).unwrap();
        let theirs =
            reference.archive().require("compile_seconds").map(|a| a.values.to_f64()[0]).unwrap_or(f64::NAN);
        match compare_compiled(&m, &reference) {
            Ok(r) => {
                ok += usize::from(r.agrees());
                println!(
                    "{stem}: {} diff, {} excepted  parse {tp:.3} total {tc:.3} mujoco {theirs:.3}",
                    r.differences.len(),
                    r.excepted.len()
                );
                for w in r.differences.iter().take(14) {
                    println!("     {w}  err {:.2e}", w.error);
                }
                let mut sizes = String::new();
                m.visit_sizes(&mut |n, v| {
                    if let Ok(a) = reference.archive().require(&format!("size.{n}")) {
                        let b = a.values.to_f64()[0];
                        if b as i64 as usize != v && n != "nbuffer" && n != "narena" {
                            sizes += &format!(" {n}:{v}/{b}");
                        }
                    }
                });
                if !sizes.is_empty() {
                    println!("     sizes{sizes}");
                }
                if std::env::var_os("EXC").is_some() {
                    for w in &r.excepted {
                        println!("     exc {w}");
                    }
                }
            }
            Err(e) => println!("{stem}: REF {e}"),
        }
    }
    println!("{ok} of {total}");
}
