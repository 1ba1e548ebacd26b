//! Radius, wavelength and size parameter: any two say the third.

use std::f64::consts::TAU;

/// What is known of a particle's size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// Of the sphere of equal volume, metres.
    pub radius: Option<f64>,
    /// In the surroundings, metres.
    pub wavelength: Option<f64>,
    /// `2πa/λ`.
    pub parameter: f64,
}

/// Why three numbers make no size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SizeConflict {
    /// They disagree: this is the size parameter of the radius and the wavelength.
    Disagree {
        /// Metres.
        radius: f64,
        /// Metres.
        wavelength: f64,
        /// The size parameter that was given.
        parameter: f64,
        /// The one that radius and wavelength make.
        implied: f64,
    },
    /// They do not say it.
    Missing,
}

/// Rounded by hand to four digits, three numbers still agree.
const ROUNDING: f64 = 5e-4;

impl Size {
    /// From two of the three, or from three that agree (metres); the size parameter alone will do.
    ///
    /// ```
    /// use gonio::scatter::Size;
    /// let size = Size::of(Some(1e-6), None, Some(10.0)).unwrap();
    /// assert!((size.wavelength.unwrap() - 6.283e-7).abs() < 1e-10);
    /// ```
    ///
    /// # Errors
    /// Numbers that disagree, or too few.
    pub fn of(
        radius: Option<f64>,
        wavelength: Option<f64>,
        parameter: Option<f64>,
    ) -> Result<Self, SizeConflict> {
        let of = |radius: f64, wavelength: f64| TAU * radius / wavelength;
        Ok(match (parameter, radius, wavelength) {
            (Some(x), Some(a), Some(w)) if (of(a, w) / x - 1.0).abs() > ROUNDING => {
                let implied = of(a, w);
                return Err(SizeConflict::Disagree {
                    radius: a,
                    wavelength: w,
                    parameter: x,
                    implied,
                });
            }
            (Some(x), Some(a), None) => {
                Self { radius, wavelength: Some(TAU * a / x), parameter: x }
            }
            (Some(x), None, Some(w)) => {
                Self { radius: Some(x * w / TAU), wavelength, parameter: x }
            }
            (Some(x), ..) => Self { radius, wavelength, parameter: x },
            (None, Some(a), Some(w)) => Self { radius, wavelength, parameter: of(a, w) },
            _ => return Err(SizeConflict::Missing),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_say_the_third_and_three_must_agree() {
        let (a, w) = (5e-6, 500e-9);
        let x = TAU * a / w;
        let close = |found: Option<f64>, right: f64| (found.unwrap() / right - 1.0).abs() < 1e-12;
        assert!(close(Size::of(Some(a), None, Some(x)).unwrap().wavelength, w));
        assert!(close(Size::of(None, Some(w), Some(x)).unwrap().radius, a));
        assert!(close(Some(Size::of(Some(a), Some(w), None).unwrap().parameter), x));
        assert!(Size::of(Some(a), Some(w), Some(1.0004 * x)).is_ok());
        let refused = Size::of(Some(a), Some(w), Some(1.001 * x)).unwrap_err();
        assert!(matches!(refused, SizeConflict::Disagree { implied, .. } if implied == x));
        assert_eq!(Size::of(Some(a), None, None), Err(SizeConflict::Missing));
    }
}
