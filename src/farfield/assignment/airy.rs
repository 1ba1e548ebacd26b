//! What Airy's theory of a bow is worth, and where ([`crate::series::airy`]).

use super::thresholds::Thresholds;
use crate::series::airy::AiryBow;
use std::fmt;

/// Where Airy's theory stands for the wave of an order, and how far that may be off there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AiryRange {
    /// Number of chords.
    pub order: u32,
    /// The bow of ray optics, radians.
    pub bow: f64,
    /// Scattering angles between which the error holds, radians.
    pub theta: [f64; 2],
    /// Share of the amplitude at its maximum, across and along the scattering plane.
    pub expected_error: [f64; 2],
}

impl Thresholds {
    /// What Airy's theory of an order's bow is worth.
    pub fn airy_range(&self, order: u32, bow: &AiryBow) -> AiryRange {
        let place = (order as usize).saturating_sub(2).min(self.error_of_airy.len() - 1);
        let fall = bow.size_parameter().cbrt();
        let ends = self.airy_arguments.map(|argument| bow.at_argument(argument));
        AiryRange {
            order,
            bow: bow.angle(),
            theta: [ends[0].min(ends[1]), ends[0].max(ends[1])],
            expected_error: self.error_of_airy[place].map(|error| (error / fall).min(1.0)),
        }
    }
}

impl fmt::Display for AiryRange {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let [from, to] = self.theta.map(f64::to_degrees);
        let [across, along] = self.expected_error.map(|error| 100.0 * error);
        write!(
            f,
            "Airy's theory of order {}, whose rays turn back at {:.3}°: from {from:.2} to {to:.2}° its wave is within \
             {across:.1} % of the largest across the scattering plane and {along:.0} % along it; farther off it strays, and \
             other orders are not in it",
            self.order,
            self.bow.to_degrees()
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The range is about the bow, and narrows with the size as its fringes do; the error falls as the cube root.
    #[test]
    fn the_range_goes_with_the_fringes() {
        let range = |x: f64| {
            let bow = AiryBow::new(x, 1.333.into(), 3).unwrap();
            Thresholds::MEASURED.airy_range(3, &bow)
        };
        let (small, large) = (range(1e3), range(1e6));
        for range in [small, large] {
            assert!(range.theta[0] < range.bow && range.bow < range.theta[1]);
        }
        let width = |range: AiryRange| range.theta[1] - range.theta[0];
        assert!((width(small) / width(large) - 100.0).abs() < 1e-6);
        assert!((small.expected_error[0] / large.expected_error[0] - 10.0).abs() < 1e-9);
        assert!(small.to_string().contains("order 3"));
    }
}
