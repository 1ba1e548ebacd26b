//! `gonio export`: tables for other programs.

use crate::cli::args::output::Output;
use crate::cli::args::polarisation::PolarisationFlag;
use crate::cli::args::ranges::angle_span;
use crate::cli::failure::{Failure, Result};
use crate::cli::show::notes;
use clap::{Args, ValueEnum};
use gonio::export::average::{Averaged, average};
use gonio::export::notes::{density_note, notes as notes_on, too_few_moments};
use gonio::export::size_grid::SizeGrid;
use gonio::export::source::{ACCEPTED_DENSITY, Source};
use gonio::export::{csv, eradiate, exr, libradtran, mitsuba, sasktran2, strip};
use gonio::hdf5::{TableError, write_netcdf};
use gonio::optics::Polarisation;
use gonio::pending_file::write_whole;
use gonio::phase_table::PhaseTable;
use std::path::{Path, PathBuf};

/// Formats of other programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Folder for Mitsuba 3: spectral table, Python plugin, scene, tabphase strings
    Mitsuba,
    /// Eradiate Aer-Core v2 netCDF; a sweep of effective radii and variances gives all pairs
    Eradiate,
    /// sasktran2 scatterer database (netCDF); a sweep of sizes gives all of them
    Sasktran2,
    /// libRadtran .mie.cdf layout (netCDF); a sweep of effective radii gives all of them
    Libradtran,
    /// Comma-separated values, mean over azimuth
    Csv,
    /// Comma-separated values, every sample
    CsvFull,
    /// OpenEXR map around the antisolar point
    Exr,
    /// PNG strip of colours over the scattering angle
    Strip,
}

/// Write a table for another program
#[derive(Args)]
#[command(after_help = "Example: gonio export raindrop.h5 --to sasktran2 -o raindrop.nc

The forward peak is cut below --cap-deg; what was cut counts as unscattered and its share is
recorded. Give --cap-deg 0 to keep it. Particles that are no spheres have six elements (11, 12, 22, 33,
34, 44) for Eradiate, libRadtran, sasktran2 and csv, mean over azimuth; mitsuba, exr and strip take
unpolarised light (element 11; exr and strip with --polarisation also what a filter lets through). libRadtran's extinction is per mass and needs the medium's density.")]
pub struct ExportArgs {
    /// Table
    #[arg(value_name = "FILE.h5")]
    file: PathBuf,
    /// Format
    #[arg(long, value_enum, value_name = "FORMAT")]
    to: Format,
    /// File (for mitsuba: folder) to write
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
    /// Replace files of the same names
    #[arg(long)]
    overwrite: bool,
    /// Cut the forward peak below this scattering angle
    #[arg(long, value_name = "DEG", default_value_t = 3.0, allow_negative_numbers = true)]
    cap_deg: f64,
    /// Legendre moments per element (eradiate, sasktran2, libradtran) [default: 384]
    #[arg(long, value_name = "N")]
    moments: Option<u16>,
    /// Density of the medium, in place of the table's (libradtran: extinction per mass)
    #[arg(long, value_name = "KG_M3", allow_negative_numbers = true)]
    density_kg_m3: Option<f64>,
    /// Azimuth of the colour strip [default: 0]
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    azimuth_deg: Option<f64>,
    /// Scattering angles of the colour strip [default: 120:150]
    #[arg(long, value_name = "FROM:TO", value_parser = angle_span)]
    theta_deg: Option<(f64, f64)>,
    /// Light of the strip or map seen through no filter, or one along or across the scattering plane
    #[arg(long, value_enum)]
    polarisation: Option<PolarisationFlag>,
    /// Radius of the OpenEXR map about the antisolar point [default: 60]
    #[arg(long, value_name = "DEG")]
    radius_deg: Option<f64>,
    /// Pixels: width of the strip, side of the map [default: 1024]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=16384))]
    size: Option<u32>,
    /// Values per curve of a Mitsuba tabphase string [default: 4096]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=1_000_000))]
    samples: Option<u32>,
}

pub fn run(args: ExportArgs) -> Result<()> {
    if !args.file.exists() {
        return Err(Failure::usage(format!("{}: no such file", args.file.display())));
    }
    without_strangers(&args)?;
    let moments = args.moments.unwrap_or(384);
    if moments == 0 {
        return Err(Failure::usage("--moments 0: at least 1"));
    }
    let output = args.output.clone().unwrap_or_else(|| default_output(&args));
    if output.exists() && !args.overwrite {
        return Err(TableError::Exists { path: output }.into());
    }
    Output { flag: "--output", path: &output, kind: "", endings: &[] }.check_folder()?;
    let many_sizes = matches!(args.to, Format::Eradiate | Format::Sasktran2 | Format::Libradtran);
    let mut source = Source::read(&args.file, many_sizes)?;
    if let Some(density) = args.density_kg_m3 {
        source = source.with_density(density).map_err(|_| {
            Failure::usage(format!("--density-kg-m3 {density}: {ACCEPTED_DENSITY}"))
        })?;
    }
    let Source { tables, sizes } = source;
    let table = &tables[0];
    let cap = args.cap_deg.to_radians();
    if let Some(note) = too_few_moments(&tables, moments).filter(|_| many_sizes) {
        notes::tell([note]);
    }
    let moments = usize::from(moments);
    note_on_tables(&args, &tables);
    let seen = args.polarisation.map_or(Polarisation::Total, Polarisation::from);
    let size = args.size.unwrap_or(1024);
    match args.to {
        Format::Mitsuba => {
            let samples = args.samples.unwrap_or(4096) as usize;
            mitsuba::write(table, &average(table, cap)?, &output, samples)?;
        }
        Format::Eradiate | Format::Libradtran => {
            let grid = SizeGrid::new(tables)?;
            let averaged =
                grid.tables.iter().map(|t| average(t, cap)).collect::<Result<Vec<_>, _>>()?;
            let content = match args.to {
                Format::Eradiate => eradiate::database(&grid, &averaged, moments)?,
                _ => libradtran::database(&grid, &averaged, moments)?,
            };
            write_netcdf(&output, &content, args.overwrite)?;
        }
        Format::Sasktran2 => {
            let averaged =
                tables.iter().map(|t| average(t, cap)).collect::<Result<Vec<Averaged>, _>>()?;
            let pairs: Vec<_> = tables.iter().zip(&averaged).collect();
            let content = sasktran2::database(&pairs, &sizes, moments);
            write_netcdf(&output, &content, args.overwrite)?;
        }
        Format::Csv => save(&output, csv::averaged(table, &average(table, cap)?).as_bytes())?,
        Format::CsvFull => save(&output, csv::every_sample(table).as_bytes())?,
        Format::Exr => {
            let radius = args.radius_deg.unwrap_or(60.0);
            if !(radius > 0.0 && radius <= 180.0) {
                let message = format!("--radius-deg {radius}: above 0 to 180");
                return Err(Failure::usage(message));
            }
            save(&output, &exr::antisolar_map(table, seen, size, radius.to_radians())?)?;
        }
        Format::Strip => {
            let (from, to) = args.theta_deg.unwrap_or((120.0, 150.0));
            let range = (from.to_radians(), to.to_radians());
            let size = (size, (size / 16).max(16));
            let azimuth = args.azimuth_deg.unwrap_or(0.0).to_radians();
            save(&output, &strip::png(table, azimuth, seen, range, size)?)?;
        }
    }
    println!("{}", output.display());
    Ok(())
}

/// Refuse flags that the format has no use for: who gives one expects an effect.
fn without_strangers(args: &ExportArgs) -> Result<()> {
    use Format::{Eradiate, Exr, Libradtran, Mitsuba, Sasktran2, Strip};
    let strangers: [(&str, bool, &[Format]); 8] = [
        ("--moments", args.moments.is_some(), &[Eradiate, Sasktran2, Libradtran]),
        ("--density-kg-m3", args.density_kg_m3.is_some(), &[Eradiate, Sasktran2, Libradtran]),
        ("--azimuth-deg", args.azimuth_deg.is_some(), &[Strip]),
        ("--theta-deg", args.theta_deg.is_some(), &[Strip]),
        ("--polarisation", args.polarisation.is_some(), &[Strip, Exr]),
        ("--radius-deg", args.radius_deg.is_some(), &[Exr]),
        ("--size", args.size.is_some(), &[Strip, Exr]),
        ("--samples", args.samples.is_some(), &[Mitsuba]),
    ];
    let name = |format: &Format| {
        format.to_possible_value().map_or(String::new(), |value| value.get_name().to_string())
    };
    for (flag, given, formats) in strangers {
        if given && !formats.contains(&args.to) {
            let formats: Vec<String> = formats.iter().map(name).collect();
            let formats = formats.join(", ");
            let message =
                format!("{flag}: --to {} does not use it, only {formats}", name(&args.to));
            return Err(Failure::usage(message));
        }
    }
    Ok(())
}

/// Say what the tables are worth, and what the format takes them for.
fn note_on_tables(args: &ExportArgs, tables: &[PhaseTable]) {
    for table in tables {
        let density = (args.to == Format::Libradtran).then(|| density_note(table)).flatten();
        let shape = (args.to == Format::Mitsuba && table.header.shape != "sphere").then(|| {
            format!(
                "{}: a mean over azimuth, unpolarised; Mitsuba knows only the scattering angle",
                table.header.shape
            )
        });
        notes::tell(notes_on(table).into_iter().chain(density).chain(shape));
    }
}

fn save(path: &Path, bytes: &[u8]) -> Result<()> {
    let named = |source| TableError::Io { path: path.to_path_buf(), source };
    Ok(write_whole(path, bytes).map_err(named)?)
}

fn default_output(args: &ExportArgs) -> PathBuf {
    let (ending, extension) = match args.to {
        Format::Mitsuba => ("-mitsuba", ""),
        Format::Eradiate => ("-eradiate", "nc"),
        Format::Sasktran2 => ("-sasktran2", "nc"),
        Format::Libradtran => ("-libradtran.mie", "cdf"),
        Format::Csv => ("", "csv"),
        Format::CsvFull => ("-full", "csv"),
        Format::Exr => ("", "exr"),
        Format::Strip => ("-strip", "png"),
    };
    let stem = args.file.file_stem().map_or("table".into(), |stem| stem.to_string_lossy());
    let dot = if extension.is_empty() { "" } else { "." };
    args.file.with_file_name(format!("{stem}{ending}{dot}{extension}"))
}
