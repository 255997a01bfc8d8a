//! Edits of a compiled model: what follows is recomputed, caches cannot go stale, and what would break it is refused.

mod models;
mod state;

use models::assets;
use robohive::physics::model::{Draft, EditError, ObjType};
use robohive::physics::table::Slice;
use robohive::physics::{Data, Model, step};
use state::bits;

fn load(name: &str) -> Model {
    let path = format!("{}/assets/{name}.xml", env!("CARGO_MANIFEST_DIR"));
    robohive::mjcf::load(&path).unwrap().model
}

#[test]
fn an_edit_of_nothing_changes_no_byte() {
    for (name, mut m) in assets() {
        let before = m.to_bytes();
        m.edit(|_| ()).unwrap();
        assert!(m.to_bytes() == before, "{name}");
    }
}

#[test]
fn what_follows_from_masses_is_recomputed() {
    let mut m = load("elbow/elbow");
    let (before, body) = (m.clone(), m.nbody - 1);
    m.edit(|m| {
        m.body_mass[body] *= 3.0;
        m.body_inertia[body].iter_mut().for_each(|moment| *moment *= 3.0);
    })
    .unwrap();
    assert!(
        (m.body_subtreemass[0] - before.body_subtreemass[0] - 2.0 * before.body_mass[body]).abs() < 1e-12
    );
    assert!(m.dof_invweight0[m.nv - 1] < 0.9 * before.dof_invweight0[m.nv - 1]);
    assert!(m.stat.meaninertia > before.stat.meaninertia);
    m.edit(|m| {
        m.body_mass[body] = before.body_mass[body];
        m.body_inertia[body] = before.body_inertia[body];
    })
    .unwrap();
    assert!(m.to_bytes() == before.to_bytes(), "an edit is undone by its inverse");
}

#[test]
fn statistics_that_the_file_or_the_edit_gives_are_kept() {
    let text = "<mujoco><statistic meanmass='7'/><worldbody><body><freejoint/><geom size='.1'/></body></worldbody></mujoco>";
    let mut m = robohive::mjcf::load_str(text).unwrap().model;
    let inertia = m.stat.meaninertia;
    m.edit(|m| m.body_mass[1] *= 2.0).unwrap();
    assert_eq!(m.stat.meanmass, 7.0);
    assert!(m.stat.meaninertia > inertia);
    m.edit(|m| m.stat.meaninertia = 0.25).unwrap();
    m.edit(|m| m.body_mass[1] *= 2.0).unwrap();
    assert_eq!((m.stat.meanmass, m.stat.meaninertia), (7.0, 0.25));
}

fn refused(m: &Model, change: impl FnOnce(&mut Draft<'_>)) -> EditError {
    let (mut edited, before) = (m.clone(), m.to_bytes());
    let error = edited.edit(change).unwrap_err();
    assert!(edited.to_bytes() == before, "{error}: the model changed");
    error
}

#[test]
fn what_would_break_the_model_is_refused_and_named() {
    let m = load("quadruped/quadruped");
    let nv = m.nv;
    assert_eq!(refused(&m, |m| m.nv += 1), EditError::Size { field: "nv", expected: nv, found: nv + 1 });
    assert_eq!(refused(&m, |m| m.nv += 1).to_string().matches("compile another model").count(), 1);
    let error = refused(&m, |m| m.body_pos[2][1] = f64::NAN);
    assert_eq!(error, EditError::NotANumber { field: "body_pos", index: 7 });
    let error = refused(&m, |m| m.geom_bodyid[3] = 1000);
    assert!(matches!(error, EditError::Inconsistent(what) if what.array == "geom_bodyid"));
    assert!(matches!(refused(&m, |m| m.actuator_gaintype[0] = 77), EditError::NotSimulated(_)));
}

/// Every array with one number replaced: refused, or stepped without a panic.
#[test]
fn whatever_an_edit_writes_is_refused_or_can_be_stepped() {
    let m = load("workbench/workbench");
    let mut arrays = Vec::new();
    m.visit(&mut |name, _, values| arrays.push((name, values.to_f64(), values.is_float())));
    let (mut refused, mut stepped) = (0, 0);
    for (name, values, float) in arrays.iter().filter(|(_, values, _)| !values.is_empty()) {
        for number in if *float { [-1.0, 1e300] } else { [-1.0, 17.0] } {
            let (mut edited, mut values) = (m.clone(), values.clone());
            let middle = values.len() / 2;
            values[middle] = number;
            if edited.edit(|m| assert_eq!(m.assign(name, &values), Some(true))).is_err() {
                refused += 1;
                continue;
            }
            let mut d = Data::new(&edited);
            d.state.ctrl.fill(0.5);
            _ = step(&edited, &mut d).and_then(|()| step(&edited, &mut d));
            stepped += 1;
        }
    }
    assert!(refused > 100 && stepped > 200, "{refused} {stepped}");
}

#[test]
fn hulls_and_names_follow_an_edit() {
    let mut m = load("workbench/workbench");
    let mut d = Data::new(&m);
    (0..20).for_each(|_| step(&m, &mut d).unwrap());
    let joint = (0..m.njnt).find(|&j| !m.name_of(ObjType::Joint, j).is_empty()).unwrap();
    let name = m.name_of(ObjType::Joint, joint).to_owned();
    assert_eq!(m.id_of(ObjType::Joint, &name), Some(joint));
    assert!(m.nmeshvert > 0 && m.mesh_graphadr.iter().any(|&graph| graph >= 0));
    let first = m.name_jntadr[joint] as usize;
    m.edit(|m| {
        m.mesh_vert.as_flattened_mut().iter_mut().for_each(|x| *x *= 0.5);
        m.names[first] = b'~';
    })
    .unwrap();
    assert_eq!(m.id_of(ObjType::Joint, &name), None);
    assert_eq!(m.id_of(ObjType::Joint, &format!("~{}", &name[1..])), Some(joint));
    let fresh = Model::from_bytes(&m.to_bytes()).unwrap();
    let mut ours = Data::new(&m);
    let mut theirs = Data::new(&fresh);
    for _ in 0..100 {
        step(&m, &mut ours).unwrap();
        step(&fresh, &mut theirs).unwrap();
    }
    assert!(!ours.con.contact.is_empty());
    assert!(bits(&m, &ours) == bits(&fresh, &theirs));
}

#[test]
fn clones_share_what_they_do_not_write() {
    let original = load("workbench/workbench");
    let mut m = original.clone();
    let shared = |m: &Model| {
        let mut own = Vec::new();
        let mut first = Vec::new();
        original.visit(&mut |_, _, values| first.push(address(values)));
        let mut first = first.into_iter();
        m.visit(&mut |name, _, values| {
            if first.next() != Some(address(values)) {
                own.push(name);
            }
        });
        own
    };
    assert!(shared(&m).is_empty());
    let body = m.bodies().last().unwrap();
    m.edit(|m| m.geom_rgba[0] = [0.0; 4]).unwrap();
    assert_eq!(shared(&m), ["geom_rgba"]);
    m.overwrite(|m| m.body_pos[body][0] += 0.1).unwrap();
    assert_eq!(shared(&m), ["body_pos", "geom_rgba"]);
    assert_eq!(original.body_pos[body][0] + 0.1, m.body_pos[body][0]);
}

/// Where an array stands in memory.
fn address(values: Slice<'_>) -> usize {
    match values {
        Slice::Bool(s) => s.as_ptr() as usize,
        Slice::U8(s) => s.as_ptr() as usize,
        Slice::I32(s) => s.as_ptr() as usize,
        Slice::I64(s) => s.as_ptr() as usize,
        Slice::F32(s) => s.as_ptr() as usize,
        Slice::F64(s) => s.as_ptr() as usize,
    }
}

#[test]
fn overwriting_writes_numbers_as_they_are_and_no_others() {
    let original = load("workbench/workbench");
    let mut arrays = Vec::new();
    original.visit(&mut |name, _, values| arrays.push((name, values.to_f64(), values.is_float())));
    let mut written = 0;
    for (name, values, _) in arrays.iter().filter(|(_, values, float)| *float && !values.is_empty()) {
        let changed: Vec<f64> = values.iter().map(|x| 0.5 * x + 0.25).collect();
        let mut m = original.clone();
        // Twice: the second time in memory of its own.
        let mut write = |numbers| m.overwrite(|m| assert_eq!(m.assign(name, numbers), Some(true)));
        write(values).unwrap();
        if write(&changed).is_err() {
            continue;
        }
        let mut expected = original.clone();
        expected.unchecked_mut().assign(name, &changed);
        assert!(m.to_bytes() == expected.to_bytes(), "{name}");
        written += 1;
    }
    assert!(written > 80, "{written}");
}

#[test]
fn overwriting_refuses_what_would_break_the_model() {
    let mut m = load("workbench/workbench");
    m.overwrite(|m| m.body_pos[1][0] = 3.0).unwrap();
    let before = m.to_bytes();
    let mut refused = |change: &dyn Fn(&mut Draft<'_>)| {
        let error = m.overwrite(change).unwrap_err();
        assert!(m.to_bytes() == before, "{error}: the model changed");
        error
    };
    let error = refused(&|m| m.body_pos[1] = [f64::NAN; 3]);
    assert_eq!(error, EditError::NotANumber { field: "body_pos", index: 3 });
    assert!(matches!(refused(&|m| m.geom_bodyid[3] = 1000), EditError::Inconsistent(_)));
    assert!(matches!(refused(&|m| m.geom_type[0] = 100), EditError::Inconsistent(_)));
    assert!(matches!(refused(&|m| m.geom_condim[0] = 2), EditError::Inconsistent(_)));
    assert!(matches!(refused(&|m| m.ngeom = 0), EditError::Size { field: "ngeom", .. }));
    let error = refused(&|m| {
        m.opt.gravity = [f64::NAN; 3];
        m.sensor_type[0] = -7;
    });
    assert!(matches!(error, EditError::Inconsistent(_) | EditError::NotSimulated(_)));
}

#[test]
fn an_edit_that_panics_is_taken_back() {
    let mut m = load("elbow/elbow");
    let before = m.to_bytes();
    let result = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
        m.edit(|m| {
            m.body_mass[1] = 100.0;
            panic!("halfway");
        })
    }));
    assert!(result.is_err() && m.to_bytes() == before);
}

#[test]
fn hulls_follow_what_is_overwritten() {
    let mut m = load("workbench/workbench");
    let mut d = Data::new(&m);
    (0..20).for_each(|_| step(&m, &mut d).unwrap());
    let clone = m.clone();
    m.overwrite(|m| m.mesh_vert.as_flattened_mut().iter_mut().for_each(|x| *x *= 0.5)).unwrap();
    for m in [m, clone] {
        let fresh = Model::from_bytes(&m.to_bytes()).unwrap();
        let mut ours = d.clone();
        let mut theirs = d.clone();
        for _ in 0..100 {
            step(&m, &mut ours).unwrap();
            step(&fresh, &mut theirs).unwrap();
        }
        assert!(!ours.con.contact.is_empty());
        assert!(bits(&m, &ours) == bits(&fresh, &theirs));
    }
}

#[test]
fn ids_index_the_arrays_of_their_kind() {
    let mut m = load("elbow/elbow");
    let (joint, body) = (m.joints().next().unwrap(), m.bodies().last().unwrap());
    let actuator = m.actuators().next().unwrap();
    m.edit(|m| {
        m.jnt_range[joint] = [-1.0, 1.0];
        m.body_mass[body] += 1.0;
        m.actuator_gainprm[actuator][0] *= 2.0;
    })
    .unwrap();
    assert_eq!(
        (m.joint(joint).range().unwrap_or([-1.0, 1.0]), m.jnt_range[joint]),
        ([-1.0, 1.0], [-1.0, 1.0])
    );
    assert_eq!(m.body(body).mass(), m.body_mass[body.index()]);
}
