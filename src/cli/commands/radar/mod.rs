//! `gonio radar`: what a radar measures of rain, or of single drops, by their T-matrices.

mod args;
mod report;

use crate::cli::args::particle::Index;
use crate::cli::args::ranges::{positive_list, positive_range};
use crate::cli::failure::{Failure, Result};
use crate::cli::show::plot;
pub use args::RadarArgs;
use args::{RadarShape, Row, WaterModel};
use gonio::medium::{MicrowaveWater, wavelength_of_ghz};
use gonio::radar::{AxisRatioLaw, BANDS, Beam, DropShape, DropSpectrum, Rain};
use gonio::scene::Named;
use gonio::shape::RaindropModel;
use num_complex::Complex64;
use std::time::Instant;

/// What drops there are.
enum Drops {
    Single(Vec<f64>),
    Spectrum(DropSpectrum, (f64, f64)),
}

pub fn run(args: RadarArgs) -> Result<()> {
    let wavelengths = wavelengths(&args)?;
    let waters = waters(&args)?;
    let shape = shape(&args)?;
    let drops = drops(&args, shape)?;
    check(&args)?;
    let number_per_m3 = args.number_per_m3.unwrap_or(1.0);
    let start = Instant::now();
    let mut rows = Vec::new();
    for &wavelength in &wavelengths {
        for &water in &waters {
            let (index, temperature_c) = match water {
                Water::Index(index) => (index, None),
                Water::Temperature(celsius) => {
                    let model = match args.water {
                        WaterModel::Liebe => MicrowaveWater::Liebe1991,
                        WaterModel::Turner => MicrowaveWater::Turner2016,
                    };
                    (model.index(wavelength, celsius + 273.15)?, Some(celsius))
                }
            };
            let rain = Rain {
                shape,
                index,
                canting: args.canting_deg.to_radians(),
                tolerance: args.tolerance,
            };
            let beam = Beam {
                wavelength,
                elevation: args.elevation_deg.to_radians(),
                dielectric_factor: args.k_squared,
            };
            let row = |diameter_mm, seen| Row {
                frequency_ghz: wavelength_of_ghz(1.0) / wavelength,
                temperature_c,
                index,
                diameter_mm,
                seen,
            };
            match &drops {
                Drops::Single(diameters) => {
                    for &d in diameters {
                        let seen = rain.measure(&beam, &[(d * 1e-3, number_per_m3)])?;
                        rows.push(row(Some(d), seen));
                    }
                }
                Drops::Spectrum(spectrum, range) => {
                    rows.push(row(None, rain.measure_spectrum(&beam, spectrum, *range)?));
                }
            }
        }
    }
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
    let band = |word: &str| {
        let known = BANDS.iter().find(|(name, _)| name.eq_ignore_ascii_case(word.trim()));
        known.map(|(_, ghz)| wavelength_of_ghz(*ghz)).ok_or_else(|| {
            let names: Vec<&str> = BANDS.iter().map(|(name, _)| *name).collect();
            usage(format!("--band {word}: {} are accepted", names.join(", ")))
        })
    };
    list.split(',').map(band).collect()
}

#[derive(Clone, Copy)]
enum Water {
    Index(Complex64),
    Temperature(f64),
}

fn waters(args: &RadarArgs) -> Result<Vec<Water>> {
    if let Some(Index(index)) = args.index {
        return Ok(vec![Water::Index(index)]);
    }
    let celsius = |word: &str| {
        let value = word.trim().parse::<f64>().ok().filter(|value| value.is_finite());
        value.map(Water::Temperature).ok_or_else(|| {
            usage(format!("--temperature-c {word:?}: a comma list of temperatures is accepted"))
        })
    };
    args.temperature_c.split(',').map(celsius).collect()
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
            let word = args.axis_ratio.as_deref().unwrap_or("thurai-2007");
            let law = AxisRatioLaw::NAMES.iter().find(|(name, _)| *name == word);
            match (word.parse::<f64>(), law) {
                (Ok(ratio), _) => {
                    let known = DropShape::Spheroid(ratio);
                    known.at(1e-3).map_err(|error| usage(format!("--axis-ratio: {error}")))?;
                    known
                }
                (_, Some((_, law))) => DropShape::SpheroidBy(*law),
                _ => {
                    let names: Vec<&str> =
                        AxisRatioLaw::NAMES.iter().map(|(name, _)| *name).collect();
                    let names = names.join(", ");
                    return Err(usage(format!(
                        "--axis-ratio {word}: a number, {names} are accepted"
                    )));
                }
            }
        }
    })
}

/// Where spectra begin, diameter in mm.
const SMALLEST_MM: f64 = 0.05;

fn drops(args: &RadarArgs, shape: DropShape) -> Result<Drops> {
    if let Some(list) = &args.diameter_mm {
        return Ok(Drops::Single(positive_range("--diameter-mm", list)?));
    }
    let spectrum = if let Some(rate) = args.marshall_palmer_mm_h {
        if !(1e-3..=1e3).contains(&rate) {
            let message = format!("--marshall-palmer-mm-h {rate}: 1e-3 to 1000 mm/h is accepted");
            return Err(usage(message));
        }
        DropSpectrum::marshall_palmer(rate)
    } else if let Some(list) = &args.exponential {
        let [intercept, slope] = positive_list("--exponential", list)?;
        DropSpectrum::Exponential { intercept: intercept * 1e3, slope: slope * 1e3 }
    } else if let Some(list) = &args.normalised_gamma {
        let (first, mu) = list.rsplit_once(',').unwrap_or((list, ""));
        let [intercept, median] = positive_list("--normalised-gamma", first)?;
        let shape = mu.trim().parse::<f64>().ok().filter(|mu| (-3.0..=30.0).contains(mu));
        let shape = shape.ok_or_else(|| {
            usage(format!(
                "--normalised-gamma {list}: N_w, D0 in mm and a shape μ of -3 to 30 are accepted"
            ))
        })?;
        let median_volume_diameter = median * 1e-3;
        DropSpectrum::NormalisedGamma { intercept: intercept * 1e3, median_volume_diameter, shape }
    } else {
        return Err(usage(
            "the drops are missing: give --diameter-mm, --marshall-palmer-mm-h, --exponential or \
             --normalised-gamma",
        ));
    };
    if args.number_per_m3.is_some() {
        return Err(usage("--number-per-m3 with a spectrum, which has its own numbers of drops"));
    }
    let from = args.from_diameter_mm.unwrap_or(SMALLEST_MM);
    let to = args.to_diameter_mm.unwrap_or(shape.largest() * 1e3);
    if !(from >= 0.0 && to > from && to <= 20.0) {
        return Err(usage(format!(
            "--from-diameter-mm {from} --to-diameter-mm {to}: two ascending diameters of 0 to 20 mm are accepted"
        )));
    }
    Ok(Drops::Spectrum(spectrum, (from * 1e-3, to * 1e-3)))
}

fn check(args: &RadarArgs) -> Result<()> {
    for (name, value, (low, high)) in [
        ("canting-deg", args.canting_deg, (0.0, 90.0)),
        ("elevation-deg", args.elevation_deg, (-90.0, 90.0)),
        ("k-squared", args.k_squared, (1e-3, 1.0)),
        ("tolerance", args.tolerance, (1e-8, 0.5)),
        ("number-per-m3", args.number_per_m3.unwrap_or(1.0), (1e-12, 1e12)),
    ] {
        if !(low..=high).contains(&value) {
            return Err(usage(format!("--{name} {value}: {low} to {high} is accepted")));
        }
    }
    Ok(())
}
