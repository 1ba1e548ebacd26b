//! `gonio lee`: the colour of the bow over scattering angle × drop radius.

use super::UsageError;
use clap::{Args, ValueEnum};
use gonio::color::to_srgb;
use gonio::hdf5::{DiagramAxis, DiagramValues, write_diagram};
use gonio::lee::{self, Beats, Diagram, Drop, LeeError, Polarisation, Request, column_exposures};
use gonio::medium::{Medium, MediumSpec};
use gonio::plan::Plan;
use gonio::render::ColorDiagram;
use gonio::scene::{Choice, Grid, Orders, Scene, SceneFile, ShapeName};
use std::f64::consts::TAU;
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
    /// Azimuth about the sun's direction, 0 = up (raindrops)
    #[arg(long, value_name = "DEG", default_value_t = 0.0, allow_negative_numbers = true)]
    azimuth_deg: f64,
    /// Light seen through no filter, or one along or across the scattering plane
    #[arg(long, value_enum, default_value = "total")]
    polarisation: LeePolarisation,
    /// A point instead of the sun's disc of 0.53°
    #[arg(long)]
    no_sun_disc: bool,
    /// Standard deviation of ln(radius) about each radius
    #[arg(long, value_name = "SPREAD", default_value_t = 0.0)]
    size_spread: f64,
    /// Medium of the drops, by name
    #[arg(long, value_name = "NAME", default_value = "water")]
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

#[derive(Clone, Copy, ValueEnum)]
enum LeePolarisation {
    Total,
    Parallel,
    Perpendicular,
}

/// Luminance of the brightest angle of each column.
const PEAK: f64 = 0.8;

pub fn run(args: LeeArgs) -> anyhow::Result<()> {
    if args.output.is_none() && args.data.is_none() && !args.json {
        return Err(usage("nothing to do: give -o LEE.png, --data LEE.h5 or --json"));
    }
    let request = request(&args)?;
    let start = Instant::now();
    let diagram = match args.shape {
        LeeShape::Sphere => lee::spheres(&request).map_err(wrong_input)?,
        LeeShape::Raindrop => raindrops(&args, &request)?,
    };
    let seconds = start.elapsed().as_secs_f64();
    let polarisation = match args.polarisation {
        LeePolarisation::Total => Polarisation::Total,
        LeePolarisation::Parallel => Polarisation::Parallel,
        LeePolarisation::Perpendicular => Polarisation::Perpendicular,
    };
    let seen = diagram.seen(polarisation);
    let exposure = column_exposures(&seen, PEAK);
    if let Some(path) = &args.output {
        draw(&args, &request, &seen, &exposure, path)?;
    }
    if let Some(path) = &args.data {
        save(&args, &diagram, path)?;
    }
    if args.json {
        print_json(&diagram, &seen, &exposure, seconds)?;
    }
    Ok(())
}

fn usage(message: impl Into<String>) -> anyhow::Error {
    UsageError(message.into()).into()
}

/// What the library refuses here was asked for on the command line.
fn wrong_input(error: LeeError) -> anyhow::Error {
    usage(error.to_string())
}

fn request(args: &LeeArgs) -> anyhow::Result<Request> {
    let spec = MediumSpec::name(args.medium.as_str());
    Ok(Request {
        radii: radii(&args.radius_mm, args.linear)?,
        theta: angles(&args.theta)?,
        medium: spec.resolve(Path::new("."))?,
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

/// Three numbers of `A:B:C`.
fn triple(flag: &str, text: &str, form: &str) -> anyhow::Result<[f64; 3]> {
    let numbers: Vec<f64> = text.split(':').filter_map(|part| part.trim().parse().ok()).collect();
    match numbers.as_slice() {
        &[a, b, c] if text.split(':').count() == 3 && a.is_finite() && b.is_finite() => {
            Ok([a, b, c])
        }
        _ => Err(usage(format!("{flag} = \"{text}\": expected {form}"))),
    }
}

fn radii(text: &str, linear: bool) -> anyhow::Result<Vec<f64>> {
    let form =
        "FROM:TO:COUNT in mm, such as 0.01:1:400, with 0 < FROM <= TO and 1 <= COUNT <= 10000";
    let [from, to, count] = triple("--radius-mm", text, form)?;
    let whole = (1.0..=10_000.0).contains(&count) && count.fract() == 0.0;
    if !(from > 0.0 && to >= from && whole && (count > 1.0 || from == to)) {
        return Err(usage(format!("--radius-mm = \"{text}\": expected {form}")));
    }
    let steps = (count - 1.0).max(1.0);
    let place = |i: usize| i as f64 / steps;
    let radius = |share: f64| {
        if linear { from + share * (to - from) } else { from * (to / from).powf(share) }
    };
    Ok((0..count as usize).map(|i| 1e-3 * radius(place(i))).collect())
}

fn angles(text: &str) -> anyhow::Result<Vec<f64>> {
    let form = "FROM:TO:STEP in degrees, such as 120:150:0.075, with 0 <= FROM < TO <= 180";
    let [from, to, step] = triple("--theta", text, form)?;
    let count = ((to - from) / step + 1e-9).floor();
    if !(from >= 0.0 && to > from && to <= 180.0 && step > 0.0 && (1.0..=1e6).contains(&count)) {
        return Err(usage(format!("--theta = \"{text}\": expected {form}")));
    }
    Ok((0..=count as usize).map(|i| (from + step * i as f64).to_radians()).collect())
}

/// Raindrops: the ray engine in one half-plane of azimuth. The orders' intensities are added:
/// beats between them are too fast for the sun's disc and for colours. The smallest drops are
/// spheres, for which Lorenz–Mie is exact.
fn raindrops(args: &LeeArgs, request: &Request) -> anyhow::Result<Diagram> {
    let azimuth = args.azimuth_deg.to_radians();
    let plan_of = |radius: f64, order: u32| -> anyhow::Result<Plan> {
        let mut file = SceneFile::default();
        file.particle.shape = Some(Choice(ShapeName::Raindrop));
        file.particle.radius_mm = Some(radius * 1e3);
        file.particle.medium = Some(MediumSpec::name(args.medium.as_str()));
        file.light.sun_elevation_deg = Some(args.sun_elevation_deg);
        file.light.wavelengths_nm = Some(Grid::List(vec![550.0]));
        let scene = Scene { orders: Orders::List(vec![order]), ..file.validate()? };
        Ok(Plan::new(&scene)?)
    };
    let directions =
        |theta: &[f64]| -> Vec<(f64, f64)> { theta.iter().map(|&t| (t, azimuth)).collect() };
    let one = |drop: &Drop, at: &[(f64, f64)]| {
        let mut sum = vec![[0.0; 2]; at.len()];
        for order in ORDERS {
            let plan = plan_of(drop.radius, order)?;
            let size_parameter = TAU * drop.radius / drop.wavelength;
            let matrices = gonio::simulate::scatter(&plan, drop.index, size_parameter, at);
            for (sum, m) in sum.iter_mut().zip(&matrices) {
                sum[0] += 0.5 * (m.s2.norm_sqr() + m.s3.norm_sqr());
                sum[1] += 0.5 * (m.s1.norm_sqr() + m.s4.norm_sqr());
            }
        }
        anyhow::Ok(sum)
    };
    let scatter = |drops: &[Drop], at: &Vec<(f64, f64)>| {
        drops.iter().map(|drop| one(drop, at)).collect::<anyhow::Result<Vec<_>>>()
    };
    let mut round = request.clone();
    let mut flat = request.clone();
    (round.radii, flat.radii) = (Vec::new(), Vec::new());
    for &radius in &request.radii {
        let sphere = plan_of(radius, ORDERS[0])?.shape.is_sphere();
        if sphere { &mut round } else { &mut flat }.radii.push(radius);
    }
    let mut xyz: Vec<Vec<[[f64; 3]; 2]>> = Vec::new();
    if !round.radii.is_empty() {
        xyz = lee::spheres(&round).map_err(wrong_input)?.xyz;
    }
    if !flat.radii.is_empty() {
        xyz.extend(lee::diagram(&flat, Beats::WithinOrders, &directions, scatter)?.xyz);
    }
    // Radii ascend, and small drops are the round ones.
    Ok(Diagram { radii: request.radii.clone(), theta: request.theta.clone(), xyz })
}

/// External reflection, transmission, primary and secondary bow.
const ORDERS: [u32; 4] = [0, 1, 2, 3];

fn draw(
    args: &LeeArgs,
    request: &Request,
    seen: &[Vec<[f64; 3]>],
    exposure: &[f64],
    path: &Path,
) -> anyhow::Result<()> {
    let shape = match args.shape {
        LeeShape::Sphere => "spheres, Lorenz–Mie".to_string(),
        LeeShape::Raindrop => format!(
            "raindrops: rays, orders 0 to 3; small ones are spheres: Lorenz–Mie; sun at {}°, azimuth \
             {}°",
            args.sun_elevation_deg, args.azimuth_deg
        ),
    };
    let light = match args.polarisation {
        LeePolarisation::Total => "all polarisations",
        LeePolarisation::Parallel => "polarised along the scattering plane",
        LeePolarisation::Perpendicular => "polarised across the scattering plane",
    };
    let disc = if request.sun_disc { "sun's disc 0.53°" } else { "point source" };
    let spread = if request.size_spread > 0.0 {
        format!(", sizes spread by {}", request.size_spread)
    } else {
        String::new()
    };
    let radii: Vec<f64> = request.radii.iter().map(|r| r * 1e3).collect();
    let theta: Vec<f64> = request.theta.iter().map(|t| t.to_degrees()).collect();
    let diagram = ColorDiagram {
        title: &format!("Lee diagram: {} ({shape})", args.medium),
        subtitle: &format!(
            "{light}, {disc}{spread}, light {}, CIE {}; every radius scaled to the same brightest \
             luminance",
            args.illuminant, args.observer
        ),
        radii: &radii,
        logarithmic: !args.linear,
        theta: &theta,
        xyz: seen,
        exposure,
        marks: &descartes(&request.medium),
    };
    diagram.picture()?.write_png(path)?;
    Ok(())
}

/// Rainbow angles of ray optics for a sphere, red and violet.
fn descartes(medium: &Medium) -> Vec<(f64, String)> {
    let mut marks = Vec::new();
    for (nm, colour) in [(650.0, "650 nm"), (420.0, "420 nm")] {
        let Ok(index) = medium.index(nm * 1e-9) else { continue };
        for (p, bow) in [(2.0, "primary"), (3.0, "secondary")] {
            let n = index.re;
            let squared: f64 = (n * n - 1.0) / (p * p - 1.0);
            if !(0.0..1.0).contains(&squared) {
                continue;
            }
            let incident = squared.sqrt().acos();
            let refracted = (incident.sin() / n).asin();
            let turned = (p - 1.0) * std::f64::consts::PI + 2.0 * incident - 2.0 * p * refracted;
            let angle = turned.rem_euclid(TAU);
            let angle = angle.min(TAU - angle).to_degrees();
            marks.push((angle, format!("{bow} {colour}, rays")));
        }
    }
    marks
}

fn save(args: &LeeArgs, diagram: &Diagram, path: &Path) -> anyhow::Result<()> {
    let radii: Vec<f64> = diagram.radii.iter().map(|r| r * 1e3).collect();
    let theta: Vec<f64> = diagram.theta.iter().map(|t| t.to_degrees()).collect();
    let flat = |part: usize| -> Vec<f32> {
        let columns = diagram.xyz.iter().flatten();
        columns.flat_map(|cell| cell[part].map(|v| v as f32)).collect()
    };
    let (parallel, perpendicular) = (flat(0), flat(1));
    let axis = |name, units, long_name, values| DiagramAxis { name, units, long_name, values };
    let values = |name, long_name, values| DiagramValues {
        name,
        units: "sr-1",
        long_name,
        axes: &[0, 1, 2],
        values,
    };
    let command = std::env::args().collect::<Vec<_>>().join(" ");
    write_diagram(
        path,
        args.overwrite,
        &[
            ("Conventions", "CF-1.11"),
            ("title", "Lee diagram: colour over drop radius and scattering angle"),
            ("source", concat!("gonio ", env!("CARGO_PKG_VERSION"))),
            ("command_line", &command),
            ("illuminant", &args.illuminant),
            ("observer", &args.observer),
            (
                "comment",
                "XYZ of the differential over the geometrical cross-section, relative to the \
                 illuminant (Y = 1 for 1 sr-1 at all wavelengths); total = parallel + perpendicular",
            ),
        ],
        &[
            axis("radius_mm", "mm", "radius of the sphere of equal volume", &radii),
            axis("theta", "degree", "scattering angle, 0 = forward", &theta),
            axis("stimulus", "1", "CIE X, Y, Z", &[0.0, 1.0, 2.0]),
        ],
        &[
            values("xyz_parallel", "light polarised along the scattering plane", &parallel),
            values("xyz_perpendicular", "light polarised across it", &perpendicular),
        ],
    )?;
    Ok(())
}

fn print_json(
    diagram: &Diagram,
    seen: &[Vec<[f64; 3]>],
    exposure: &[f64],
    seconds: f64,
) -> anyhow::Result<()> {
    let srgb: Vec<Vec<[u8; 3]>> = seen
        .iter()
        .zip(exposure)
        .map(|(column, &e)| column.iter().map(|&xyz| to_srgb(xyz, e)).collect())
        .collect();
    let value = serde_json::json!({
        "seconds": seconds,
        "radii_mm": diagram.radii.iter().map(|r| r * 1e3).collect::<Vec<_>>(),
        "theta_deg": diagram.theta.iter().map(|t| t.to_degrees()).collect::<Vec<_>>(),
        "srgb": srgb,
    });
    println!("{}", serde_json::to_string(&value)?);
    Ok(())
}
