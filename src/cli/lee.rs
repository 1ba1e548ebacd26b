//! `gonio lee`: the colour of the bow over scattering angle × drop radius.

mod columns;
mod data;
mod picture;
mod ranges;

use super::UsageError;
use super::polarisation::PolarisationFlag;
use clap::{Args, ValueEnum};
use gonio::lee::{Request, column_exposures};
use gonio::medium::MediumSpec;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Lee diagram: colour over scattering angle × drop radius, as PNG and HDF5
#[derive(Args)]
#[command(after_help = "Example: gonio lee -o lee.png --data lee.h5 --radius-mm 0.01:1:400")]
pub struct LeeArgs {
    /// Picture to write
    #[arg(short, long, value_name = "LEE.png")]
    output: Option<PathBuf>,
    /// Numbers to write (HDF5)
    #[arg(long, value_name = "LEE.h5")]
    data: Option<PathBuf>,
    /// Replace a data file of the same name
    #[arg(long)]
    overwrite: bool,
    /// Spheres by Lorenz–Mie, raindrops by rays
    #[arg(long, value_enum, default_value = "sphere")]
    shape: LeeShape,
    /// Radii FROM:TO:COUNT, log-spaced
    #[arg(long, value_name = "MM", default_value = "0.01:1:400")]
    radius_mm: String,
    /// Radii evenly spaced
    #[arg(long)]
    linear: bool,
    /// Scattering angles FROM:TO:STEP
    #[arg(long, value_name = "DEG", default_value = "120:150:0.075")]
    theta: String,
    /// Sun above the horizon (raindrops)
    #[arg(long, value_name = "DEG", default_value_t = 20.0, allow_negative_numbers = true)]
    sun_elevation_deg: f64,
    /// Azimuth about the sun's rays of the light seen (raindrops): 180, light that goes down, is the
    /// top of the bow; 90 its side; 0 its lowest point
    #[arg(long, value_name = "DEG", default_value_t = 180.0, allow_negative_numbers = true)]
    azimuth_deg: f64,
    /// Light seen through no filter, or one along or across the scattering plane
    #[arg(long, value_enum, default_value = "total")]
    polarisation: PolarisationFlag,
    /// A point instead of the sun's disc of 0.53°
    #[arg(long)]
    no_sun_disc: bool,
    /// Standard deviation of ln(radius) about each radius
    #[arg(long, value_name = "SPREAD", default_value_t = 0.0)]
    size_spread: f64,
    /// Medium of the drops: a name, a .yml or .csv file, or a table in braces as in a scene
    #[arg(long, value_name = "MEDIUM", default_value = "water")]
    medium: String,
    /// Light: D65, A, E, D50, 5778K, sun, sun-ground, sun@DEGREES
    #[arg(long, default_value = "D65")]
    illuminant: String,
    /// Observer: 1931 or 2015
    #[arg(long, default_value = "1931")]
    observer: String,
    /// Factor on the numbers of angles and wavelengths
    #[arg(long, default_value_t = 1.0)]
    fineness: f64,
    /// Print seconds, radii, angles and colours
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, ValueEnum)]
enum LeeShape {
    Sphere,
    Raindrop,
}

/// Luminance of the brightest angle of each column.
const PEAK: f64 = 0.8;

pub fn run(args: LeeArgs) -> anyhow::Result<()> {
    if args.output.is_none() && args.data.is_none() && !args.json {
        return Err(usage("nothing to do: give -o LEE.png, --data LEE.h5 or --json"));
    }
    if let Some(path) = args.data.as_ref().filter(|path| path.exists() && !args.overwrite) {
        let message = "the file exists; choose another name, or --overwrite";
        return Err(usage(format!("--data = {}: {message}", path.display())));
    }
    let request = request(&args)?;
    let start = Instant::now();
    let diagram = columns::columns(&args, &request)?;
    let seconds = start.elapsed().as_secs_f64();
    let seen = diagram.seen(args.polarisation.into());
    let exposure = column_exposures(&seen, PEAK);
    if let Some(path) = &args.output {
        picture::draw(&args, &request, &seen, &exposure, path)?;
    }
    if let Some(path) = &args.data {
        data::save(&args, &diagram, path)?;
    }
    if args.json {
        data::print_json(&diagram, &seen, &exposure, seconds)?;
    }
    Ok(())
}

fn usage(message: impl Into<String>) -> anyhow::Error {
    UsageError(message.into()).into()
}

fn request(args: &LeeArgs) -> anyhow::Result<Request> {
    let medium = MediumSpec::parse(&args.medium)?.resolve(Path::new("."))?;
    super::notes::tell(medium.notes());
    Ok(Request {
        radii: ranges::radii(&args.radius_mm, args.linear)?,
        theta: ranges::angles(&args.theta)?,
        medium,
        sun_disc: !args.no_sun_disc,
        size_spread: args.size_spread,
        illuminant: args
            .illuminant
            .parse()
            .map_err(|e: gonio::color::ColorError| usage(e.to_string()))?,
        observer: args
            .observer
            .parse()
            .map_err(|e: gonio::color::ColorError| usage(e.to_string()))?,
        fineness: args.fineness,
    })
}
