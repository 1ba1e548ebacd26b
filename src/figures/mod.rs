//! Figures of the literature, drawn anew by this program: each with what to look at, and the numbers that the paper
//! gives beside ours.
//!
//! A [`Figure`] is a function from scenes (`data/scenes/figures`) to a sheet of charts and pictures and a list of
//! [`Number`]s. Figures that show the same drops share them through a [`Workshop`].
//!
//! ```
//! use gonio::figures::{Workshop, named};
//!
//! let figure = named("sadeghi-3")?;
//! let made = figure.make(&Workshop::default())?;
//! let bow = &made.numbers()[0];
//! assert!(bow.quantity.contains("primary") && bow.paper == Some(137.7));
//! assert!(bow.difference().unwrap().abs() < 0.05);
//! assert!(made.svg()?.contains("scattering angle"));
//! assert!(named("sadegi-3").unwrap_err().to_string().contains("sadeghi-3"));
//! # Ok::<(), gonio::figures::FigureError>(())
//! ```

mod catalogue;
mod dispersion;
mod error;
mod figure;
mod glasses;
mod gradients;
mod made;
mod media;
mod number;
mod papers;
mod plain;
mod rainbows;
mod scenes;
mod workshop;

pub use catalogue::{all, named};
pub use error::FigureError;
pub use figure::Figure;
pub use made::Made;
pub use number::Number;
pub use scenes::{SCENES, SceneOfFigure};
pub use workshop::Workshop;
