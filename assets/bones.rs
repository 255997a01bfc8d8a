//! Bones of skeletons: shafts that widen at their ends, in metres.

use workshop::{Mesh, Profile, Station, Vec3, ellipsoid, sweep};

/// Points round a bone by its largest half width \[m\]: few for ribs and fingers, which are many.
fn round(widest: f64) -> usize {
    if widest < 0.008 { 6 } else { 10 }
}

/// A bone along a path: places, and the half widths of its section there. Its ends are rounded.
pub(crate) fn shaft(path: &[(Vec3, [f64; 2])]) -> Mesh {
    let station = |(at, size): &(Vec3, [f64; 2])| Station { at: *at, size: *size };
    let mut stations: Vec<Station> = path.iter().map(station).collect();
    let tip = |end: Station, inner: Station| {
        let reach = 0.5 * (end.size[0] + end.size[1]);
        let out = [0, 1, 2].map(|i| end.at[i] - inner.at[i]);
        let length = out.iter().map(|x| x * x).sum::<f64>().sqrt();
        // A ring of a half ellipsoid, and its pole.
        [(0.55, 0.8), (0.9, 0.0)].map(|(far, wide)| Station {
            at: [0, 1, 2].map(|i| end.at[i] + out[i] / length * reach * far),
            size: end.size.map(|size| size * wide),
        })
    };
    let last = stations.len() - 1;
    let (head, tail) = (tip(stations[0], stations[1]), tip(stations[last], stations[last - 1]));
    stations.splice(0..0, head.into_iter().rev());
    stations.extend(tail);
    let widest = path.iter().flat_map(|(_, size)| *size).fold(0.0, f64::max);
    sweep(&Profile::circle(1.0, round(widest)), &stations)
}

/// A straight bone: a slender shaft between two ends of their own thickness.
pub(crate) fn long(from: Vec3, to: Vec3, middle: f64, ends: [f64; 2]) -> Mesh {
    let at = |share: f64| [0, 1, 2].map(|i| from[i] + share * (to[i] - from[i]));
    let section = |share: f64, radius: f64| (at(share), [radius; 2]);
    shaft(&[
        section(0.02, ends[0]),
        section(0.1, 0.75 * ends[0] + 0.25 * middle),
        section(0.25, middle),
        section(0.75, middle),
        section(0.9, 0.75 * ends[1] + 0.25 * middle),
        section(0.98, ends[1]),
    ])
}

/// A round part, such as a joint's head or a bone of the wrist, by its half axes.
pub(crate) fn knob(half: Vec3, at: Vec3) -> Mesh {
    ellipsoid(half, if half[0] < 0.04 { 7 } else { 18 }).moved(at)
}
