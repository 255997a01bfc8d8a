//! Bounds on round-off, from the extents of the points (Barber et al. 1996, section 4), and how far facets
//! have come to lie below points since.

/// After this many unions a walk over the surface may end at a local maximum.
const MANY_UNIONS: usize = 50;

/// Bounds on the error of a height and the widths derived from it, in input units.
#[derive(Debug, Clone, Default)]
pub(super) struct Tolerances {
    /// Largest extent of the points along an axis.
    pub width: f64,
    /// Error of the height of a point above a plane.
    pub round: f64,
    /// A facet whose centre is no deeper below a neighbour than this is not convex to it.
    pub center: f64,
    /// A point this far above a facet sees it.
    pub visible: f64,
    /// A point this far above a facet has to be added.
    pub outside: f64,
    /// Points less than this below a facet are remembered.
    pub near: f64,
    /// Height above a facet that a single union may cause.
    pub union: f64,
    /// Facets united over more than this keep their centre.
    pub wide: f64,
    /// Pivots smaller than this, per column, are zero.
    pub zero: [f64; 3],
}

impl Tolerances {
    /// Bounds for these points, and the points of least and greatest x, y and z; the first of equals.
    pub(super) fn of(points: &[[f64; 3]]) -> (Self, [usize; 6]) {
        let mut extreme = [0; 6];
        for (k, p) in points.iter().enumerate() {
            for axis in 0..3 {
                if points[extreme[2 * axis + 1]][axis] < p[axis] {
                    extreme[2 * axis + 1] = k;
                } else if points[extreme[2 * axis]][axis] > p[axis] {
                    extreme[2 * axis] = k;
                }
            }
        }
        let bounds = [0, 1, 2].map(|axis| [0, 1].map(|end| points[extreme[2 * axis + end]][axis]));
        let reach = bounds.map(|[least, most]| most.max(-least));
        let partial_sums = [reach[0], reach[0] + reach[1], reach[0] + reach[1] + reach[2]];
        let max_reach = reach.into_iter().fold(0.0, f64::max);
        let norm = f64::min(3.0f64.sqrt() * max_reach, partial_sums[2]);
        let round = f64::EPSILON * (3.0 * norm * 1.01 + max_reach);
        let center = 2.0 * round;
        let union = 3.0 * center + round;
        let outside = 2.0 * center;
        let tolerances = Self {
            width: bounds.into_iter().map(|[least, most]| most - least).fold(f64::MIN, f64::max),
            round,
            center,
            visible: center,
            outside,
            near: union * 5.0,
            union,
            wide: outside.max(6.0 * center),
            zero: partial_sums.map(|sum| 80.0 * sum * f64::EPSILON),
        };
        (tolerances, extreme)
    }
}

/// What unions have made of the bounds.
#[derive(Debug, Default)]
pub(super) struct Slack {
    unions: usize,
    /// Largest height of a point above the facet it belongs to.
    pub highest: f64,
    /// Limit on that height before a point counts as outside again.
    pub limit: f64,
}

impl Slack {
    pub(super) fn count_union(&mut self) {
        self.unions += 1;
    }

    /// After many unions a walk from facet to facet may miss the highest one, so all fresh facets are compared.
    pub(super) fn many_unions(&self) -> bool {
        self.unions > MANY_UNIONS
    }

    /// Records that a point lies `height` above its facet.
    pub(super) fn allow(&mut self, height: f64) {
        self.highest = self.highest.max(height);
    }

    pub(super) fn raise_limit(&mut self, tol: &Tolerances) {
        self.limit = self.highest.max(tol.union + tol.round).max(tol.outside);
    }

    /// A point this high above a facet need not be compared with other facets.
    pub(super) fn clearly_outside(&self, tol: &Tolerances) -> f64 {
        self.factor() * f64::max(2.0 * tol.outside, self.highest)
    }

    /// Round-off may hide a higher facet behind one that is lower by less than this.
    pub(super) fn plateau(&self, tol: &Tolerances) -> f64 {
        self.factor() * (self.highest + 2.0 * tol.round + tol.visible)
    }

    fn factor(&self) -> f64 {
        if self.many_unions() { 2.0 } else { 1.0 }
    }
}
