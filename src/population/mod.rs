//! Populations: what many particles of a volume scatter together.
//!
//! Particles of a volume are strewn about, so that their powers add, element by element of the Mueller matrix,
//! as cross-sections: [`Sum`] adds the slabs of several kinds of particles, or of many sizes, each by its
//! share of the number. [`radii()`] stand for a distribution of sizes, where drops are computed by rays,
//! [`SampledSizes`] where every wavelength of a colour may see another size.
//! [`bodies()`] are the means of what they are as bodies, [`bulk()`] what a volume of air holds of them.
//!
//! ```
//! use gonio::population::Sum;
//! use gonio::scene::{Scene, SceneFile, SceneText};
//! use gonio::simulate;
//!
//! let text = r#"
//! [[particles]]
//! number_fraction = 0.9
//! shape = "sphere"
//! size_distribution = { kind = "gamma", effective_radius_um = 0.1, effective_variance = 0.1 }
//! medium = { index = [1.75, 0.44] }
//! [[particles]]
//! number_fraction = 0.1
//! shape = "sphere"
//! radius_um = 0.5
//! [light]
//! wavelengths_nm = [550]
//! [table]
//! theta_deg = { from = 0, to = 180, count = 91 }
//! "#;
//! let text = SceneText::parse("example", text.into())?;
//! let scene = Scene::from_text(text, &SceneFile::default())?;
//! let together = simulate::table(&scene)?.slabs.remove(0);
//! // the same by hand
//! let mut sum = Sum::default();
//! for (part, share) in scene.parts().iter().zip(scene.number_shares()) {
//!     sum.add(&simulate::table(part)?.slabs[0], share);
//! }
//! let scattering = sum.scattering();
//! assert!((together.scattering_cross_section / scattering - 1.0).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bodies;
mod bulk;
mod radii;
mod samples;
mod sum;

pub use bodies::bodies;
pub use bulk::{Bulk, bulk, fall_speed};
pub use radii::{Radius, radii};
pub use samples::SampledSizes;
pub use sum::Sum;
