//! `gonio scatter`: the amplitude matrix in chosen directions, by rays, Lorenz–Mie or Debye terms.

use super::UsageError;
use super::scatter_input::{
    Index, ShapeFlags, ShapeKind, parse_index, parse_orders, parse_theta, raindrop_model,
};
use anyhow::{Result, bail};
use clap::{Args, ValueEnum};
use gonio::farfield::patches::gaussian_filter;
use gonio::math::digits::to_digits;
use gonio::medium::Medium;
use gonio::optics::AmplitudeMatrix;
use gonio::plan::{
    DOUBTFUL_PHASE_SHIFT, Engine, Plan, Symmetry, check_rays, last_order, phase_shift,
};
use gonio::series::debye::{DebyeSeries, Term};
use gonio::series::lorenz_mie::Sphere;
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
    /// Radius of the sphere of equal volume, micrometres. Of radius, wavelength and size parameter
    /// two say the third; given all three, they must agree
    #[arg(long, allow_hyphen_values = true)]
    radius_um: Option<f64>,
    /// Diameter of the sphere of equal volume, millimetres
    #[arg(long, conflicts_with = "radius_um")]
    diameter_mm: Option<f64>,
    /// Wavelength in vacuum, nanometres
    #[arg(long, allow_hyphen_values = true)]
    wavelength_nm: Option<f64>,
    /// Size parameter 2πa/λ of the sphere of equal volume
    #[arg(long, allow_hyphen_values = true)]
    size_parameter: Option<f64>,
    /// Index n or n+k; without it, water at the wavelength
    #[arg(long, value_parser = parse_index, allow_hyphen_values = true)]
    index: Option<Index>,
    /// Vertical over horizontal diameter of a spheroid
    #[arg(long, allow_hyphen_values = true)]
    axis_ratio: Option<f64>,
    /// Sun above the horizon; of no effect on a sphere
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    sun_elevation_deg: f64,
    /// Azimuth of the light about the sun's rays; of no effect on a sphere
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    azimuth_deg: f64,
    /// Scattering angles in degrees: a comma list of values and from:to:step ranges
    #[arg(long)]
    theta: String,
    /// A comma list of orders, "diffraction", or "auto"; not for Lorenz–Mie, which has all of them
    #[arg(long, default_value = "auto")]
    orders: String,
    /// airy: uniform formulas at every bow (default); gaussian: rays whose intensities a filter smooths
    /// near bows (Sadeghi et al. 2012; phases are those of the rays); none: rays alone
    #[arg(long, value_enum)]
    diffraction: Option<DiffractionName>,
    /// Relative error asked of rays and of the number of Debye terms
    #[arg(long, default_value_t = 0.01)]
    tolerance: f64,
    /// Raindrop model (default: beard-chuang-1987)
    #[arg(long)]
    model: Option<String>,
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
    /// Metres, where it is known.
    radius: Option<f64>,
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
    remainder: Option<Remainder>,
}

/// What a sum over Debye's terms leaves out.
struct Remainder {
    /// Of the largest coefficient.
    largest: f64,
    /// Of the amplitudes, root mean square, relative to Lorenz–Mie without diffraction.
    share: f64,
    last_order: u32,
}

pub fn run(args: ScatterArgs) -> Result<()> {
    let job = job(&args)?;
    let start = Instant::now();
    let answer = match args.method {
        MethodName::Mie => mie(&args, &job)?,
        MethodName::Debye => debye(&args, &job)?,
        MethodName::Rays => rays(&args, &job)?,
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

/// Radius and wavelength in metres where they are known, and the size parameter.
struct Size {
    radius: Option<f64>,
    wavelength: Option<f64>,
    parameter: f64,
}

/// Rounded by hand to four digits, three numbers still agree.
const ROUNDING: f64 = 5e-4;

/// Any two of radius, wavelength and size parameter say the third; three must agree.
fn size(args: &ScatterArgs) -> Result<Size> {
    let diameter = positive("diameter-mm", args.diameter_mm)?;
    let radius = positive("radius-um", args.radius_um)?.or(diameter.map(|d| 500.0 * d));
    let wavelength = positive("wavelength-nm", args.wavelength_nm)?.map(|nm| nm * 1e-9);
    let parameter = positive("size-parameter", args.size_parameter)?;
    let radius = radius.map(|um| um * 1e-6);
    let of = |radius: f64, wavelength: f64| TAU * radius / wavelength;
    Ok(match (parameter, radius, wavelength) {
        (Some(x), Some(a), Some(w)) if (of(a, w) / x - 1.0).abs() > ROUNDING => {
            return Err(usage(format!(
                "--size-parameter {x} disagrees with a radius of {} µm at {} nm, whose size \
                 parameter is {:.6}: give two of the three",
                to_digits(a * 1e6, 9),
                to_digits(w * 1e9, 9),
                of(a, w)
            )));
        }
        (Some(x), Some(a), None) => Size { radius, wavelength: Some(TAU * a / x), parameter: x },
        (Some(x), None, Some(w)) => Size { radius: Some(x * w / TAU), wavelength, parameter: x },
        (Some(x), ..) => Size { radius, wavelength, parameter: x },
        (None, Some(a), Some(w)) => Size { radius, wavelength, parameter: of(a, w) },
        _ => {
            return Err(usage(
                "the particle's size is missing: give --size-parameter, or --radius-um and \
                 --wavelength-nm"
                    .into(),
            ));
        }
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
        return Err(usage((*message).into()));
    }
    let flags =
        ShapeFlags { shape: args.shape, axis_ratio: args.axis_ratio, model: args.model.as_deref() };
    Ok(flags.check()?)
}

fn job(args: &ScatterArgs) -> Result<Job> {
    check_flags(args)?;
    let size = size(args)?;
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
        None => {
            let wavelength = size.wavelength.ok_or_else(|| {
                usage(
                    "the index of water needs --wavelength-nm (or --radius-um); or give --index"
                        .into(),
                )
            })?;
            Medium::Water { temperature: 293.15 }.index(wavelength)?
        }
    };
    let (orders, diffraction_term) = parse_orders(&args.orders).map_err(usage)?;
    let theta = parse_theta(&args.theta).map_err(usage)?;
    let azimuth = args.azimuth_deg.to_radians();
    let (size_parameter, radius) = (size.parameter, size.radius);
    Ok(Job { size_parameter, radius, index, theta, azimuth, orders, diffraction_term })
}

fn sphere_only(args: &ScatterArgs) -> Result<()> {
    let round = args.shape == ShapeKind::Sphere
        || (args.shape == ShapeKind::Spheroid && args.axis_ratio == Some(1.0));
    if round {
        return Ok(());
    }
    Err(usage("--method mie and debye serve spheres only: use --method rays for this shape".into()))
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
        remainder: None,
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
    // Only a sum from the first order on stands for the whole.
    let all_up_to = list.last().copied().filter(|_| (0..).zip(&list).all(|(k, order)| k == *order));
    let mut terms: Vec<Term> = list.into_iter().map(Term::Order).collect();
    let diffraction_included = auto || job.diffraction_term;
    if diffraction_included {
        terms.push(Term::Diffraction);
    }
    let series = DebyeSeries::new(job.size_parameter, job.index)?;
    let amplitudes = diagonal(series.sum_parallel(&terms, &radians(job)));
    let remainder = all_up_to.map(|last_order| Remainder {
        largest: series.remainder(last_order),
        share: series.missing_share(last_order),
        last_order,
    });
    if let Some(left) = remainder.as_ref().filter(|left| auto && left.share > args.tolerance) {
        eprintln!(
            "note: the sum of Debye terms up to order {} has not converged: what is left out is {:.1e} of \
             the amplitude outside the forward peak; --method mie has all orders",
            left.last_order, left.share
        );
    }
    let q = Sphere::new(job.size_parameter, job.index)?.efficiencies();
    Ok(Answer {
        amplitudes,
        q_ext: Some(q.q_ext),
        q_sca: Some(q.q_sca),
        q_abs: Some(q.q_abs),
        q_back: Some(q.q_back),
        asymmetry: Some(q.asymmetry),
        diffraction_included,
        remainder,
    })
}

fn shape(args: &ScatterArgs, job: &Job) -> Result<Shape> {
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
            let radius = job.radius.ok_or_else(|| {
                usage(
                    "a raindrop's shape depends on its size: give --radius-um, or --wavelength-nm"
                        .into(),
                )
            })?;
            Shape::raindrop(radius, raindrop_model(args.model.as_deref())?, sun)
                .map_err(|e| usage(e.to_string()))?
        }
    })
}

fn rays(args: &ScatterArgs, job: &Job) -> Result<Answer> {
    check_rays(job.index, job.size_parameter, "").map_err(|error| usage(error.to_string()))?;
    if job.diffraction_term {
        return Err(usage("--orders diffraction: a term of --method debye only".into()));
    }
    let shape = shape(args, job)?;
    let diffraction_name = args.diffraction.unwrap_or(DiffractionName::Airy);
    let engine = match diffraction_name {
        DiffractionName::Airy => Engine::Meridians,
        DiffractionName::None | DiffractionName::Gaussian => Engine::Patches,
    };
    let auto = job.orders.is_none();
    let orders = job
        .orders
        .clone()
        .unwrap_or_else(|| (0..=last_order(job.index.re, args.tolerance)).collect());
    let diffraction = auto && diffraction_name != DiffractionName::None;
    let plan =
        Plan::direct(shape, 1.0, engine, orders, diffraction, args.tolerance, args.rays_across);
    let filter = (diffraction_name == DiffractionName::Gaussian)
        .then(|| gaussian_filter::standard_deviation(job.radius.unwrap_or(1e-6)));
    // The backward direction rides along: rays are traced once.
    let asked = radians(job).into_iter().map(|theta| (theta, job.azimuth));
    let directions: Vec<(f64, f64)> = asked.chain([(PI, job.azimuth)]).collect();
    let fates = fates(&plan, job)?;
    let (mut amplitudes, sections) = simulate::scatter_with_sections(
        &plan,
        job.index,
        job.size_parameter,
        &directions,
        fates.absorbed,
        filter,
    )?;
    let shift = phase_shift(job.index, job.size_parameter);
    if engine == Engine::Meridians && shift < DOUBTFUL_PHASE_SHIFT {
        let worth = simulate::worth_of_rays(&plan, job.index, job.size_parameter)?;
        eprintln!(
            "note: the phase shift through the particle, 2x|n - 1| = {shift:.1}, is small for rays \
             (below {DOUBTFUL_PHASE_SHIFT}): intensities from 10 to 170 degrees are {:.0} % off, \
             weighted by intensity, and {:.0} % on average over angles",
            100.0 * worth.weighted,
            100.0 * worth.by_band
        );
    }
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
        remainder: None,
    })
}

/// What becomes of the light on the shadow, by rays.
fn fates(plan: &Plan, job: &Job) -> Result<Fates> {
    const GRID: usize = 64;
    let spokes = if plan.symmetry == Symmetry::Rotational { 4 } else { GRID };
    let last = plan.orders.iter().copied().max().unwrap_or(0);
    let tracer = Tracer::new(&plan.shape, job.index, job.size_parameter, last);
    let fates = energy_by_fate(&tracer, &Wavefront::midpoints(&plan.shape, GRID, spokes));
    if !simulate::adds_up(fates.residual, job.index, last) {
        bail!("energy does not add up: {:e} of the light is unaccounted for", fates.residual);
    }
    Ok(fates)
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
        "remainder": answer.remainder.as_ref().map(|left| left.largest),
        "remainder_share": answer.remainder.as_ref().map(|left| left.share),
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
