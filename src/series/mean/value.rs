//! What an average gives: elements of the Mueller matrix, cross-sections, its error.

use super::sum::Summed;

/// Mean per particle.
#[derive(Clone, Debug)]
pub struct Mean {
    /// S11, S12, S33, S34 by angle as areas per solid angle, m²/sr.
    pub elements: Vec<[f64; 4]>,
    /// Scattering cross-section, m².
    pub scattering: f64,
    /// Absorption cross-section, m².
    pub absorption: f64,
    /// Extinction by the optical theorem on the mean amplitudes straight ahead, m²: scattering and
    /// absorption by another way.
    pub forward_extinction: f64,
    /// Mean cosine of the scattering angle.
    pub asymmetry: f64,
    /// Relative error: the largest of that of S11, root mean square over all angles, of scattering
    /// and of absorption, estimated from half the cut and from panels twice as wide; and the share of the
    /// light in the tails of the distribution, which is left out.
    pub error: f64,
    /// Spheres that were solved.
    pub spheres: usize,
}

impl Mean {
    pub(super) fn new(total: Summed, angles: usize, error: f64, spheres: usize) -> Mean {
        let mut elements = total.elements;
        elements.truncate(angles);
        Mean {
            elements,
            scattering: total.scattering,
            absorption: total.absorption,
            forward_extinction: total.extinction,
            asymmetry: total.forward / total.scattering,
            error,
            spheres,
        }
    }

    pub(super) fn scaled(mut self, factor: f64) -> Mean {
        self.elements.iter_mut().flatten().for_each(|value| *value *= factor);
        self.scattering *= factor;
        self.absorption *= factor;
        self.forward_extinction *= factor;
        self.error *= factor;
        self
    }

    pub(super) fn plus(mut self, other: &Mean) -> Mean {
        let pairs = self.elements.iter_mut().flatten().zip(other.elements.iter().flatten());
        pairs.for_each(|(sum, value)| *sum += value);
        let scattering = self.scattering + other.scattering;
        self.asymmetry =
            (self.asymmetry * self.scattering + other.asymmetry * other.scattering) / scattering;
        self.scattering = scattering;
        self.absorption += other.absorption;
        self.forward_extinction += other.forward_extinction;
        self.error += other.error;
        self.spheres += other.spheres;
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mean(scattering: f64, asymmetry: f64) -> Mean {
        Mean {
            elements: vec![[scattering, 0.1, 0.2, 0.3]; 2],
            scattering,
            absorption: 0.5 * scattering,
            forward_extinction: 1.5 * scattering,
            asymmetry,
            error: 0.01,
            spheres: 3,
        }
    }

    /// Areas add up, the asymmetry is weighted by what is scattered.
    #[test]
    fn means_add_up() {
        let sum = mean(1.0, 0.8).plus(&mean(3.0, 0.4).scaled(2.0));
        assert_eq!((sum.scattering, sum.absorption, sum.spheres), (7.0, 3.5, 6));
        assert_eq!(sum.forward_extinction, 10.5);
        assert!((sum.asymmetry - (0.8 + 6.0 * 0.4) / 7.0).abs() < 1e-15);
        assert!((sum.error - 0.03).abs() < 1e-15 && sum.elements[1][0] == 7.0);
        assert!((sum.elements[0][3] - 0.9).abs() < 1e-15);
    }
}
