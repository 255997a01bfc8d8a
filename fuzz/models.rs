//! What targets do with a model: load it, write it, load it again, step it.

use mjcf::files::{Memory, Overlay};
use mjcf::{Limits, Loader};
use physics::{Data, Model, forward, step};

/// Loads a model; what loads is written, and what can be written loads again with the same arrays. The model; `None` where
/// it is refused.
pub(crate) fn come_back(files: Memory, path: &str) -> Option<Model> {
    let limits = Limits::default().with_copies(300).with_memory(64 << 20);
    let loader = Loader::default().files(files.clone()).limits(limits);
    let parsed = loader.parse(path).ok()?;
    let mut spec = parsed.spec.clone();
    let loaded = loader.compile(parsed).ok()?;
    assert!(loaded.model.nbody > 0);
    spec.settle_keys(&loaded.model);
    if spec.place_assets("").is_ok()
        && let Ok(text) = spec.to_xml()
    {
        let again = Loader::default().files(Overlay::new(files, path, text.as_bytes())).load(path);
        let again = again.unwrap_or_else(|findings| panic!("{findings}\n{text}"));
        // Numbers that are not alike come of numbers that are no numbers; sizes are alike.
        assert_eq!(
            (again.model.nq, again.model.nbody, again.model.ngeom),
            (loaded.model.nq, loaded.model.nbody, loaded.model.ngeom)
        );
    }
    Some(loaded.model)
}

/// Three steps of a model that asks for no more memory and iterations than take no time.
pub(crate) fn steps(mut m: Model) {
    if m.nsensordata.max(m.nhistory).max(m.na).max(m.nuserdata) > 1 << 12 {
        return;
    }
    let opt = m.options_mut();
    for count in
        [&mut opt.iterations, &mut opt.ls_iterations, &mut opt.noslip_iterations, &mut opt.ccd_iterations]
    {
        *count = (*count).min(50);
    }
    let mut d = Data::new(&m);
    d.state.ctrl.fill(0.5);
    for _ in 0..3 {
        if step(&m, &mut d).is_err() {
            break;
        }
    }
    let _ = forward(&m, &mut d);
}
