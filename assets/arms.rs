//! What arms consist of: tubes along paths, and drums round joints \[m\].

use workshop::{Mesh, Profile, Station, Vec3, revolve, sweep};

/// A tube along a path, in `count` steps round: places, and the half widths of its section across the path.
pub(crate) fn tube(path: &[(Vec3, [f64; 2])], count: usize) -> Mesh {
    let stations: Vec<_> = path.iter().map(|(at, size)| Station { at: *at, size: *size }).collect();
    sweep(&Profile::superellipse([1.0, 1.0], 2.2, count), &stations)
}

/// A drum about an axis through `centre`, from `low` to `high` along it, with softly rounded rims, in `count` steps round.
pub(crate) fn drum(radius: f64, axis: Vec3, centre: Vec3, [low, high]: [f64; 2], count: usize) -> Mesh {
    let soft = 0.18 * radius;
    let line = [
        [0.0, low],
        [radius - soft, low],
        [radius, low + soft],
        [radius, high - soft],
        [radius - soft, high],
        [0.0, high],
    ];
    revolve(&line, count).along(axis, centre)
}
