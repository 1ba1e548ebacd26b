//! The far field: from rays that left the particle to amplitudes in any direction.
//!
//! Two ways lead there. The main one follows, for each order, the rays that leave in one plane (a
//! [`meridian`]), cuts them at their landmarks ([`arc`]) into [`segment`]s with the uniform formulas of
//! [`fold`], [`rim`] and [`edge`], interpolates them over azimuth (a [`fan`]) and adds them up in a
//! [`sweep`] over the samples; orders too tangled for that are sums on a [`complex_wavefront`], and those of
//! small particles of [`partial_waves`]. The other,
//! that of Sadeghi et al. 2012: sheets of rays cut into [`patch`]es, held in a [`collecting_sphere`];
//! [`interference`] of all patches that contain a direction; diffraction by the [`gaussian_filter`].
//! [`forward_wave`] is what goes straight on; [`tabulate`] makes the values of a table.

pub mod arc;
mod arc_layout;
mod arc_search;
mod arc_segments;
mod assignment;
mod axis_wave;
mod bow_wave;
pub mod collecting_sphere;
pub mod complex_wavefront;
mod corresponding;
mod cross_check;
pub mod direction;
pub mod edge;
mod edge_layout;
mod edge_profile;
mod error_estimate;
pub mod fan;
pub mod fold;
pub mod forward_diffraction;
pub mod forward_peak;
pub mod forward_wave;
pub mod gaussian_filter;
pub mod huygens_fresnel;
pub mod interference;
mod launch_line;
mod launch_rays;
pub mod meridian;
mod order_fan;
pub mod partial_waves;
pub mod patch;
pub mod rim;
mod rim_integrand;
mod rim_layout;
mod rim_rays;
mod roughness;
pub mod segment;
pub mod sweep;
pub mod tabulate;
mod tangled;
mod taper;

pub use collecting_sphere::CollectingSphere;
pub use direction::Direction;
pub use error_estimate::ErrorEstimate;

use crate::optics::AmplitudeMatrix;
use crate::shape::Shape;
use crate::trace::Tracer;
use fan::{Fan, FanSettings};
use forward_diffraction::ForwardDiffraction;
use forward_wave::ForwardWave;
use interference::{Interference, PathInterpolation};
use partial_waves::PartialWaves;
use std::f64::consts::{PI, TAU};
use tabulate::Column;
use tangled::Tangled;

/// The far field of one wavelength, ready to be asked for columns or single directions.
pub struct FarField<'a> {
    source: Source<'a>,
    silhouette: ForwardDiffraction,
    size_parameter: f64,
    _shape: &'a Shape,
}

/// How amplitudes are found.
enum Source<'a> {
    Patches(CollectingSphere, Interference),
    /// Meridians, and something else for the orders whose meridians do not correspond.
    Meridians(Box<Fan>, Tangled<'a>),
}

impl<'a> FarField<'a> {
    /// Patches on the collecting sphere.
    pub fn patches(shape: &'a Shape, sheets: Vec<patch::Sheet>, size_parameter: f64) -> Self {
        let interpolation = PathInterpolation::Gradient;
        let largest_jacobian = f64::INFINITY;
        let interference = Interference { size_parameter, interpolation, largest_jacobian };
        Self {
            source: Source::Patches(CollectingSphere::new(sheets), interference),
            silhouette: ForwardDiffraction::new(shape),
            size_parameter,
            _shape: shape,
        }
    }

    /// Meridians with uniform Airy functions at their folds.
    pub fn meridians(tracer: &Tracer<'a>, settings: &FanSettings) -> Self {
        let silhouette = ForwardDiffraction::new(tracer.shape());
        let (waves, orders) = PartialWaves::of_small_particles(tracer, settings);
        let share = |order: u32| assignment::share_of_sum(tracer, order);
        let planes: Vec<u32> = orders.iter().copied().filter(|&p| share(p) < 1.0).collect();
        let of_planes = FanSettings { orders: &planes, ..settings.clone() };
        let mut fan = Fan::new(tracer, &of_planes, &silhouette);
        for order in cross_check::doubtful_orders(&fan, tracer, &of_planes) {
            fan.give_up(order);
        }
        let by_sum = |order: u32| if fan.irregular.contains(&order) { 1.0 } else { share(order) };
        let shares: Vec<(u32, f64)> =
            orders.iter().map(|&p| (p, by_sum(p))).filter(|(_, share)| *share > 0.0).collect();
        for &(order, share) in &shares {
            fan.scale(order, 1.0 - share);
        }
        let tangled = Tangled::new(tracer, waves, &shares, settings);
        Self {
            source: Source::Meridians(Box::new(fan), tangled),
            silhouette,
            size_parameter: settings.size_parameter,
            _shape: tracer.shape(),
        }
    }

    /// Orders that the method could not represent.
    pub fn irregular(&self) -> &[u32] {
        match &self.source {
            Source::Patches(..) => &[],
            Source::Meridians(fan, _) => &fan.irregular,
        }
    }

    /// The wave that goes straight on.
    pub fn forward_wave(&self) -> ForwardWave<'_> {
        let edge = match &self.source {
            Source::Patches(..) => None,
            Source::Meridians(fan, _) => fan.edge(),
        };
        ForwardWave { shadow: &self.silhouette, edge, size_parameter: self.size_parameter }
    }

    /// The silhouette and its diffraction.
    pub fn silhouette(&self) -> &ForwardDiffraction {
        &self.silhouette
    }

    /// Amplitudes straight forward of rays that a meridian stands for and of the edge wave, where
    /// diffraction and external reflection are joined.
    pub fn straight_forward(&self) -> Option<AmplitudeMatrix> {
        let Source::Meridians(fan, _) = &self.source else { return None };
        fan.edge()?;
        let rays = fan.columns(&[0.0], &[0.0]).swap_remove(0)[0];
        Some(rays + self.forward_wave().peak(&Direction::new(0.0, 0.0)))
    }

    /// All scattering angles at each of some azimuths in [0, π], without forward diffraction.
    pub fn columns(&self, theta: &[f64], azimuths: &[f64], incoherent: bool) -> Vec<Column> {
        match &self.source {
            Source::Patches(sphere, interference) => azimuths
                .iter()
                .map(|&phi| patch_column(sphere, interference, theta, phi, incoherent))
                .collect(),
            Source::Meridians(fan, tangled) => {
                let caustic_order = fan.caustic_order(theta);
                let columns = fan.columns(theta, azimuths).into_iter().zip(azimuths);
                let finish = |(mut amplitude, &phi): (Vec<AmplitudeMatrix>, &f64)| {
                    tangled.add(theta, phi, &mut amplitude);
                    Column {
                        amplitude,
                        incoherent: Vec::new(),
                        rays: Vec::new(),
                        caustic_order: caustic_order.clone(),
                    }
                };
                columns.map(finish).collect()
            }
        }
    }

    /// Amplitudes in single directions `(θ, φ)`, with forward diffraction where asked.
    pub fn scatter(&self, directions: &[(f64, f64)], diffraction: bool) -> Vec<AmplitudeMatrix> {
        let mut amplitudes = match &self.source {
            Source::Patches(sphere, interference) => directions
                .iter()
                .map(|&(t, p)| interference.collect(sphere, &Direction::new(t, p)).amplitude)
                .collect(),
            Source::Meridians(fan, tangled) => scatter_by_columns(directions, |theta, phi| {
                let mut column = fan.columns(theta, &[phi]).swap_remove(0);
                tangled.add(theta, phi, &mut column);
                column
            }),
        };
        if diffraction {
            let forward = self.forward_wave();
            for (amplitude, &(theta, phi)) in amplitudes.iter_mut().zip(directions) {
                *amplitude += forward.beside_meridians(&Direction::new(theta, phi));
            }
        }
        amplitudes
    }
}

/// A column collected patch by patch.
fn patch_column(
    sphere: &CollectingSphere,
    interference: &Interference,
    theta: &[f64],
    phi: f64,
    incoherent: bool,
) -> Column {
    let mut column = Column {
        amplitude: Vec::with_capacity(theta.len()),
        incoherent: Vec::new(),
        rays: Vec::with_capacity(theta.len()),
        caustic_order: Vec::new(),
    };
    for &t in theta {
        let found = interference.collect(sphere, &Direction::new(t, phi));
        column.amplitude.push(found.amplitude);
        if incoherent {
            column.incoherent.push(found.incoherent);
        }
        column.rays.push(found.rays_by_order);
    }
    column
}

/// Directions grouped into columns of equal azimuth in [0, π], each computed in ascending θ.
fn scatter_by_columns(
    directions: &[(f64, f64)],
    column: impl Fn(&[f64], f64) -> Vec<AmplitudeMatrix>,
) -> Vec<AmplitudeMatrix> {
    let folded = |phi: f64| {
        let turned = phi.rem_euclid(TAU);
        if turned > PI { (TAU - turned, true) } else { (turned, false) }
    };
    let mut order: Vec<usize> = (0..directions.len()).collect();
    let key = |&i: &usize| (folded(directions[i].1).0, directions[i].0);
    order.sort_by(|a, b| {
        let (a, b) = (key(a), key(b));
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    let mut amplitudes = vec![AmplitudeMatrix::default(); directions.len()];
    for group in order.chunk_by(|a, b| key(a).0 == key(b).0) {
        let theta: Vec<f64> = group.iter().map(|&i| directions[i].0).collect();
        for (&i, mut amplitude) in group.iter().zip(column(&theta, key(&group[0]).0)) {
            if folded(directions[i].1).1 {
                (amplitude.s3, amplitude.s4) = (-amplitude.s3, -amplitude.s4);
            }
            amplitudes[i] = amplitude;
        }
    }
    amplitudes
}
