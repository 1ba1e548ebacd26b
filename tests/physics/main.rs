//! Results against independent truth, and identities that must hold: rays and their far field, exact
//! series, media, colours. One module per subject: `cargo test --release --test physics stress::`.

mod support;

mod absorption_against_mie;
mod color_reference;
mod dyed_drop;
mod error_estimate;
mod facets;
mod facets_claims;
mod farfield_complex_wavefront;
mod farfield_huygens;
mod farfield_orders;
mod farfield_partial_waves;
mod farfield_spheroid;
mod forward_rings;
mod medium_input;
mod medium_kramers_kronig;
mod medium_references;
mod one_drop;
mod rain;
mod random_scenes;
mod reciprocity;
mod series_debye_reference;
mod series_layered;
mod series_means;
mod series_mie_reference;
mod shared_rays;
mod stress;
mod tmatrix;
mod trace_physics;
mod transfer;
mod transfer_monte_carlo;
