//! The dimensions that every table has, and their coordinate variables.

use super::schema::ELEMENTS;
use super::{Kind, Store, Variable};
use crate::math::digits::{degree, nm};
use crate::phase_table::{Axes, Quantity};

/// The dimensions of a file and their coordinate variables.
#[derive(Debug)]
pub struct Dimensions<V> {
    pub wavelength: V,
    pub element: Option<V>,
    pub theta: V,
    pub phi: V,
}

impl<V: Variable> Dimensions<V> {
    pub fn create<S: Store<Variable = V, Error = V::Error>>(
        file: &S,
        axes: &Axes,
        quantity: Quantity,
    ) -> Result<Self, V::Error> {
        let nanometres: Vec<f64> = axes.wavelength.iter().map(|metres| nm(*metres)).collect();
        let degrees = |angles: &[f64]| angles.iter().map(|a| degree(*a)).collect::<Vec<_>>();
        let theta_degrees = degrees(&axes.theta);

        let wavelength = scale(file, "wavelength_nm", &nanometres, "nm")?;
        wavelength.attribute("standard_name", "radiation_wavelength")?;
        wavelength.attribute("long_name", "wavelength in vacuum")?;
        let theta = scale(file, "theta", &theta_degrees, "degree")?;
        theta.attribute("standard_name", "scattering_angle")?;
        theta.attribute("long_name", "scattering angle, 0 is forward")?;
        let phi = scale(file, "phi", &degrees(&axes.phi), "degree")?;
        phi.attribute("long_name", "azimuth about the incident light, 0 is the upper side")?;
        let element = match quantity {
            Quantity::PhaseFunction => None,
            Quantity::Mueller => {
                let element = file.variable("mueller_element", Kind::Texts, &[16])?;
                element.write_texts(&ELEMENTS.map(String::from))?;
                element.attribute("long_name", "element of the Mueller matrix, row and column")?;
                element.make_scale("mueller_element")?;
                Some(element)
            }
        };

        let antisolar: Vec<f64> = theta_degrees.iter().map(|theta| 180.0 - theta).collect();
        let antisolar_data =
            file.variable("angle_from_antisolar_point", Kind::F64, &[antisolar.len() as u64])?;
        antisolar_data.write_numbers(&antisolar)?;
        antisolar_data.attribute("units", "degree")?;
        antisolar_data.attribute("long_name", "angle from the antisolar point")?;
        antisolar_data.attach(&[&theta])?;
        Ok(Dimensions { wavelength, element, theta, phi })
    }
}

/// A coordinate variable of numbers.
pub fn scale<S: Store>(
    file: &S,
    name: &str,
    values: &[f64],
    units: &str,
) -> Result<S::Variable, S::Error> {
    let data = file.variable(name, Kind::F64, &[values.len() as u64])?;
    data.write_numbers(values)?;
    data.attribute("units", units)?;
    data.make_scale(name)?;
    Ok(data)
}
