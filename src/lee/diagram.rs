//! The finished diagram, and how it is looked at: through a filter, with an exposure, as colours.

use crate::color::to_srgb;
use crate::optics::Polarisation;

/// The diagram: XYZ of the differential cross-section over the geometrical one, sr⁻¹.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagram {
    /// Metres.
    pub radii: Vec<f64>,
    /// Radians.
    pub theta: Vec<f64>,
    /// Per radius and angle: XYZ of the parallel and of the perpendicular part.
    pub xyz: Vec<Vec<[[f64; 3]; 2]>>,
}

impl Diagram {
    /// XYZ as seen with or without a filter, per radius and angle.
    pub fn seen(&self, polarisation: Polarisation) -> Vec<Vec<[f64; 3]>> {
        let pick = |[parallel, perpendicular]: &[[f64; 3]; 2]| match polarisation {
            Polarisation::Parallel => *parallel,
            Polarisation::Perpendicular => *perpendicular,
            Polarisation::Total => std::array::from_fn(|c| parallel[c] + perpendicular[c]),
        };
        self.xyz.iter().map(|column| column.iter().map(pick).collect()).collect()
    }

    /// The radii, millimetres.
    pub fn radii_mm(&self) -> Vec<f64> {
        self.radii.iter().map(|r| r * 1e3).collect()
    }

    /// The scattering angles, degrees.
    pub fn theta_deg(&self) -> Vec<f64> {
        self.theta.iter().map(|t| t.to_degrees()).collect()
    }
}

/// Luminance that pictures give the brightest angle of each column.
pub const PEAK: f64 = 0.8;

/// Exposure of each column such that its brightest angle has the luminance `peak`.
pub fn column_exposures(seen: &[Vec<[f64; 3]>], peak: f64) -> Vec<f64> {
    seen.iter()
        .map(|column| {
            let brightest = column.iter().fold(0.0_f64, |m, xyz| m.max(xyz[1]));
            if brightest > 0.0 { peak / brightest } else { 0.0 }
        })
        .collect()
}

/// What is seen, each column exposed, as 8-bit sRGB.
pub fn srgb(seen: &[Vec<[f64; 3]>], exposures: &[f64]) -> Vec<Vec<[u8; 3]>> {
    let columns = seen.iter().zip(exposures);
    columns.map(|(column, &e)| column.iter().map(|&xyz| to_srgb(xyz, e)).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Parts add up, and every column's brightest angle gets the luminance asked for.
    #[test]
    fn parts_and_exposures() {
        let cell = |y: f64| [[0.95 * y, y, 1.09 * y], [0.0, 0.5 * y, 0.0]];
        let diagram = Diagram {
            radii: vec![1e-3, 2e-3],
            theta: vec![2.0, 2.1],
            xyz: vec![vec![cell(1.0), cell(3.0)], vec![cell(0.0), cell(0.0)]],
        };
        let total = diagram.seen(Polarisation::Total);
        assert_eq!(total[0][1][1], 4.5);
        assert_eq!(diagram.seen(Polarisation::Perpendicular)[0][1], [0.0, 1.5, 0.0]);
        let white = diagram.seen(Polarisation::Parallel);
        let exposures = column_exposures(&white, 1.0);
        assert_eq!(exposures, [1.0 / 3.0, 0.0]);
        let colours = srgb(&white, &exposures);
        assert!(colours[0][1].iter().all(|v| *v >= 254) && colours[1] == [[0; 3]; 2]);
    }
}
