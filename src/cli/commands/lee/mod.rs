//! `gonio lee`: the colour of the bow over scattering angle × drop radius.

mod args;
mod picture;

pub use args::LeeArgs;

use crate::cli::args::output::Output;
use crate::cli::args::ranges;
use crate::cli::command_line::command_line;
use crate::cli::failure::{Failure, Result};
use crate::cli::show::{notes, progress};
use args::{LeeMethod, LeeShape};
use gonio::lee::file::{About, save};
use gonio::lee::{Bodies, Diagram, PEAK, Raindrops, Request, column_exposures, columns, srgb};
use gonio::medium::MediumSpec;
use std::path::Path;
use std::time::Instant;

pub fn run(args: LeeArgs) -> Result<()> {
    if args.output.is_none() && args.data.is_none() && !args.json {
        return Err(usage("nothing to do: give -o LEE.png, --data LEE.h5 or --json"));
    }
    let picture = (&args.output, "--output", "a PNG", &["png"][..]);
    for (path, flag, kind, endings) in [picture, (&args.data, "--data", "HDF5", &[])] {
        if let Some(path) = path {
            Output { flag, path, kind, endings }.check_new(args.overwrite)?;
        }
    }
    let request = request(&args)?;
    let start = Instant::now();
    let bodies = bodies(&args)?;
    let bar = progress::bar(request.radii.len(), "radii");
    let diagram = columns(&request, &bodies, || bar.inc(1))?;
    bar.finish_and_clear();
    notes::step(|| format!("{} radii computed", request.radii.len()));
    let seconds = start.elapsed().as_secs_f64();
    let seen = diagram.seen(args.polarisation.into());
    let exposure = column_exposures(&seen, PEAK);
    if let Some(path) = &args.output {
        picture::draw(&args, &request, &seen, &exposure, path)?;
        notes::wrote(path);
    }
    if let Some(path) = &args.data {
        let command_line = &command_line();
        let (illuminant, observer) = (&*args.illuminant, &*args.observer);
        let about = About { command_line, illuminant, observer };
        save(&diagram, about, path, args.overwrite)?;
        notes::wrote(path);
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
    Ok(match (args.shape, args.method) {
        (LeeShape::Sphere, LeeMethod::Auto) => Bodies::Spheres,
        (LeeShape::Sphere, LeeMethod::Airy) => Bodies::Airy,
        (LeeShape::Raindrop, LeeMethod::Airy) => {
            return Err(usage(
                "--method airy: Airy's theory is of spheres; raindrops go by --method auto",
            ));
        }
        (LeeShape::Raindrop, LeeMethod::Auto) => Bodies::Raindrops(Raindrops::new(
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
        radii: ranges::radii(&args.radius_mm, args.linear)?.metres,
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
