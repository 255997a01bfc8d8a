//! Compiled models as bytes: what is read back, and what is refused.

mod own;

use own::{Own, assets, bits};
use physics::consistency::check_consistency;
use physics::model::binary::{BinaryError, seal};
use physics::pipeline::validity::check_model;
use physics::{Data, Model, step};
use robohive_mjcf::files::Memory;
use robohive_mjcf::{Loader, load_str};

const SMALL: &str = "<mujoco model='small'><option density='2'/><asset>
    <mesh name='m' vertex='0 0 0 1 0 0 0 1 0 0 0 1'/>
    <texture name='t' type='2d' builtin='checker' width='2' height='2'/><material name='t' texture='t'/></asset>
  <worldbody><geom type='plane' size='1 1 1' material='t'/><body name='b' pos='0 0 2'><freejoint/>
    <geom type='mesh' mesh='m'/><site name='s'/></body>
    <body mocap='true'><geom size='.1'/></body></worldbody>
  <tendon><spatial name='p'><site site='s'/><site site='s2'/></spatial></tendon>
  <actuator><motor tendon='p' delay='.01' nsample='3'/></actuator>
  <sensor><accelerometer site='s'/><rangefinder site='s'/></sensor>
  <keyframe><key qpos='0 0 1 1 0 0 0'/></keyframe></mujoco>";

fn small() -> Model {
    let text = SMALL.replace("<site name='s'/>", "<site name='s'/><site name='s2' pos='0 0 -.1'/>");
    load_str(&text).unwrap().model
}

#[test]
fn every_model_comes_back_bit_for_bit() {
    for path in assets() {
        let m = Loader::default().files(Own).load(path).unwrap().model;
        let bytes = m.to_bytes();
        let again = Model::from_bytes(&bytes).unwrap_or_else(|error| panic!("{path}: {error}"));
        assert_eq!(bits(&again), bits(&m), "{path}");
        assert_eq!((&again.opt, &again.stat, &again.vis), (&m.opt, &m.stat, &m.vis), "{path}");
        assert_eq!(again.name, m.name);
        let mut sizes = [Vec::new(), Vec::new()];
        m.visit_sizes(&mut |name, n| sizes[0].push((name, n)));
        again.visit_sizes(&mut |name, n| sizes[1].push((name, n)));
        assert_eq!(sizes[0], sizes[1], "{path}");
        assert_eq!(again.to_bytes(), bytes, "{path}");
    }
}

#[test]
fn the_loader_takes_compiled_models() {
    let (m, mut files) = (small(), Memory::default());
    files.insert("small.rhm", m.to_bytes());
    let loaded = Loader::default().files(files.clone()).load("small.rhm").unwrap();
    assert_eq!(bits(&loaded.model), bits(&m));
    let error =
        Loader::default().files(files).substitute("a", "b").load("small.rhm").unwrap_err().to_string();
    assert!(error.contains("cannot be edited"), "{error}");
}

#[test]
fn a_file_cut_off_anywhere_is_refused() {
    let bytes = small().to_bytes();
    for length in 0..bytes.len() {
        let expected = if length < 8 { BinaryError::NotAModel } else { BinaryError::Length };
        assert_eq!(Model::from_bytes(&bytes[..length]).unwrap_err(), expected, "{length}");
    }
    // With a header that fits, the arrays still miss their end.
    for length in (36..bytes.len()).step_by(7) {
        let mut cut = bytes[..length].to_vec();
        seal(&mut cut);
        assert_eq!(Model::from_bytes(&cut).unwrap_err(), BinaryError::Length, "{length}");
    }
    let mut longer = bytes.clone();
    longer.push(0);
    seal(&mut longer);
    assert_eq!(Model::from_bytes(&longer).unwrap_err(), BinaryError::Length);
}

#[test]
fn changed_bits_are_noticed() {
    let bytes = small().to_bytes();
    for at in (0..40).chain((40..bytes.len()).step_by(5)) {
        let mut changed = bytes.clone();
        changed[at] ^= 1 << (at % 8);
        let expected = match at {
            0..8 => BinaryError::NotAModel,
            8..20 => BinaryError::Stale,
            20..28 => BinaryError::Length,
            _ => BinaryError::Checksum,
        };
        assert_eq!(Model::from_bytes(&changed).unwrap_err(), expected, "byte {at}");
    }
}

/// Whatever a file with a fitting checksum says, reading it and stepping what it holds ends in a result or an error.
#[test]
fn sealed_nonsense_makes_no_step_panic() {
    let bytes = small().to_bytes();
    let (mut refused, mut stepped) = (0, 0);
    for at in (36..bytes.len()).step_by(7) {
        for change in [0x01, 0x80, 0xff] {
            let mut changed = bytes.clone();
            changed[at] ^= change;
            seal(&mut changed);
            match Model::from_bytes(&changed) {
                Err(_) => refused += 1,
                Ok(m) if m.nsensordata + m.nhistory + m.nuserdata > 1 << 16 => {}
                Ok(m) => {
                    let mut d = Data::new(&m);
                    _ = step(&m, &mut d).and_then(|()| step(&m, &mut d));
                    stepped += 1;
                }
            }
        }
    }
    assert!(refused > 200 && stepped > 200, "{refused} {stepped}");
}

/// Every array with one number replaced by one that no compiler writes.
#[test]
fn numbers_out_of_range_are_refused_or_stepped() {
    let (mut refused, mut stepped) = (0, 0);
    for path in assets().iter().filter(|path| ["workbench", "delays"].iter().any(|n| path.contains(n))) {
        let m = Loader::default().files(Own).load(path).unwrap().model;
        let mut arrays = Vec::new();
        m.visit(&mut |name, _, values| arrays.push((name, values.to_f64(), values.is_float())));
        for (name, values, float) in arrays.iter().filter(|(_, values, _)| !values.is_empty()) {
            let numbers: &[f64] =
                if *float { &[f64::NAN, -1.0, 1e300] } else { &[-1.0, 1.0, 17.0, 2147483647.0] };
            for (at, number) in [0, values.len() / 2, values.len() - 1]
                .iter()
                .flat_map(|at| numbers.iter().map(move |x| (*at, *x)))
            {
                let (mut changed, mut values) = (m.clone(), values.clone());
                values[at] = number;
                assert_eq!(changed.unchecked_mut().assign(name, &values), Some(true));
                if check_consistency(&changed).is_err() || check_model(&changed).is_err() {
                    refused += 1;
                    continue;
                }
                let mut d = Data::new(&changed);
                d.state.ctrl.fill(0.5);
                _ = step(&changed, &mut d).and_then(|()| step(&changed, &mut d));
                stepped += 1;
            }
        }
    }
    assert!(refused > 1000 && stepped > 2000, "{refused} {stepped}");
}

/// Balls and boxes turned inside out, and of no size, inside a height field.
#[test]
fn height_fields_meet_bodies_of_impossible_sizes() {
    let text = "<mujoco><asset><hfield name='h' nrow='9' ncol='9' size='1 1 .1 1'/></asset><worldbody>
        <geom type='hfield' hfield='h'/><body pos='.06 .06 -.5'><freejoint/><geom size='.1'/></body></worldbody></mujoco>";
    let m = load_str(text).unwrap().model;
    let mut stepped = 0;
    for name in ["geom_rbound", "geom_aabb", "geom_size", "hfield_size", "hfield_data"] {
        let mut scalars = 0;
        m.visit(&mut |array, _, values| scalars = if array == name { values.len() } else { scalars });
        for number in [f64::NAN, -0.4, -1e300, 1e300, f64::INFINITY] {
            let mut changed = m.clone();
            assert_eq!(changed.unchecked_mut().assign(name, &vec![number; scalars]), Some(true));
            if check_consistency(&changed).is_ok() {
                stepped += 1;
                _ = step(&changed, &mut Data::new(&changed));
            }
        }
    }
    assert!(stepped > 15, "{stepped}");
}

/// Loops over pixels that are fewer than none, or that make no reading, end.
#[test]
fn cameras_without_a_number_of_pixels_are_refused() {
    let text = "<mujoco><worldbody><camera name='c' resolution='2 3'/></worldbody>
        <sensor><rangefinder camera='c'/></sensor></mujoco>";
    let m = load_str(text).unwrap().model;
    for (resolution, dim) in [([-1, 0], 0), ([0, -1], 0), ([-2, -3], 6), ([i32::MAX; 2], 0)] {
        let mut changed = m.clone();
        let arrays = changed.unchecked_mut();
        (arrays.cam_resolution[0], arrays.sensor_dim[0]) = (resolution, dim);
        (arrays.sensor_intprm[0][0], arrays.nsensordata) = (dim / 6, dim as usize);
        assert!(check_consistency(&changed).is_err(), "{resolution:?}");
    }
}

#[test]
fn histories_too_long_to_be_added_up_are_refused() {
    let sensors = "<clock delay='.01' nsample='2'/>".repeat(3);
    let mut m = load_str(format!("<mujoco><sensor>{sensors}</sensor></mujoco>")).unwrap().model;
    assert_eq!((m.nhistory, check_consistency(&m)), (18, Ok(())));
    let arrays = m.unchecked_mut();
    arrays.sensor_dim.fill(i32::MAX);
    arrays.sensor_history.fill([i32::MAX, 0]);
    arrays.nsensordata = 3 * i32::MAX as usize;
    assert_eq!(check_consistency(&m).unwrap_err().array, "nhistory");
}

/// Sharing children makes paths without end of a tree; too many levels leave the stack of a search.
#[test]
fn hierarchies_that_are_no_trees_are_refused() {
    let m = small();
    let first = m.mesh_bvhadr[0] as usize;
    assert_eq!(m.bvh_child[first..first + 5], [[1, 4], [2, 3], [-1, -1], [-1, -1], [5, 6]]);
    for (node, children) in [(0, [1, 1]), (0, [1, 3]), (1, [2, 2]), (1, [3, 2]), (2, [3, -1]), (0, [-1, -1])]
    {
        let mut changed = m.clone();
        changed.unchecked_mut().bvh_child[first + node] = children;
        assert!(check_consistency(&changed).is_err(), "{node} {children:?}");
    }
    // A tree of no nodes would be walked unchecked.
    let mut changed = m.clone();
    changed.unchecked_mut().mesh_bvhnum[0] = 0;
    assert!(check_consistency(&changed).is_err());
}
