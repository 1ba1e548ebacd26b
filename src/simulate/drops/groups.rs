//! Drops whose orders are computed together: those of one radius and tilt.

use crate::population::{Radius, radii};
use crate::size_distribution::SizeDistribution;

/// A stretch of radii over which the shape changes smoothly, and an order on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Part {
    pub stretch: (f64, f64),
    pub spheres: bool,
    pub order: u32,
    /// Even number of steps.
    pub steps: usize,
}

/// A drop, and what each of its orders counts in the mean.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Group {
    pub at: Radius,
    /// Orders ascending, each with its weight and that among every second radius.
    pub orders: Vec<(u32, [f64; 2])>,
}

impl Group {
    /// Its orders alone.
    pub fn numbers(&self) -> Vec<u32> {
        self.orders.iter().map(|(order, _)| *order).collect()
    }
}

/// All drops of some parts, in the order of stretches and radii.
pub(super) fn groups<'p>(
    sizes: &SizeDistribution,
    parts: impl Iterator<Item = &'p Part>,
) -> Vec<Group> {
    let mut all: Vec<Group> = Vec::new();
    for part in parts {
        for at in radii(sizes, part.stretch, part.steps) {
            let weights = (part.order, [at.weight, at.coarse]);
            // a kink of the shape is in two stretches, one radius with tilts at many places
            let same = |group: &&mut Group| {
                group.at.radius == at.radius
                    && group.at.place == at.place
                    && group.orders.iter().all(|(order, _)| *order != part.order)
            };
            match all.iter_mut().find(same) {
                Some(group) => group.orders.push(weights),
                None => all.push(Group { at, orders: vec![weights] }),
            }
        }
    }
    for group in &mut all {
        group.orders.sort_by_key(|(order, _)| *order);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::size_distribution::SizeLaw;

    /// Each order keeps its own weights; drops that some orders share are there once.
    #[test]
    fn drops_are_shared_between_orders() {
        let sizes = SizeDistribution::between(SizeLaw::marshall_palmer(5.0), 1e-4, 9e-4).unwrap();
        let part = |stretch, order, steps| Part { stretch, spheres: false, order, steps };
        let (low, high) = ((1e-4, 4e-4), (4e-4, 9e-4));
        let parts = [part(low, 0, 4), part(low, 2, 8), part(high, 0, 2), part(high, 2, 4)];
        let all = groups(&sizes, parts.iter());
        assert_eq!(all.len(), 9 + 5);
        for part in &parts {
            let known = radii(&sizes, part.stretch, part.steps);
            let found: Vec<[f64; 2]> = all
                .iter()
                .filter(|group| known.iter().any(|at| at.radius == group.at.radius))
                .flat_map(|group| &group.orders)
                .filter(|(order, _)| *order == part.order)
                .map(|(_, weights)| *weights)
                .collect();
            let has = |at: &Radius| found.contains(&[at.weight, at.coarse]);
            assert!(known.iter().all(has), "{part:?}: {found:?}");
        }
        assert!(all.iter().all(|group| group.numbers().is_sorted()));
    }
}
