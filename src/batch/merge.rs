//! All shards of a plan in one file, in the order of the plan.

use super::plan::{BatchPlan, PlannedTable};
use super::range::tidy;
use super::shard::ShardStatus;
use super::{BatchError, invalid};
use crate::hdf5::{
    AxisValues, SweepAxis, SweepCoordinate, SweepWriter, TableError, TableReader, WriteOptions,
};
use crate::phase_table::{Slab, TableHeader};
use ndarray::{Array2, Array3};
use std::path::Path;

/// Merge the shards in `folder` into `output`. The bytes of the result depend on the tables alone,
/// not on the order in which they were computed.
///
/// # Errors
/// When a table is missing (unless `allow_missing`), tables do not fit together, or the file cannot
/// be written.
pub fn merge(
    plan: &BatchPlan,
    folder: &Path,
    output: &Path,
    allow_missing: bool,
    overwrite: bool,
) -> Result<(), BatchError> {
    let there: Vec<&PlannedTable> =
        plan.tables.iter().filter(|table| table.status(folder) == ShardStatus::Done).collect();
    let missing = plan.tables.len() - there.len();
    if there.is_empty() || (missing > 0 && !allow_missing) {
        let absent = |table: &&PlannedTable| !there.iter().any(|other| other.id == table.id);
        let first = plan.tables.iter().find(absent).map_or(String::new(), |table| table.id.clone());
        return Err(BatchError::Missing { missing, total: plan.tables.len(), first });
    }

    let (header, bit_round) = common_header(&there, folder)?;
    let axes = sweep_axes(plan)?;
    let options = WriteOptions {
        bit_round,
        overwrite,
        dated: false,
        attributes: vec![("plan_digest".into(), plan.digest.clone())],
        ..WriteOptions::default()
    };
    let mut writer = SweepWriter::create(output, &header, &axes, &options)?;
    for table in there {
        let reader = TableReader::open(&table.file(folder))?;
        writer.describe(&table.position, reader.header())?;
        let rounding = reader.rounding()?;
        for index in 0..header.axes.wavelength.len() {
            let slab = reader.slab(index)?;
            slab.validate(reader.header(), rounding).map_err(TableError::from)?;
            let slab = spread(slab, header.axes.phi.len());
            writer.write_slab(&table.position, index, &slab)?;
        }
    }
    Ok(writer.finish()?)
}

/// What all tables have in common; fails where they differ in more than the swept values. Tables
/// without azimuth dependence fit those that have one.
fn common_header(
    tables: &[&PlannedTable],
    folder: &Path,
) -> Result<(TableHeader, Option<u8>), BatchError> {
    let mut common: Option<(TableHeader, Option<u8>)> = None;
    for table in tables {
        let reader = TableReader::open(&table.file(folder))?;
        let header = reader.header();
        let Some((first, _)) = &mut common else {
            common = Some((header.clone(), reader.bit_round()?));
            continue;
        };
        let same = header.axes.wavelength == first.axes.wavelength
            && header.axes.theta == first.axes.theta
            && header.quantity == first.quantity
            && header.averaging.sun_disc == first.averaging.sun_disc
            && header.forward_peak == first.forward_peak;
        if !same {
            let accepted = "tables of one plan with the same wavelengths, angles and quantity";
            return Err(invalid("table", &table.id, accepted));
        }
        first.averaging.sizes |= header.averaging.sizes;
        // Effective radii of swept distributions: each table has its own.
        if header.averaging.sizes && header.radius != first.radius {
            first.radius = f64::NAN;
        }
        if let (Some(all), Some(own)) = (&mut first.bodies, &header.bodies)
            && !all.density_source.split("; ").any(|source| source == own.density_source)
        {
            all.density_source = format!("{}; {}", all.density_source, own.density_source);
        }
        let more = &header.method;
        if !first.method.split('+').any(|method| method == more) {
            first.method = format!("{}+{more}", first.method);
        }
        if !first.shape.split('+').any(|shape| *shape == header.shape) {
            first.shape = format!("{}+{}", first.shape, header.shape);
        }
        match (first.rotational_symmetry, header.rotational_symmetry) {
            (true, false) => {
                first.axes.phi = header.axes.phi.clone();
                first.rotational_symmetry = false;
            }
            (false, false) if first.axes.phi != header.axes.phi => {
                return Err(invalid("table", &table.id, "tables with the same azimuths"));
            }
            _ => {}
        }
    }
    let (mut header, bit_round) =
        common.ok_or_else(|| invalid("plan", "no table", "at least one table"))?;
    header.command_line = "gonio batch merge".into();
    Ok((header, bit_round))
}

/// A slab without azimuth dependence, written out for every azimuth.
fn spread(slab: Slab, azimuths: usize) -> Slab {
    let (elements, theta, phi) = slab.values.dim();
    if phi == azimuths {
        return slab;
    }
    let values =
        Array3::from_shape_fn((elements, theta, azimuths), |(e, i, _)| slab.values[(e, i, 0)]);
    let caustic_order = slab
        .caustic_order
        .map(|mask| Array2::from_shape_fn((theta, azimuths), |(i, _)| mask[(i, 0)]));
    Slab { values, caustic_order, ..slab }
}

/// The swept dimensions, from the values that the lines of the plan carry.
fn sweep_axes(plan: &BatchPlan) -> Result<Vec<SweepAxis>, BatchError> {
    let Some(first) = plan.tables.first() else { return Ok(Vec::new()) };
    (0..first.shape.len())
        .map(|axis| {
            // The tables that differ from the first along this axis alone, in order.
            let along = plan.tables.iter().filter(|table| {
                table.position.iter().enumerate().all(|(other, &i)| other == axis || i == 0)
            });
            let along: Vec<_> = along.map(|table| &table.values[axis]).collect();
            let mut keys: Vec<&String> = first.values[axis].keys().collect();
            // A paired axis is named by the radius where that is in it.
            keys.sort_by_key(|key| !key.starts_with("particle.radius"));
            let coordinates = keys
                .into_iter()
                .map(|key| coordinate(key, along.iter().map(|values| values.get(key))))
                .collect::<Result<_, _>>()?;
            Ok(SweepAxis { coordinates })
        })
        .collect()
}

fn coordinate<'a>(
    key: &str,
    values: impl Iterator<Item = Option<&'a serde_json::Value>>,
) -> Result<SweepCoordinate, BatchError> {
    let values = values
        .map(|value| value.ok_or_else(|| invalid("plan", key, "a value in every line")))
        .collect::<Result<Vec<_>, _>>()?;
    let (name, units, factor) = match key {
        "particle.radius_mm" => ("radius_um", "um", 1e3),
        "particle.radius_um" => ("radius_um", "um", 1.0),
        "particle.diameter_mm" => ("radius_um", "um", 500.0),
        "particle.temperature_c" => ("temperature", "degC", 1.0),
        "particle.model" => ("shape_model", "", 1.0),
        "particle.density_kg_m3" => ("density_kg_m3", "kg m-3", 1.0),
        sizes if sizes.starts_with("particle.size_distribution.") => {
            let name = sizes.rsplit('.').next().unwrap_or(sizes);
            let unit =
                ["um", "mm", "nm"].into_iter().find(|unit| name.ends_with(&format!("_{unit}")));
            (name, unit.unwrap_or("1"), 1.0)
        }
        "light.sun_elevation_deg" => ("sun_elevation", "degree", 1.0),
        other => (other.rsplit('.').next().unwrap_or(other), "1", 1.0),
    };
    let numbers: Option<Vec<f64>> = values.iter().map(|value| value.as_f64()).collect();
    let (values, units) = match numbers {
        Some(numbers) => {
            (AxisValues::Numbers(numbers.iter().map(|n| tidy(n * factor)).collect()), units)
        }
        None => {
            let text = |value: &&serde_json::Value| {
                value.as_str().map_or_else(|| value.to_string(), String::from)
            };
            (AxisValues::Texts(values.iter().map(text).collect()), "")
        }
    };
    Ok(SweepCoordinate { name: name.into(), units: units.into(), values })
}
