//! `gonio radar`: what a radar measures of rain, or of single drops, by their T-matrices.

mod args;
mod report;

use crate::cli::args::output::Output;
use crate::cli::args::particle::Index;
use crate::cli::args::ranges::{positive_list, positive_range};
use crate::cli::failure::{Failure, Result};
use crate::cli::show::{plot, progress};
pub use args::RadarArgs;
use args::{RadarShape, WaterModel};
use gonio::medium::{MicrowaveWater, wavelength_of_ghz};
use gonio::radar::{DropShape, DropSpectrum, Drops, Observation, Water, band, number};
use gonio::scene::Named;
use gonio::shape::RaindropModel;
use std::time::Instant;

pub fn run(args: RadarArgs) -> Result<()> {
    if let Some(path) = &args.output {
        Output { flag: "--output", path, kind: "", endings: &[] }.check()?;
    }
    let wavelengths = wavelengths(&args)?;
    let water = water(&args)?;
    let shape = shape(&args)?;
    let asked = Observation {
        wavelengths,
        water,
        drops: drops(&args, shape)?,
        shape,
        canting: number("canting_deg", args.canting_deg)?.to_radians(),
        elevation: number("elevation_deg", args.elevation_deg)?.to_radians(),
        dielectric_factor: number("k_squared", args.k_squared)?,
        tolerance: number("tolerance", args.tolerance)?,
    };
    let start = Instant::now();
    let bar = progress::bar(asked.count(), "rows");
    let rows = asked.rows(|| bar.inc(1))?;
    bar.finish_and_clear();
    let seconds = start.elapsed().as_secs_f64();
    let text =
        if args.json { report::as_json(&args, &rows, seconds) } else { report::as_csv(&rows) };
    match &args.output {
        Some(path) => plot::write_whole(path, text.as_bytes()),
        None => {
            print!("{text}");
            Ok(())
        }
    }
}

fn usage(message: impl Into<String>) -> Failure {
    Failure::usage(message)
}

/// Wavelengths, metres.
fn wavelengths(args: &RadarArgs) -> Result<Vec<f64>> {
    if let Some(list) = &args.wavelength_mm {
        return Ok(positive_range("--wavelength-mm", list)?.iter().map(|mm| mm * 1e-3).collect());
    }
    if let Some(list) = &args.frequency_ghz {
        return Ok(positive_range("--frequency-ghz", list)?
            .iter()
            .copied()
            .map(wavelength_of_ghz)
            .collect());
    }
    let Some(list) = &args.band else {
        return Err(usage(
            "the wavelength is missing: give --band, --frequency-ghz or --wavelength-mm",
        ));
    };
    Ok(list.split(',').map(band).collect::<Result<_, _>>()?)
}

fn water(args: &RadarArgs) -> Result<Water> {
    if let Some(Index(index)) = args.index {
        return Ok(Water::Index(index));
    }
    let model = match args.water {
        WaterModel::Liebe => MicrowaveWater::Liebe1991,
        WaterModel::Turner => MicrowaveWater::Turner2016,
    };
    let celsius = |word: &str| {
        let value = word.trim().parse::<f64>().ok().filter(|value| value.is_finite());
        value.ok_or_else(|| {
            usage(format!("--temperature-c {word:?}: a comma list of temperatures is accepted"))
        })
    };
    Ok(Water::Celsius(model, args.temperature_c.split(',').map(celsius).collect::<Result<_>>()?))
}

fn shape(args: &RadarArgs) -> Result<DropShape> {
    match (&args.axis_ratio, &args.model) {
        (Some(_), _) if args.shape != RadarShape::Spheroid => {
            return Err(usage("--axis-ratio: only --shape spheroid has an axis ratio"));
        }
        (_, Some(_)) if args.shape != RadarShape::Raindrop => {
            return Err(usage("--model: only --shape raindrop has a shape model"));
        }
        _ => {}
    }
    Ok(match args.shape {
        RadarShape::Sphere => DropShape::Sphere,
        RadarShape::Raindrop => {
            let name = args.model.as_deref().unwrap_or("beard-chuang-1987");
            let model = RaindropModel::from_name(name);
            DropShape::Raindrop(model.map_err(|error| usage(format!("--model: {error}")))?)
        }
        RadarShape::Spheroid => {
            DropShape::spheroid(args.axis_ratio.as_deref().unwrap_or("thurai-2007"))?
        }
    })
}

fn drops(args: &RadarArgs, shape: DropShape) -> Result<Drops> {
    if let Some(list) = &args.diameter_mm {
        return Ok(Drops::Each {
            diameters: positive_range("--diameter-mm", list)?.iter().map(|mm| mm * 1e-3).collect(),
            number_per_m3: number("number_per_m3", args.number_per_m3.unwrap_or(1.0))?,
        });
    }
    let spectrum = if let Some(rate) = args.marshall_palmer_mm_h {
        DropSpectrum::marshall_palmer(number("marshall_palmer_mm_h", rate)?)
    } else if let Some(list) = &args.exponential {
        let [intercept, slope] = positive_list("--exponential", list)?;
        DropSpectrum::Exponential { intercept: intercept * 1e3, slope: slope * 1e3 }
    } else if let Some(list) = &args.normalised_gamma {
        let (first, mu) = list.rsplit_once(',').unwrap_or((list, ""));
        let [intercept, median] = positive_list("--normalised-gamma", first)?;
        let shape = mu.trim().parse::<f64>().map_err(|_| {
            usage(format!("--normalised-gamma {list}: N_w, D0 in mm and a shape μ are accepted"))
        })?;
        DropSpectrum::NormalisedGamma {
            intercept: intercept * 1e3,
            median_volume_diameter: median * 1e-3,
            shape: number("mu", shape)?,
        }
    } else {
        return Err(usage(
            "the drops are missing: give --diameter-mm, --marshall-palmer-mm-h, --exponential or \
             --normalised-gamma",
        ));
    };
    if args.number_per_m3.is_some() {
        return Err(usage("--number-per-m3 with a spectrum, which has its own numbers of drops"));
    }
    Ok(Drops::spectrum(spectrum, args.from_diameter_mm, args.to_diameter_mm, shape)?)
}
