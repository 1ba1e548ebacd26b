//! How all meridians of an order are cut: the same landmarks, the same fractions.

use super::rim_layout::RimLayout;
use super::taper::Taper;

/// Settings shared by all meridians of an order, so that their segments correspond.
#[derive(Clone, Debug)]
pub struct ArcLayout {
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
    /// Where an integral takes over from rays near the rim.
    pub rim: Option<RimLayout>,
    /// Where the edge wave takes over from reflected rays, by the cosine of the grazing angle.
    pub edge: Option<Taper>,
}

impl ArcLayout {
    /// The same with twice the knots.
    pub(super) fn finer(&self) -> Self {
        Self {
            density: 2.0 * self.density,
            knots: self.knots.iter().map(|count| 2 * count).collect(),
            folds: self.folds.iter().map(FoldLayout::finer).collect(),
            rim: self.rim.as_ref().map(RimLayout::finer),
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
    pub(super) fn finer(&self) -> Self {
        let between = |knots: &Vec<f64>| {
            let halves = knots.windows(2).flat_map(|w| [w[0], 0.5 * (w[0] + w[1])]);
            halves.chain(knots.last().copied()).collect()
        };
        Self { integral: self.integral.as_ref().map(between), ..*self }
    }
}
