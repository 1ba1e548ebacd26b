//! Everything that goes straight on: the shadow's diffraction, with the soft edge where external
//! reflection is computed beside it.

use super::diffraction::ForwardDiffraction;
use super::penumbra::Penumbra;
use super::penumbra_layout::near_axis;
use crate::farfield::direction::Direction;
use crate::optics::AmplitudeMatrix;
use num_complex::Complex64;

/// The forward wave of one particle and wavelength.
#[derive(Clone, Copy, Debug)]
pub struct ForwardWave<'a> {
    pub shadow: &'a ForwardDiffraction,
    /// The edge wave; beyond the axis it is among the planes of order 0.
    pub edge: Option<&'a Penumbra>,
    pub size_parameter: f64,
}

impl ForwardWave<'_> {
    /// The amplitude near the axis, where the forward peak is.
    pub fn peak(&self, direction: &Direction) -> AmplitudeMatrix {
        match self.edge {
            Some(edge) => edge.near_axis(direction),
            None => isotropic(self.shadow.amplitude(self.size_parameter, direction)),
        }
    }

    /// What is still to be added to the waves of planes in any direction.
    pub fn beside_planes(&self, direction: &Direction) -> AmplitudeMatrix {
        match self.edge {
            Some(_) if direction.theta < near_axis(self.size_parameter) => self.peak(direction),
            Some(_) => AmplitudeMatrix::default(),
            None => isotropic(self.shadow.tail(self.size_parameter, direction)),
        }
    }

    /// The same beyond the peak, at several scattering angles of one azimuth, while it lasts.
    pub fn tails(&self, theta: &[f64], phi: f64) -> Vec<AmplitudeMatrix> {
        if self.edge.is_some() {
            return Vec::new();
        }
        let farthest = self.shadow.farthest(self.size_parameter);
        let end = theta.partition_point(|&t| t < farthest);
        let tails = self.shadow.tails(self.size_parameter, &theta[..end], phi);
        tails.into_iter().map(isotropic).collect()
    }
}

/// The same for both polarisations.
fn isotropic(amplitude: Complex64) -> AmplitudeMatrix {
    AmplitudeMatrix { s1: amplitude, s2: amplitude, ..Default::default() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Shape;
    use std::f64::consts::TAU;

    /// Without an edge wave the sharp shadow stands for all: its peak, and its fading tail.
    #[test]
    fn a_sharp_shadow_has_peak_and_tail() {
        let shadow = ForwardDiffraction::new(&Shape::spheroid(0.9, 0.3).unwrap());
        let x = 400.0;
        let wave = ForwardWave { shadow: &shadow, edge: None, size_parameter: x };
        let ahead = wave.peak(&Direction::new(0.0, 0.0));
        assert!((ahead.s1 - x * x * shadow.area() / TAU).norm() < 1e-9 * x * x);
        assert_eq!((ahead.s1, ahead.s3), (ahead.s2, Complex64::default()));
        let theta: Vec<f64> = (0..=314).map(|k| 0.01 * f64::from(k)).collect();
        let tails = wave.tails(&theta, 0.4);
        assert!(tails.len() < theta.len() && theta[tails.len()] >= shadow.farthest(x));
        for (tail, &theta) in tails.iter().zip(&theta) {
            let one = wave.beside_planes(&Direction::new(theta, 0.4));
            assert!((tail.s1 - one.s1).norm() <= 1e-9 * one.s1.norm(), "{theta}");
        }
    }
}
