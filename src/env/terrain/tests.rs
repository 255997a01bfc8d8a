//! Every kind is the same for the same seed, within its bounds, flat where a robot starts, and carries what stands on it.

use super::{Grid, Kind, Terrain, TerrainError};
use mjcf::load_str;

const KINDS: [Kind; 5] = [Kind::Rough, Kind::Hilly, Kind::Stairs, Kind::Obstacles, Kind::Gaps];
const GRID: Grid = Grid { rows: 81, columns: 121, half: [6.0, 4.0] };

fn terrain(kind: Kind) -> Terrain {
    Terrain { kind, height: 0.3, flat: 0.5 }
}

/// FNV-1a of the bits of all heights.
fn digest(heights: &[f64]) -> u64 {
    let bytes = heights.iter().flat_map(|height| height.to_bits().to_le_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

#[test]
fn a_seed_decides_every_bit() {
    let found = KINDS.map(|kind| digest(&terrain(kind).draw(&GRID, 1).unwrap().heights));
    let again = KINDS.map(|kind| digest(&terrain(kind).draw(&GRID, 1).unwrap().heights));
    let other = KINDS.map(|kind| digest(&terrain(kind).draw(&GRID, 2).unwrap().heights));
    assert_eq!(found, again);
    assert!(found.iter().zip(&other).all(|(one, two)| one != two));
    let recorded = [
        0x6a9b_92a9_e6d0_b65e,
        0x1c70_99af_11f6_e6e3,
        0x692a_6290_6c1b_83b5,
        0xc0a4_792d_847a_69a7,
        0xb101_6236_748c_ad85,
    ];
    assert_eq!(found, recorded, "{found:#018x?}");
}

#[test]
fn heights_stay_within_their_bounds_and_use_them() {
    for kind in KINDS {
        for seed in 0..20 {
            let ground = terrain(kind).draw(&GRID, seed).unwrap();
            let low = ground.heights.iter().copied().fold(f64::INFINITY, f64::min);
            let high = ground.heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            assert!(low >= 0.0 && high <= 0.3 + 1e-15, "{kind:?} {seed}: {low} {high}");
            assert!(high - low > 0.2, "{kind:?} {seed}: {low} {high}");
        }
    }
}

#[test]
fn the_patch_in_the_middle_is_flat_on_any_grid() {
    for grid in [
        GRID,
        Grid { rows: 20, columns: 50, half: [2.0, 7.0] },
        Grid { rows: 2, columns: 3, half: [0.4, 0.4] },
    ] {
        for kind in KINDS {
            for seed in 0..5 {
                let ground = terrain(kind).draw(&grid, seed).unwrap();
                let within = |[x, y]: [f64; 2]| x.abs() <= 0.5 && y.abs() <= 0.5;
                let patch = ground.heights.iter().zip(grid.places()).filter(|(_, place)| within(*place));
                let off = patch.map(|(height, _)| (height - ground.level).abs()).fold(0.0, f64::max);
                assert!(off < 1e-15, "{kind:?} {seed}: {off}");
            }
        }
    }
}

#[test]
fn stairs_rise_by_a_fifth_and_gaps_are_as_deep_as_they_are_told() {
    let middle = |kind: Kind| -> Vec<f64> {
        let heights = terrain(kind).draw(&GRID, 3).unwrap().heights;
        heights[40 * GRID.columns..41 * GRID.columns].to_vec()
    };
    let stairs = middle(Kind::Stairs);
    let largest = stairs.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
    assert!((largest - 0.06).abs() < 1e-15, "{largest}");
    // Mirrored at the robot's place.
    assert!(stairs.iter().zip(stairs.iter().rev()).all(|(left, right)| left == right));
    let gaps = middle(Kind::Gaps);
    assert!(gaps.iter().all(|height| *height == 0.0 || *height == 0.3));
    let edges = gaps.windows(2).filter(|pair| pair[0] != pair[1]).count();
    assert!(edges >= 8, "{edges}");
}

#[test]
fn a_ball_rests_on_the_patch() {
    for kind in KINDS {
        let ground = terrain(kind).draw(&GRID, 4).unwrap();
        let text = format!(
            "<mujoco><asset><hfield name='ground' nrow='81' ncol='121' size='6 4 0.3 0.1'/></asset><worldbody>
               <geom type='hfield' hfield='ground' pos='0 0 {}'/>
               <body pos='0.03 0.02 0.15'><freejoint/><geom size='0.1'/></body></worldbody></mujoco>",
            -ground.level
        );
        let mut model = load_str(&text).unwrap().model;
        ground.write(&mut model, "ground").unwrap();
        let mut data = physics::Data::new(&model);
        for _ in 0..1000 {
            physics::step(&model, &mut data).unwrap();
        }
        let height = data.state.qpos[2];
        assert!((height - 0.1).abs() < 2e-3, "{kind:?}: {height}");
    }
}

#[test]
fn wrong_numbers_are_named() {
    let error = |terrain: Terrain, grid: Grid| terrain.draw(&grid, 0).unwrap_err().to_string();
    let rough = terrain(Kind::Rough);
    assert!(error(rough, Grid { rows: 1, ..GRID }).contains("1 rows and 121 columns"));
    assert!(error(rough, Grid { half: [0.0, 1.0], ..GRID }).contains("along x is 0 m"));
    assert!(error(Terrain { height: f64::NAN, ..rough }, GRID).contains("height NaN m"));
    assert!(error(Terrain { flat: -1.0, ..rough }, GRID).contains("half side -1 m"));
    assert!(error(rough, Grid { rows: usize::MAX, ..GRID }).contains("16777216 heights at most"));
    let text =
        "<mujoco><asset><hfield name='ground' nrow='81' ncol='121' size='6 4 0.1 0.1'/></asset></mujoco>";
    let mut model = load_str(text).unwrap().model;
    let ground = rough.draw(&GRID, 0).unwrap();
    let refused = |error: TerrainError, part: &str| assert!(error.to_string().contains(part), "{error}");
    refused(ground.write(&mut model, "grund").unwrap_err(), "is it 'ground'?");
    refused(ground.write(&mut model, "ground").unwrap_err(), "is 0.1 m high");
    let other = rough.draw(&Grid { rows: 80, ..GRID }, 0).unwrap();
    refused(other.write(&mut model, "ground").unwrap_err(), "rows: 81");
}
