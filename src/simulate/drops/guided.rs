//! Guides to the scattering planes of every drop of a mean, found once for all wavelengths of a table.

use super::one_order::Drop;
use super::steps::{Part, Steps, index_range, middle_light, sizes_of};
use crate::farfield::Guides;
use crate::math::parallel::*;
use crate::medium::Light;
use crate::plan::Plan;
use crate::population::{Radius, radii};
use crate::scene::Scene;
use crate::simulate::error::SimulateError;
use std::collections::HashMap;

/// A drop by its radius and place among them, and an order.
type Key = (u64, u64, u32);

/// Guides by drop and order; none for drops whose orders have no planes.
#[derive(Debug, Default)]
pub(crate) struct DropGuides(HashMap<Key, Guides>);

fn key(at: &Radius, order: u32) -> Key {
    (at.radius.to_bits(), at.place.to_bits(), order)
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
        let of_part = |part: &Part| {
            let all = radii(sizes, part.stretch, part.steps).into_iter();
            all.map(|at| (at, part.order)).collect::<Vec<_>>()
        };
        let flattened = steps.parts.iter().filter(|part| !part.spheres);
        let drops: Vec<(Radius, u32)> = flattened.flat_map(of_part).collect();
        let guides = drops
            .par_iter()
            .map(|(at, order)| {
                let drop = Drop::new(scene, plan, at, (wavelength, index))?;
                Ok(drop.guides(*order, range).map(|guides| (key(at, *order), guides)))
            })
            .collect::<Result<Vec<_>, SimulateError>>()?;
        Ok(Self(guides.into_iter().flatten().collect()))
    }

    /// Those of an order of a drop.
    pub fn of(&self, at: &Radius, order: u32) -> Option<&Guides> {
        self.0.get(&key(at, order))
    }
}
