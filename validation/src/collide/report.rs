//! What a stream of placements and rays showed.

use std::collections::BTreeMap;

/// Rays through a scene, one at a time, and together.
pub const SCENE: usize = 8;
/// See [`SCENE`].
pub const TOGETHER: usize = 9;

/// How the rays against one kind of target compare.
#[derive(Clone, Debug, Default)]
pub struct RayTally {
    /// Rays.
    pub rays: usize,
    /// Rays that hit.
    pub hits: usize,
    /// Rays whose answer in MuJoCo changes under a nudge, or depends on whether rays are cast together.
    pub unstable: usize,
    /// Rays that differ, among the unstable ones.
    pub excepted: usize,
    /// Rays that differ, among the others.
    pub different: usize,
    /// Largest difference in distance (relative beyond one) and normal where rays agree.
    pub worst: [f64; 2],
}

/// How one pair of types in one variant compares.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// Placements.
    pub placements: usize,
    /// Placements with a contact.
    pub touching: usize,
    /// Placements with a contact deeper than a tenth of the smaller bounding radius.
    pub deep: usize,
    /// Placements whose answer in MuJoCo changes under a nudge.
    pub unstable: usize,
    /// Placements whose contacts differ, among the unstable ones.
    pub excepted: usize,
    /// Placements whose contacts differ, among the others.
    pub different: usize,
    /// Largest difference in `dist`, `pos`, `frame` where contacts agree.
    pub worst: [f64; 3],
    /// Distance queries whose answer in MuJoCo changes under a nudge.
    pub distance_unstable: usize,
    /// Distance queries that differ, among the unstable ones.
    pub distance_excepted: usize,
    /// Distance queries that differ, among the others.
    pub distance_different: usize,
    /// Largest difference in distance and nearest points where queries agree.
    pub distance_worst: [f64; 2],
}

/// Everything a stream showed.
#[derive(Default)]
pub struct Report {
    /// Names of variants in the order of the stream.
    pub variants: Vec<String>,
    /// By variant and pair of types.
    pub pairs: BTreeMap<(usize, [usize; 2]), Tally>,
    /// Elements of flexes, by name of variant and pair.
    pub flexes: BTreeMap<(String, String), Tally>,
    /// By name of what the rays met.
    pub rays: BTreeMap<usize, RayTally>,
    /// A sentence for each difference that no nudge explains, the first ones.
    pub differences: Vec<String>,
}

impl Report {
    /// Comparisons that differ and are not excepted.
    pub fn different(&self) -> usize {
        let pairs: usize = self.pairs.values().map(|t| t.different + t.distance_different).sum();
        let flexes: usize = self.flexes.values().map(|t| t.different).sum();
        pairs + flexes + self.rays.values().map(|t| t.different).sum::<usize>()
    }

    /// The number of a variant, which may be new.
    pub(super) fn variant(&mut self, name: String) -> usize {
        self.variants.iter().position(|v| *v == name).unwrap_or_else(|| {
            self.variants.push(name);
            self.variants.len() - 1
        })
    }

    /// Notes a difference.
    pub(crate) fn note(&mut self, text: impl FnOnce() -> String) {
        if self.differences.len() < 20 {
            self.differences.push(text());
        }
    }
}
