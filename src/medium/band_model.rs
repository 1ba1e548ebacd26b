//! Models of dyes for which no measured table of n and k could be found. **Not measurements.**
//!
//! k is a sum of Gaussian bands in wavenumber, `k(λ) = Σ kᵢ exp(−(1/λ − 1/λᵢ)²/2σᵢ²)`, at fraction 1;
//! a solution scales it. n follows by Kramers–Kronig. Gaussians are what a dye's bands look like in
//! solution, and what Weidlich & Wilkie 2009 (sec. 3.2.1) name for the purpose.
//!
//! - **Rose bengal in water**: bands at 549 nm (monomer) and 515 nm (shoulder of the dimer). The
//!   height is set so that a 10 % solution reaches k = 0.04, the top of the axis in Weidlich &
//!   Wilkie 2009, fig. 4(b), whose curves are after van der Plaats 1915.
//! - **Fuchsine in alcohol**: one band at 547 nm with a weak shoulder at 505 nm. The height follows
//!   from a molar absorptivity of 9·10⁴ L/(mol cm), 337.9 g/mol and 0.17 kg of dye per litre of
//!   Christiansen's 19 % solution (1871): k = ε c ln(10) λ/4π = 0.45.
//!
//! Positions, widths and the absorptivity are round numbers typical of these dyes, chosen for this
//! program; do not quote digits.

use crate::medium::error::MediumError;
use crate::medium::kramers_kronig::{Absorption, Tails};
use crate::medium::solution::Dye;

/// A dye as a sum of Gaussian bands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BandModel {
    name: &'static str,
    bands: &'static [Band],
    source: &'static str,
}

/// One band: centre in nm, standard deviation in cm⁻¹, k of its top at fraction 1.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Band {
    centre_nm: f64,
    sigma_per_cm: f64,
    top: f64,
}

const ROSE_BENGAL: BandModel = BandModel {
    name: "rose-bengal-model",
    bands: &[
        Band { centre_nm: 549.0, sigma_per_cm: 430.0, top: 0.386 },
        Band { centre_nm: 515.0, sigma_per_cm: 700.0, top: 0.130 },
    ],
    source: "MODEL, not a measurement: two Gaussian bands; a 10 % solution reaches k = 0.04 as in \
        Weidlich & Wilkie 2009, fig. 4(b)",
};

const FUCHSINE: BandModel = BandModel {
    name: "fuchsine-model",
    bands: &[
        Band { centre_nm: 547.0, sigma_per_cm: 600.0, top: 2.30 },
        Band { centre_nm: 505.0, sigma_per_cm: 900.0, top: 0.70 },
    ],
    source: "MODEL, not a measurement: two Gaussian bands; k of a 19 % solution about 0.45 from a \
        molar absorptivity of 9e4 L/(mol cm)",
};

impl BandModel {
    /// The model of a name.
    pub fn by_name(name: &str) -> Option<Self> {
        [ROSE_BENGAL, FUCHSINE].into_iter().find(|model| model.name == name)
    }

    /// k at fraction 1 at a wavelength in metres.
    pub fn extinction(&self, wavelength: f64) -> f64 {
        let per_cm = |w: f64| 0.01 / w;
        let band = |b: &Band| {
            let u = (per_cm(wavelength) - per_cm(b.centre_nm * 1e-9)) / b.sigma_per_cm;
            b.top * (-0.5 * u * u).exp()
        };
        self.bands.iter().map(band).sum()
    }

    /// The dye at fraction 1, tabulated every nanometre from 300 to 900 nm; at the ends the bands
    /// are far below any other number in the program.
    pub(super) fn dye(&self) -> Result<Dye, MediumError> {
        let wavelength: Vec<f64> = (300..=900).map(|nm| f64::from(nm) / 1e9).collect();
        let k: Vec<f64> = wavelength.iter().map(|&w| self.extinction(w)).collect();
        let absorption = Absorption::new(&wavelength, &k, Tails::Taper)?;
        let notes = Vec::new();
        Ok(Dye { name: self.name.into(), source: self.source.into(), absorption, notes })
    }
}
