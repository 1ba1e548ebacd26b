//! The directions of a table as a grid that can be asked for any direction in between.

use crate::phase_table::Axes;
use std::f64::consts::TAU;

/// θ × φ samples with bilinear interpolation; φ goes round.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectionGrid {
    /// Scattering angles, radians, ascending.
    pub theta: Vec<f64>,
    /// As in the table; one value when the table stands for all azimuths.
    pub phi: Vec<f64>,
    /// The last sample and the first are neighbours across 2π (the axis does not repeat the end).
    wraps: bool,
    /// The axis covers the whole circle, with or without repeating the end.
    whole_circle: bool,
    even_theta: bool,
    even_phi: bool,
}

/// Four samples and their weights; indices into a θ-major array of θ × φ.
pub(super) type Corners = [(usize, f64); 4];

impl DirectionGrid {
    /// The directions of a table.
    pub fn new(axes: &Axes) -> Self {
        let (theta, phi) = (axes.theta.clone(), axes.phi.clone());
        let (wraps, whole_circle) = match phi.as_slice() {
            [first, .., before, last] => {
                let (span, step) = (last - first, last - before);
                let closed = (span - TAU).abs() < 1e-9 * TAU;
                let wraps = !closed && (span + step - TAU).abs() < 1e-6 * TAU;
                (wraps, closed || wraps)
            }
            _ => (false, phi.len() == 1),
        };
        let (even_theta, even_phi) = (even(&theta), even(&phi));
        Self { theta, phi, wraps, whole_circle, even_theta, even_phi }
    }

    /// Number of samples.
    pub fn len(&self) -> usize {
        self.theta.len() * self.phi.len()
    }

    /// The table has one azimuth and stands for all.
    pub fn is_rotational(&self) -> bool {
        self.phi.len() == 1
    }

    /// The samples around a direction (radians), or nothing where the table does not reach.
    pub fn corners(&self, theta: f64, phi: f64) -> Option<Corners> {
        let (t, ft) = locate(&self.theta, self.even_theta, theta)?;
        let next_t = (t + 1).min(self.theta.len() - 1);
        let (p, next_p, fp) = self.locate_phi(phi)?;
        let n = self.phi.len();
        Some([
            (t * n + p, (1.0 - ft) * (1.0 - fp)),
            (t * n + next_p, (1.0 - ft) * fp),
            (next_t * n + p, ft * (1.0 - fp)),
            (next_t * n + next_p, ft * fp),
        ])
    }

    fn locate_phi(&self, phi: f64) -> Option<(usize, usize, f64)> {
        let count = self.phi.len();
        if count == 1 {
            return Some((0, 0, 0.0));
        }
        let first = self.phi[0];
        let phi = first + (phi - first).rem_euclid(TAU);
        let last = self.phi[count - 1];
        if self.wraps && phi > last {
            return Some((count - 1, 0, (phi - last) / (first + TAU - last)));
        }
        if phi > last && self.whole_circle {
            return Some((count - 1, count - 1, 0.0));
        }
        let (p, fraction) = locate(&self.phi, self.even_phi, phi)?;
        Some((p, (p + 1).min(count - 1), fraction))
    }
}

/// Are the samples evenly spaced (to rounding)? Then the interval is found without a search.
fn even(axis: &[f64]) -> bool {
    let count = axis.len();
    if count < 2 {
        return false;
    }
    let step = (axis[count - 1] - axis[0]) / (count - 1) as f64;
    axis.iter().enumerate().all(|(i, &x)| (x - axis[0] - step * i as f64).abs() < 1e-3 * step)
}

/// Interval of an ascending axis and the place in it, with a little slack at both ends.
fn locate(axis: &[f64], even: bool, x: f64) -> Option<(usize, f64)> {
    let (first, last) = (*axis.first()?, *axis.last()?);
    let slack = 1e-6;
    if x < first - slack || x > last + slack || x.is_nan() {
        return None;
    }
    if axis.len() == 1 {
        return Some((0, 0.0));
    }
    let top = axis.len() - 2;
    let index = if even {
        let step = (last - first) / (axis.len() - 1) as f64;
        (((x - first) / step).max(0.0) as usize).min(top)
    } else {
        axis.partition_point(|&value| value <= x).saturating_sub(1).min(top)
    };
    let fraction = (x - axis[index]) / (axis[index + 1] - axis[index]);
    Some((index, fraction.clamp(0.0, 1.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(phi: Vec<f64>) -> DirectionGrid {
        let theta = (0..=18).map(|i| (10.0 * i as f64).to_radians()).collect();
        DirectionGrid::new(&Axes { wavelength: vec![], theta, phi })
    }

    fn value(grid: &DirectionGrid, theta: f64, phi: f64) -> f64 {
        let n = grid.phi.len();
        let sample = |i: usize| grid.theta[i / n] + grid.phi[i % n].cos();
        let corners = grid.corners(theta, phi).unwrap();
        corners.iter().map(|&(i, w)| w * sample(i)).sum()
    }

    /// A closed axis (0 to 360) and one that wraps (0 to 350) must answer alike across the seam.
    #[test]
    fn seam_in_azimuth_is_invisible() {
        let degrees = |count: usize| (0..count).map(|i| (10.0 * i as f64).to_radians()).collect();
        let (closed, wrapping) = (grid(degrees(37)), grid(degrees(36)));
        for i in -40..80 {
            let phi = 0.13 * i as f64;
            let (a, b) = (value(&closed, 1.0, phi), value(&wrapping, 1.0, phi));
            assert!((a - b).abs() < 1e-12, "{phi}");
            assert!((a - 1.0 - phi.cos()).abs() < 5e-3, "{phi}");
        }
    }

    #[test]
    fn beyond_the_table_there_is_nothing() {
        let part = grid((0..10).map(|i| 0.1 * i as f64).collect());
        assert!(part.corners(1.0, 0.5).is_some());
        assert!(part.corners(1.0, 2.0).is_none());
        assert!(part.corners(3.5, 0.5).is_none());
        assert!(part.corners(f64::NAN, 0.5).is_none());
    }
}
