//! How all planes of an order are cut: the same landmarks, the same fractions.

use crate::farfield::branch::window::Window;
use crate::farfield::deflection::scan::Scan;
use crate::farfield::deflection::scattering_plane::Node;
use crate::farfield::impact_integral::near_grazing_layout::NearGrazingLayout;
use std::f64::consts::FRAC_PI_2;

/// Settings shared by all planes of an order, so that their segments correspond.
#[derive(Clone, Debug)]
pub struct CutLayout {
    /// Nodes of the first scan.
    pub scan: usize,
    /// Angle about later axis crossings that is left out, radians.
    pub axis_gap: f64,
    pub folds: Vec<FoldLayout>,
    /// Launch coordinate at which the last plain segment is cut in two, where last rays differ: the
    /// inner part does not depend on them.
    pub cut: Option<f64>,
    /// Knots per radian of exit angle.
    pub density: f64,
    /// Pieces of each plain segment; empty while the layout is being found.
    pub knots: Vec<usize>,
    pub size_parameter: f64,
    /// Whether the order's rays cross the axis again.
    pub high: bool,
    /// Whether a fold's rays may come near total reflection inside.
    pub near_critical: bool,
    /// Where an integral takes over from rays near the rim.
    pub rim: Option<NearGrazingLayout>,
    /// Where the edge wave takes over from reflected rays, by the cosine of the grazing angle.
    pub edge: Option<Window>,
}

impl CutLayout {
    /// How each plane is scanned.
    pub(crate) fn scanning(&self) -> Scan {
        let limit = self.rim.as_ref().map_or(FRAC_PI_2, |rim| rim.full.asin());
        Scan { nodes: self.scan, axis_gap: self.axis_gap, limit }
    }

    /// Pieces between knots that a plain segment needs.
    pub(crate) fn pieces(&self, ends: &[Node; 2]) -> usize {
        4 + (self.density * (ends[1].angle - ends[0].angle).abs()).ceil() as usize
    }

    /// The same with twice the knots.
    pub(crate) fn finer(&self) -> Self {
        Self {
            density: 2.0 * self.density,
            knots: self.knots.iter().map(|count| 2 * count).collect(),
            folds: self.folds.iter().map(FoldLayout::finer).collect(),
            rim: self.rim.as_ref().map(NearGrazingLayout::finer),
            ..self.clone()
        }
    }
}

/// The segment about a fold.
#[derive(Clone, Debug)]
pub struct FoldLayout {
    /// Its reach on the dark and the lit side, radians.
    pub dark: f64,
    pub lit: f64,
    /// Argument of the Airy function per radian, where it grows fastest.
    pub per_angle: f64,
    /// For an integral over impacts in place of a pair: places of its knots, radians from the fold.
    pub integral: Option<Vec<f64>>,
}

impl FoldLayout {
    pub(crate) fn finer(&self) -> Self {
        let between = |knots: &Vec<f64>| {
            let halves = knots.windows(2).flat_map(|w| [w[0], 0.5 * (w[0] + w[1])]);
            halves.chain(knots.last().copied()).collect()
        };
        Self { integral: self.integral.as_ref().map(between), ..*self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Twice the knots stand between those of before; the reach of a fold stays.
    #[test]
    fn a_finer_fold_has_knots_half_way() {
        let fold = FoldLayout {
            dark: 0.1,
            lit: 0.2,
            per_angle: 40.0,
            integral: Some(vec![-0.1, 0.0, 0.05, 0.2]),
        };
        let finer = fold.finer();
        let expected = [-0.1, -0.05, 0.0, 0.025, 0.05, 0.125, 0.2];
        let found = finer.integral.unwrap();
        assert!(found.len() == 7 && found.iter().zip(expected).all(|(f, e)| (f - e).abs() < 1e-15));
        assert_eq!((finer.dark, finer.lit, finer.per_angle), (0.1, 0.2, 40.0));
        assert!(FoldLayout { integral: None, ..fold }.finer().integral.is_none());
    }
}
