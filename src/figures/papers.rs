//! Where the figures are printed.

pub const RAINBOWS: &str = "Sadeghi et al. 2012, ACM Trans. Graph. 31, 3";
pub const ANOMALOUS_DISPERSION: &str = "Weidlich & Wilkie 2009, Comput. Graph. Forum 28, 1065";
pub const GLASSES: &str = "LuxCore: Glass Material IOR and Dispersion; pbrt: spectral dispersion";
pub const VARYING_DIELECTRICS: &str = "Elhoni: Ray tracing spatially varying dielectrics";
pub const AIRY: &str = "Lee 1998, Appl. Opt. 37, 1506; AirySim";
