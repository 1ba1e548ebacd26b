//! One wavelength of a table by the T-matrix: columns of all azimuths, the forward peak in its cells, and
//! the error that T states of itself, by direction.

use super::far_field::{Azimuth, Scattered};
use super::kernel::error::NoMean;
use super::kernel::range::Solver;
use super::matrix::TMatrix;
use super::random::RandomOrientation;
use super::sections::Sections;
use super::stated::StatedError;
use crate::math::parallel::*;
use crate::optics::{AmplitudeMatrix, mirror_sign};
use crate::phase_table::{Axes, ForwardPeak, MethodPart, Quantity, Slab};
use crate::series::table::{coarse_cells, samples};
use ndarray::{Array2, Array3};
use std::f64::consts::PI;

/// What a slab is made for.
#[derive(Clone, Copy, Debug)]
pub struct TableJob<'a> {
    /// Wavelength in vacuum, metres.
    pub wavelength: f64,
    /// Radius of the sphere of equal volume, metres.
    pub radius: f64,
    /// Radians.
    pub sun_elevation: f64,
    /// Of the table.
    pub axes: &'a Axes,
    /// Azimuths to compute, radians.
    pub computed: &'a [f64],
    /// For each azimuth of the table which of them serves it, and whether as mirror image.
    pub places: &'a [(usize, bool)],
    /// What is tabulated.
    pub quantity: Quantity,
    /// How the forward peak enters.
    pub forward_peak: ForwardPeak,
    /// Relative error asked for.
    pub tolerance: f64,
}

/// Mueller elements of the computed azimuths of a row, one after the other.
type Row = Vec<f64>;

/// What a row of a table is made of.
enum Source {
    Fixed { scattered: Scattered, azimuths: Vec<Azimuth> },
    Random(RandomOrientation),
}

/// Numbers of a slab beside its values.
struct Numbers {
    sections: Sections,
    /// Extinction efficiency by the amplitudes straight ahead.
    ahead: Option<f64>,
    asymmetry: f64,
    errors: StatedError,
    /// What makes rows a phase function.
    scale: f64,
    part: MethodPart,
}

impl TableJob<'_> {
    /// The slab of a fixed body; values over the whole sphere add up to 1 where the forward peak is averaged.
    pub fn slab(&self, t: &TMatrix) -> Slab {
        let scattered = Scattered::new(t, self.sun_elevation);
        let q = scattered.efficiencies();
        let sections = Sections::new(&q, t);
        let azimuths: Vec<Azimuth> =
            self.computed.iter().map(|&phi| scattered.azimuth(phi)).collect();
        let numbers = Numbers {
            errors: StatedError::of_fixed(t, &scattered).at_least(sections.lost),
            sections,
            ahead: Some(q.q_ahead),
            asymmetry: q.asymmetry,
            scale: 1.0 / (t.size_parameter().powi(2) * PI * q.q_sca),
            part: t.method_part(),
        };
        self.filled(t, &Source::Fixed { scattered, azimuths }, numbers)
    }

    /// The slab of a body in random orientation: one azimuth.
    ///
    /// # Errors
    /// A mean that does not stand still.
    pub fn random_slab(&self, t: &TMatrix) -> Result<Slab, NoMean> {
        let mean = RandomOrientation::new(t, MEAN_SHARE * self.tolerance)?;
        let sections = Sections::new(&mean.efficiencies(), t);
        let part = t.method_part();
        let numbers = Numbers {
            errors: StatedError::of_random(t, &mean).at_least(sections.lost),
            sections,
            ahead: None,
            asymmetry: mean.asymmetry(),
            scale: 1.0 / (4.0 * PI),
            part: MethodPart {
                reason: format!("{}, mean over all orientations", part.reason),
                ..part
            },
        };
        Ok(self.filled(t, &Source::Random(mean), numbers))
    }

    fn filled(&self, t: &TMatrix, source: &Source, numbers: Numbers) -> Slab {
        let theta = &self.axes.theta;
        let scale = numbers.scale;
        let mut rows: Vec<Row> = theta.par_iter().map(|&theta| self.row(source, theta)).collect();
        let weights = self.axes.solid_angle();
        let sum_before_peak = self.sum(&rows, &weights) * scale;
        if self.forward_peak == ForwardPeak::CellAverage {
            self.average_peak(t.size_parameter(), source, &mut rows, &weights, scale);
        }
        let elements = self.quantity.elements();
        let shape = (elements, theta.len(), self.axes.phi.len());
        let values = Array3::from_shape_fn(shape, |(e, i, j)| {
            let (column, mirrored) = self.places[j];
            let sign = if mirrored { mirror_sign(e) } else { 1.0 };
            (sign * rows[i][column * elements + e] * scale) as f32
        });
        let Numbers { sections, ahead, asymmetry, errors, part, .. } = numbers;
        let shadow = PI * self.radius * self.radius;
        Slab {
            wavelength: self.wavelength,
            index: t.index(),
            outside_index: 1.0,
            values,
            caustic_order: None,
            scattering_cross_section: sections.scattering * shadow,
            extinction_cross_section: sections.extinction * shadow,
            absorption_cross_section: sections.absorption * shadow,
            forward_extinction: ahead.map(|q| q * shadow),
            asymmetry,
            energy: None,
            sum_before_peak,
            peak_share: 0.0,
            error_estimate: errors.weighted,
            error_by_band: errors.by_band,
            error_by_direction: errors.by_direction,
            tolerance_met: Some(errors.weighted <= self.tolerance),
            left_out: 0.0,
            methods: vec![part],
        }
    }

    fn row(&self, source: &Source, theta: f64) -> Row {
        let elements = self.quantity.elements();
        match source {
            Source::Fixed { scattered, azimuths } => {
                let of = |s: &AmplitudeMatrix| match self.quantity {
                    Quantity::PhaseFunction => vec![s.s11()],
                    Quantity::Mueller => s.mueller().into_iter().flatten().collect(),
                };
                let mut row = Vec::with_capacity(elements * azimuths.len());
                scattered.amplitudes(theta, azimuths).iter().for_each(|s| row.extend(of(s)));
                row
            }
            Source::Random(mean) => {
                let [a1, a2, a3, a4, b1, b2] = mean.at(theta.cos());
                let mueller =
                    [a1, b1, 0.0, 0.0, b1, a2, 0.0, 0.0, 0.0, 0.0, a3, b2, 0.0, 0.0, -b2, a4];
                mueller[..elements].to_vec()
            }
        }
    }

    /// Means over the cells about the forward direction that are coarser than its lobes; what the samples
    /// of the rest miss is closed there, by one factor.
    fn average_peak(
        &self,
        size_parameter: f64,
        source: &Source,
        rows: &mut [Row],
        weights: &Array2<f64>,
        scale: f64,
    ) {
        let cells = coarse_cells(&self.axes.theta, size_parameter);
        let means: Vec<Row> = cells
            .par_iter()
            .map(|&(low, high)| {
                let (angles, shares) = samples(low, high, size_parameter);
                let mut mean: Row = Vec::new();
                for (&theta, share) in angles.iter().zip(&shares) {
                    let fine = self.row(source, theta);
                    mean.resize(fine.len(), 0.0);
                    mean.iter_mut().zip(&fine).for_each(|(to, from)| *to += share * from);
                }
                mean
            })
            .collect();
        let count = means.len();
        rows[..count].clone_from_slice(&means);
        if count > 0 && self.axes.cover_sphere() {
            let peak = self.sum(&rows[..count], weights) * scale;
            let rest = self.sum(rows, weights) * scale - peak;
            let factor = ((1.0 - rest) / peak).clamp(0.5, 2.0);
            rows[..count].iter_mut().flatten().for_each(|value| *value *= factor);
        }
    }

    /// Σ of the first element times solid angle.
    fn sum(&self, rows: &[Row], weights: &Array2<f64>) -> f64 {
        let elements = self.quantity.elements();
        let line = |(i, row): (usize, &Row)| -> f64 {
            let at = |(j, &(column, _)): (usize, &(usize, bool))| {
                row[column * elements] * weights[[i, j]]
            };
            self.places.iter().enumerate().map(at).sum()
        };
        rows.iter().enumerate().map(line).sum()
    }
}

/// Share of a table's tolerance that the rule over orientations may take.
const MEAN_SHARE: f64 = 0.01;

impl TMatrix {
    /// How a table came about, in words.
    fn method_part(&self) -> MethodPart {
        let (solver, degrees) = self.solver();
        let by = match solver {
            Solver::NullField => "null field",
            Solver::LeastSquares => "least squares on the surface",
        };
        MethodPart {
            order: None,
            method: format!("T-matrix by {by}"),
            reason: format!("a body of revolution: exact, waves up to degree {degrees}"),
            expected_error: Some(self.error()),
            ..MethodPart::default()
        }
    }
}
