//! `gonio scatter`: the amplitude matrix in chosen directions, by rays, Lorenz–Mie, Debye terms or
//! the T-matrix.

use super::UsageError;
use super::scatter_input::{
    Index, ShapeKind, parse_index, parse_orders, parse_theta, raindrop_model,
};
use anyhow::Result;
use clap::{Args, ValueEnum};
use gonio::medium::Medium;
use gonio::optics::AmplitudeMatrix;
use gonio::plan::{Engine, LARGEST_K_OVER_N, Plan, RAY_SIZES, Symmetry, last_order};
use gonio::series::debye::{DebyeSeries, Term};
use gonio::series::lorenz_mie::Sphere;
use gonio::series::tmatrix::{Scattered, TMatrix};
use gonio::shape::Shape;
use gonio::simulate;
use gonio::trace::{Fates, Tracer, Wavefront, energy_by_fate};
use num_complex::Complex64;
use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};
use std::time::Instant;

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum MethodName {
    Rays,
    Mie,
    Debye,
    /// Exact for bodies of revolution
    Tmatrix,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum DiffractionName {
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
    method: MethodName,
    #[arg(long, value_enum, default_value = "sphere")]
    shape: ShapeKind,
    /// Radius of the sphere of equal volume, micrometres
    #[arg(long, allow_hyphen_values = true)]
    radius_um: Option<f64>,
    /// Diameter of the sphere of equal volume, millimetres
    #[arg(long, conflicts_with = "radius_um")]
    diameter_mm: Option<f64>,
    /// Wavelength in vacuum, nanometres
    #[arg(long, allow_hyphen_values = true)]
    wavelength_nm: Option<f64>,
    /// Frequency in place of the wavelength, GHz
    #[arg(long, allow_hyphen_values = true, conflicts_with = "wavelength_nm")]
    frequency_ghz: Option<f64>,
    /// Size parameter 2πa/λ of the sphere of equal volume
    #[arg(long, allow_hyphen_values = true)]
    size_parameter: Option<f64>,
    /// Index n or n+k; without it, water at the wavelength
    #[arg(long, value_parser = parse_index, allow_hyphen_values = true)]
    index: Option<Index>,
    /// Vertical over horizontal diameter of a spheroid
    #[arg(long, allow_hyphen_values = true)]
    axis_ratio: Option<f64>,
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    sun_elevation_deg: f64,
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    azimuth_deg: f64,
    /// Scattering angles in degrees: a comma list of values and from:to:step ranges
    #[arg(long)]
    theta: String,
    /// A comma list of orders, "diffraction", or "auto"
    #[arg(long, default_value = "auto")]
    orders: String,
    #[arg(long, value_enum, default_value = "airy")]
    diffraction: DiffractionName,
    /// Relative error asked for
    #[arg(long, default_value_t = 0.01)]
    tolerance: f64,
    /// Raindrop model
    #[arg(long, default_value = "beard-chuang-1987")]
    model: String,
    /// Rays across the silhouette for the patches of `--diffraction none` and `gaussian`
    #[arg(long)]
    rays_across: Option<usize>,
    /// JSON on standard output
    #[arg(long)]
    json: bool,
}

/// What was asked for, checked.
struct Job {
    size_parameter: f64,
    index: Complex64,
    theta: Vec<f64>,
    azimuth: f64,
    orders: Option<Vec<u32>>,
    diffraction_term: bool,
}

/// Amplitudes and integrals of one method.
struct Answer {
    amplitudes: Vec<AmplitudeMatrix>,
    q_ext: Option<f64>,
    q_sca: Option<f64>,
    q_abs: Option<f64>,
    q_back: Option<f64>,
    asymmetry: Option<f64>,
    diffraction_included: bool,
    /// Estimated relative error of amplitudes, where the method has one
    error_estimate: Option<f64>,
}

pub fn run(args: ScatterArgs) -> Result<()> {
    let job = job(&args)?;
    let start = Instant::now();
    let answer = match args.method {
        MethodName::Mie => mie(&args, &job)?,
        MethodName::Debye => debye(&args, &job)?,
        MethodName::Rays => rays(&args, &job)?,
        MethodName::Tmatrix => t_matrix(&args, &job)?,
    };
    let seconds = start.elapsed().as_secs_f64();
    if args.json {
        println!("{}", to_json(&args, &job, &answer, seconds));
    } else {
        print_table(&job, &answer);
    }
    Ok(())
}

fn usage(message: String) -> anyhow::Error {
    UsageError(message).into()
}

fn positive(name: &str, value: Option<f64>) -> Result<Option<f64>> {
    match value {
        Some(v) if !(v.is_finite() && v > 0.0) => {
            Err(usage(format!("--{name} {v}: a finite number above 0 is accepted")))
        }
        other => Ok(other),
    }
}

fn job(args: &ScatterArgs) -> Result<Job> {
    let radius =
        positive("radius-um", args.radius_um)?
            .or(positive("diameter-mm", args.diameter_mm)?.map(|d| 500.0 * d));
    let wavelength = positive("wavelength-nm", args.wavelength_nm)?.or(positive(
        "frequency-ghz",
        args.frequency_ghz,
    )?
    .map(|ghz| gonio::medium::wavelength_of_ghz(ghz) * 1e9));
    let size = positive("size-parameter", args.size_parameter)?;
    let radius_m = radius.unwrap_or(1.0) * 1e-6;
    let (size_parameter, wavelength_m) = match (size, wavelength, radius) {
        (Some(x), Some(w), _) => (x, w * 1e-9),
        (Some(x), None, _) => (x, TAU * radius_m / x),
        (None, Some(w), Some(_)) => (TAU * radius_m / (w * 1e-9), w * 1e-9),
        _ => {
            return Err(usage(
                "the particle's size is missing: give --size-parameter, or --radius-um and \
                 --wavelength-nm"
                    .into(),
            ));
        }
    };
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
    let index = match args.index {
        Some(Index(index)) => index,
        None => Medium::Water { temperature: 293.15 }.index(wavelength_m)?,
    };
    let (orders, diffraction_term) = parse_orders(&args.orders).map_err(usage)?;
    let theta = parse_theta(&args.theta).map_err(usage)?;
    let azimuth = args.azimuth_deg.to_radians();
    Ok(Job { size_parameter, index, theta, azimuth, orders, diffraction_term })
}

fn sphere_only(args: &ScatterArgs) -> Result<()> {
    let round = args.shape == ShapeKind::Sphere
        || (args.shape == ShapeKind::Spheroid && args.axis_ratio == Some(1.0));
    if round {
        return Ok(());
    }
    Err(usage(
        "--method mie and debye serve spheres only: use --method rays or tmatrix for this shape"
            .into(),
    ))
}

fn radians(job: &Job) -> Vec<f64> {
    job.theta.iter().map(|t| t.to_radians()).collect()
}

fn diagonal(pairs: Vec<(Complex64, Complex64)>) -> Vec<AmplitudeMatrix> {
    pairs.into_iter().map(|(s1, s2)| AmplitudeMatrix { s1, s2, ..Default::default() }).collect()
}

fn mie(args: &ScatterArgs, job: &Job) -> Result<Answer> {
    sphere_only(args)?;
    let sphere = Sphere::new(job.size_parameter, job.index)?;
    let q = sphere.efficiencies();
    Ok(Answer {
        amplitudes: diagonal(sphere.amplitudes_parallel(&radians(job))),
        q_ext: Some(q.q_ext),
        q_sca: Some(q.q_sca),
        q_abs: Some(q.q_abs),
        q_back: Some(q.q_back),
        asymmetry: Some(q.asymmetry),
        diffraction_included: true,
        error_estimate: None,
    })
}

fn debye(args: &ScatterArgs, job: &Job) -> Result<Answer> {
    sphere_only(args)?;
    let auto = job.orders.is_none() && !job.diffraction_term;
    let list = match &job.orders {
        Some(list) => list.clone(),
        None if job.diffraction_term => Vec::new(),
        None => (0..=last_order(job.index.re, args.tolerance)).collect(),
    };
    let mut terms: Vec<Term> = list.into_iter().map(Term::Order).collect();
    let diffraction_included = auto || job.diffraction_term;
    if diffraction_included {
        terms.push(Term::Diffraction);
    }
    let series = DebyeSeries::new(job.size_parameter, job.index)?;
    let amplitudes = diagonal(series.sum_parallel(&terms, &radians(job)));
    let q = Sphere::new(job.size_parameter, job.index)?.efficiencies();
    Ok(Answer {
        amplitudes,
        q_ext: Some(q.q_ext),
        q_sca: Some(q.q_sca),
        q_abs: Some(q.q_abs),
        q_back: Some(q.q_back),
        asymmetry: Some(q.asymmetry),
        diffraction_included,
        error_estimate: None,
    })
}

fn shape(args: &ScatterArgs) -> Result<Shape> {
    let sun = args.sun_elevation_deg.to_radians();
    Ok(match args.shape {
        ShapeKind::Sphere => Shape::sphere(),
        ShapeKind::Spheroid => {
            let ratio = args
                .axis_ratio
                .ok_or_else(|| usage("--axis-ratio is missing for a spheroid".into()))?;
            Shape::spheroid(ratio, sun).map_err(|e| usage(format!("--axis-ratio: {e}")))?
        }
        ShapeKind::Raindrop => {
            let radius = args.radius_um.or(args.diameter_mm.map(|d| 500.0 * d)).unwrap_or(1.0);
            Shape::raindrop(radius * 1e-6, raindrop_model(&args.model)?, sun)
                .map_err(|e| usage(e.to_string()))?
        }
    })
}

fn rays(args: &ScatterArgs, job: &Job) -> Result<Answer> {
    if job.index.im > LARGEST_K_OVER_N * job.index.re {
        return Err(usage(format!(
            "--index {}+{}: rays need k/n below {LARGEST_K_OVER_N}; use --method mie for a sphere",
            job.index.re, job.index.im
        )));
    }
    let (smallest, largest) = RAY_SIZES;
    if !(smallest..=largest).contains(&job.size_parameter) {
        return Err(usage(format!(
            "size parameter {:e}: rays are accepted from {smallest} to {largest:e}; use --method mie \
             for a small sphere",
            job.size_parameter
        )));
    }
    if job.diffraction_term {
        return Err(usage("--orders diffraction: a term of --method debye only".into()));
    }
    let shape = shape(args)?;
    let engine = match args.diffraction {
        DiffractionName::Airy => Engine::Meridians,
        DiffractionName::None | DiffractionName::Gaussian => Engine::Patches,
    };
    let auto = job.orders.is_none();
    let orders = job
        .orders
        .clone()
        .unwrap_or_else(|| (0..=last_order(job.index.re, args.tolerance)).collect());
    let diffraction = auto && args.diffraction != DiffractionName::None;
    let plan =
        Plan::direct(shape, 1.0, engine, orders, diffraction, args.tolerance, args.rays_across);
    // The backward direction rides along: rays are traced once.
    let asked = radians(job).into_iter().map(|theta| (theta, job.azimuth));
    let directions: Vec<(f64, f64)> = asked.chain([(PI, job.azimuth)]).collect();
    let fates = fates(&plan, job);
    let (mut amplitudes, sections) = simulate::scatter_with_sections(
        &plan,
        job.index,
        job.size_parameter,
        &directions,
        fates.absorbed,
    );
    let back = amplitudes.pop().unwrap_or_default();
    let shadow = plan.shape.silhouette().area() / PI;
    let (q_ext, q_abs) = (sections.extinction / PI, sections.absorption / PI);
    let q_sca = q_ext - q_abs;
    // rays by their angles; what is beyond them goes straight on
    let straight = q_sca - shadow * (1.0 - fates.absorbed);
    Ok(Answer {
        amplitudes,
        q_ext: Some(q_ext),
        q_sca: Some(q_sca),
        q_abs: Some(q_abs),
        q_back: Some(4.0 * back.s11() / job.size_parameter.powi(2)),
        asymmetry: Some((shadow * fates.forward_momentum + straight) / q_sca),
        diffraction_included: diffraction,
        error_estimate: None,
    })
}

/// Exact for bodies of revolution: amplitudes and cross sections of one T-matrix.
fn t_matrix(args: &ScatterArgs, job: &Job) -> Result<Answer> {
    if job.orders.is_some() || job.diffraction_term {
        return Err(usage(format!(
            "--orders {}: the T-matrix has all orders at once; --method debye or rays takes a list",
            args.orders
        )));
    }
    let shape = shape(args)?;
    let t = TMatrix::new(&shape, job.size_parameter, job.index, args.tolerance)?;
    let scattered = Scattered::new(&t, args.sun_elevation_deg.to_radians());
    let directions: Vec<(f64, f64)> =
        radians(job).into_iter().map(|theta| (theta, job.azimuth)).collect();
    let q = scattered.efficiencies();
    Ok(Answer {
        amplitudes: scattered.directions(&directions),
        q_ext: Some(q.q_ext),
        q_sca: Some(q.q_sca),
        q_abs: Some(q.q_ext - q.q_sca),
        q_back: Some(q.q_back),
        asymmetry: Some(q.asymmetry),
        diffraction_included: true,
        error_estimate: Some(t.error()),
    })
}

/// What becomes of the light on the shadow, by rays.
fn fates(plan: &Plan, job: &Job) -> Fates {
    const GRID: usize = 64;
    let spokes = if plan.symmetry == Symmetry::Rotational { 4 } else { GRID };
    let last = plan.orders.iter().copied().max().unwrap_or(0);
    let tracer = Tracer::new(&plan.shape, job.index, job.size_parameter, last);
    energy_by_fate(&tracer, &Wavefront::midpoints(&plan.shape, GRID, spokes))
}

fn to_json(args: &ScatterArgs, job: &Job, answer: &Answer, seconds: f64) -> Value {
    let pairs = |f: fn(&AmplitudeMatrix) -> Complex64| -> Vec<[f64; 2]> {
        answer.amplitudes.iter().map(|s| [f(s).re, f(s).im]).collect()
    };
    json!({
        "method": match args.method {
            MethodName::Rays => "rays",
            MethodName::Mie => "mie",
            MethodName::Debye => "debye",
            MethodName::Tmatrix => "tmatrix",
        },
        "size_parameter": job.size_parameter,
        "index": [job.index.re, job.index.im],
        "azimuth_deg": args.azimuth_deg,
        "theta_deg": job.theta,
        "s1": pairs(|s| s.s1),
        "s2": pairs(|s| s.s2),
        "s3": pairs(|s| s.s3),
        "s4": pairs(|s| s.s4),
        "q_ext": answer.q_ext,
        "q_sca": answer.q_sca,
        "q_abs": answer.q_abs,
        "q_back": answer.q_back,
        "asymmetry": answer.asymmetry,
        "diffraction_included": answer.diffraction_included,
        "error_estimate": answer.error_estimate,
        "seconds": seconds,
    })
}

fn print_table(job: &Job, answer: &Answer) {
    println!("# size parameter {}, index {}+{}i", job.size_parameter, job.index.re, job.index.im);
    println!("# theta_deg  S1  S2  S3  S4  S11");
    for (theta, s) in job.theta.iter().zip(&answer.amplitudes) {
        let s11 = s.s11();
        println!("{theta:9.4} {:.6e} {:.6e} {:.6e} {:.6e} {s11:.6e}", s.s1, s.s2, s.s3, s.s4);
    }
}
