//! From amplitudes to the slabs of a table.
//!
//! ```
//! use gonio::scene::{Scene, SceneFile, SceneText};
//! use gonio::simulate;
//!
//! let text = r#"
//! [particle]
//! shape = "sphere"
//! radius_um = 50
//! [light]
//! wavelengths_nm = [550]
//! [table]
//! theta_deg = { from = 0, to = 180, count = 91 }
//! azimuth_deg = [0]
//! forward_peak = "cell_average"
//! [model]
//! method = "rays"
//! "#;
//! let text = SceneText::parse("example", text.into())?;
//! let scene = Scene::from_text(text, &SceneFile::default())?;
//! let slab = &simulate::table(&scene)?.slabs[0];
//! // the forward peak is narrower than a cell of 2°; the mean over the cell has its power
//! let highest = slab.values.iter().fold(0f32, |most, &value| most.max(value));
//! assert_eq!(highest, slab.values[(0, 0, 0)]);
//! assert!((slab.sum_before_peak - 1.0).abs() < 0.1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod forward_peak;
pub mod peak_change;
pub mod scattered_power;
pub mod slab;
