//! What a far field is made with.

/// What a far field is made with.
#[derive(Clone, Debug)]
pub struct FarFieldSettings<'a> {
    /// Circumference of the sphere of equal volume over the wavelength.
    pub size_parameter: f64,
    /// Orders (chords) to sum.
    pub orders: &'a [u32],
    /// Relative error asked for.
    pub tolerance: f64,
    /// Whether forward diffraction goes with order 0, joined by the edge wave.
    pub diffraction: bool,
}
