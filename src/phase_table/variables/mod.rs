//! A table as named variables with dimensions, units and words: what its file holds, and what a Dataset in
//! Python holds, said once.
//!
//! The functions of this room write into a `Store`; one is an HDF5 file, the other is memory
//! ([`Description`]), for whoever wants the variables without a file.
//!
//! ```
//! use gonio::phase_table::variables::{Attribute, Describer};
//! use gonio::scene::{Scene, SceneFile};
//! use gonio::simulate;
//!
//! let keys: SceneFile = toml::from_str("[particle]
//!     shape = 'sphere'
//!     radius_um = 1
//!     [light]
//!     wavelengths_nm = [550]
//!     [table]
//!     theta_deg = [0, 90, 180]
//!     [model]
//!     method = 'mie'")?;
//! let table = simulate::table(&Scene::built_in(&keys)?)?;
//! let mut describer = Describer::new(&table.header);
//! describer.add(0, &table.slabs[0]);
//! let whole = describer.finish(None, true);
//! assert!(whole.attributes.contains(&("method".into(), Attribute::Text("mie".into()))));
//! let values = whole.variables.iter().find(|variable| variable.name == "phase_function").unwrap();
//! assert_eq!(values.dimensions, ["wavelength_nm", "theta", "phi"]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub(crate) mod circumstances;
pub(crate) mod dimensions;
mod memory;
pub(crate) mod methods;
pub(crate) mod record;
pub(crate) mod schema;
pub(crate) mod values;

pub use memory::{Attribute, Described, Describer, Description, Values};

/// What the values of a variable are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Single precision.
    F32,
    /// Double precision.
    F64,
    /// Integers.
    I32,
    /// Bytes.
    U8,
    /// Strings of any length: what h5netcdf and netCDF-C both show as text in variables.
    Texts,
}

/// Where variables are put.
pub(crate) trait Store {
    type Variable: Variable<Error = Self::Error>;
    type Error;

    /// A text attribute of the whole.
    fn attribute(&self, name: &str, text: &str) -> Result<(), Self::Error>;

    /// An integer attribute of the whole.
    fn attribute_integer(&self, name: &str, value: i32) -> Result<(), Self::Error>;

    /// A new variable; a scalar when `shape` is empty.
    fn variable(
        &self,
        name: &str,
        kind: Kind,
        shape: &[u64],
    ) -> Result<Self::Variable, Self::Error>;
}

/// A variable that is being put.
pub(crate) trait Variable {
    type Error;

    /// All values of one of [`Kind::F64`].
    fn write_numbers(&self, values: &[f64]) -> Result<(), Self::Error>;

    /// All values of one of [`Kind::I32`].
    fn write_integers(&self, values: &[i32]) -> Result<(), Self::Error>;

    /// All values of one of [`Kind::Texts`].
    fn write_texts(&self, texts: &[String]) -> Result<(), Self::Error>;

    /// A text attribute.
    fn attribute(&self, name: &str, text: &str) -> Result<(), Self::Error>;

    /// An integer attribute.
    fn attribute_integer(&self, name: &str, value: i32) -> Result<(), Self::Error>;

    /// Make it the coordinate of the dimension of the same name.
    fn make_scale(&self, name: &str) -> Result<(), Self::Error>;

    /// Attach the coordinates of its dimensions, in order.
    fn attach(&self, scales: &[&Self]) -> Result<(), Self::Error>;
}
