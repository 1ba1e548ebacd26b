//! What the far field holds for one column of a table: all scattering angles at one azimuth.

use crate::optics::AmplitudeMatrix;

/// What a column of the far field (all θ at one azimuth) holds.
#[derive(Clone, Debug)]
pub struct Column {
    /// Coherent amplitudes by θ, without forward diffraction.
    pub amplitude: Vec<AmplitudeMatrix>,
    /// Mueller matrices without interference; empty unless asked for.
    pub incoherent: Vec<[[f64; 4]; 4]>,
    /// Rays by order and θ; empty where not known.
    pub rays: Vec<Vec<u16>>,
    /// Caustic mask by θ; empty where not known.
    pub caustic_order: Vec<u8>,
}

impl Column {
    /// Of amplitudes alone.
    pub fn of_amplitudes(amplitude: Vec<AmplitudeMatrix>) -> Self {
        Self { amplitude, incoherent: Vec::new(), rays: Vec::new(), caustic_order: Vec::new() }
    }
}
