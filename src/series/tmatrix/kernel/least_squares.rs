//! Least squares on the surface: where the null field stalls.
//!
//! The same spherical waves, outgoing outside and regular inside, are fitted to the conditions of
//! continuity of tangential E and H at the Gauss nodes (generalised point matching). For strongly
//! deformed bodies the null field's equations lose what more terms would add, and no more digits
//! cure that; a fit by orthogonal factors (Householder's QR, columns scaled to about 1) still converges, though
//! its ill-conditioned columns say nothing about single coefficients of high degree.

use super::block::{OrderBlock, System, systems};
use super::null_field::components;
use super::waves::{Angular, NodeWaves, Radial, power_of_two};
use faer::Mat;
use faer::linalg::solvers::{Qr, SolveLstsq};
use num_complex::Complex64;

/// T of one order, kept for degrees to `kept`, from waves of degrees to `top ≥ kept`.
pub(in crate::series::tmatrix) fn order_block(
    waves: &[NodeWaves],
    index: Complex64,
    m: usize,
    (top, kept): (usize, usize),
    mirror: bool,
) -> OrderBlock {
    let angular: Vec<Angular> =
        waves.iter().map(|w| Angular::new(m, top, w.node.cos, w.node.sin)).collect();
    let outgoing: Vec<Radial<Complex64>> =
        waves.iter().map(|w| outgoing(&w.regular, &w.irregular)).collect();
    let mut block = OrderBlock::zero(m, kept);
    for (system, small) in systems(m, top, mirror).iter().zip(systems(m, kept, mirror)) {
        let surface = Matching { waves, angular: &angular, outgoing: &outgoing, index };
        block.put(&small, surface.fit(system, &small).as_ref());
    }
    block
}

fn outgoing(regular: &Radial<f64>, irregular: &Radial<f64>) -> Radial<Complex64> {
    let join = |re: &[f64], im: &[f64]| -> Vec<Complex64> {
        re.iter().zip(im).map(|(&re, &im)| Complex64::new(re, im)).collect()
    };
    Radial {
        value: join(&regular.value, &irregular.value),
        derivative: join(&regular.derivative, &irregular.derivative),
        across: join(&regular.across, &irregular.across),
    }
}

/// Conditions at the nodes.
struct Matching<'a> {
    waves: &'a [NodeWaves],
    angular: &'a [Angular],
    outgoing: &'a [Radial<Complex64>],
    index: Complex64,
}

/// A kind of wave at the surface.
#[derive(Clone, Copy)]
enum Side {
    Incident,
    Outgoing,
    Inside,
}

impl Matching<'_> {
    fn fit(&self, system: &System, kept: &System) -> Mat<Complex64> {
        let rows = 4 * self.waves.len();
        let columns = ordered(system);
        let unknowns: Vec<(Side, bool, usize)> = columns
            .iter()
            .flat_map(|&(electric, n)| [(Side::Outgoing, electric, n), (Side::Inside, electric, n)])
            .collect();
        let mut matrix = Mat::zeros(rows, unknowns.len());
        let mut scales = Vec::with_capacity(unknowns.len());
        for (k, &(side, electric, n)) in unknowns.iter().enumerate() {
            let column = self.column(side, electric, n);
            let largest = column.iter().fold(0.0f64, |most, value| most.max(value.norm()));
            scales.push(power_of_two(largest));
            (0..rows).for_each(|i| matrix[(i, k)] = column[i] * scales[k]);
        }
        let driven: Vec<(bool, usize)> = plain(kept);
        let mut right = Mat::zeros(rows, driven.len());
        for (k, &(electric, n)) in driven.iter().enumerate() {
            let column = self.column(Side::Incident, electric, n);
            (0..rows).for_each(|i| right[(i, k)] = -column[i]);
        }
        let solution = Qr::new(matrix.as_ref()).solve_lstsq(&right);
        let place = |wave: &(bool, usize)| {
            2 * columns.iter().position(|other| other == wave).unwrap_or_default()
        };
        let rows: Vec<usize> = driven.iter().map(place).collect();
        Mat::from_fn(driven.len(), driven.len(), |i, k| {
            let sign = if driven[i].0 == driven[k].0 { 1.0 } else { -1.0 };
            solution[(rows[i], k)] * (sign * scales[rows[i]])
        })
    }

    /// Tangential E (two components), then H, of one wave at all nodes.
    fn column(&self, side: Side, electric: bool, n: usize) -> Vec<Complex64> {
        let count = self.waves.len();
        let mut column = vec![Complex64::ZERO; 4 * count];
        for (g, (wave, angle)) in self.waves.iter().zip(self.angular).enumerate() {
            let weight = wave.node.weight.sqrt() * wave.node.radius;
            let slope = wave.node.slope;
            // z'π, z'τ + …, zπ, zτ
            let (c, e, h) = match side {
                Side::Incident => {
                    let real = components(&wave.regular, angle, slope, n, weight);
                    (real.map(Complex64::from), Complex64::ONE, Complex64::ONE)
                }
                Side::Outgoing => {
                    let c = components(&self.outgoing[g], angle, slope, n, weight);
                    (c, Complex64::ONE, Complex64::ONE)
                }
                Side::Inside => {
                    let c = components(&wave.inside, angle, slope, n, weight);
                    (c, -Complex64::ONE, -self.index)
                }
            };
            let values = if electric {
                [e * c[1], e * c[0], -(h * c[2]), -(h * c[3])]
            } else {
                [e * c[2], e * c[3], h * c[1], h * c[0]]
            };
            values.into_iter().enumerate().for_each(|(part, v)| column[part * count + g] = v);
        }
        column
    }
}

/// Waves (electric or not, n) of a system, high degrees last.
fn ordered(system: &System) -> Vec<(bool, usize)> {
    let mut waves = plain(system);
    waves.sort_by_key(|&(electric, n)| (n, electric));
    waves
}

/// Waves in the order of a block: magnetic, then electric.
fn plain(system: &System) -> Vec<(bool, usize)> {
    let magnetic = system.magnetic.iter().map(|&n| (false, n));
    magnetic.chain(system.electric.iter().map(|&n| (true, n))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::series::tmatrix::kernel::null_field;
    use crate::series::tmatrix::kernel::surface::Surface;
    use crate::series::tmatrix::kernel::waves::on_surface;
    use crate::shape::Shape;

    /// Both methods find the T of a body that both bear; a plane of symmetry saves work and changes nothing.
    #[test]
    fn the_fit_and_the_null_field_agree() {
        let (x, index, top, kept) = (3.0, Complex64::new(1.4, 0.02), 20, 13);
        let shape = Shape::spheroid(0.8, 0.0).unwrap();
        let mut surface = Surface::new(&shape).unwrap();
        let half = on_surface(&surface.nodes(60).unwrap(), x, index, top);
        surface.mirror = false;
        let whole = on_surface(&surface.nodes(60).unwrap(), x, index, top);
        for m in [0, 1, 2] {
            let fit = order_block(&whole, index, m, (top, kept), false);
            let mirrored = order_block(&half, index, m, (top, kept), true);
            let known = null_field::order_block(&half, index, m, top, true);
            let norm = known.norm_and_oddness().0;
            let apart =
                (fit.squared_distance(&known) / norm, fit.squared_distance(&mirrored) / norm);
            assert!(apart.0 < 1e-14 && apart.1 < 1e-18, "{m} {apart:?}");
        }
    }
}
