//! Keeping contacts of flexes few: where two bodies or flexes touch at many points, the deepest and those that lie
//! farthest from the ones already chosen stay.

use crate::math::{dot, sub};
use crate::model::bounds::{MAXCONPAIR, MAXVAL};
use crate::stages::Contact;

/// Working memory of the choice.
#[derive(Clone, Debug, Default)]
pub(crate) struct Spread {
    /// Places that were chosen.
    chosen: Vec<bool>,
    /// Squared distance to the nearest of the chosen contacts.
    nearest: Vec<f64>,
}

/// Keeps at most `MAXCONPAIR` of the contacts from `first` on.
///
/// A chosen contact changes places with one in front, while what is known of the places stays, as MuJoCo does it: which
/// contacts remain depends on that.
pub(super) fn keep_spread(contacts: &mut Vec<Contact>, first: usize, spread: &mut Spread) {
    let found = &mut contacts[first..];
    if found.len() <= MAXCONPAIR {
        return;
    }
    spread.chosen.clear();
    spread.chosen.resize(found.len(), false);
    spread.nearest.clear();
    spread.nearest.resize(found.len(), MAXVAL);
    let deepest =
        (1..found.len()).fold(0, |best, i| if -found[i].dist > -found[best].dist { i } else { best });
    let mut next = Some(deepest);
    let mut kept = 0;
    while let Some(best) = next.filter(|_| kept < MAXCONPAIR) {
        spread.chosen[best] = true;
        next = farthest(found, best, spread);
        if kept < MAXCONPAIR - 1 {
            found.swap(kept, best);
            if next == Some(kept) {
                next = Some(best);
            }
        }
        kept += 1;
    }
    contacts.truncate(first + kept);
}

/// The place farthest from all chosen ones, with the distance to `newest` taken into account.
fn farthest(found: &[Contact], newest: usize, spread: &mut Spread) -> Option<usize> {
    let centre = found[newest].pos;
    let (mut best, mut most) = (None, -1.0);
    for (i, contact) in found.iter().enumerate() {
        if spread.chosen[i] {
            continue;
        }
        let gap = sub(contact.pos, centre);
        let distance2 = dot(gap, gap);
        let nearest = &mut spread.nearest[i];
        if distance2 < *nearest {
            *nearest = distance2;
        }
        if *nearest > most {
            (best, most) = (Some(i), *nearest);
        }
    }
    best
}

/// Sorts the contacts of two bodies or flexes, at most `MAXCONPAIR`, by what touches. Contacts of the same parts keep
/// their order.
pub(super) fn sort(contacts: &mut [Contact]) {
    let part = |c: &Contact, side: usize| match (c.geom[side], c.elem[side]) {
        (geom, _) if geom >= 0 => geom,
        (_, element) if element >= 0 => element,
        _ => c.vert[side],
    };
    let mut places = [(0, 0, 0); MAXCONPAIR];
    let places = &mut places[..contacts.len()];
    for (i, (place, c)) in places.iter_mut().zip(&*contacts).enumerate() {
        *place = (part(c, 0), part(c, 1), i);
    }
    places.sort_unstable();
    for to in 0..contacts.len() {
        // What stood there has gone where the one that took its place was.
        let mut from = places[to].2;
        while from < to {
            from = places[from].2;
        }
        contacts.swap(to, from);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_many_contacts_the_deepest_and_the_one_farthest_from_it_stay() {
        let contact = |i: usize| Contact {
            pos: [i as f64, 0.0, 0.0],
            dist: if i == 70 { -1.0 } else { -0.1 },
            ..Contact::default()
        };
        let mut contacts: Vec<Contact> = (0..3 * MAXCONPAIR).map(contact).collect();
        keep_spread(&mut contacts, 1, &mut Spread::default());
        assert_eq!(contacts.len(), 1 + MAXCONPAIR);
        assert_eq!(contacts[0].pos[0], 0.0);
        let last = (3 * MAXCONPAIR - 1) as f64;
        for kept in [70.0, last] {
            assert!(contacts[1..].iter().any(|c| c.pos[0] == kept));
        }
        let mut few = contacts.clone();
        keep_spread(&mut few, 1, &mut Spread::default());
        assert_eq!(few, contacts);
    }
}
