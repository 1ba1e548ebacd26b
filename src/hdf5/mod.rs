//! Phase tables as HDF5 files that are also netCDF-4: this page is the schema.
//!
//! # Format `gonio phase table`, version 1
//! Every dimension has a coordinate variable (an HDF5 dimension scale), so h5py, xarray (engines
//! `h5netcdf` and `netcdf4`) and ncdump show named coordinates with units.
//!
//! | variable | dimensions | units | content |
//! |---|---|---|---|
//! | `wavelength_nm` | itself | nm | wavelength in vacuum, f64 |
//! | `theta` | itself | degree | scattering angle, 0 = forward, f64 |
//! | `phi` | itself | degree | azimuth about the incident light, 0 = upper vertical half-plane, f64 |
//! | `mueller_element` | itself | | "11", "12", … "44" (only in `mueller` tables) |
//! | `order` | itself | | number of chords inside the particle, i32 (only with an energy budget) |
//! | `phase_function` | wavelength_nm, theta, phi | sr-1 | quantity `phase_function`, f32 |
//! | `mueller` | wavelength_nm, mueller_element, theta, phi | sr-1 | quantity `mueller`, same scaling |
//! | `caustic_order` | wavelength_nm, theta, phi | 1 | rays that coalesce where the two-ray formula does not hold, else 0, u8; only where a method has it |
//! | `solid_angle` | theta, phi | sr | what each sample stands for: Σ phase_function · solid_angle = 1, f32 |
//! | `angle_from_antisolar_point` | theta | degree | 180 − theta |
//! | `scattering_cross_section`, `extinction_cross_section`, `absorption_cross_section` | wavelength_nm | m2 | f64 |
//! | `extinction_straight_ahead` | wavelength_nm | m2 | extinction by the optical theorem on the amplitude at theta = 0; NaN where the table has no forward diffraction |
//! | `asymmetry` | wavelength_nm | 1 | mean cosine of the scattering angle |
//! | `refractive_index_real`, `refractive_index_imag` | wavelength_nm | 1 | n + ik, k ≥ 0 absorbs |
//! | `sum_before_peak` | wavelength_nm | 1 | Σ phase_function · solid_angle before the forward peak was treated |
//! | `peak_share` | wavelength_nm | 1 | share of the scattered power in the separated peak |
//! | `error_estimate` | wavelength_nm | 1 | estimated relative error of the intensity, weighted by intensity, 10° to 170° |
//! | `error_estimate_by_band` | wavelength_nm | 1 | the same, root mean square over bands of 4°, each relative to its own intensity |
//! | `tolerance_met` | wavelength_nm | 1 | 1: the error that was asked for is met by the method's own estimate; 0: it is not; NaN: no estimate |
//! | `error_theta` | itself | degree | middles of the bands of 4° for which an error is stated: 0, 4, … 180, f64 |
//! | `error_estimate_by_direction` | wavelength_nm, error_theta | 1 | the same within 2° of each angle |
//! | `left_out_share` | wavelength_nm | 1 | share of the scattered power in orders that the scene's list leaves out: what Σ phase_function · solid_angle lacks to 1; only where not 0 |
//! | `energy_left_by_order` | wavelength_nm, order | 1 | power that left after that many chords, per power on the silhouette |
//! | `energy_absorbed`, `energy_totally_reflected`, `energy_truncated`, `energy_residual` | wavelength_nm | 1 | the rest of the budget; NaN where a wavelength has none |
//! | `radius_um` | | um | radius of the sphere of equal volume |
//! | `sun_elevation`, `solar_zenith_angle` | | degree | sun above the horizon; from the zenith |
//! | `size_effective_radius` | | um | 3/4 mean volume over mean projected area |
//! | `size_effective_variance` | | 1 | effective variance of the sizes; 0 for one size |
//! | `mean_volume`, `mean_projected_area` | | m3, m2 | per particle |
//! | `medium_density` | | kg m-3 | NaN where not known; attribute `density_source` says where it is from |
//! | `bandwidth_nm` | | nm | band that each wavelength is a mean over; 0: none |
//! | `filter_standard_deviation` | | degree | Gaussian filter in place of diffraction; 0: none |
//! | `tolerance_asked` | | 1 | relative error that was asked for |
//!
//! Root attributes: `Conventions`, `title`, `format`, `format_version`, `program`,
//! `program_version`, `git_hash`, `date_created` (from `SOURCE_DATE_EPOCH` where that is set),
//! `scene` (resolved, as TOML), `command_line`, `conventions` (in words), `license`, `quantity`,
//! `method`, `methods` (JSON: by range of wavelengths and order what computed it, why, its expected error,
//! its share of the light, formulas and where they stand; of a sweep a variable along its axes), `shape`,
//! `forward_peak` (`cell_average`, `point` or `separate`),
//! `averaged_over_sun_disc` (`none`, `uniform`, `limb-darkened`: then no program may smooth again),
//! `averaged_over_sizes` (0 or 1), `density_source`,
//! `rotational_symmetry` (1: `phi` has one value that stands for all), `bit_round` (bits of the
//! mantissa kept, where values were rounded) and, written last, `complete` = 1.
//!
//! **Sweeps** ([`SweepWriter`]) have the same variables with one more leading dimension per swept
//! value (`radius_um`, `sun_elevation`, …, in this order before `wavelength_nm`), `present`
//! (leading dimensions; 1 where a table is there, else its values are NaN) and the root attribute
//! `format` = `gonio phase table sweep`; `sweep_axes` names the swept dimensions in order. The numbers
//! without dimension (but radius and sun, which are axes where they are swept) run along them too.
//!
//! Chunks are (1, …, rows of θ, φ), at most a mebibyte, shuffled and deflated; no filter beyond
//! these two. Objects carry no time stamps: equal input gives equal bytes. A file appears under its
//! name only when it is whole.

mod body;
mod chunk;
mod circumstances;
mod diagram;
mod heap;
mod literal;
mod methods;
mod netcdf;
mod output;
mod raw_attribute;
mod raw_id;
mod raw_read;
mod raw_write;
mod reader;
mod record;
mod schema;
mod space;
mod sweep;
mod writer;

pub use diagram::{DiagramAxis, DiagramValues, write_diagram};
pub use netcdf::{NetcdfFile, NetcdfValues, NetcdfVariable, write_netcdf};
pub use output::WriteOptions;
pub use reader::{TableReader, read};
pub use schema::FORMAT_VERSION;
pub use space::{available_bytes, estimate_bytes};
pub use sweep::{AxisValues, SweepAxis, SweepCoordinate, SweepReader, SweepWriter, position_of};
pub use writer::{TableWriter, write};

use crate::fault::{Blame, Fault};
pub use crate::math::bytes::decimal_bytes;
use crate::phase_table::InvalidTable;
use std::path::{Path, PathBuf};

/// What went wrong with a table or its file: which one, what, and what would do.
#[derive(Debug, thiserror::Error)]
pub enum TableError {
    #[error("{}: the file exists; choose another name or ask to overwrite it (--overwrite)", path.display())]
    Exists { path: PathBuf },
    #[error("{}: the table needs up to {} but the disk has {} free; take fewer angles or wavelengths",
        path.display(), decimal_bytes(*needed), decimal_bytes(*available))]
    NoSpace { path: PathBuf, needed: u64, available: u64 },
    #[error("{}: {source}", path.display())]
    Io { path: PathBuf, source: std::io::Error },
    #[error("{}: cannot be written: {message}", path.display())]
    Write { path: PathBuf, message: String },
    /// The same, where the disk has no room or the quota none left.
    #[error("{}: cannot be written: {message}", path.display())]
    DiskFull { path: PathBuf, message: String },
    #[error("{}: not a phase table: {message}", path.display())]
    Foreign { path: PathBuf, message: String },
    #[error("{}: damaged: {message}", path.display())]
    Damaged { path: PathBuf, message: String },
    #[error("{field} = {value}: {accepted}")]
    Invalid { field: String, value: String, accepted: String },
    #[error(transparent)]
    Table(#[from] InvalidTable),
}

impl Blame for TableError {
    fn fault(&self) -> Fault {
        match self {
            TableError::Exists { .. }
            | TableError::NoSpace { .. }
            | TableError::Foreign { .. }
            | TableError::Invalid { .. } => Fault::Input,
            TableError::Io { .. }
            | TableError::Write { .. }
            | TableError::DiskFull { .. }
            | TableError::Damaged { .. }
            | TableError::Table(_) => Fault::Run,
        }
    }
}

fn damaged(path: &Path, message: &str) -> TableError {
    TableError::Damaged { path: path.to_path_buf(), message: message.into() }
}

fn foreign(path: &Path, message: &str) -> TableError {
    TableError::Foreign { path: path.to_path_buf(), message: message.into() }
}

fn invalid(field: &str, value: impl ToString, accepted: &str) -> TableError {
    TableError::Invalid { field: field.into(), value: value.to_string(), accepted: accepted.into() }
}
