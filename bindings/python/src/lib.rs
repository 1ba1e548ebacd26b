//! The extension module of the Python package `gonio`: it turns arrays and scenes into calls of the library and
//! adds no physics. The Python side in `python/gonio` has the documentation that users see.

mod arrays;
mod colours;
mod errors;
mod job;
mod media;
mod radar;
mod scenes;
mod spheres;
mod tmatrix;

use pyo3::prelude::*;

/// What Python imports as `gonio._gonio`.
#[pymodule]
mod _gonio {
    use super::*;

    #[pymodule_export]
    use super::colours::{colour_weights, lee, srgb_of};
    #[pymodule_export]
    use super::job::threads;
    #[pymodule_export]
    use super::media::{Medium, media};
    #[pymodule_export]
    use super::radar::radar;
    #[pymodule_export]
    use super::scenes::Scene;
    #[pymodule_export]
    use super::spheres::{debye_amplitudes, mie_amplitudes, mie_efficiencies, mie_legendre};
    #[pymodule_export]
    use super::tmatrix::{RandomMean, TMatrix};

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
