//! What `gonio scatter` is asked, as flags and as the checked job that they make.

use crate::cli::args::medium::MediumFlags;
use crate::cli::args::particle::{Index, ShapeKind, parse_index};
use clap::{Args, ValueEnum};
use gonio::medium::radial::Body;
use gonio::scatter::{DebyeTerms, Request};

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum MethodName {
    Rays,
    Mie,
    Debye,
    /// Exact for bodies of revolution
    Tmatrix,
    /// The classical theory of the primary and the secondary bow of spheres
    Airy,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum DiffractionName {
    None,
    Gaussian,
    Airy,
}

/// Amplitude matrix in chosen directions, by any method
#[derive(Args)]
#[command(after_help = "Example: gonio scatter --method rays --shape raindrop --radius-um 500 \
--wavelength-nm 650 --sun-elevation-deg 20 --theta 130:150:0.1 --json")]
pub struct ScatterArgs {
    #[arg(long, value_enum)]
    pub(super) method: MethodName,
    #[arg(long, value_enum, default_value = "sphere")]
    pub(super) shape: ShapeKind,
    /// Radius of the sphere of equal volume, micrometres. Of radius, wavelength and size parameter
    /// two say the third; given all three, they must agree
    #[arg(long, allow_hyphen_values = true)]
    pub(super) radius_um: Option<f64>,
    /// Diameter of the sphere of equal volume, millimetres
    #[arg(long, conflicts_with = "radius_um")]
    pub(super) diameter_mm: Option<f64>,
    /// Wavelength in vacuum, nanometres
    #[arg(long, allow_hyphen_values = true)]
    pub(super) wavelength_nm: Option<f64>,
    /// Frequency in place of the wavelength
    #[arg(long, value_name = "GHZ", allow_hyphen_values = true, conflicts_with = "wavelength_nm")]
    pub(super) frequency_ghz: Option<f64>,
    /// Size parameter 2πa/λ of the sphere of equal volume, λ in the medium around it
    #[arg(long, allow_hyphen_values = true)]
    pub(super) size_parameter: Option<f64>,
    /// Index n or n+k; without it, water at the wavelength
    #[arg(long, value_parser = parse_index, allow_hyphen_values = true)]
    pub(super) index: Option<Index>,
    #[command(flatten)]
    pub(super) made_of: MediumFlags,
    /// Vertical over horizontal diameter of a spheroid
    #[arg(long, allow_hyphen_values = true)]
    pub(super) axis_ratio: Option<f64>,
    /// Sun above the horizon; of no effect on a sphere
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    pub(super) sun_elevation_deg: f64,
    /// Azimuth of the light about the sun's rays; of no effect on a sphere
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    pub(super) azimuth_deg: f64,
    /// Scattering angles in degrees: a comma list of values and from:to:step ranges
    #[arg(long)]
    pub(super) theta: String,
    /// A comma list of orders, "diffraction", or "auto"; not for Lorenz–Mie and the T-matrix, which have all
    #[arg(long, default_value = "auto")]
    pub(super) orders: String,
    /// airy: uniform formulas at every bow (default); gaussian: rays whose intensities a filter smooths
    /// near bows (Sadeghi et al. 2012; phases are those of the rays); none: rays alone
    #[arg(long, value_enum)]
    pub(super) diffraction: Option<DiffractionName>,
    /// Relative error asked of rays, of the number of Debye terms and of a T-matrix
    #[arg(long, default_value_t = 0.01)]
    pub(super) tolerance: f64,
    /// Raindrop model (default: beard-chuang-1987)
    #[arg(long)]
    pub(super) model: Option<String>,
    /// Rays across the silhouette for the patches of `--diffraction none` and `gaussian`
    #[arg(long)]
    pub(super) rays_across: Option<usize>,
    /// JSON on standard output
    #[arg(long)]
    pub(super) json: bool,
}

/// What was asked for, checked.
pub(super) struct Job {
    /// Size parameter and index are relative to the surroundings.
    pub(super) request: Request,
    /// Index of the surroundings.
    pub(super) outside: f64,
    /// What varies along the radius.
    pub(super) body: Option<Body>,
    /// Metres, where it is known.
    pub(super) radius: Option<f64>,
    pub(super) theta_deg: Vec<f64>,
    pub(super) terms: DebyeTerms,
}
