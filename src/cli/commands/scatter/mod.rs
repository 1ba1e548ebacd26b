//! `gonio scatter`: the amplitude matrix in chosen directions, by rays, Lorenz–Mie, Debye terms or the
//! T-matrix.

mod args;
mod report;

use crate::cli::args::particle::{ShapeFlags, ShapeKind, parse_orders, raindrop_model};
use crate::cli::args::ranges::scattering_angles;
use crate::cli::failure::{Failure, Result};
use crate::cli::show::progress;
pub use args::ScatterArgs;
use args::{DiffractionName, Job, MethodName};
use gonio::math::digits::to_digits;
use gonio::medium::{Light, Medium, wavelength_of_ghz};
use gonio::plan::{check_outside, check_rays};
use gonio::scatter::{self, RayDiffraction, RayRequest, Request, Scattering, Size, SizeConflict};
use gonio::shape::Shape;
use std::f64::consts::TAU;
use std::time::Instant;

pub fn run(args: ScatterArgs) -> Result<()> {
    let job = job(&args)?;
    let start = Instant::now();
    let spinner = progress::spinner("amplitudes");
    let seen = match args.method {
        MethodName::Mie => {
            sphere_only(&args)?;
            match &job.body {
                Some(body) => scatter::layered(&job.request, body)?,
                None => scatter::lorenz_mie(&job.request)?,
            }
        }
        _ if job.body.is_some() => return Err(one_index_only(&args)),
        MethodName::Debye => {
            sphere_only(&args)?;
            scatter::debye(&job.request, &job.terms)?
        }
        MethodName::Rays => rays(&args, &job)?,
        MethodName::Tmatrix => scatter::t_matrix(&job.request, &shape(&args, &job)?)?,
        MethodName::Airy => {
            sphere_only(&args)?;
            if job.terms.diffraction {
                return Err(usage("--orders diffraction: a term of --method debye only"));
            }
            scatter::airy(&job.request, job.terms.orders.as_deref())?
        }
    };
    let seconds = start.elapsed().as_secs_f64();
    spinner.finish_and_clear();
    report::note(&args, &job, &seen);
    if args.json {
        println!("{}", report::to_json(&args, &job, &seen, seconds));
    } else {
        report::print_table(&job, &seen);
    }
    Ok(())
}

fn usage(message: impl Into<String>) -> Failure {
    Failure::usage(message)
}

/// Rays, Debye terms and the T-matrix follow one index.
fn one_index_only(args: &ScatterArgs) -> Failure {
    let method = match args.method {
        MethodName::Rays => "rays",
        MethodName::Debye => "debye",
        MethodName::Mie => "mie",
        MethodName::Tmatrix => "tmatrix",
        MethodName::Airy => "airy",
    };
    usage(format!(
        "--method {method}: layers, profiles and films are solved by --method mie, for spheres; rays, Debye \
         terms, Airy's theory and the T-matrix follow one index inside"
    ))
}

fn positive(name: &str, value: Option<f64>) -> Result<Option<f64>> {
    match value {
        Some(v) if !(v.is_finite() && v > 0.0) => {
            Err(usage(format!("--{name} {v}: a finite number above 0 is accepted")))
        }
        other => Ok(other),
    }
}

/// Any two of radius, wavelength and size parameter say the third; three must agree. The wavelength is the one
/// in the particle's surroundings.
fn size(args: &ScatterArgs, medium: &Medium) -> Result<Size> {
    let diameter = positive("diameter-mm", args.diameter_mm)?;
    let radius = positive("radius-um", args.radius_um)?.or(diameter.map(|d| 500.0 * d));
    let wavelength = positive("wavelength-nm", args.wavelength_nm)?
        .map(|nm| nm * 1e-9)
        .or(positive("frequency-ghz", args.frequency_ghz)?.map(wavelength_of_ghz))
        .map(|vacuum| medium.seen_outside(vacuum))
        .transpose()?;
    let parameter = positive("size-parameter", args.size_parameter)?;
    Size::of(radius.map(|um| um * 1e-6), wavelength, parameter).map_err(|conflict| match conflict {
        SizeConflict::Disagree { radius, wavelength, parameter, implied } => usage(format!(
            "--size-parameter {parameter} disagrees with a radius of {} µm at {} nm, whose size \
             parameter is {implied:.6}: give two of the three",
            to_digits(radius * 1e6, 9),
            to_digits(wavelength * 1e9, 9)
        )),
        SizeConflict::Missing => usage(
            "the particle's size is missing: give --size-parameter, or --radius-um and \
             --wavelength-nm",
        ),
    })
}

/// Flags that contradict each other; each pair is refused rather than settled.
fn check_flags(args: &ScatterArgs) -> Result<()> {
    let series = args.method != MethodName::Rays;
    let patches = args.diffraction.is_some_and(|diffraction| diffraction != DiffractionName::Airy);
    let rules = [
        (
            args.method == MethodName::Mie && args.orders != "auto",
            "--orders with --method mie: Lorenz–Mie has all orders at once; debye and rays take a list",
        ),
        (
            args.method == MethodName::Tmatrix && args.orders != "auto",
            "--orders with --method tmatrix: the T-matrix has all orders at once; debye and rays take a list",
        ),
        (
            series && args.diffraction.is_some(),
            "--diffraction with an exact series, which has all of it: a flag of --method rays only",
        ),
        (
            series && args.rays_across.is_some(),
            "--rays-across with an exact series, which has no rays: a flag of --method rays only",
        ),
        (
            !series && !patches && args.rays_across.is_some(),
            "--rays-across without patches of rays: a flag of --diffraction none and gaussian only",
        ),
    ];
    if let Some((_, message)) = rules.iter().find(|(wrong, _)| *wrong) {
        return Err(usage(*message));
    }
    let flags =
        ShapeFlags { shape: args.shape, axis_ratio: args.axis_ratio, model: args.model.as_deref() };
    flags.check()
}

fn job(args: &ScatterArgs) -> Result<Job> {
    check_flags(args)?;
    let medium = args.made_of.medium(args.index)?;
    let size = size(args, &medium)?;
    if !(args.tolerance > 0.0 && args.tolerance < 1.0) {
        return Err(usage(format!(
            "--tolerance {}: a number between 0 and 1 is accepted",
            args.tolerance
        )));
    }
    for (name, value, limit) in [
        ("sun-elevation-deg", args.sun_elevation_deg, 90.0),
        ("azimuth-deg", args.azimuth_deg, 360.0),
    ] {
        if value.is_nan() || value.abs() > limit {
            return Err(usage(format!("--{name} {value}: -{limit} to {limit} is accepted")));
        }
    }
    let Seen { light, radius, vacuum } = seen(args, &size, &medium)?;
    let body = medium.body(light.wavelength, radius)?;
    let terms = parse_orders(&args.orders).map_err(usage)?;
    let theta_deg = scattering_angles(&args.theta).map_err(usage)?;
    let request = Request {
        size_parameter: size.parameter,
        index: light.index,
        theta: theta_deg.iter().map(|t| t.to_radians()).collect(),
        azimuth: args.azimuth_deg.to_radians(),
        tolerance: args.tolerance,
    };
    let outside = vacuum / light.wavelength;
    Ok(Job { request, outside, body, radius: size.radius, theta_deg, terms })
}

/// The particle's light, with the radius (metres) that goes with it.
struct Seen {
    light: Light,
    radius: f64,
    /// Wavelength, metres.
    vacuum: f64,
}

/// Where a size parameter alone is given, and nothing depends on the wavelength, any radius will do.
fn seen(args: &ScatterArgs, size: &Size, medium: &Medium) -> Result<Seen> {
    let (radius, wavelength) = match (size.radius, size.wavelength) {
        (Some(radius), Some(wavelength)) => (radius, wavelength),
        _ if medium.valid_range() == (0.0, f64::INFINITY) && args.made_of.coating.is_none() => {
            (USUAL_RADIUS, TAU * USUAL_RADIUS / size.parameter)
        }
        _ => {
            if args.made_of.coating.is_some() {
                let message = "--coating: films have a thickness in the particle's size: give --radius-um, or \
                               --wavelength-nm";
                return Err(usage(message));
            }
            let plain = args.made_of.medium.is_none() && args.made_of.outside.is_none();
            let name = if plain { "water".into() } else { medium.name() };
            return Err(usage(format!(
                "the index of {name} needs --wavelength-nm (or --radius-um); or give --index"
            )));
        }
    };
    let vacuum = medium.vacuum(wavelength)?;
    check_outside(medium, vacuum, radius)?;
    let light = medium.light_at_surface(vacuum, radius)?;
    // As it was given, to the last digit.
    Ok(Seen { light: Light { wavelength, ..light }, radius, vacuum })
}

fn sphere_only(args: &ScatterArgs) -> Result<()> {
    let round = args.shape == ShapeKind::Sphere
        || (args.shape == ShapeKind::Spheroid && args.axis_ratio == Some(1.0));
    if round {
        return Ok(());
    }
    Err(usage(
        "--method mie, debye and airy serve spheres only: use --method rays or tmatrix for this shape",
    ))
}

fn shape(args: &ScatterArgs, job: &Job) -> Result<Shape> {
    let sun = args.sun_elevation_deg.to_radians();
    Ok(match args.shape {
        ShapeKind::Sphere => Shape::sphere(),
        ShapeKind::Spheroid => {
            let ratio =
                args.axis_ratio.ok_or_else(|| usage("--axis-ratio is missing for a spheroid"))?;
            Shape::spheroid(ratio, sun).map_err(|e| usage(format!("--axis-ratio: {e}")))?
        }
        ShapeKind::Raindrop => {
            let radius = job.radius.ok_or_else(|| {
                usage(
                    "a raindrop's shape depends on its size: give --radius-um, or --wavelength-nm",
                )
            })?;
            Shape::raindrop(radius, raindrop_model(args.model.as_deref())?, sun)?
        }
    })
}

/// Radius that stands for a sphere's whose size parameter alone is given, metres.
const USUAL_RADIUS: f64 = 1e-6;

fn rays(args: &ScatterArgs, job: &Job) -> Result<Scattering> {
    // Said before anything about the shape, which may be wrong too.
    check_rays(job.request.index, job.request.size_parameter, "")?;
    if job.terms.diffraction {
        return Err(usage("--orders diffraction: a term of --method debye only"));
    }
    let particle = RayRequest {
        shape: shape(args, job)?,
        orders: job.terms.orders.clone(),
        diffraction: match args.diffraction.unwrap_or(DiffractionName::Airy) {
            DiffractionName::None => RayDiffraction::None,
            DiffractionName::Gaussian => {
                RayDiffraction::Gaussian { radius: job.radius.unwrap_or(USUAL_RADIUS) }
            }
            DiffractionName::Airy => RayDiffraction::Airy,
        },
        rays_across: args.rays_across,
    };
    Ok(scatter::rays(&job.request, &particle)?)
}
