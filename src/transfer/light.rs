//! The light of a layer: order by order, and at any direction.

use super::error::TransferError;
use super::layer::{Fineness, Layer, check};
use super::quadrature::Directions;
use super::single::{Side, once};
use super::truncation::{forward_share, truncated};
use super::{adding, phase_matrix, thin};
use faer::Mat;
use std::f64::consts::{PI, TAU};

/// Light that a layer sends out when the sun shines on it.
///
/// Radiances are per irradiance across the sun's rays, sr⁻¹; azimuths are measured from where the light travels to,
/// cosines to the layer's normal. Stokes parameters are in the plane of line of sight and normal
/// ([`crate::optics`]).
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Cosine of the sun.
    sun: f64,
    /// Optical depth without the forward peak.
    depth: f64,
    /// Factor of light scattered once: albedo over 1 − albedo · forward.
    strength: f64,
    /// Share of the scattered light that counts as going straight on.
    pub forward: f64,
    nodes: Vec<f64>,
    /// Barycentric weights of the nodes.
    barycentric: Vec<f64>,
    views: usize,
    stokes: usize,
    /// By side and order: light scattered more often than once or off the ground, at nodes and views.
    more: [Vec<Vec<f64>>; 2],
    /// Share of the light that leaves the layer on the side of the sun.
    pub reflected: f64,
    /// Share that comes to the ground, straight or not.
    pub downward: f64,
    /// The same of `reflected` by light scattered once in the layer alone, the peak left out.
    pub reflected_once: f64,
}

impl Layer<'_> {
    /// Solve for the sun at a cosine, and at `views` besides the nodes.
    ///
    /// # Errors
    /// [`TransferError`] that names what no layer can be.
    pub fn light(
        &self,
        sun: f64,
        views: &[f64],
        fineness: &Fineness,
    ) -> Result<Light, TransferError> {
        check(self, sun, views, fineness)?;
        let degree = 2 * fineness.streams;
        let rest = match fineness.forward {
            Some(whole) => (whole - self.peak) / (1.0 - self.peak),
            None => forward_share(self.phase, degree),
        };
        let cut = truncated(self.phase, degree, rest);
        let forward = self.peak + (1.0 - self.peak) * cut.forward;
        let kept = 1.0 - self.albedo * forward;
        let depth = self.optical_depth * kept;
        let albedo = self.albedo * (1.0 - forward) / kept;

        let stokes = fineness.polarisation.components();
        let directions = Directions::new(fineness.streams, stokes, views, sun);
        let doublings = (depth / fineness.start).log2().ceil().max(0.0);
        let first = depth / doublings.exp2();
        let mut light = Light::dark(&directions, views.len(), depth, self.albedo / kept, forward);
        let mut largest = 0.0f64;
        for m in 0..cut.expansion.len() {
            let mut slab = thin::slab(&cut.expansion, albedo, first, m, &directions);
            for _ in 0..doublings as usize {
                slab = adding::doubled(&slab, &directions);
            }
            let [up, down] = if m == 0 && self.ground_albedo > 0.0 {
                adding::upon(&slab, &ground(self.ground_albedo, &directions), &directions)
            } else {
                [slab.reflection, slab.transmission]
            };
            let last = directions.columns() - 1;
            let total = [up, down].map(|kernel| -> Vec<f64> {
                (0..directions.rows()).map(|i| kernel[(i, last)] / TAU).collect()
            });
            let single = single_order(&cut.expansion, albedo, depth, m, &directions);
            if m == 0 {
                light.add_up_fluxes(&total, &single, &directions);
            }
            let more = [0, 1].map(|side| -> Vec<f64> {
                total[side].iter().zip(&single[side]).map(|(all, one)| all - one).collect()
            });
            let size = more.iter().flatten().fold(0.0f64, |most, value| most.max(value.abs()));
            largest = largest.max(size);
            let [lit, far] = more;
            light.more[0].push(lit);
            light.more[1].push(far);
            // single orders may vanish by chance, two in a row do not
            let small = size < fineness.least_order * largest;
            if small && light.last_sizes(m) < fineness.least_order * largest {
                break;
            }
        }
        Ok(light)
    }

    /// The same, with an error: on one side the largest difference from a solution of half as many streams, over the
    /// mean radiance, of what is scattered more often than once. The finer solution is nearer to the truth than that.
    ///
    /// # Errors
    /// As [`Layer::light`].
    pub fn light_with_error(
        &self,
        sun: f64,
        side: Side,
        fineness: &Fineness,
    ) -> Result<(Light, f64), TransferError> {
        let fine = self.light(sun, &[], fineness)?;
        let half = Fineness { streams: (fineness.streams / 2).max(2), ..fineness.clone() };
        let coarse = self.light(sun, &[], &half)?;
        let (mut most, mut mean) = (0.0f64, 0.0);
        for cosine in COMPARED {
            for k in 0..=6 {
                let azimuth = PI * f64::from(k) / 6.0;
                let [a, b] = [&fine, &coarse].map(|light| light.more(side, cosine, azimuth)[0]);
                most = most.max((a - b).abs());
                mean += a / (7.0 * COMPARED.len() as f64);
            }
        }
        Ok((fine, most / mean.abs().max(f64::MIN_POSITIVE)))
    }
}

/// Cosines at which two solutions are compared.
const COMPARED: [f64; 4] = [0.15, 0.4, 0.65, 0.9];

/// A ground that throws light back evenly and unpolarised.
fn ground(albedo: f64, directions: &Directions) -> Mat<f64> {
    let (rows, columns) = (directions.of_rows(), directions.of_columns());
    Mat::from_fn(rows.len(), columns.len(), |i, k| {
        let plain = rows[i].1 == 0 && columns[k].1 == 0;
        if plain { 2.0 * albedo * columns[k].0 } else { 0.0 }
    })
}

/// Light scattered once, of the truncated phase matrix, in one Fourier order, on both sides.
fn single_order(
    expansion: &super::Expansion,
    albedo: f64,
    depth: f64,
    m: usize,
    directions: &Directions,
) -> [Vec<f64>; 2] {
    let (rows, sun) = (directions.of_rows(), directions.sun());
    [(Side::Lit, -1.0), (Side::Far, 1.0)].map(|(side, sign)| {
        let z = phase_matrix::order(expansion, m, directions.stokes, sign, &rows, &[(sun, 0)]);
        let at = |i: usize| 0.5 * albedo / TAU * z[(i, 0)] * once(side, depth, rows[i].0, sun);
        (0..rows.len()).map(at).collect()
    })
}

impl Light {
    fn dark(
        directions: &Directions,
        views: usize,
        depth: f64,
        strength: f64,
        forward: f64,
    ) -> Self {
        let nodes = directions.nodes().to_vec();
        let weight = |(i, x): (usize, &f64)| {
            let others = nodes.iter().enumerate().filter(|(k, _)| *k != i);
            // in units of a quarter of the interval, so that products of many stay within range
            1.0 / others.map(|(_, y)| 4.0 * (x - y)).product::<f64>()
        };
        let barycentric = nodes.iter().enumerate().map(weight).collect();
        Self {
            sun: directions.sun(),
            depth,
            strength,
            forward,
            barycentric,
            nodes,
            views,
            stokes: directions.stokes,
            more: [Vec::new(), Vec::new()],
            reflected: 0.0,
            downward: 0.0,
            reflected_once: 0.0,
        }
    }

    fn add_up_fluxes(
        &mut self,
        total: &[Vec<f64>; 2],
        single: &[Vec<f64>; 2],
        directions: &Directions,
    ) {
        let flux = |radiance: &[f64]| -> f64 {
            let nodes = directions.nodes().iter().zip(&directions.weight).enumerate();
            TAU / self.sun
                * nodes.map(|(i, (mu, w))| mu * w * radiance[i * self.stokes]).sum::<f64>()
        };
        let straight = (-self.depth / self.sun).exp();
        let [reflected, downward] = [flux(&total[0]), flux(&total[1]) + straight];
        let reflected_once = flux(&single[0]);
        (self.reflected, self.downward, self.reflected_once) =
            (reflected, downward, reflected_once);
    }

    /// Size of the order before `m`.
    fn last_sizes(&self, m: usize) -> f64 {
        if m == 0 {
            return f64::INFINITY;
        }
        let both = self.more.iter().flat_map(|side| &side[m - 1]);
        both.fold(0.0f64, |most, value| most.max(value.abs()))
    }

    /// Orders of the series in azimuth.
    pub fn orders(&self) -> usize {
        self.more[0].len()
    }

    /// Components of light.
    pub fn stokes(&self) -> usize {
        self.stokes
    }

    /// Factor by which a phase function (sr⁻¹) becomes the radiance of light scattered once, by the exact phase function and
    /// the depth without the peak (Nakajima & Tanaka 1988, TMS).
    pub fn once(&self, side: Side, view: f64) -> f64 {
        self.strength * once(side, self.depth, view, self.sun)
    }

    /// Stokes parameters of light scattered more often than once, or off the ground, between the nodes.
    pub fn more(&self, side: Side, view: f64, azimuth: f64) -> [f64; 4] {
        let orders = self.orders_at(side, view);
        self.turned(&orders, azimuth)
    }

    /// The same at one of the views that were asked for.
    pub fn more_at_view(&self, side: Side, view: usize, azimuth: f64) -> [f64; 4] {
        let place = self.nodes.len() + view.min(self.views.saturating_sub(1));
        let orders = &self.more[side as usize];
        let orders: Vec<[f64; 4]> = orders
            .iter()
            .map(|order| std::array::from_fn(|s| self.component(order, place, s)))
            .collect();
        self.turned(&orders, azimuth)
    }

    /// Orders at a cosine, by the polynomial through the nodes; odd ones go with the sine of the angle.
    pub fn orders_at(&self, side: Side, view: f64) -> Vec<[f64; 4]> {
        let sine = |x: f64| (1.0 - x * x).max(0.0).sqrt();
        let met = self.nodes.iter().position(|x| (x - view).abs() < 1e-14);
        let weights: Vec<f64> = match met {
            Some(at) => (0..self.nodes.len()).map(|i| f64::from(u8::from(i == at))).collect(),
            None => {
                let nodes = self.nodes.iter().zip(&self.barycentric);
                let parts: Vec<f64> = nodes.map(|(x, w)| w / (view - x)).collect();
                let sum: f64 = parts.iter().sum();
                parts.iter().map(|part| part / sum).collect()
            }
        };
        let order = |(m, values): (usize, &Vec<f64>)| -> [f64; 4] {
            std::array::from_fn(|s| {
                let nodes = self.nodes.iter().zip(&weights).enumerate();
                let sum: f64 = nodes
                    .map(|(i, (x, w))| {
                        let scale = if m % 2 == 1 { sine(view) / sine(*x) } else { 1.0 };
                        scale * w * self.component(values, i, s)
                    })
                    .sum();
                sum
            })
        };
        self.more[side as usize].iter().enumerate().map(order).collect()
    }

    fn component(&self, order: &[f64], place: usize, component: usize) -> f64 {
        if component < self.stokes { order[place * self.stokes + component] } else { 0.0 }
    }

    /// The sum over orders at an azimuth.
    pub fn turned(&self, orders: &[[f64; 4]], azimuth: f64) -> [f64; 4] {
        let mut sum = [0.0; 4];
        for (m, order) in orders.iter().enumerate() {
            let (sine, cosine) = (m as f64 * azimuth).sin_cos();
            let twice = if m == 0 { 1.0 } else { 2.0 };
            for (s, value) in sum.iter_mut().enumerate() {
                *value += twice * order[s] * if s < 2 { cosine } else { sine };
            }
        }
        sum
    }
}
