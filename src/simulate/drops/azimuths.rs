//! Azimuths at which means over sizes are computed, and those of the table from them.
//!
//! The light of one drop has fringes that turn with the azimuth; of the mean over sizes nothing but the slow
//! change of bows is left. Few azimuths serve, evenly over a half-turn, with the mirror image for the rest.

use crate::math::half_turn::shares;
use crate::math::parallel::*;
use crate::optics::mirror_sign;
use crate::plan::{Plan, Symmetry};
use crate::scene::{Scene, SunDisc};
use crate::sun_disc::near_axis;
use ndarray::{Array3, Axis};
use std::f64::consts::PI;

/// Steps of a half-turn: 5°.
const STEPS: usize = 36;
/// Neighbours in the interpolation.
const STENCIL: usize = 6;

/// Where a mean is computed.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Azimuths {
    /// At those of the table, folded into [0, π]; for each of the table which one serves, and whether as a
    /// mirror image.
    Asked(Vec<f64>, Vec<(usize, bool)>),
    /// At even steps of a half-turn, both ends in.
    Even,
}

impl Azimuths {
    /// For the azimuths of a table that are computed, and their places; at all of them where a mean over the sun's
    /// disc `takes_together` what is about the axis.
    pub fn new((computed, places): (Vec<f64>, Vec<(usize, bool)>), takes_together: bool) -> Self {
        if computed.len() <= STEPS && !takes_together {
            Self::Asked(computed, places)
        } else {
            Self::Even
        }
    }

    /// Those of one kind of drops under a scene's sun.
    pub fn of(scene: &Scene, plan: &Plan) -> Self {
        let together = scene.sun_disc != SunDisc::None
            && plan.symmetry != Symmetry::Rotational
            && near_axis(&scene.theta);
        Self::new(plan.computed_azimuths(&plan.table_azimuths(&scene.phi)), together)
    }

    /// Even steps of a half-turn, where they are.
    pub fn half_turn(&self) -> Option<usize> {
        (*self == Self::Even).then_some(STEPS)
    }

    /// Radians, in [0, π].
    pub fn computed(&self) -> Vec<f64> {
        match self {
            Self::Asked(computed, _) => computed.clone(),
            Self::Even => (0..=STEPS).map(|j| PI * j as f64 / STEPS as f64).collect(),
        }
    }

    /// The values of a table (elements, θ, its azimuths) from the computed ones.
    pub fn spread(&self, values: &Array3<f64>, table: &[f64]) -> Array3<f64> {
        let (elements, theta, _) = values.dim();
        let sources: Vec<Vec<(usize, bool, f64)>> = match self {
            Self::Asked(_, places) => {
                places.iter().map(|&(index, mirrored)| vec![(index, mirrored, 1.0)]).collect()
            }
            Self::Even => table
                .iter()
                .map(|&phi| {
                    let shares = shares::<STENCIL>(phi, STEPS + 1);
                    shares.map(|s| (s.index, s.mirrored, s.weight)).to_vec()
                })
                .collect(),
        };
        let mut out = Array3::<f64>::zeros((elements, theta, table.len()));
        for (e, mut face) in out.axis_iter_mut(Axis(0)).enumerate() {
            let from = values.index_axis(Axis(0), e);
            let rows = face.axis_iter_mut(Axis(0)).into_par_iter().zip(from.axis_iter(Axis(0)));
            rows.for_each(|(mut row, from)| {
                for (value, sources) in row.iter_mut().zip(&sources) {
                    let share = |&(index, mirrored, weight): &(usize, bool, f64)| {
                        let sign = if mirrored { mirror_sign(e) } else { 1.0 };
                        sign * weight * from[index]
                    };
                    *value = sources.iter().map(share).sum();
                }
            });
        }
        // what a polynomial leaves below nothing at the edge of darkness is nothing
        out.index_axis_mut(Axis(0), 0).mapv_inplace(|value| value.max(0.0));
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Smooth functions come back at any azimuth; elements that the mirror turns over change their sign.
    #[test]
    fn few_azimuths_make_many() {
        let table: Vec<f64> = (0..=360).map(|i| f64::from(i).to_radians()).collect();
        let folded: Vec<f64> = (0..=180).map(|i| f64::from(i).to_radians()).collect();
        let azimuths = Azimuths::new((folded, Vec::new()), false);
        let computed = azimuths.computed();
        assert_eq!(computed.len(), STEPS + 1);
        let known = |e: usize, phi: f64| {
            if mirror_sign(e) < 0.0 { (2.0 * phi).sin() } else { 2.0 + (3.0 * phi).cos() }
        };
        let values =
            Array3::from_shape_fn((16, 2, computed.len()), |(e, _, j)| known(e, computed[j]));
        let spread = azimuths.spread(&values, &table);
        for ((e, _, j), value) in spread.indexed_iter() {
            assert!((value - known(e, table[j])).abs() < 2e-5, "{e} {j}: {value}");
        }
        let few = Azimuths::new((vec![0.0, 1.0], vec![(1, true), (0, false)]), false);
        assert_eq!(few.computed(), [0.0, 1.0]);
        let values = Array3::from_shape_fn((16, 1, 2), |(_, _, j)| 1.0 + j as f64);
        let spread = few.spread(&values, &[-1.0, 0.0]);
        assert_eq!(
            (spread[(0, 0, 0)], spread[(2, 0, 0)].abs(), spread[(0, 0, 1)]),
            (2.0, 2.0, 1.0)
        );
    }
}
