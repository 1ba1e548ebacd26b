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
    /// Its folds, in order.
    pub folds: Vec<FoldLayout>,
    /// Launch coordinate at which the last plain segment is cut in two, where last rays differ: the
    /// inner part does not depend on them.
    pub cut: Option<f64>,
    /// Knots per radian of exit angle.
    pub density: f64,
    /// Pieces of each plain segment; empty while the layout is being found.
    pub knots: Vec<usize>,
    /// Circumference of the sphere of equal volume over the wavelength.
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
    /// The other of the two.
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
