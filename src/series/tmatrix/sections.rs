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
