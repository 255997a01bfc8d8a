//! The box that the end effector stays in.

use protocol::franka::{JOINTS, flange};
use robot::Fault;

/// How much farther outside the box an arm that begins outside may get while it moves inside \[m\].
const SLACK: f64 = 1e-3;

/// A box in the frame of the arm's base \[m\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Workspace {
    /// Smallest and largest coordinate along each axis.
    ends: [[f64; 2]; 3],
    /// Distance of the point that is kept inside from the flange, along the flange's axis \[m\].
    tool: f64,
}

impl Workspace {
    /// A box `[x low, x high, y low, y high, z low, z high]` \[m\] for a point at this distance \[m\] in front of the flange.
    ///
    /// # Errors
    /// The numbers are not a box.
    pub(super) fn new(numbers: &[f64], tool: f64) -> Result<Workspace, Fault> {
        let wrong = |why: &str| {
            Err(Fault::Refused(format!(
                "its interface has a box that {why}; it is [x low, x high, y low, y high, z low, z high] in m"
            )))
        };
        let &[a, b, c, d, e, f] = numbers else {
            return wrong(&format!("has {} numbers instead of 6", numbers.len()));
        };
        let ends = [[a, b], [c, d], [e, f]];
        match (
            ends.as_flattened().iter().all(|end| end.is_finite()),
            ends.iter().all(|[low, high]| low < high),
        ) {
            (false, _) => wrong("has numbers that are not finite"),
            (_, false) => wrong("has a low end that is not below its high end"),
            _ => Ok(Workspace { ends, tool }),
        }
    }

    /// Position of the point \[m\], in the frame of the base, with the joints at `q` \[rad\].
    fn point(&self, q: &[f64; JOINTS]) -> [f64; 3] {
        let pose = flange(q);
        std::array::from_fn(|axis| pose[12 + axis] + self.tool * pose[8 + axis])
    }

    /// Distance outside along each axis \[m\]; 0 inside.
    pub(super) fn beyond(&self, q: &[f64; JOINTS]) -> [f64; 3] {
        let point = self.point(q);
        std::array::from_fn(|axis| {
            let [low, high] = self.ends[axis];
            (low - point[axis]).max(point[axis] - high).max(0.0)
        })
    }

    /// Whether the joints may be at `wanted`: in the box, or no farther outside than `outside`, the smallest distance since
    /// the motion began.
    pub(super) fn allows(&self, outside: &[f64; 3], wanted: &[f64; JOINTS]) -> bool {
        let slack = |outside: f64| if outside > 0.0 { outside + SLACK } else { 0.0 };
        self.beyond(wanted).iter().zip(outside).all(|(beyond, outside)| *beyond <= slack(*outside))
    }

    /// The fault for joints at `wanted` that are not allowed.
    pub(super) fn refusal(&self, what: &str, wanted: &[f64; JOINTS]) -> Fault {
        let [x, y, z] = self.point(wanted);
        let beyond = self.beyond(wanted);
        let names =
            ["x", "y", "z"].into_iter().zip(self.ends).zip(beyond).filter(|(_, beyond)| *beyond > 0.0);
        let broken: Vec<_> =
            names.map(|((name, [low, high]), _)| format!("{name} from {low} to {high}")).collect();
        Fault::Refused(format!(
            "{what} its end effector at ({x:.3}, {y:.3}, {z:.3}) m from its base, and its box is {} m",
            broken.join(", ")
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_outside_may_come_nearer_and_go_no_further() {
        // Stretched upwards the flange is 0.926 m high, 0.088 m in front, and points down.
        let up = [0.0; JOINTS];
        let workspace = Workspace::new(&[-0.2, 0.2, -0.2, 0.2, 0.0, 0.8], 0.1).unwrap();
        let [x, y, z] = workspace.point(&up);
        assert!((x - 0.088).abs() < 1e-12 && y.abs() < 1e-12 && (z - 0.826).abs() < 1e-12, "{z}");
        let mut lower = up;
        lower[1] = 0.2;
        let outside = workspace.beyond(&up);
        assert!((outside[2] - 0.026).abs() < 1e-12, "{outside:?}");
        assert!(workspace.allows(&outside, &up) && workspace.allows(&outside, &lower));
        assert!(!workspace.allows(&[0.0, 0.0, 0.02], &up), "it has been nearer");
        lower[1] = 1.5;
        assert!(!workspace.allows(&outside, &lower), "too far in front");
        let text = workspace.refusal("this would have", &lower).to_string();
        assert!(
            text.contains("its end effector at (0.") && text.ends_with("its box is x from -0.2 to 0.2 m"),
            "{text}"
        );
        for (numbers, part) in [
            (&[0.0; 5][..], "has 5 numbers instead of 6"),
            (&[0.0, 1.0, 0.0, 1.0, 0.0, f64::NAN], "finite"),
            (&[0.0, 1.0, 0.5, 0.5, 0.0, 1.0], "not below its high end"),
        ] {
            let text = Workspace::new(numbers, 0.0).unwrap_err().to_string();
            assert!(text.contains(part), "{text}");
        }
    }
}
