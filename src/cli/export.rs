//! `gonio export`: tables for other programs.

use super::UsageError;
use clap::{Args, ValueEnum};
use gonio::export::average::{Averaged, average};
use gonio::export::{csv, eradiate, exr, libradtran, mitsuba, sasktran2, strip};
use gonio::hdf5::{self, AxisValues, SweepReader, TableError, write_netcdf};
use gonio::pending_file::write_whole;
use gonio::phase_table::PhaseTable;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

/// Formats of other programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Folder for Mitsuba 3: spectral table, Python plugin, scene, tabphase strings
    Mitsuba,
    /// Eradiate Aer-Core v2 netCDF
    Eradiate,
    /// sasktran2 scatterer database (netCDF); a sweep of radii gives all of them
    Sasktran2,
    /// libRadtran .mie.cdf layout (netCDF)
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
recorded. Give --cap-deg 0 to keep it.")]
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
    /// Legendre moments per element
    #[arg(long, value_name = "N", default_value_t = 384)]
    moments: u16,
    /// Azimuth of the colour strip
    #[arg(long, value_name = "DEG", default_value_t = 0.0, allow_negative_numbers = true)]
    azimuth_deg: f64,
    /// Scattering angles of the colour strip
    #[arg(long, value_name = "FROM:TO", default_value = "120:150", value_parser = parse_range)]
    theta_deg: (f64, f64),
    /// Radius of the OpenEXR map about the antisolar point
    #[arg(long, value_name = "DEG", default_value_t = 60.0)]
    radius_deg: f64,
    /// Pixels: width of the strip, side of the map
    #[arg(long, value_name = "N", default_value_t = 1024, value_parser = clap::value_parser!(u32).range(2..=16384))]
    size: u32,
    /// Values per curve of a Mitsuba tabphase string
    #[arg(long, value_name = "N", default_value_t = 4096, value_parser = clap::value_parser!(u32).range(2..=1_000_000))]
    samples: u32,
}

pub fn run(args: ExportArgs) -> anyhow::Result<()> {
    if !args.file.exists() {
        return Err(UsageError(format!("{}: no such file", args.file.display())).into());
    }
    if args.moments == 0 {
        return Err(UsageError("--moments 0: at least 1".into()).into());
    }
    let output = args.output.clone().unwrap_or_else(|| default_output(&args));
    if output.exists() && !args.overwrite {
        return Err(TableError::Exists { path: output }.into());
    }
    let tables = read(&args)?;
    let table = &tables[0];
    let cap = args.cap_deg.to_radians();
    let moments = usize::from(args.moments);
    note_on_moments(&args, &tables);
    match args.to {
        Format::Mitsuba => write_mitsuba(&average(table, cap)?, &output, args.samples)?,
        Format::Eradiate => {
            let content = eradiate::database(table, &average(table, cap)?, moments);
            write_netcdf(&output, &content, args.overwrite)?;
        }
        Format::Sasktran2 => {
            let averaged =
                tables.iter().map(|t| average(t, cap)).collect::<Result<Vec<Averaged>, _>>()?;
            let pairs: Vec<_> = tables.iter().zip(&averaged).collect();
            write_netcdf(&output, &sasktran2::database(&pairs, moments), args.overwrite)?;
        }
        Format::Libradtran => {
            let content = libradtran::database(table, &average(table, cap)?, moments);
            write_netcdf(&output, &content, args.overwrite)?;
        }
        Format::Csv => save(&output, csv::averaged(&average(table, cap)?).as_bytes())?,
        Format::CsvFull => save(&output, csv::every_sample(table).as_bytes())?,
        Format::Exr => {
            if !(args.radius_deg > 0.0 && args.radius_deg <= 180.0) {
                let message = format!("--radius-deg {}: above 0 to 180", args.radius_deg);
                return Err(UsageError(message).into());
            }
            save(&output, &exr::antisolar_map(table, args.size, args.radius_deg.to_radians())?)?;
        }
        Format::Strip => {
            let (from, to) = args.theta_deg;
            let range = (from.to_radians(), to.to_radians());
            let size = (args.size, (args.size / 16).max(16));
            save(&output, &strip::png(table, args.azimuth_deg.to_radians(), range, size)?)?;
        }
    }
    println!("{}", output.display());
    Ok(())
}

/// The scattering matrix of a sphere of size parameter x has 2x moments and a few more; with fewer the
/// series rings at the dark angles. Say so rather than let a user find out.
fn note_on_moments(args: &ExportArgs, tables: &[PhaseTable]) {
    if !matches!(args.to, Format::Eradiate | Format::Sasktran2 | Format::Libradtran) {
        return;
    }
    let largest = |table: &PhaseTable| {
        let wavelengths = table.header.axes.wavelength.iter();
        wavelengths.map(|wavelength| TAU * table.header.radius / wavelength).fold(0.0, f64::max)
    };
    let size_parameter = tables.iter().map(largest).fold(0.0, f64::max);
    let whole = 2.0 * size_parameter + 16.0;
    if f64::from(args.moments) < whole {
        eprintln!(
            "note: {} Legendre moments; size parameter {size_parameter:.0} has about {whole:.0}. With \
             fewer the series is off by tens of per cent at the dark angles (--moments; with all of \
             them --cap-deg 0 is exact)",
            args.moments
        );
    }
}

/// The table; for sasktran2 all tables of a sweep of radii.
fn read(args: &ExportArgs) -> anyhow::Result<Vec<PhaseTable>> {
    match hdf5::read(&args.file) {
        Ok(table) => Ok(vec![table]),
        Err(TableError::Foreign { .. }) if SweepReader::open(&args.file).is_ok() => {
            let reader = SweepReader::open(&args.file)?;
            let one_axis_of_radii = matches!(
                reader.axes(),
                [axis] if axis.coordinates.iter().any(|c| c.name == "radius_um"
                    && matches!(c.values, AxisValues::Numbers(_)))
            );
            if args.to != Format::Sasktran2 || !one_axis_of_radii {
                return Err(UsageError(format!(
                    "{}: a sweep; only a sweep over the radius alone can be exported, to sasktran2",
                    args.file.display()
                ))
                .into());
            }
            let tables = reader.present()?.len();
            Ok((0..tables).map(|i| reader.table(&[i])).collect::<Result<_, _>>()?)
        }
        Err(error) => Err(error.into()),
    }
}

fn write_mitsuba(averaged: &Averaged, folder: &Path, samples: u32) -> anyhow::Result<()> {
    std::fs::create_dir_all(folder)?;
    save(&folder.join("phase.csv"), mitsuba::spectral_table(averaged).as_bytes())?;
    let strings = mitsuba::tabphase(averaged, samples as usize);
    save(&folder.join("tabphase.txt"), strings.as_bytes())?;
    save(&folder.join("gonio_phase.py"), mitsuba::PLUGIN.as_bytes())?;
    save(&folder.join("scene.py"), mitsuba::SCENE.as_bytes())
}

fn save(path: &Path, bytes: &[u8]) -> anyhow::Result<()> {
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

fn parse_range(text: &str) -> Result<(f64, f64), String> {
    let wrong = || format!("{text:?} is no FROM:TO within 0 to 180, such as 120:150");
    let (from, to) = text.split_once(':').ok_or_else(wrong)?;
    let (from, to): (f64, f64) =
        (from.parse().map_err(|_| wrong())?, to.parse().map_err(|_| wrong())?);
    let fine = (0.0..=180.0).contains(&from) && (0.0..=180.0).contains(&to) && from != to;
    if fine { Ok((from, to)) } else { Err(wrong()) }
}
