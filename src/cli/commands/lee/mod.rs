//! `gonio lee`: the colour of the bow over scattering angle × drop radius.

mod picture;

use crate::cli::args::polarisation::PolarisationFlag;
use crate::cli::args::ranges;
use crate::cli::show::{notes, progress};
use crate::cli::{Failure, Result};
use clap::{Args, ValueEnum};
use gonio::lee::file::{About, save};
use gonio::lee::{Bodies, Diagram, Raindrops, Request, column_exposures, columns, srgb};
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

pub fn run(args: LeeArgs) -> Result<()> {
    if args.output.is_none() && args.data.is_none() && !args.json {
        return Err(usage("nothing to do: give -o LEE.png, --data LEE.h5 or --json"));
    }
    if let Some(path) = args.data.as_ref().filter(|path| path.exists() && !args.overwrite) {
        let message = "the file exists; choose another name, or --overwrite";
        return Err(usage(format!("--data = {}: {message}", path.display())));
    }
    let request = request(&args)?;
    let start = Instant::now();
    let bodies = bodies(&args)?;
    let bar = progress::bar(request.radii.len(), "radii");
    let diagram = columns(&request, &bodies, || bar.inc(1))?;
    bar.finish_and_clear();
    let seconds = start.elapsed().as_secs_f64();
    let seen = diagram.seen(args.polarisation.into());
    let exposure = column_exposures(&seen, PEAK);
    if let Some(path) = &args.output {
        picture::draw(&args, &request, &seen, &exposure, path)?;
    }
    if let Some(path) = &args.data {
        let command_line = &std::env::args().collect::<Vec<_>>().join(" ");
        let (illuminant, observer) = (&*args.illuminant, &*args.observer);
        let about = About { command_line, illuminant, observer };
        save(&diagram, about, path, args.overwrite)?;
    }
    if args.json {
        print_json(&diagram, &srgb(&seen, &exposure), seconds)?;
    }
    Ok(())
}

fn usage(message: impl Into<String>) -> Failure {
    Failure::usage(message)
}

fn bodies(args: &LeeArgs) -> Result<Bodies> {
    Ok(match args.shape {
        LeeShape::Sphere => Bodies::Spheres,
        LeeShape::Raindrop => Bodies::Raindrops(Raindrops::new(
            MediumSpec::parse(&args.medium)?,
            args.sun_elevation_deg,
            args.azimuth_deg.to_radians(),
        )?),
    })
}

fn request(args: &LeeArgs) -> Result<Request> {
    let medium = MediumSpec::parse(&args.medium)?.resolve(Path::new("."))?;
    notes::tell(medium.notes());
    Ok(Request {
        radii: ranges::radii(&args.radius_mm, args.linear)?,
        theta: ranges::diagram_angles(&args.theta)?,
        medium,
        sun_disc: !args.no_sun_disc,
        size_spread: args.size_spread,
        illuminant: args.illuminant.parse()?,
        observer: args.observer.parse()?,
        fineness: args.fineness,
    })
}

/// Colours as JSON on stdout.
fn print_json(diagram: &Diagram, srgb: &[Vec<[u8; 3]>], seconds: f64) -> Result<()> {
    let value = serde_json::json!({
        "seconds": seconds,
        "radii_mm": diagram.radii_mm(),
        "theta_deg": diagram.theta_deg(),
        "srgb": srgb,
    });
    println!("{}", serde_json::to_string(&value)?);
    Ok(())
}
