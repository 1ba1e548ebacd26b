//! Orders that planes do not serve, each by the method that it is assigned to: sums of partial waves, of
//! beams, or patches.

use crate::farfield::assignment::{Assignment, Method};
use crate::farfield::gaussian_beams::GaussianBeams;
use crate::farfield::partial_waves::PartialWaves;
use crate::farfield::patches::field::PatchField;
use crate::farfield::settings::FarFieldSettings;
use crate::farfield::wave_field::{WaveField, waves};
use crate::optics::AmplitudeMatrix;
use crate::trace::Tracer;

/// The waves of orders without planes.
pub(crate) struct FallbackField(Vec<Part>);

/// Orders that one method serves.
struct Part {
    field: Box<dyn WaveField>,
    /// Share of its amplitude by which its wave may be wrong, measured against Debye terms.
    doubt: f64,
}

impl FallbackField {
    /// What an assignment leaves beside scattering planes; `waves` are its partial waves.
    pub(crate) fn new(
        tracer: &Tracer,
        waves: Option<PartialWaves>,
        assignment: &Assignment,
        settings: &FarFieldSettings,
    ) -> Self {
        let mut parts = Vec::new();
        if let Some(waves) = waves {
            // theirs is measured on the sphere, and stated by the deformation of others
            parts.push(Part { field: Box::new(waves), doubt: 0.0 });
        }
        let doubt = |orders: &[u32]| orders.iter().min().map(|&lowest| assignment.error_of(lowest));
        let (reflected, transmitted): (Vec<u32>, Vec<u32>) =
            assignment.orders_of(Method::Patches).into_iter().partition(|&order| order == 0);
        for orders in [reflected, transmitted] {
            if let Some(doubt) = doubt(&orders) {
                let field = Box::new(PatchField::of_orders(tracer, &orders, settings));
                parts.push(Part { field, doubt });
            }
        }
        let by_beams = assignment.orders_of(Method::Beams);
        if let Some(doubt) = doubt(&by_beams) {
            let (azimuths, x) = (settings.azimuths, settings.size_parameter);
            let field = Box::new(GaussianBeams::new(tracer, &by_beams, azimuths, x));
            parts.push(Part { field, doubt });
        }
        Self(parts)
    }

    /// The waves at one azimuth, with `S11` of what may be wrong.
    pub(crate) fn doubted(&self, theta: &[f64], phi: f64) -> (Vec<AmplitudeMatrix>, Vec<f64>) {
        let mut sums = vec![AmplitudeMatrix::default(); theta.len()];
        let mut wrong = vec![0.0; theta.len()];
        for part in &self.0 {
            let waves = waves(&*part.field, theta, phi);
            for (i, wave) in waves.into_iter().enumerate() {
                sums[i] += wave;
                wrong[i] += part.doubt * part.doubt * wave.s11();
            }
        }
        (sums, wrong)
    }
}

impl WaveField for FallbackField {
    fn add(&self, theta: &[f64], phi: f64, sums: &mut [AmplitudeMatrix]) {
        for part in &self.0 {
            part.field.add(theta, phi, sums);
        }
    }
}
