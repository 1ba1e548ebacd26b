//! Two slabs, one upon the other; a slab upon the ground; a slab doubled until it is as thick as asked.
//!
//! Light goes to and fro between the two (van de Hulst 1980, section 4.5; de Haan, Bosma & Hovenier 1987, eqs. 84 to
//! 93): with `Q = (1 − R*_top R_bottom)⁻¹ R*_top R_bottom` the diffuse light between them is
//! `D = T + Q e + Q T` downwards and `U = R_bottom (e + D)` upwards.

use super::quadrature::Directions;
use super::slab::{Slab, Straight, product, resolved};
use faer::Mat;

/// Light between two slabs that comes of light from above.
pub(super) struct Between {
    /// Downwards, without what passed straight through the upper.
    pub down: Mat<f64>,
    /// Upwards.
    pub up: Mat<f64>,
}

/// Light between a slab and what reflects below it.
pub(super) fn between(
    top: (&Mat<f64>, &Mat<f64>, &Straight),
    reflection: &Mat<f64>,
    directions: &Directions,
) -> Between {
    let (transmission, reflection_below, straight) = top;
    let weights = directions.weights();
    let once = product(reflection_below.as_ref(), &weights, reflection.as_ref());
    let nodes = once.as_ref().subrows(0, weights.len()).to_owned();
    let all = resolved(|_| 1.0, |_| 1.0, &once, &weights, nodes);
    let to_and_fro = &once + product(once.as_ref(), &weights, all.as_ref());
    let down = transmission
        + times_columns(&to_and_fro, &straight.columns)
        + product(to_and_fro.as_ref(), &weights, transmission.as_ref());
    let up = times_columns(reflection, &straight.columns)
        + product(reflection.as_ref(), &weights, down.as_ref());
    Between { down, up }
}

/// Reflection and transmission of a slab upon another, lit from the upper one's side.
fn lit(
    [reflection, transmission]: [&Mat<f64>; 2],
    [reflection_below, transmission_below]: [&Mat<f64>; 2],
    straight: &Straight,
    [under_reflection, under_transmission]: [&Mat<f64>; 2],
    under: &Straight,
    directions: &Directions,
) -> [Mat<f64>; 2] {
    let weights = directions.weights();
    let top = (transmission, reflection_below, straight);
    let Between { down, up } = between(top, under_reflection, directions);
    let whole = reflection
        + times_rows(&up, &straight.rows)
        + product(transmission_below.as_ref(), &weights, up.as_ref());
    let through = times_rows(&down, &under.rows)
        + times_columns(under_transmission, &straight.columns)
        + product(under_transmission.as_ref(), &weights, down.as_ref());
    [whole, through]
}

/// A slab upon itself.
pub(super) fn doubled(slab: &Slab, directions: &Directions) -> Slab {
    let down = [&slab.reflection, &slab.transmission];
    let up = [&slab.reflection_below, &slab.transmission_below];
    let straight = &slab.straight;
    let [reflection, transmission] = lit(down, up, straight, down, straight, directions);
    let square = |shares: &[f64]| shares.iter().map(|share| share * share).collect();
    let straight = Straight { rows: square(&straight.rows), columns: square(&straight.columns) };
    Slab::homogeneous(reflection, transmission, straight, directions)
}

/// What is seen of a slab upon a reflecting ground: upwards above it, downwards below it.
pub(super) fn upon(slab: &Slab, ground: &Mat<f64>, directions: &Directions) -> [Mat<f64>; 2] {
    let top = (&slab.transmission, &slab.reflection_below, &slab.straight);
    let Between { down, up } = between(top, ground, directions);
    let weights = directions.weights();
    let whole = &slab.reflection
        + times_rows(&up, &slab.straight.rows)
        + product(slab.transmission_below.as_ref(), &weights, up.as_ref());
    [whole, down]
}

fn times_rows(kernel: &Mat<f64>, factors: &[f64]) -> Mat<f64> {
    Mat::from_fn(kernel.nrows(), kernel.ncols(), |i, k| kernel[(i, k)] * factors[i])
}

fn times_columns(kernel: &Mat<f64>, factors: &[f64]) -> Mat<f64> {
    Mat::from_fn(kernel.nrows(), kernel.ncols(), |i, k| kernel[(i, k)] * factors[k])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transfer::expansion::Expansion;
    use crate::transfer::thin;

    /// Two starts that are far apart make the same slab, in an order where all components couple.
    #[test]
    fn thickness_at_the_start_does_not_matter() {
        let directions = Directions::new(6, 4, &[0.9], 0.5);
        let mut expansion = Expansion::henyey_greenstein(0.6, 12);
        expansion.add(&Expansion::rayleigh(), 0.5);
        expansion.alpha[0][0] = 1.0;
        let doubled_from = |times: i32| {
            let mut slab = thin::slab(&expansion, 0.95, 2f64.powi(-times), 1, &directions);
            for _ in 0..times {
                slab = doubled(&slab, &directions);
            }
            slab
        };
        let (one, other) = (doubled_from(13), doubled_from(18));
        for (a, b) in
            [(&one.reflection, &other.reflection), (&one.transmission, &other.transmission)]
        {
            for i in 0..directions.rows() {
                for k in 0..directions.columns() {
                    let scale = b[(i, k)].abs() + 0.1;
                    assert!(
                        (a[(i, k)] - b[(i, k)]).abs() < 1e-6 * scale,
                        "{} {}",
                        a[(i, k)],
                        b[(i, k)]
                    );
                }
            }
        }
    }
}
