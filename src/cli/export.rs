//! `gonio export`: tables for other programs.

use super::UsageError;
use super::polarisation::PolarisationFlag;
use clap::{Args, ValueEnum};
use gonio::export::average::{Averaged, average};
use gonio::export::notes::{density_note, notes};
use gonio::export::sasktran2::SizeDimension;
use gonio::export::size_grid::SizeGrid;
use gonio::export::{csv, eradiate, exr, libradtran, mitsuba, sasktran2, strip};
use gonio::hdf5::{self, AxisValues, SweepReader, TableError, position_of, write_netcdf};
use gonio::optics::Polarisation;
use gonio::pending_file::write_whole;
use gonio::phase_table::PhaseTable;
use std::f64::consts::TAU;
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
    #[arg(long, value_name = "FROM:TO", value_parser = parse_range)]
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

pub fn run(args: ExportArgs) -> anyhow::Result<()> {
    if !args.file.exists() {
        return Err(UsageError(format!("{}: no such file", args.file.display())).into());
    }
    without_strangers(&args)?;
    let moments = args.moments.unwrap_or(384);
    if moments == 0 {
        return Err(UsageError("--moments 0: at least 1".into()).into());
    }
    let output = args.output.clone().unwrap_or_else(|| default_output(&args));
    if output.exists() && !args.overwrite {
        return Err(TableError::Exists { path: output }.into());
    }
    let Source { tables, sizes } = read(&args)?;
    let table = &tables[0];
    let cap = args.cap_deg.to_radians();
    note_on_moments(&args, &tables, moments);
    let moments = usize::from(moments);
    note_on_tables(&args, &tables);
    let seen = args.polarisation.map_or(Polarisation::Total, Polarisation::from);
    let size = args.size.unwrap_or(1024);
    match args.to {
        Format::Mitsuba => {
            write_mitsuba(table, &average(table, cap)?, &output, args.samples.unwrap_or(4096))?
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
                return Err(UsageError(message).into());
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
fn without_strangers(args: &ExportArgs) -> Result<(), UsageError> {
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
            return Err(UsageError(message));
        }
    }
    Ok(())
}

/// The scattering matrix of a sphere of size parameter x has 2x moments and a few more; with fewer the
/// series rings at the dark angles. Say so rather than let a user find out.
fn note_on_moments(args: &ExportArgs, tables: &[PhaseTable], moments: u16) {
    if !matches!(args.to, Format::Eradiate | Format::Sasktran2 | Format::Libradtran) {
        return;
    }
    let largest = |table: &PhaseTable| {
        let wavelengths = table.header.axes.wavelength.iter();
        wavelengths.map(|wavelength| TAU * table.header.radius / wavelength).fold(0.0, f64::max)
    };
    let size_parameter = tables.iter().map(largest).fold(0.0, f64::max);
    let whole = 2.0 * size_parameter + 16.0;
    if f64::from(moments) < whole {
        eprintln!(
            "note: {} Legendre moments; size parameter {size_parameter:.0} has about {whole:.0}. With \
             fewer the series is off by tens of per cent at the dark angles (--moments; with all of \
             them --cap-deg 0 is exact)",
            moments
        );
    }
}

/// Say what the tables are worth, and what the format takes them for.
fn note_on_tables(args: &ExportArgs, tables: &[PhaseTable]) {
    let mut told: Vec<String> = Vec::new();
    for table in tables {
        let density = (args.to == Format::Libradtran).then(|| density_note(table)).flatten();
        let shape = (args.to == Format::Mitsuba && table.header.shape != "sphere").then(|| {
            format!(
                "{}: a mean over azimuth, unpolarised; Mitsuba knows only the scattering angle",
                table.header.shape
            )
        });
        for note in notes(table).into_iter().chain(density).chain(shape) {
            if !told.contains(&note) {
                eprintln!("note: {note}");
                told.push(note);
            }
        }
    }
}

/// What is exported: one table, or those of a sweep with its axes.
struct Source {
    tables: Vec<PhaseTable>,
    /// As sasktran2 names them; empty for one table.
    sizes: Vec<SizeDimension>,
}

/// The table, or all tables of a sweep of sizes.
fn read(args: &ExportArgs) -> anyhow::Result<Source> {
    let mut source = match hdf5::read(&args.file) {
        Ok(table) => Source { tables: vec![table], sizes: Vec::new() },
        Err(TableError::Foreign { .. }) if SweepReader::open(&args.file).is_ok() => {
            read_sweep(args)?
        }
        Err(error) => return Err(error.into()),
    };
    let Some(density) = args.density_kg_m3 else { return Ok(source) };
    if !(density.is_finite() && (1e-3..=3e4).contains(&density)) {
        let message = format!("--density-kg-m3 {density}: 0.001 to 30000 kg/m³ is accepted");
        return Err(UsageError(message).into());
    }
    for table in &mut source.tables {
        if let Some(bodies) = table.header.bodies.take() {
            table.header.bodies = Some(bodies.with_density(Some(density), "given to the export"));
        }
    }
    Ok(source)
}

fn read_sweep(args: &ExportArgs) -> anyhow::Result<Source> {
    let reader = SweepReader::open(&args.file)?;
    let refuse = |why: String| UsageError(format!("{}: a sweep; {why}", args.file.display()));
    if !matches!(args.to, Format::Eradiate | Format::Sasktran2 | Format::Libradtran) {
        let why = "it can be exported to eradiate, sasktran2 or libradtran, which hold many sizes";
        return Err(refuse(why.into()).into());
    }
    let mut sizes = Vec::new();
    for axis in reader.axes() {
        let numbers = axis.coordinates.iter().find_map(|coordinate| match &coordinate.values {
            AxisValues::Numbers(values) if is_size(&coordinate.name) => {
                Some(SizeDimension::of_coordinate(&coordinate.name, &coordinate.units, values))
            }
            _ => None,
        });
        let name = axis.coordinates.first().map_or("", |coordinate| &coordinate.name);
        let why = format!("its axis {name} is no size of particles, and the format has only those");
        sizes.push(numbers.ok_or_else(|| refuse(why))?);
    }
    let shape: Vec<usize> = reader.axes().iter().map(|axis| axis.len()).collect();
    let present = reader.present()?;
    if present.iter().any(|present| !present) {
        return Err(refuse("tables of it are missing".into()).into());
    }
    let tables = (0..present.len()).map(|i| reader.table(&position_of(i, &shape)));
    Ok(Source { tables: tables.collect::<Result<_, _>>()?, sizes })
}

/// Names of swept keys that are sizes of particles or parameters of their distribution.
fn is_size(name: &str) -> bool {
    const PARAMETERS: [&str; 4] =
        ["spread", "effective_variance", "deviation_um", "rain_rate_mm_h"];
    name.ends_with("radius_um") || PARAMETERS.contains(&name)
}

fn write_mitsuba(
    table: &PhaseTable,
    averaged: &Averaged,
    folder: &Path,
    samples: u32,
) -> anyhow::Result<()> {
    std::fs::create_dir_all(folder)?;
    save(&folder.join("phase.csv"), mitsuba::spectral_table(averaged).as_bytes())?;
    let strings = mitsuba::tabphase(table, averaged, samples as usize);
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
