//! Orders that planes do not serve, or only in part, each by the method that it is assigned to: sums of
//! partial waves, on a complex wavefront, or patches.

use crate::farfield::assignment::{Assignment, Method};
use crate::farfield::complex_wavefront::ComplexWavefront;
use crate::farfield::partial_waves::PartialWaves;
use crate::farfield::patches::field::PatchField;
use crate::farfield::settings::FarFieldSettings;
use crate::farfield::wave_field::{WaveField, waves};
use crate::optics::AmplitudeMatrix;
use crate::trace::Tracer;

/// The waves of orders without planes.
pub(crate) struct FallbackField<'a>(Vec<Part<'a>>);

/// What one method serves.
struct Part<'a> {
    field: Box<dyn WaveField + 'a>,
    /// Its order; `None` for partial waves, which hold several.
    order: Option<u32>,
    /// Share of its amplitude by which its wave may be wrong, measured against Debye terms.
    doubt: f64,
}

impl<'a> FallbackField<'a> {
    /// What an assignment leaves beside scattering planes; `waves` are its partial waves.
    pub(crate) fn new(
        tracer: &Tracer<'a>,
        waves: Option<PartialWaves>,
        assignment: &Assignment,
        settings: &FarFieldSettings,
    ) -> Self {
        let mut parts: Vec<Part<'a>> = Vec::new();
        if let Some(waves) = waves {
            // theirs is measured on the sphere, and stated by the deformation of others
            parts.push(Part { field: Box::new(waves), order: None, doubt: 0.0 });
        }
        for order in assignment.orders_of(Method::Patches) {
            let field = Box::new(PatchField::of_orders(tracer, &[order], settings));
            parts.push(Part { field, order: Some(order), doubt: assignment.error_of(order) });
        }
        let shares = assignment.shares_of_sum();
        if !shares.is_empty() {
            for sum in ComplexWavefront::of_orders(tracer, &shares, settings.size_parameter) {
                let order = sum.order();
                let doubt = assignment.error_of(order);
                parts.push(Part { field: Box::new(sum), order: Some(order), doubt });
            }
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

    /// Add the waves of one order to columns of some azimuths.
    pub(crate) fn add_order(
        &self,
        order: u32,
        theta: &[f64],
        azimuths: &[f64],
        columns: &mut [Vec<AmplitudeMatrix>],
    ) {
        for part in self.0.iter().filter(|part| part.order == Some(order)) {
            part.field.add_columns(theta, azimuths, columns);
        }
    }
}

impl WaveField for FallbackField<'_> {
    fn add(&self, theta: &[f64], phi: f64, sums: &mut [AmplitudeMatrix]) {
        for part in &self.0 {
            part.field.add(theta, phi, sums);
        }
    }

    fn add_columns(&self, theta: &[f64], azimuths: &[f64], columns: &mut [Vec<AmplitudeMatrix>]) {
        for part in &self.0 {
            part.field.add_columns(theta, azimuths, columns);
        }
    }
}
