//! One batch: a sweep over radii, computed as shards, merged into one file.
//!
//! `cargo run --release --example batch`

use gonio::batch::{BatchPlan, Event, Sweep, merge, run};
use gonio::hdf5::SweepReader;

/// A scene in which one value is a list.
const SWEEP: &str = r#"
[particle]
shape = "sphere"
radius_um = [5.0, 10.0, 20.0]
[light]
wavelengths_nm = [550]
[table]
theta_deg = { from = 0, to = 180, count = 181 }
azimuth_deg = [0]
"#;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::temp_dir().join(format!("gonio-batch-{}", std::process::id()));
    let plan = BatchPlan::from_sweep(&Sweep::parse(SWEEP)?)?;
    let tables: Vec<_> = plan.tables.iter().collect();
    // Running it again would only compute what is missing.
    run(&plan, &tables, &folder, None, |event| match event {
        Event::Done(shard) => println!("{} in {:.2} s", shard.id, shard.seconds),
        Event::Failed { id, error } => println!("{id}: {error}"),
    })?;
    let merged = folder.join("sweep.h5");
    merge(&plan, &folder, &merged, false, false)?;
    let sweep = SweepReader::open(&merged)?;
    println!("swept: {:?}", sweep.axes()[0].coordinates[0]);
    assert_eq!(sweep.axes()[0].len(), 3);
    std::fs::remove_dir_all(&folder)?;
    Ok(())
}
