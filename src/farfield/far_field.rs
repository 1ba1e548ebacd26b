//! The far field of one wavelength, asked for columns of a table or for single directions.

use super::assignment::{Assignment, Method, Outcome, Thresholds};
use super::azimuth::guides::Guides;
use super::azimuth::plane_set::{CHECKED_AZIMUTH, PlaneSet};
use super::column::Column;
use super::direction::Direction;
use super::fallback::FallbackField;
use super::forward::diffraction::ForwardDiffraction;
use super::forward::wave::ForwardWave;
use super::partial_waves::PartialWaves;
use super::patches::field::PatchField;
use super::patches::{gaussian_filter, sheets};
use super::wave_field::{WaveField, waves};
use crate::farfield::settings::FarFieldSettings;
use crate::optics::AmplitudeMatrix;
use crate::shape::Shape;
use crate::trace::Tracer;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// The far field of one wavelength, ready to be asked for columns or single directions.
pub struct FarField<'a> {
    pub(crate) source: Source<'a>,
    assignment: Option<Assignment>,
    silhouette: ForwardDiffraction,
    pub(crate) size_parameter: f64,
    _shape: &'a Shape,
}

/// How amplitudes are found.
pub(crate) enum Source<'a> {
    Patches(PatchField),
    /// Scattering planes, and something else for the orders whose planes do not correspond.
    Planes(Box<PlaneSet<'a>>, FallbackField<'a>),
}

impl<'a> FarField<'a> {
    /// Patches on the collecting sphere.
    pub fn patches(shape: &'a Shape, sheets: Vec<sheets::Sheet>, size_parameter: f64) -> Self {
        Self {
            source: Source::Patches(PatchField::of_sheets(sheets, size_parameter)),
            assignment: None,
            silhouette: ForwardDiffraction::new(shape),
            size_parameter,
            _shape: shape,
        }
    }

    /// Every order by the method that the measured thresholds say.
    pub fn meridians(tracer: &Tracer<'a>, settings: &FarFieldSettings) -> Self {
        let (x, tolerance) = (settings.size_parameter, settings.tolerance);
        let by = &Thresholds::MEASURED;
        let assignment = Assignment::new(tracer, settings.orders, x, tolerance, by);
        Self::assigned(tracer, settings, assignment)
    }

    /// Every order by the method that it is assigned to or, where that fails on trial, by the next.
    pub fn assigned(
        tracer: &Tracer<'a>,
        settings: &FarFieldSettings,
        assignment: Assignment,
    ) -> Self {
        Self::guided(tracer, settings, assignment, None)
    }

    /// The same with guides to the planes of its orders.
    pub fn guided(
        tracer: &Tracer<'a>,
        settings: &FarFieldSettings,
        assignment: Assignment,
        guides: Option<&Guides>,
    ) -> Self {
        let (x, by) = (settings.size_parameter, *assignment.thresholds());
        let silhouette = ForwardDiffraction::new(tracer.shape());

        let small = assignment.orders_of(Method::PartialWaves);
        let waves = (!small.is_empty()).then(|| PartialWaves::new(tracer, &small, x, &by));
        let (waves, lost) = waves.map_or((None, Vec::new()), |(waves, lost)| (Some(waves), lost));
        let assignment = assignment.after(Outcome::RadialLines(&lost));

        let orders = assignment.orders_of(Method::Planes);
        let of_planes = FarFieldSettings { orders: &orders, ..settings.clone() };
        let mut planes = PlaneSet::guided(tracer, &of_planes, &silhouette, &by, guides);
        let assignment = assignment.after(Outcome::Planes(&planes.outcomes()));

        for (order, share) in assignment.shares_of_sum() {
            planes.scale(order, 1.0 - share);
        }
        let fallback = FallbackField::new(tracer, waves, &assignment, settings);
        Self {
            source: Source::Planes(Box::new(planes), fallback),
            assignment: Some(assignment),
            silhouette,
            size_parameter: x,
            _shape: tracer.shape(),
        }
    }

    /// Which method stands for which order, as it turned out. `None` for patches alone.
    pub fn assignment(&self) -> Option<&Assignment> {
        self.assignment.as_ref()
    }

    /// Orders that neither planes nor partial waves could represent.
    pub fn irregular(&self) -> Vec<u32> {
        let of = |method| self.assignment.iter().flat_map(move |all| all.orders_of(method));
        let mut orders: Vec<u32> =
            of(Method::ComplexWavefront).chain(of(Method::Patches)).collect();
        orders.sort_unstable();
        orders
    }

    /// `2πr/λ`.
    pub fn size_parameter(&self) -> f64 {
        self.size_parameter
    }

    /// The wave that goes straight on.
    pub fn forward_wave(&self) -> ForwardWave<'_> {
        let edge = match &self.source {
            Source::Patches(_) => None,
            Source::Planes(planes, _) => planes.edge(),
        };
        ForwardWave { shadow: &self.silhouette, edge, size_parameter: self.size_parameter }
    }

    /// The silhouette and its diffraction.
    pub fn silhouette(&self) -> &ForwardDiffraction {
        &self.silhouette
    }

    /// The whole amplitude straight forward: rays of all orders and what diffraction adds. `None` for
    /// patches alone, whose rays of focused rings have no amplitude on the axis.
    ///
    /// `S1 + S2` there is a trace, the same in the plane of every azimuth: that of a traced one is taken.
    pub fn straight_forward(&self) -> Option<AmplitudeMatrix> {
        let Source::Planes(..) = &self.source else { return None };
        Some(self.scatter(&[(0.0, CHECKED_AZIMUTH)], true)[0])
    }

    /// `S11` at scattering angles (ascending) of one azimuth in [0, π] as a table of patches has it:
    /// with or without forward diffraction and interference, filtered near bows.
    pub fn patch_intensities(
        &self,
        theta: &[f64],
        phi: f64,
        diffraction: bool,
        interference: bool,
        filter: Option<f64>,
    ) -> Vec<f64> {
        let column = self.columns(theta, &[phi], !interference).swap_remove(0);
        let wave = self.forward_wave();
        let intensity = |(i, &t): (usize, &f64)| {
            let ahead = wave.beside_planes(&Direction::new(t, phi));
            let ahead = if diffraction { ahead } else { AmplitudeMatrix::default() };
            match column.incoherent.get(i) {
                Some(mueller) => mueller[0][0] + ahead.s11(),
                None => (column.amplitude[i] + ahead).s11(),
            }
        };
        let plain: Vec<f64> = theta.iter().enumerate().map(intensity).collect();
        let Some(sigma) = filter else { return plain };
        let bows = gaussian_filter::bows(theta, &column.rays);
        gaussian_filter::apply(theta, &plain, &bows, sigma)
    }

    /// Amplitudes in single directions, scaled to the intensities that the Gaussian filter leaves near
    /// bows; where no ray arrives its light is unpolarised.
    pub fn scatter_filtered(
        &self,
        directions: &[(f64, f64)],
        diffraction: bool,
        sigma: f64,
    ) -> Vec<AmplitudeMatrix> {
        let step = sigma / FILTER_SAMPLES;
        let grid: Vec<f64> = (0..=(PI / step) as usize).map(|k| k as f64 * step).collect();
        let mut amplitudes = self.scatter(directions, diffraction);
        let folded = |phi: f64| {
            let turned = phi.rem_euclid(TAU);
            turned.min(TAU - turned)
        };
        let mut order: Vec<usize> = (0..directions.len()).collect();
        let azimuth = |&i: &usize| folded(directions[i].1);
        order.sort_by(|a, b| azimuth(a).total_cmp(&azimuth(b)));
        for group in order.chunk_by(|a, b| azimuth(a) == azimuth(b)) {
            let mut theta = grid.clone();
            theta.extend(group.iter().map(|&i| directions[i].0));
            theta.sort_by(f64::total_cmp);
            theta.dedup();
            let phi = azimuth(&group[0]);
            let smooth = self.patch_intensities(&theta, phi, diffraction, true, Some(sigma));
            for &i in group {
                let place = theta.partition_point(|&t| t < directions[i].0);
                amplitudes[i] = scaled_to(amplitudes[i], smooth[place]);
            }
        }
        amplitudes
    }

    /// All scattering angles at each of some azimuths in [0, π], without forward diffraction.
    pub fn columns(&self, theta: &[f64], azimuths: &[f64], incoherent: bool) -> Vec<Column> {
        match &self.source {
            Source::Patches(patches) => {
                let column = |&phi| patch_column(patches, theta, phi, incoherent);
                azimuths.iter().map(column).collect()
            }
            Source::Planes(planes, fallback) => {
                let mut columns = planes.columns(theta, azimuths);
                fallback.add_columns(theta, azimuths, &mut columns);
                let caustic_order = planes.caustic_order(theta);
                let column = |amplitude| Column {
                    amplitude,
                    incoherent: Vec::new(),
                    rays: Vec::new(),
                    caustic_order: caustic_order.clone(),
                };
                columns.into_iter().map(column).collect()
            }
        }
    }

    /// One order's amplitudes at scattering angles (ascending) of some azimuths in [0, π]; `None` where its wave
    /// is not known by itself.
    pub fn columns_of_order(
        &self,
        order: u32,
        theta: &[f64],
        azimuths: &[f64],
    ) -> Option<Vec<Vec<AmplitudeMatrix>>> {
        let Source::Planes(planes, fallback) = &self.source else { return None };
        let of_waves = |all: &Assignment| all.orders_of(Method::PartialWaves).contains(&order);
        if self.assignment.as_ref().is_some_and(of_waves) {
            return None;
        }
        let mut columns = planes.columns_of(order, theta, azimuths);
        fallback.add_order(order, theta, azimuths, &mut columns);
        Some(columns)
    }

    /// Amplitudes in single directions `(θ, φ)`, with forward diffraction where asked.
    pub fn scatter(&self, directions: &[(f64, f64)], diffraction: bool) -> Vec<AmplitudeMatrix> {
        let mut amplitudes = match &self.source {
            Source::Patches(patches) => {
                directions.iter().map(|&(theta, phi)| waves(patches, &[theta], phi)[0]).collect()
            }
            Source::Planes(planes, fallback) => scatter_by_columns(directions, |theta, phi| {
                let mut column = waves(&**planes, theta, phi);
                fallback.add(theta, phi, &mut column);
                column
            }),
        };
        if diffraction {
            let forward = self.forward_wave();
            for (amplitude, &(theta, phi)) in amplitudes.iter_mut().zip(directions) {
                *amplitude += forward.beside_planes(&Direction::new(theta, phi));
            }
        }
        amplitudes
    }
}

/// Samples per standard deviation of the Gaussian filter.
const FILTER_SAMPLES: f64 = 6.0;

/// An amplitude scaled to an intensity; unpolarised light where there was none.
fn scaled_to(amplitude: AmplitudeMatrix, intensity: f64) -> AmplitudeMatrix {
    let size = amplitude.s11();
    if size > 0.0 {
        return amplitude * Complex64::from((intensity / size).sqrt());
    }
    let s = Complex64::from(intensity.max(0.0).sqrt());
    AmplitudeMatrix { s1: s, s2: s, ..Default::default() }
}

/// A column collected patch by patch.
fn patch_column(patches: &PatchField, theta: &[f64], phi: f64, incoherent: bool) -> Column {
    let mut column = Column {
        amplitude: Vec::with_capacity(theta.len()),
        incoherent: Vec::new(),
        rays: Vec::with_capacity(theta.len()),
        caustic_order: Vec::new(),
    };
    for &t in theta {
        let found = patches.interference.collect(&patches.sphere, &Direction::new(t, phi));
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Columns are asked for once per azimuth of either side, ascending; each direction gets its own value,
    /// on the far side of the mirror plane with S3 and S4 turned.
    #[test]
    fn directions_are_grouped_into_columns() {
        let directions =
            [(2.0, 1.0), (0.5, -1.0), (0.3, 1.0), (1.0, PI), (0.7, 1.0 + TAU), (1.5, TAU - 0.5)];
        let asked = std::cell::RefCell::new(Vec::new());
        let found = scatter_by_columns(&directions, |theta, phi| {
            assert!(theta.windows(2).all(|w| w[0] <= w[1]) && (0.0..=PI).contains(&phi));
            asked.borrow_mut().push((phi, theta.len()));
            let one = |&t: &f64| AmplitudeMatrix {
                s1: t.into(),
                s2: phi.into(),
                s3: Complex64::from(1.0),
                s4: Complex64::i(),
            };
            theta.iter().map(one).collect()
        });
        let mut asked = asked.into_inner();
        // 1 + 2π folds back to 1 but for its last digit
        asked.dedup_by(|a, b| (a.0 - b.0).abs() < 1e-12);
        assert_eq!(asked.len(), 3, "{asked:?}");
        for (s, (theta, phi)) in found.iter().zip(directions) {
            let sine = phi.sin();
            let folded = f64::acos(phi.cos());
            assert!((s.s1.re - theta).abs() < 1e-12 && (s.s2.re - folded).abs() < 1e-12);
            let sign = if sine < -1e-9 { -1.0 } else { 1.0 };
            assert_eq!((s.s3.re, s.s4.im), (sign, sign), "{theta} {phi}");
        }
    }

    #[test]
    fn amplitudes_are_scaled_to_intensities() {
        let s = AmplitudeMatrix { s1: Complex64::i() * 2.0, s4: 1.0.into(), ..Default::default() };
        let scaled = scaled_to(s, 10.0);
        assert!((scaled.s11() - 10.0).abs() < 1e-14);
        assert!((scaled.s1 / scaled.s4 - Complex64::i() * 2.0).norm() < 1e-15);
        // where no ray arrives light is unpolarised, and never negative
        let dark = scaled_to(AmplitudeMatrix::default(), 4.0);
        assert!(dark.s1 == dark.s2 && (dark.s11() - 4.0).abs() < 1e-15);
        assert_eq!(scaled_to(AmplitudeMatrix::default(), -1.0), AmplitudeMatrix::default());
    }
}
