//! `gonio info`: what is in a table.

use crate::cli::failure::{Failure, Result};
use clap::Args;
use gonio::hdf5::{AxisValues, SweepReader, TableError, TableReader, decimal_bytes};
use gonio::math::digits::to_digits;
use gonio::phase_table::{BulkOptics, ERROR_BANDS, TableHeader, error_theta};
use gonio::scene::Named;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Describe a table or a merged sweep
#[derive(Args)]
#[command(after_help = "Example: gonio info raindrop.h5 --json")]
pub struct InfoArgs {
    /// Table or sweep
    #[arg(value_name = "FILE.h5")]
    file: PathBuf,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    /// Print the scene that made the table, as TOML, and nothing else
    #[arg(long, conflicts_with = "json")]
    scene: bool,
}

pub fn run(args: InfoArgs) -> Result<()> {
    let description = match TableReader::open(&args.file) {
        Ok(reader) if args.scene => {
            print!("{}", reader.header().scene_toml);
            return Ok(());
        }
        Ok(reader) => describe(&args.file, &reader)?,
        Err(TableError::Foreign { .. }) if SweepReader::open(&args.file).is_ok() => {
            describe_sweep(&args.file)?
        }
        Err(TableError::Io { source, .. }) if source.kind() == std::io::ErrorKind::NotFound => {
            return Err(Failure::usage(format!("{}: no such file", args.file.display())));
        }
        Err(error) => return Err(error.into()),
    };
    if args.json {
        println!("{}", serde_json::to_string(&description)?);
    } else {
        print_object(&description, 0);
    }
    Ok(())
}

fn common(path: &Path, header: &TableHeader) -> Value {
    let degrees = |angles: &[f64]| {
        let end = |angle: Option<&f64>| angle.map(|angle| tidy(angle.to_degrees()));
        json!({ "count": angles.len(), "from": end(angles.first()), "to": end(angles.last()) })
    };
    let nanometres: Vec<f64> = header.axes.wavelength.iter().map(|w| tidy(w * 1e9)).collect();
    json!({
        "file": path.display().to_string(),
        "bytes": std::fs::metadata(path).map_or(0, |data| data.len()),
        "quantity": header.quantity.name(),
        "method": header.method,
        "shape": header.shape,
        "radius_um": number(header.radius * 1e6),
        "sun_elevation_deg": number(header.sun_elevation.to_degrees()),
        "particles": header.bodies.as_ref().map(|bodies| json!({
            "effective_radius_um": number(bodies.effective_radius * 1e6),
            "effective_variance": number(bodies.effective_variance),
            "mean_volume_m3": number(bodies.mean_volume),
            "mean_projected_area_m2": number(bodies.mean_area),
            "density_kg_m3": bodies.density.map(number),
            "density_source": bodies.density.map(|_| &bodies.density_source),
            "mean_cubed_radius_um3": number(bodies.mean_cubed_radius() * 1e18),
            "number_per_m3": bodies.number_density.map(number),
            "mass_content_g_m3": bodies.mass_content().map(|content| number(content * 1e3)),
            "rain_rate_mm_h": bodies.rain_rate.map(|rate| number(rate * 3.6e6)),
        })),
        "averaged_over": header.averaging.words(),
        "tolerance_asked": number(header.tolerance),
        "rotational_symmetry": header.rotational_symmetry,
        "forward_peak": format!("{:?}", header.forward_peak),
        "wavelength_nm": nanometres,
        "theta_deg": degrees(&header.axes.theta),
        "azimuth_deg": degrees(&header.axes.phi),
    })
}

fn describe(path: &Path, reader: &TableReader) -> Result<Value> {
    let header = reader.header();
    let mut description = common(path, header);
    let mut slabs = Vec::new();
    for index in 0..header.axes.wavelength.len() {
        let slab = reader.slab(index)?;
        let face = slab.values.index_axis(ndarray::Axis(0), 0);
        let most = face.iter().copied().fold(f32::NEG_INFINITY, f32::max);
        let least = face.iter().copied().fold(f32::INFINITY, f32::min);
        let by_direction: Vec<Value> = slab
            .error_by_direction
            .iter()
            .map(|&error| if error.is_finite() { json!(to_digits(error, 3)) } else { Value::Null })
            .collect();
        let optics = BulkOptics::of(header, &slab);
        slabs.push(json!({
            "wavelength_nm": tidy(slab.wavelength * 1e9),
            "index": [slab.index.re, slab.index.im],
            "scattering_cross_section_m2": slab.scattering_cross_section,
            "extinction_cross_section_m2": slab.extinction_cross_section,
            "absorption_cross_section_m2": slab.absorption_cross_section,
            "extinction_straight_ahead_m2": slab.forward_extinction,
            "asymmetry": slab.asymmetry,
            "single_scattering_albedo": number(optics.albedo),
            "backscatter_m2_sr": optics.backscatter.map(number),
            "backward_depolarisation": optics.depolarisation.map(number),
            "extinction_per_m": optics.extinction_per_length.map(number),
            "scattering_per_m": optics.scattering_per_length.map(number),
            "backscatter_per_m_sr": optics.backscatter_per_length.map(number),
            "extinction_m2_kg": optics.extinction_per_mass.map(number),
            "sum": slab.sum(&header.axes),
            "sum_before_peak": slab.sum_before_peak,
            "smallest_per_sr": least,
            "largest_per_sr": most,
            "error_estimate": number(slab.error_estimate),
            "error_estimate_by_band": number(slab.error_by_band),
            "tolerance_met": slab.tolerance_met,
            "error_estimate_by_direction": by_direction,
            "left_out_share": slab.left_out,
            "samples_beyond_two_rays": slab
                .caustic_order
                .as_ref()
                .map(|mask| mask.iter().filter(|order| **order > 0).count()),
            "energy": slab.energy,
        }));
    }
    let bands: Vec<f64> = (0..ERROR_BANDS).map(|k| tidy(error_theta(k).to_degrees())).collect();
    description["error_theta_deg"] = json!(bands);
    description["wavelengths"] = Value::Array(slabs);
    description["methods"] = match reader.attribute("methods")? {
        Some(text) => serde_json::from_str(&text)?,
        None => Value::Null,
    };
    for name in ["program_version", "git_hash", "date_created", "command_line", "license"] {
        description[name] = json!(reader.attribute(name)?);
    }
    description["bit_round"] = json!(reader.bit_round()?);
    Ok(description)
}

fn describe_sweep(path: &Path) -> Result<Value> {
    let reader = SweepReader::open(path)?;
    let mut description = common(path, reader.header());
    let axes = reader.axes().iter().flat_map(|axis| &axis.coordinates);
    let axes = axes.map(|coordinate| match &coordinate.values {
        AxisValues::Numbers(values) => {
            json!({ "name": coordinate.name, "units": coordinate.units, "values": values })
        }
        AxisValues::Texts(values) => json!({ "name": coordinate.name, "values": values }),
    });
    description["sweep"] = Value::Array(axes.collect());
    let present = reader.present()?;
    description["tables"] = json!(present.len());
    description["tables_present"] = json!(present.iter().filter(|present| **present).count());
    Ok(description)
}

/// A number that JSON can hold.
fn number(value: f64) -> Value {
    if value.is_finite() { json!(tidy(value)) } else { Value::Null }
}

fn tidy(value: f64) -> f64 {
    to_digits(value, 10)
}

/// `key: value` lines for people; lists of objects as blocks.
fn print_object(object: &Value, indent: usize) {
    let Value::Object(entries) = object else { return };
    let space = " ".repeat(indent);
    for (key, value) in entries {
        match value {
            Value::Null => {}
            Value::Array(items) if items.iter().any(Value::is_object) => {
                println!("{space}{key}:");
                for item in items {
                    println!("{space}  -");
                    print_object(item, indent + 4);
                }
            }
            Value::Object(_) => {
                println!("{space}{key}:");
                print_object(value, indent + 2);
            }
            Value::String(text) => println!("{space}{key}: {text}"),
            Value::Number(bytes) if key == "bytes" => {
                println!("{space}size: {}", decimal_bytes(bytes.as_u64().unwrap_or(0)));
            }
            other => println!("{space}{key}: {other}"),
        }
    }
}
