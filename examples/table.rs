//! One table: a scene becomes a file, the file is read back.
//!
//! `cargo run --release --example table [FILE]`

use gonio::hdf5::{TableReader, TableWriter, WriteOptions};
use gonio::scene::{Scene, SceneFile, SceneText};
use gonio::simulate;
use std::path::PathBuf;

const SCENE: &str = r#"
[particle]
shape = "raindrop"
radius_mm = 0.5
model = "beard-chuang-1987"
[light]
sun_elevation_deg = 20
wavelengths_nm = [450, 650]
[table]
theta_deg = { from = 0, to = 180, count = 181 }
azimuth_deg = { from = 0, to = 360, count = 13 }
"#;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let text = SceneText::parse("the scene of this example", SCENE.into())?;
    let scene = Scene::from_text(text, &SceneFile::default())?;
    let given = std::env::args().nth(1).map(PathBuf::from);
    let name = format!("gonio-example-{}.h5", std::process::id());
    let path = given.clone().unwrap_or_else(|| std::env::temp_dir().join(name));

    // Slab by slab: the file appears when it is complete.
    let header = simulate::header(&scene, String::new())?;
    let mut writer = TableWriter::create(&path, &header, WriteOptions::default())?;
    simulate::simulate::<Box<dyn std::error::Error>>(&scene, |i, slab| {
        println!("{:.0} nm: stated error {:.3}", slab.wavelength * 1e9, slab.error_estimate);
        Ok(writer.write_slab(i, &slab)?)
    })?;
    writer.finish()?;

    let reader = TableReader::open(&path)?;
    let slab = reader.slab(1)?;
    let mean = slab.azimuth_mean(&reader.header().axes, 0);
    println!("P(139°) at 650 nm, mean over azimuth: {:.1e} sr⁻¹", mean[139]);
    assert!(mean[139] > 2.0 * mean[130], "the primary bow is brighter than the dark band");
    if given.is_none() {
        std::fs::remove_file(&path)?;
    }
    Ok(())
}
