//! What can compute the wave of an order, by which formula in which directions, and why it does.

use std::fmt;

/// What computes the wave of an order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Rays of scattering planes ([`crate::farfield::PlaneSet`]).
    Planes,
    /// [`crate::farfield::PartialWaves`].
    PartialWaves,
    /// [`crate::farfield::ComplexWavefront`].
    ComplexWavefront,
    /// [`crate::farfield::sheets`].
    Patches,
}

impl Method {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Method::Planes => "rays of scattering planes",
            Method::PartialWaves => "partial waves from rays",
            Method::ComplexWavefront => "sum on a complex wavefront",
            Method::Patches => "patches of rays",
        }
    }
}

/// What scattering planes have in place of one ray per direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Formula {
    /// Two rays of a bow with uniform Airy functions.
    AiryPair,
    /// An integral over impacts where a bow's rays come near total reflection inside.
    NearCritical,
    /// An integral over impacts near the rim, and beyond it.
    NearGrazing,
    /// Rings of rays about the axis: Bessel functions.
    AxialRings,
    /// Reflection and diffraction at the edge of the shadow in one.
    Penumbra,
}

impl Formula {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Formula::AiryPair => "Airy functions at a bow",
            Formula::NearCritical => "integral over impacts near total reflection",
            Formula::NearGrazing => "integral over impacts near the rim",
            Formula::AxialRings => "rings about the axis",
            Formula::Penumbra => "penumbra of the shadow's edge",
        }
    }
}

/// Where a formula stands for single rays, at some azimuth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FormulaRange {
    /// What stands there.
    pub formula: Formula,
    /// Least and largest scattering angle, radians.
    pub theta: [f64; 2],
}

/// Where the planes of an order are traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spacing {
    /// One stands for all.
    One,
    /// At so many azimuths over a half-turn; others are interpolated.
    Even(usize),
    /// At each azimuth, when it is asked for.
    Single,
}

/// Why a method has an order, in the order in which it came about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reason {
    /// The scene asks for it.
    Asked,
    /// Order 0, which is one with the penumbra.
    Reflection,
    /// Nothing depends on azimuth.
    OnePlane,
    /// Rays stray so far from those of a sphere (caustic disorder), and no farther.
    Ordered(f64),
    /// The particle is smaller than this size parameter.
    Small(f64),
    /// Radial lines of launch points lose their rays.
    RadialLinesLost,
    /// Planes do not match from azimuth to azimuth.
    Unmatched,
    /// Rays stray farther than so much, here the second.
    Disordered(f64, f64),
    /// This share of the amplitude is that of a sum on a complex wavefront, which takes over.
    Mixed(f64),
    /// Planes are traced there.
    Traced(Spacing),
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Reason::Asked => write!(f, "asked for: interference off, or no \"airy\" diffraction"),
            Reason::Reflection => write!(f, "reflection, one with the shadow's edge"),
            Reason::OnePlane => write!(f, "nothing depends on azimuth"),
            Reason::Ordered(disorder) => {
                write!(f, "rays stray {disorder:.3} from a sphere's and match over azimuth")
            }
            Reason::Small(limit) => write!(f, "size parameter below {limit}"),
            Reason::RadialLinesLost => write!(f, "radial lines of rays break off"),
            Reason::Unmatched => write!(f, "planes do not match over azimuth"),
            Reason::Disordered(disorder, limit) => {
                write!(f, "rays stray {disorder:.3} from a sphere's, above {limit}")
            }
            Reason::Mixed(share) => {
                write!(f, "mixed with {:.0} % of a sum on a complex wavefront", 100.0 * share)
            }
            Reason::Traced(Spacing::One) => write!(f, "one plane stands for all"),
            Reason::Traced(Spacing::Even(count)) => write!(f, "interpolated from {count} planes"),
            Reason::Traced(Spacing::Single) => write!(f, "traced azimuth by azimuth"),
        }
    }
}
