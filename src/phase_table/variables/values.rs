//! Words of the large variables, whose values each store writes in its own way.

use super::Variable;
use super::dimensions::Dimensions;
use crate::phase_table::Quantity;

/// Variables that accompany the values without being dimensions.
const COORDINATES: &str = "angle_from_antisolar_point radius_um sun_elevation solar_zenith_angle";

/// Name of the mask of caustics.
pub const CAUSTIC_ORDER: &str = "caustic_order";
/// Name of the solid angles.
pub const SOLID_ANGLE: &str = "solid_angle";

/// The values of a table, `leading` before its own dimensions in a sweep.
pub fn describe_values<V: Variable>(
    values: &V,
    dimensions: &Dimensions<V>,
    leading: &[&V],
    quantity: Quantity,
    bit_round: Option<u8>,
) -> Result<(), V::Error> {
    values.attribute("units", "sr-1")?;
    values.attribute(
        "long_name",
        match quantity {
            Quantity::PhaseFunction => "phase function, integral over the sphere 1",
            Quantity::Mueller => "Mueller matrix, scaled so that the integral of element 11 is 1",
        },
    )?;
    values.attribute("coordinates", COORDINATES)?;
    if let Some(bits) = bit_round {
        let name = "_QuantizeBitRoundNumberOfSignificantBits";
        values.attribute_integer(name, i32::from(bits))?;
    }
    let mut scales = leading.to_vec();
    scales.push(&dimensions.wavelength);
    scales.extend(&dimensions.element);
    scales.extend([&dimensions.theta, &dimensions.phi]);
    values.attach(&scales)
}

/// The mask of caustics.
pub fn describe_caustic<V: Variable>(
    mask: &V,
    dimensions: &Dimensions<V>,
    leading: &[&V],
) -> Result<(), V::Error> {
    mask.attribute("units", "1")?;
    mask.attribute(
        "long_name",
        "number of rays that coalesce where the two-ray uniform formula does not hold, else 0",
    )?;
    let mut scales = leading.to_vec();
    scales.extend([&dimensions.wavelength, &dimensions.theta, &dimensions.phi]);
    mask.attach(&scales)
}

/// The solid angles of a face.
pub fn describe_solid_angle<V: Variable>(
    data: &V,
    dimensions: &Dimensions<V>,
) -> Result<(), V::Error> {
    data.attribute("units", "sr")?;
    data.attribute("long_name", "solid angle that a sample stands for")?;
    data.attach(&[&dimensions.theta, &dimensions.phi])
}
