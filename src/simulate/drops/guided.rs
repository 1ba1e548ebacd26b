//! Guides to the scattering planes of every drop of a mean, found once for all wavelengths of a table.

use super::groups::groups;
use super::one_drop::Drop;
use super::steps::{Steps, index_range, middle_light, sizes_of};
use crate::farfield::Guides;
use crate::math::parallel::*;
use crate::medium::Light;
use crate::plan::Plan;
use crate::population::Radius;
use crate::scene::Scene;
use crate::simulate::error::SimulateError;
use std::collections::HashMap;

/// A drop by its radius and place among them.
type Key = (u64, u64);

/// Guides by drop; none for drops whose orders have no planes.
#[derive(Debug, Default)]
pub(crate) struct DropGuides(HashMap<Key, Guides>);

fn key(at: &Radius) -> Key {
    (at.radius.to_bits(), at.place.to_bits())
}

impl DropGuides {
    /// For the drops of one kind.
    ///
    /// # Errors
    /// A radius outside the model of the shape, or a wavelength outside the medium's data.
    pub fn new(scene: &Scene, plan: &Plan, steps: &Steps) -> Result<Self, SimulateError> {
        let sizes = &sizes_of(scene);
        let range = index_range(scene)?;
        let Light { wavelength, index } = middle_light(scene)?;
        let drops = groups(sizes, steps.parts.iter().filter(|part| !part.spheres));
        let guides = drops
            .par_iter()
            .map(|group| {
                let drop = Drop::new(scene, plan, &group.at, (wavelength, index))?;
                let guides = drop.guides(&group.numbers(), range);
                Ok(guides.map(|guides| (key(&group.at), guides)))
            })
            .collect::<Result<Vec<_>, SimulateError>>()?;
        Ok(Self(guides.into_iter().flatten().collect()))
    }

    /// Those of a drop.
    pub fn of(&self, at: &Radius) -> Option<&Guides> {
        self.0.get(&key(at))
    }
}
