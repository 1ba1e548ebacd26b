//! Cross-sections of a fixed body in balance, and what their imbalance says of T's error.

use super::far_field::FixedEfficiencies;
use super::matrix::TMatrix;
use crate::series::Efficiencies;

/// Efficiencies, over the shadow of the sphere of equal volume, in balance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sections {
    /// What the light loses.
    pub extinction: f64,
    /// What leaves.
    pub scattering: f64,
    /// What stays.
    pub absorption: f64,
    /// What extinction, scattering and absorption say of the error, as a share.
    pub lost: f64,
}

impl Sections {
    /// Without absorption whatever is lost is scattered, and the difference of the two powers is an error;
    /// with it, that less is lost than is scattered.
    pub fn new(q: &FixedEfficiencies, t: &TMatrix) -> Self {
        let extinction = q.q_ext;
        let absorption = extinction - q.q_sca;
        let lost = absorption.abs() / extinction;
        if t.index().im == 0.0 {
            return Self { extinction, scattering: extinction, absorption: 0.0, lost };
        }
        let lost = if absorption < 0.0 { lost } else { 0.0 };
        let absorption = absorption.max(0.0);
        Self { extinction, scattering: extinction - absorption, absorption, lost }
    }

    /// With what else is told of a particle.
    pub fn efficiencies(&self, q: &FixedEfficiencies) -> Efficiencies {
        Efficiencies {
            q_ext: self.extinction,
            q_sca: self.scattering,
            q_abs: self.absorption,
            q_back: q.q_back,
            asymmetry: q.asymmetry,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Shape;
    use num_complex::Complex64;

    /// What does not add up is an error where nothing may be absorbed, and absorption where something may.
    #[test]
    fn sections_are_in_balance() {
        let of = |k: f64, q_sca: f64| {
            let t = TMatrix::new(&Shape::sphere(), 1.0, Complex64::new(1.3, k), 1e-3).unwrap();
            let q =
                FixedEfficiencies { q_ext: 2.0, q_ahead: 2.0, q_sca, q_back: 0.5, asymmetry: 0.1 };
            Sections::new(&q, &t)
        };
        for (k, q_sca, absorption, lost) in [
            (0.0, 1.5, 0.0, 0.25),
            (0.1, 1.5, 0.5, 0.0),
            (0.1, 2.5, 0.0, 0.25),
            (0.0, 2.0, 0.0, 0.0),
        ] {
            let found = of(k, q_sca);
            assert_eq!((found.absorption, found.lost), (absorption, lost));
            assert_eq!(found.extinction, found.scattering + found.absorption);
        }
    }
}
