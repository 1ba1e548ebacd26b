//! `gonio rays`: ray paths and deviation of one order in the vertical symmetry plane.

mod drawing;
mod plane;
mod radial;

use super::UsageError;
use super::plot::write_whole;
use super::scatter_input::{Index, ShapeKind, parse_index, raindrop_model};
use super::scene_flags::parse_medium;
use anyhow::Result;
use clap::Args;
use gonio::medium::radial::Body;
use gonio::medium::{Medium, MediumSpec};
use gonio::shape::Shape;
use gonio::trace::Tracer;
use plane::{PlaneRay, Rainbow, rainbows, trace};
use serde_json::json;
use std::path::{Path, PathBuf};

/// Ray paths and deviation of one order in the vertical symmetry plane
#[derive(Args)]
#[command(
    after_help = "Example: gonio rays --shape raindrop --radius-mm 1 --sun-elevation-deg 20 \
--order 2 --count 15 -o rays.svg"
)]
pub struct RaysArgs {
    #[arg(long, value_enum, default_value = "sphere")]
    shape: ShapeKind,
    /// Radius of the sphere of equal volume, millimetres
    #[arg(long, default_value_t = 0.5)]
    radius_mm: f64,
    /// Raindrop model
    #[arg(long, default_value = "beard-chuang-1987")]
    model: String,
    /// Vertical over horizontal diameter of a spheroid
    #[arg(long)]
    axis_ratio: Option<f64>,
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    sun_elevation_deg: f64,
    /// Index n or n+k; without it, water at --wavelength-nm
    #[arg(long, value_parser = parse_index, allow_hyphen_values = true)]
    index: Option<Index>,
    /// Medium in place of an index: a name, a file, or a table as in a scene file; one that varies
    /// along the radius is for spheres
    #[arg(long, value_name = "TABLE", value_parser = parse_medium, conflicts_with = "index")]
    medium: Option<MediumSpec>,
    /// Wavelength in vacuum, nanometres
    #[arg(long, default_value_t = 589.3)]
    wavelength_nm: f64,
    /// Number of chords inside the drop
    #[arg(long, default_value_t = 2)]
    order: u32,
    /// Number of rays, evenly spaced from the lower to the upper rim
    #[arg(long, default_value_t = 41)]
    count: usize,
    #[arg(long)]
    json: bool,
    /// Drawing of the paths
    #[arg(short, long, value_name = "RAYS.svg")]
    output: Option<PathBuf>,
}

/// Most rays accepted.
const MOST_RAYS: usize = 1_000_000;
const HIGHEST_ORDER: u32 = 200;

pub fn run(args: RaysArgs) -> Result<()> {
    let shape = shape(&args)?;
    let medium = match (&args.index, &args.medium) {
        (Some(Index(index)), _) => Medium::Constant(*index),
        (None, Some(spec)) => spec.resolve(Path::new("."))?,
        (None, None) => Medium::Water { temperature: 293.15 },
    };
    if !(2..=MOST_RAYS).contains(&args.count) {
        let message = format!("--count {}: 2 to {MOST_RAYS} is accepted", args.count);
        return Err(UsageError(message).into());
    }
    if args.order > HIGHEST_ORDER {
        let message = format!("--order {}: 0 to {HIGHEST_ORDER} is accepted", args.order);
        return Err(UsageError(message).into());
    }
    if let Some(body) = medium.body(args.wavelength_nm * 1e-9, args.radius_mm * 1e-3)? {
        return in_radial(&args, &shape, &body);
    }
    let index = medium.index(args.wavelength_nm * 1e-9)?;
    let tracer = Tracer::new(&shape, index, 1.0, args.order);
    let rim = |azimuth: f64| shape.silhouette().radius(azimuth);
    let (upper, lower) = (rim(0.0), rim(std::f64::consts::PI));
    let impact = |i: usize| {
        // the outermost rays miss the rim by a millionth
        let share = i as f64 / (args.count - 1) as f64;
        (1.0 - 1e-6) * (-lower + share * (upper + lower))
    };
    let rays: Vec<PlaneRay> =
        (0..args.count).filter_map(|i| trace(&tracer, args.order, impact(i))).collect();
    let rainbows = rainbows(&tracer, args.order, lower, upper);
    if let Some(path) = &args.output {
        write_whole(path, drawing::draw(&shape, args.order, &rays, &rainbows).as_bytes())?;
    }
    if args.json {
        println!("{}", to_json(&rays, &rainbows));
    } else {
        for bow in &rainbows {
            let degrees = bow.deviation.to_degrees();
            println!("rainbow at {degrees:.4}° ({} branch), impact {:.6}", branch(bow), bow.impact);
        }
        println!("# impact  deviation_deg  optical_path  focal_lines");
        for ray in &rays {
            let (degrees, exit) = (ray.exit.scattering_angle().to_degrees(), &ray.exit);
            println!("{:9.6} {degrees:10.5} {:12.8} {}", ray.impact, exit.path, exit.focal_lines);
        }
    }
    Ok(())
}

/// Rays of a sphere whose index varies along the radius.
fn in_radial(args: &RaysArgs, shape: &Shape, body: &Body) -> Result<()> {
    let usage = |message: &str| Err(UsageError(message.into()).into());
    if !shape.is_sphere() {
        return usage("--medium: layers and profiles are for --shape sphere");
    }
    if !body.layers.is_empty() {
        return usage(
            "--medium: rays follow smooth profiles; at the interfaces of layers they would split, and \
             gonio scatter --method mie solves those",
        );
    }
    if args.output.is_some() {
        return usage("--output: drawings are of straight chords; leave it out for a profile");
    }
    let traced = radial::trace(body, args.order, args.count);
    if args.json {
        println!("{}", traced.json());
    } else {
        traced.print();
    }
    Ok(())
}

fn shape(args: &RaysArgs) -> Result<Shape> {
    let usage = |message: String| anyhow::Error::from(UsageError(message));
    if args.sun_elevation_deg.is_nan() || args.sun_elevation_deg.abs() > 90.0 {
        let given = args.sun_elevation_deg;
        return Err(usage(format!("--sun-elevation-deg {given}: -90 to 90 is accepted")));
    }
    if !(args.radius_mm.is_finite() && args.radius_mm > 0.0) {
        return Err(usage(format!("--radius-mm {}: a number above 0 is accepted", args.radius_mm)));
    }
    let sun = args.sun_elevation_deg.to_radians();
    Ok(match args.shape {
        ShapeKind::Sphere => Shape::sphere(),
        ShapeKind::Spheroid => {
            let ratio = args.axis_ratio.ok_or_else(|| usage("--axis-ratio is missing".into()))?;
            Shape::spheroid(ratio, sun)?
        }
        ShapeKind::Raindrop => {
            Shape::raindrop(args.radius_mm * 1e-3, raindrop_model(&args.model)?, sun)?
        }
    })
}

fn branch(bow: &Rainbow) -> &'static str {
    if bow.impact >= 0.0 { "upper" } else { "lower" }
}

fn to_json(rays: &[PlaneRay], rainbows: &[Rainbow]) -> serde_json::Value {
    let ray = |r: &PlaneRay| {
        json!({
            "impact": r.impact,
            "deviation_deg": r.exit.scattering_angle().to_degrees(),
            "optical_path": r.exit.path,
            "focal_lines": r.exit.focal_lines,
        })
    };
    let bow = |b: &Rainbow| {
        json!({
            "impact": b.impact,
            "deviation_deg": b.deviation.to_degrees(),
            "branch": branch(b),
        })
    };
    json!({
        "rays": rays.iter().map(ray).collect::<Vec<_>>(),
        "rainbows": rainbows.iter().map(bow).collect::<Vec<_>>(),
    })
}
