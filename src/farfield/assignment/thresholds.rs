//! Every number on which the choice of a method, or of a formula within one, rests: thresholds on order,
//! size parameter, deformation, index contrast and tolerance, and the errors that methods are expected to
//! have. Each stands here and nowhere else, with what it was measured by.
//!
//! Numbers of resolution (knots per period, rays per line) belong to their kernels; they decide how finely
//! a method works, not which.
//!
//! ```
//! use gonio::farfield::assignment::Thresholds;
//! let by = Thresholds { partial_waves_below: 150.0, ..Thresholds::MEASURED };
//! assert_ne!(by, Thresholds::default());
//! ```

use super::rim::Rim;

/// Where on a sphere the taper from single rays to the integral near the rim may lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TaperRoom {
    /// Widths of the Airy function between the bow's ray and the end of the taper; of order 1 so many before its last
    /// ray.
    pub airy_widths: f64,
    /// Least impact at its end.
    pub deepest: f64,
    /// Least impact at its start, per that at its end.
    pub deepest_start: f64,
    /// Fewest Fresnel zones within.
    pub fewest_zones: f64,
}

/// The table of thresholds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thresholds {
    /// What light may lose in absorbing surroundings on the way along the particle's diameter: the series and the rays
    /// outside are those of a transparent medium.
    pub most_lost_outside: f64,
    /// Size parameters for which rays are accepted: below there are no rays, above phases of `f64` lose
    /// their digits.
    pub ray_sizes: [f64; 2],
    /// Least phase shift `2x|n - 1|` of the central ray for which rays are accepted. Measured against
    /// Lorenz–Mie for n = 0.97, 1.002, 1.02 and 1.1: extinction is 87 % off at 2, 33 % at 3, 13 % at 4 and
    /// 3 to 5 % from 5 to 10, at any index.
    pub least_phase_shift: f64,
    /// Phase shift below which a warning goes with rays: extinction errs by up to 5 %, and directions
    /// beside the forward peak by much more (the stated error tells).
    pub doubtful_phase_shift: f64,
    /// Beyond this `k/n` the wave inside is too inhomogeneous for real rays: measured against Lorenz–Mie.
    pub largest_k_over_n: f64,

    /// Share of the light of a layer that is scattered more often than once up to which pictures leave it out: less
    /// than an eye tells apart.
    pub most_scattered_again: f64,

    /// Least size parameter of a body of facets, and least half width (between parallel planes, over the reduced
    /// wavelength): below, fields on facets are no plane waves cut off at edges.
    pub least_facet_sizes: [f64; 2],
    /// Least size parameter of the circle of a facet's area (mean over the surface): meshes of a sphere lose 3 % of
    /// the power at 22, a third at 11 (validation/facets.md).
    pub least_facet: f64,
    /// Relative error of intensities (root mean square over bands, one orientation) times the size parameter:
    /// measured against discrete dipoles for a hexagonal column (validation/facets.md).
    pub error_of_facets: f64,
    /// The same of rays alone through facets, times the root of the size parameter (bands of 4° beside beams with
    /// diffraction, size parameters 57 and 228): what diffraction would smooth.
    pub error_of_facet_rays: f64,

    /// Highest order that `orders = "auto"` goes to, and the least last order that it takes.
    pub highest_order: u32,
    /// The least last order that `"auto"` takes.
    pub least_last_order: u32,
    /// Share of the light that orders left out may hold, per tolerance. Alexander's band holds about 1 %
    /// of the light per steradian that the bow beside it does, so that orders must be kept down to far
    /// less than the tolerance itself; measured against exact sums of Debye terms (1.1 % error up to p = 7
    /// at 120–150° for a tolerance of 1 %).
    pub left_out_per_tolerance: f64,
    /// Share of the light in a band of 10° that a single order beyond those of a sphere may hold and be left out,
    /// per tolerance.
    pub left_out_of_a_band_per_tolerance: f64,

    /// Seconds of one core that `auto` spends on the T-matrix of one wavelength in place of rays.
    pub most_t_matrix_seconds: f64,
    /// Strain (`series::tmatrix::Expectation`) up to which `auto` tries a T-matrix: beyond, none was found
    /// to converge.
    pub most_t_matrix_strain: f64,

    /// Size parameter below which transmitted orders of deformed particles are sums over partial waves:
    /// from here on planes are quicker, and as good (errors of both meet at 600).
    pub partial_waves_below: f64,
    /// The first order whose rays cross the axis again and make their bow near the rim: its planes have
    /// wider gaps about the axis, steps closer by half, and waves of the rim; partial waves of it leave
    /// out the steep rays at the middle of the shadow, which hold next to nothing and stray far.
    pub first_high_order: u32,
    /// Caustic disorder from which on planes of such orders no longer match across the axis, unless an
    /// integral stands for the rays near the rim.
    pub hopeless_disorder: f64,
    /// Caustic disorder over which a sum on a complex wavefront takes over from planes: of orders 1, 2, 3, and
    /// that of order [`Thresholds::first_high_order`] for all from it on. Raindrops with the sun at 20°: planes of
    /// order 1 miss all of some azimuths from 1.8 mm on (0.205), those of order 2 are within 0.2 % of an
    /// independent sum over wavefronts up to 1 mm (0.158) and 33 % off at some azimuths of 1.5 mm (0.316), those of
    /// order 3 within 1.5 % up to 1 mm (0.237), where the sum errs by 4 to 5 % next to total reflection, and not
    /// reciprocal at 1.3 mm (0.381); those of order 4 hold a third too much light at 0.6 mm (0.085).
    pub wavefront: [[f64; 2]; 4],
    /// How many times that for bodies that look the same from below: planes of a spheroid of axis ratio 0.9
    /// are reciprocal within 1e-4 up to order 3.
    pub wavefront_mirror: f64,
    /// Size parameter from which on such a sum serves: below, orders from 5 on lose more than
    /// half of their light.
    pub wavefront_from: f64,
    /// How far planes may differ from what their neighbours make of them (radians of phase, or share of
    /// the wave) to be interpolated over azimuth; interpolation between them has half the step and more
    /// neighbours, and errs by a small part of that.
    pub roughest: f64,
    /// The last order for which that is looked at: higher ones are weak, and their waves have many knots.
    pub last_smoothed_order: u32,
    /// The first order whose plain segments have fewer knots: weaker than those before.
    pub first_sparse_order: u32,

    /// Orders that a near-grazing integral serves from on, where the body is a sphere. On other particles from
    /// [`Thresholds::first_high_order`] on, and where they are nearly round.
    pub first_near_grazing_order: u32,
    /// Order times deformation of the body over which it leaves orders 1, 2 and 3 of other particles to single rays.
    /// Raindrops in bands of 2° against sums over partial waves at x = 600: order 1 with the penumbra behind its last
    /// ray is within 6 % of the power to 90° up to 0.6 mm (0.03; without, nothing is there), and polynomials through
    /// rays stray beyond the rim from 0.7 mm on; order 3 is within 2 % at 0.41 mm and 5 % at 0.5 mm (0.046; without, up
    /// to 60 % of it is missing), and its bow is not as good as that of single rays at 0.6 mm. The penumbra of order 2
    /// reaches to the axis, where only waves that do not depend on azimuth can be added up.
    pub near_grazing_deformation: [[f64; 2]; 3],
    /// Index above which a bow is far enough from the forward direction for that integral.
    pub near_grazing_index: f64,
    /// Where the taper from single rays to that integral may lie: of order 1, of low and high orders of spheres, of all
    /// others. Order 2 of a sphere of n = 1.333 is 21 % off without the integral at x = 300 and 1.3 % with it, at
    /// x = 100 33 and 7 %: there it starts near the axis. The rays of order 1 spread slowly: their zones are wide, and
    /// below x = 130 single rays are nearer the truth at the middle than a short taper.
    pub tapers: [TaperRoom; 4],
    /// Fresnel zones of a ray within the taper, of low orders and of high ones: fewer would leave a step in the wave.
    /// The first order served is ten times as strong as the others.
    pub taper_zones: [f64; 2],
    /// Fewest widths of the Airy function between the end of the taper and the bow's ray.
    pub fewest_airy_widths: f64,
    /// Distance from the axis at which the rays of a taper are clear of it, in gaps of the planes there.
    pub taper_axis_gaps: f64,
    /// The least such gap, radians.
    pub narrowest_axis_gap: f64,
    /// The order whose fold may come near total reflection inside: order 2 meets it far from its bow, and
    /// the bows of higher ones are made too near the rim.
    pub near_critical_order: u32,

    /// Orders by planes that are compared with a sum on a complex wavefront: higher ones are weak, and order 0
    /// has its own wave at the edge.
    pub cross_checked_orders: [u32; 2],
    /// Caustic disorder over which it is done: below, planes were never found wrong.
    pub cross_checked_disorder: f64,

    /// Wavelengths of a table from which on its planes are found by guides over the index: a guide takes the scans of four
    /// or five of them.
    pub fewest_guided: usize,

    /// Size parameter of the largest sphere that a method is measured on; no error of rays grows with the
    /// size.
    pub largest_checked_sphere: f64,

    /// Size parameter up to which the power that amplitudes scatter is added up over the sphere and compared
    /// with extinction less absorption: beyond, rays lose less than 1 % of the light. And the largest share
    /// by which the two may differ; up to there the difference is in the stated error.
    pub largest_power_sum: f64,
    /// The share of the sentence above.
    pub most_power_lost: f64,
    /// Share of the light on the shadow from which on an order's power is compared with that of its rays.
    pub least_checked_power: f64,
    /// Share of it by which the two may differ without a word in the table.
    pub most_order_off: f64,

    /// How far the share of a separated peak may be from that of the shadow's light, beside the edge effect of
    /// order `x^(-2/3)`: what the wave between diffraction and rays carries, and what samples add up to of fringes
    /// finer than they are. Six shapes and sizes, x = 190 to 9700, 181 to 1801 angles: up to 0.013.
    pub peak_edge: f64,

    /// Share of its amplitude by which a wave may be off, root mean square from 10° to 170°, measured
    /// against Debye terms of spheres (n = 1.333 and 1.5, x = 300 to 10 000). Of scattering planes by
    /// order (the last: and higher), in units of `x^{-2/3}`, the size of the next term of uniform formulas;
    /// order 2 has its bow where few wave zones lie between it and the rim. On spheres such bows are as
    /// good as order 1 wherever the integral near the rim holds them (n = 1.333: from x = 100 on; 1.5: 200; 1.7: 700).
    pub error_of_planes: [f64; 4],
    /// What the density of their knots adds, per tolerance.
    pub error_of_knots: f64,
    /// Of sums over partial waves: in units of `1/x`.
    pub error_of_partial_waves: f64,
    /// What the deformation of a body adds to the stated error below [`Thresholds::partial_waves_below`],
    /// where it fades: a share of the amplitude, per cube root of the deformation and per `1/√x`. Against the
    /// T-matrix: spheroids of x = 20, 50, 100 with axis ratios 0.91 to 0.98, raindrops of 1 and 2 mm at x = 30.
    pub error_of_deformation: f64,
    /// Deformation from which on the brightest waves are as doubtful as the others, as the fourth power goes below:
    /// the umbilic of a 2 mm drop at x = 30 (deformation 0.2) is off by half, the bows of spheroids of axis ratio
    /// 0.91 are not.
    pub strange_deformation: f64,
    /// Of sums on a complex wavefront by order (the last: and higher): against an independent sum over
    /// wavefronts of raindrops of 0.8 to 1.5 mm, and Debye terms; what the wave next to the last ray misses
    /// is most of it.
    pub error_of_wavefront: [f64; 5],
    /// The size parameter at which that is.
    pub wavefront_measured_at: f64,
    /// Of the mean over sizes of orders that add as powers, a share of the intensity at x = 1000: from 48° to 112° and
    /// straight back, where high orders are missed that have their bows there (10 and 11 of water), and elsewhere.
    /// Against exact means of spheres of x = 1000 ± 8 %, bands of 10°: 0.4 to 4.4 %, 8 % straight back, and up to
    /// 1.1 %; at a tolerance of 0.1 %, which takes those orders, up to 1.4 % and 2.4 %.
    pub error_of_powers: [f64; 2],
    /// The power of the size parameter by which that falls.
    pub fall_of_powers: f64,
    /// The same within 2° of straight back, where a glory is interference of orders, at a size parameter of 1000; it
    /// grows with the size up to 0.9 (measured: 0.2 point by point at 1000, 0.87 at 4570).
    pub error_of_glory: f64,
    /// Effective size parameter from which on pictures take drops of many sizes by rays: within some per cent of the
    /// exact series but for the glory, at a hundredth of its time (validation/population.md).
    pub pictures_by_rays_from: f64,
    /// Of Airy's theory of the bows of orders 2 and 3, across and along the scattering plane: a share of its largest
    /// amplitude, times the cube root of the size parameter, which the next terms fall with. Against Debye terms
    /// (n = 1.333, x = 2000 to 100 000), phases included: 1.04 to 1.06 and 12 to 14.5, 1.15 to 1.34 and 7.9 to 9.4.
    pub error_of_airy: [[f64; 2]; 2],
    /// Arguments of the Airy function between which that holds: from the dark side to the first minimum.
    pub airy_arguments: [f64; 2],
    /// Of patches without bows (reflection), and with.
    pub error_of_reflection_by_patches: f64,
    /// The same with bows.
    pub error_of_patches: f64,
}

impl Thresholds {
    /// As measured.
    pub const MEASURED: Self = Self {
        most_lost_outside: 1e-3,
        ray_sizes: [1.0, 1e9],
        least_phase_shift: 5.0,
        doubtful_phase_shift: 20.0,
        largest_k_over_n: 0.03,
        most_scattered_again: 0.01,
        least_facet_sizes: [20.0, 5.0],
        least_facet: 12.0,
        error_of_facets: 6.0,
        error_of_facet_rays: 3.3,
        highest_order: 24,
        least_last_order: 3,
        left_out_per_tolerance: 0.035,
        left_out_of_a_band_per_tolerance: 1.0,
        most_t_matrix_seconds: 15.0,
        most_t_matrix_strain: 9.0,
        partial_waves_below: 600.0,
        first_high_order: 4,
        hopeless_disorder: 0.068,
        wavefront: [[0.165, 0.195], [0.19, 0.24], [0.29, 0.33], [0.055, 0.068]],
        wavefront_mirror: 2.0,
        wavefront_from: 1000.0,
        roughest: 0.2,
        last_smoothed_order: 3,
        first_sparse_order: 3,
        first_near_grazing_order: 1,
        near_grazing_deformation: [[0.03, 0.04], [0.0, 0.0], [0.05, 0.075]],
        near_grazing_index: 1.05,
        tapers: [
            TaperRoom { airy_widths: 3.0, deepest: 0.3, deepest_start: 0.1, fewest_zones: 10.0 },
            TaperRoom { airy_widths: 3.0, deepest: 0.1, deepest_start: 0.05, fewest_zones: 3.5 },
            TaperRoom { airy_widths: 5.0, deepest: 0.1, deepest_start: 0.05, fewest_zones: 3.5 },
            TaperRoom { airy_widths: 5.0, deepest: 0.3, deepest_start: 0.5, fewest_zones: 5.0 },
        ],
        taper_zones: [20.0, 10.0],
        fewest_airy_widths: 2.0,
        taper_axis_gaps: 1.25,
        narrowest_axis_gap: 0.02,
        near_critical_order: 3,
        cross_checked_orders: [1, 3],
        cross_checked_disorder: 0.06,
        fewest_guided: 8,
        largest_checked_sphere: 20_000.0,
        largest_power_sum: 200.0,
        most_power_lost: 0.25,
        least_checked_power: 1e-4,
        most_order_off: 0.05,
        peak_edge: 0.015,
        error_of_planes: [0.25, 1.25, 8.0, 1.25],
        error_of_knots: 0.5,
        error_of_partial_waves: 2.0,
        error_of_deformation: 4.2,
        strange_deformation: 0.2,
        error_of_wavefront: [0.3, 0.01, 0.03, 0.06, 0.3],
        wavefront_measured_at: 1e4,
        error_of_powers: [0.05, 0.015],
        fall_of_powers: 0.85,
        error_of_glory: 0.2,
        pictures_by_rays_from: 300.0,
        error_of_airy: [[1.1, 15.0], [1.4, 10.0]],
        airy_arguments: [-2.0, 2.3],
        error_of_reflection_by_patches: 0.07,
        error_of_patches: 0.3,
    };
}

impl Thresholds {
    /// Share of its amplitude by which the wave of a deformed body may be wrong beyond that of a sphere.
    pub fn doubt_of_deformation(&self, size_parameter: f64, deformation: f64) -> f64 {
        let fading = (1.0 - size_parameter / self.partial_waves_below).max(0.0).sqrt();
        (self.error_of_deformation * fading * deformation.cbrt() / size_parameter.sqrt()).min(1.0)
    }

    /// Relative error of the intensity at a scattering angle (radians) where orders add as powers.
    pub fn doubt_of_powers(&self, size_parameter: f64, theta: f64) -> f64 {
        let degrees = theta.to_degrees();
        let [most, least] = self.error_of_powers;
        let share = if (48.0..=112.0).contains(&degrees) || degrees > 170.0 { most } else { least };
        let fallen = (share * (1000.0 / size_parameter).powf(self.fall_of_powers)).min(0.5);
        let glory = (self.error_of_glory * size_parameter / 1000.0).min(0.9);
        if degrees > 178.0 { fallen.max(glory) } else { fallen }
    }

    /// Whether an order's rays cross the axis again and make their bow near the rim.
    pub fn is_high(&self, order: u32) -> bool {
        order >= self.first_high_order
    }

    /// Share of an order's wave near the rim that the integral over its rays there makes, for a body of a
    /// `deformation` (`Shape::deformation`).
    pub fn near_grazing_share(&self, index: f64, order: u32, rim: Rim, deformation: f64) -> f64 {
        if order < self.first_near_grazing_order.max(1) || index <= self.near_grazing_index {
            return 0.0;
        }
        match self.near_grazing_deformation.get(order as usize - 1) {
            Some(range) if !rim.is_settled(order) => {
                1.0 - eased(*range, f64::from(order) * deformation)
            }
            _ => 1.0,
        }
    }

    /// Whether an order of a particle may need an integral where its rays near total reflection.
    pub fn near_critical_serves(&self, order: u32, rotational: bool) -> bool {
        order == self.near_critical_order && !rotational
    }

    /// Whether planes of an order do not match across the axis without an integral near the rim.
    pub fn is_hopeless(&self, order: u32, caustic_disorder: f64) -> bool {
        self.is_high(order) && caustic_disorder > self.hopeless_disorder
    }

    /// Share of a sum on a complex wavefront in an order's wave where it takes over; `mirror` as in
    /// [`Thresholds::wavefront_disorder`].
    pub fn wavefront_share(&self, order: u32, mirror: bool, disorder: f64) -> f64 {
        eased(self.wavefront_disorder(order, mirror), disorder)
    }

    /// The caustic disorder over which a sum on a complex wavefront takes over; `mirror` says whether the body
    /// looks the same from below.
    pub fn wavefront_disorder(&self, order: u32, mirror: bool) -> [f64; 2] {
        let range = self.wavefront[(order.max(1) as usize).min(self.wavefront.len()) - 1];
        range.map(|disorder| if mirror { self.wavefront_mirror * disorder } else { disorder })
    }
}

impl Default for Thresholds {
    fn default() -> Self {
        Self::MEASURED
    }
}

/// How far a value is from the start of a range to its end: 0 to 1, with a smooth start and end.
fn eased([from, to]: [f64; 2], value: f64) -> f64 {
    if to <= from {
        return if value < from { 0.0 } else { 1.0 };
    }
    let t = ((value - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The integral near the rim fades with deformation without a jump, and never serves reflection.
    #[test]
    fn the_integral_near_the_rim_fades() {
        let by = Thresholds::MEASURED;
        let share = |order, rim, deformation| by.near_grazing_share(1.333, order, rim, deformation);
        for order in [1, 3] {
            let [from, to] = by.near_grazing_deformation[order as usize - 1];
            let at = |value: f64| share(order, Rim::Uneven, value / f64::from(order));
            assert_eq!([at(0.0), at(0.999 * from), at(1.001 * to)], [1.0, 1.0, 0.0]);
            let step = |k: i32| at(from + (to - from) * f64::from(k) / 1000.0);
            for k in 0..1000 {
                let fall = step(k) - step(k + 1);
                assert!((0.0..2e-3).contains(&fall), "order {order}: {fall}");
            }
        }
        for deformation in [0.0, 0.3] {
            assert_eq!(share(1, Rim::Sphere, deformation), 1.0);
            assert_eq!(share(2, Rim::Axial, deformation), 1.0);
            assert_eq!(share(2, Rim::Uneven, deformation), 0.0);
            assert_eq!(share(4, Rim::Uneven, deformation), 1.0);
            assert_eq!(share(0, Rim::Sphere, deformation), 0.0);
        }
    }
}
