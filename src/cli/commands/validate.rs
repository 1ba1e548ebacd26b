//! `gonio validate`: check a table or a scene.

use crate::cli::failure::{Failure, Result};
use crate::cli::show::notes;
use clap::Args;
use gonio::hdf5::{SweepReader, TableError, TableReader, position_of};
use gonio::scene::{Scene, SceneFile};
use std::path::{Path, PathBuf};

/// Check a table, a merged sweep or a scene file
#[derive(Args)]
#[command(after_help = "Example: gonio validate raindrop.h5

A table: whole, finite, normalised, S11 >= |Sij|. A scene: every key and value.")]
pub struct ValidateArgs {
    /// Table (.h5) or scene (.toml)
    file: PathBuf,
}

pub fn run(args: ValidateArgs) -> Result<()> {
    let path = &args.file;
    if !path.exists() {
        return Err(Failure::usage(format!("{}: no such file", path.display())));
    }
    if path.extension().is_some_and(|extension| extension == "toml") {
        let scene = Scene::load(path, &SceneFile::default())?;
        gonio::plan::Plan::new(&scene)?;
        println!("{}: a valid scene", path.display());
        return Ok(());
    }
    let tables = match TableReader::open(path) {
        Ok(reader) => {
            check_table(&reader)?;
            1
        }
        Err(TableError::Foreign { .. }) if SweepReader::open(path).is_ok() => check_sweep(path)?,
        Err(error) => return Err(error.into()),
    };
    match tables {
        1 => println!("{}: a valid table", path.display()),
        count => println!("{}: a valid sweep of {count} tables", path.display()),
    }
    Ok(())
}

fn check_table(reader: &TableReader) -> Result<()> {
    let header = reader.header();
    let rounding = reader.rounding()?;
    let mut missed = 0;
    for index in 0..header.axes.wavelength.len() {
        let slab = reader.slab(index)?;
        slab.validate(header, rounding)?;
        missed += usize::from(slab.tolerance_met == Some(false));
    }
    note_on_tolerance(missed, header.axes.wavelength.len(), header.tolerance);
    Ok(())
}

fn check_sweep(path: &Path) -> Result<usize> {
    let reader = SweepReader::open(path)?;
    let shape: Vec<usize> = reader.axes().iter().map(|axis| axis.len()).collect();
    let rounding = reader.rounding()?;
    let mut checked = 0;
    for (number, present) in reader.present()?.into_iter().enumerate() {
        if !present {
            continue;
        }
        let table = reader.table(&position_of(number, &shape))?;
        table.header.validate()?;
        table.slabs.iter().try_for_each(|slab| slab.validate(&table.header, rounding))?;
        let missed = table.slabs.iter().filter(|slab| slab.tolerance_met == Some(false));
        note_on_tolerance(missed.count(), table.slabs.len(), table.header.tolerance);
        checked += 1;
    }
    Ok(checked)
}

/// A table is sound and still not what was asked for.
fn note_on_tolerance(missed: usize, wavelengths: usize, asked: f64) {
    if missed > 0 {
        notes::tell([format!(
            "the error asked for, {asked}, is not met at {missed} of {wavelengths} wavelengths"
        )]);
    }
}
