//! `gonio rays`: ray paths and deviation of one order in the vertical symmetry plane.

mod radial;

use crate::cli::args::medium::MediumFlags;
use crate::cli::args::output::Output;
use crate::cli::args::particle::{Index, ShapeFlags, ShapeKind, parse_index, raindrop_model};
use crate::cli::failure::{Failure, Result};
use crate::cli::show::plot::write_whole;
use clap::Args;
use gonio::medium::radial::Body;
use gonio::medium::wavelength_of_ghz;
use gonio::render::{DrawnRay, draw_ray_paths};
use gonio::shape::Shape;
use gonio::trace::{PlaneRay, Rainbow, SymmetryPlane, Tracer};
use serde_json::json;
use std::path::PathBuf;

/// Ray paths and deviation of one order in the vertical symmetry plane
#[derive(Args)]
#[command(
    after_help = "Example: gonio rays --shape raindrop --radius-mm 1 --sun-elevation-deg 20 \
--order 2 --count 15 -o rays.svg"
)]
pub struct RaysArgs {
    #[arg(long, value_enum, default_value = "sphere")]
    shape: ShapeKind,
    /// Radius of the sphere of equal volume, millimetres: it gives a raindrop its shape
    #[arg(long, default_value_t = 0.5)]
    radius_mm: f64,
    /// Raindrop model (default: beard-chuang-1987)
    #[arg(long)]
    model: Option<String>,
    /// Vertical over horizontal diameter of a spheroid
    #[arg(long)]
    axis_ratio: Option<f64>,
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    sun_elevation_deg: f64,
    /// Index n or n+k; without it, water at --wavelength-nm
    #[arg(long, value_parser = parse_index, allow_hyphen_values = true)]
    index: Option<Index>,
    #[command(flatten)]
    made_of: MediumFlags,
    /// Wavelength in vacuum of the medium's index (default 589.3)
    #[arg(long, conflicts_with = "index")]
    wavelength_nm: Option<f64>,
    /// Frequency in place of the wavelength
    #[arg(long, value_name = "GHZ", conflicts_with_all = ["index", "wavelength_nm"])]
    frequency_ghz: Option<f64>,
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

/// Metres.
fn wavelength(args: &RaysArgs) -> Result<f64> {
    match args.frequency_ghz {
        Some(ghz) if ghz > 0.0 && ghz.is_finite() => Ok(wavelength_of_ghz(ghz)),
        Some(ghz) => {
            Err(Failure::usage(format!("--frequency-ghz {ghz}: a positive number is accepted")))
        }
        None => Ok(args.wavelength_nm.unwrap_or(589.3) * 1e-9),
    }
}

pub fn run(args: RaysArgs) -> Result<()> {
    if let Some(path) = &args.output {
        Output { flag: "--output", path, kind: "an SVG", endings: &["svg"] }.check()?;
    }
    let shape = shape(&args)?;
    let medium = args.made_of.medium(args.index)?;
    if !(2..=MOST_RAYS).contains(&args.count) {
        let message = format!("--count {}: 2 to {MOST_RAYS} is accepted", args.count);
        return Err(Failure::usage(message));
    }
    if args.order > HIGHEST_ORDER {
        let message = format!("--order {}: 0 to {HIGHEST_ORDER} is accepted", args.order);
        return Err(Failure::usage(message));
    }
    let seen = medium.seen_outside(wavelength(&args)?)?;
    if let Some(body) = medium.body(seen, args.radius_mm * 1e-3)? {
        return in_radial(&args, &shape, &body);
    }
    let tracer = Tracer::new(&shape, medium.index(seen)?, 1.0, args.order);
    let plane = SymmetryPlane::new(&shape, &tracer, args.order);
    let (rays, rainbows) = (plane.fan(args.count), plane.rainbows());
    if let Some(path) = &args.output {
        let drawn: Vec<DrawnRay> = rays.iter().map(drawn).collect();
        write_whole(path, draw_ray_paths(&shape, args.order, &drawn, &rainbows).as_bytes())?;
    }
    if args.json {
        println!("{}", to_json(&rays, &rainbows));
    } else {
        for bow in &rainbows {
            let degrees = bow.deviation.to_degrees();
            println!(
                "rainbow at {degrees:.4}° ({} branch), impact {:.6}",
                bow.branch(),
                bow.impact
            );
        }
        println!("# impact  deviation_deg  optical_path  focal_lines");
        for ray in &rays {
            let (degrees, exit) = (ray.exit.scattering_angle().to_degrees(), &ray.exit);
            println!("{:9.6} {degrees:10.5} {:12.8} {}", ray.impact, exit.path, exit.focal_lines);
        }
    }
    Ok(())
}

fn drawn(ray: &PlaneRay) -> DrawnRay {
    let direction = ray.exit.direction;
    DrawnRay { points: ray.points.clone(), leaves: Some([direction.x, direction.z]) }
}

/// Rays of a sphere whose index varies along the radius.
fn in_radial(args: &RaysArgs, shape: &Shape, body: &Body) -> Result<()> {
    if args.shape != ShapeKind::Sphere {
        return Err(Failure::usage("--medium: layers, profiles and films are for --shape sphere"));
    }
    if !body.layers.is_empty() {
        return Err(Failure::usage(
            "--medium, --coating: rays follow smooth profiles; at the interfaces of layers and films they \
             would split, and gonio scatter --method mie solves those",
        ));
    }
    let traced = radial::trace(body, args.order, args.count);
    if let Some(path) = &args.output {
        let svg = draw_ray_paths(shape, args.order, &traced.drawn(), &traced.rainbows);
        write_whole(path, svg.as_bytes())?;
    }
    if args.json {
        println!("{}", traced.json());
    } else {
        traced.print();
    }
    Ok(())
}

fn shape(args: &RaysArgs) -> Result<Shape> {
    let usage = |message: String| Failure::usage(message);
    if args.sun_elevation_deg.is_nan() || args.sun_elevation_deg.abs() > 90.0 {
        let given = args.sun_elevation_deg;
        return Err(usage(format!("--sun-elevation-deg {given}: -90 to 90 is accepted")));
    }
    if !(args.radius_mm.is_finite() && args.radius_mm > 0.0) {
        return Err(usage(format!("--radius-mm {}: a number above 0 is accepted", args.radius_mm)));
    }
    let (shape, axis_ratio, model) = (args.shape, args.axis_ratio, args.model.as_deref());
    ShapeFlags { shape, axis_ratio, model }.check()?;
    let sun = args.sun_elevation_deg.to_radians();
    Ok(match args.shape {
        ShapeKind::Sphere => Shape::sphere(),
        ShapeKind::Spheroid => {
            let ratio = args.axis_ratio.ok_or_else(|| usage("--axis-ratio is missing".into()))?;
            Shape::spheroid(ratio, sun)?
        }
        ShapeKind::Raindrop => {
            Shape::raindrop(args.radius_mm * 1e-3, raindrop_model(args.model.as_deref())?, sun)?
        }
    })
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
            "branch": b.branch(),
        })
    };
    json!({
        "rays": rays.iter().map(ray).collect::<Vec<_>>(),
        "rainbows": rainbows.iter().map(bow).collect::<Vec<_>>(),
    })
}
