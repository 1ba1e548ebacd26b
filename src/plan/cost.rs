//! What a table costs before it is computed: memory, and the time to write it down.
//!
//! The time of the physics is not modelled: `gonio plan` computes a few columns of a few wavelengths and
//! counts processor time, so that its forecast holds on any machine, idle or loaded. Memory cannot be
//! tried out; here are the sizes of what is held at once, with bytes as measured (the peak resident set of
//! whole runs, x86-64 Linux).

use super::{Engine, Plan, Symmetry};
use crate::scene::Scene;
use crate::series::tmatrix::expectation;
use crate::shape::Body;
use std::f64::consts::TAU;

/// The program, its libraries and threads.
const PROGRAM: f64 = 22e6;
/// Slabs at once: one being computed, one waiting, one being written.
const SLABS: f64 = 3.0;
/// Amplitudes and values of one direction of a column, and columns in work on each thread.
const COLUMN: f64 = 200.0;
const COLUMNS: f64 = 8.0;
/// Values (f32) that the preview keeps at most, and what drawing it takes per direction.
const PREVIEW_VALUES: f64 = 64.0 * 1024.0 * 1024.0;
const PREVIEW_DIRECTION: f64 = 24.0;
/// Per ray and order of a grid of patches: corners twice (as traced, and as a sheet), triangles, and
/// their hierarchy of boxes. Measured: 1.69 GB for 500 × 1000 rays of 4 orders.
const PATCH: f64 = 890.0;
/// Spokes of the grid of patches on the sphere that the stated error is measured on.
const CHECK_SPOKES: usize = 96;
/// Meridians of an order at all its azimuths; what is added in drops whose rays tangle, from the radius
/// at which it begins over a range of radii; and the share that pieces of memory left between the
/// wavelengths add, complete at so many of them.
const MERIDIANS: f64 = 4.5e6;
const TANGLED: f64 = 5e6;
const TANGLED_FROM: f64 = 0.4e-3;
const TANGLED_OVER: f64 = 0.9e-3;
const LEFT_BETWEEN: f64 = 0.85;
const LEFT_AFTER: f64 = 7.0;
/// Partial waves: samples and potentials, per squared size parameter.
const PARTIAL_WAVES: f64 = 420.0;
/// Spheres: coefficients per size parameter; means over sizes: sums on all threads.
const SERIES_SIZE: f64 = 1000.0;
const MEANS: f64 = 82e6;
/// T-matrices: all blocks, and what makes them on each thread, per cube of the degrees; values (f64) of the
/// computed half of the directions.
const T_MATRIX: f64 = 40.0;
const T_MATRIX_VALUE: f64 = 4.0;

/// Of a crystal's table: eight replicas and the pieces of one, of eight bytes, over those of a T-matrix.
const REPLICAS_AND_PIECES: f64 = 24.0 * 8.0 / T_MATRIX_VALUE;

/// Processor seconds to compress and write one value, to start and draw an empty preview, and to draw
/// one of its directions.
const WRITE_VALUE: f64 = 2.2e-8;
const DRAW: f64 = 0.03;
const DRAW_DIRECTION: f64 = 5e-7;

/// What a table takes beside its physics.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// Peak memory of the whole run, bytes.
    pub memory: u64,
    /// Processor seconds to write the file and draw its picture.
    pub writing_seconds: f64,
}

impl Plan {
    /// The cost of a scene's table on some threads.
    ///
    /// ```
    /// use gonio::plan::Plan;
    /// use gonio::scene::{Scene, SceneFile};
    /// let scene = Scene::built_in(&SceneFile::default())?;
    /// let cost = Plan::new(&scene)?.cost(&scene, 2);
    /// assert!(cost.memory > 100_000_000 && cost.memory < 1_000_000_000);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn cost(&self, scene: &Scene, threads: usize) -> Cost {
        let azimuths = if self.symmetry == Symmetry::Rotational { 1 } else { scene.phi.len() };
        let theta = scene.theta.len() as f64;
        let directions = theta * azimuths as f64;
        let values = directions * scene.quantity.elements() as f64;
        let wavelengths = scene.wavelengths.len() as f64;
        let series = self.engine.is_exact() || self.engine == Engine::Facets;

        let slabs = SLABS.min(wavelengths + 1.0) * 4.0 * values;
        // half the azimuths are computed, and held until the slab is filled
        let lines = if series { 0.0 } else { 2.0 * values };
        let columns = if series { 0.0 } else { threads as f64 * COLUMNS * theta * COLUMN };
        let preview =
            4.0 * PREVIEW_VALUES.min(directions * wavelengths) + PREVIEW_DIRECTION * directions;
        let memory = PROGRAM + slabs + lines + columns + preview + self.method_memory(scene);
        let drawing = DRAW + DRAW_DIRECTION * directions;
        Cost {
            memory: memory as u64,
            writing_seconds: WRITE_VALUE * values * wavelengths + drawing,
        }
    }

    /// Values of a T-matrix's table before they are turned into a slab, bytes.
    fn directions(&self, scene: &Scene) -> f64 {
        let azimuths = if self.symmetry == Symmetry::Rotational { 1 } else { scene.phi.len() };
        T_MATRIX_VALUE * (scene.theta.len() * azimuths * scene.quantity.elements()) as f64
    }

    /// What the method holds for one wavelength.
    fn method_memory(&self, scene: &Scene) -> f64 {
        let shortest = scene.wavelengths.iter().copied().fold(f64::INFINITY, f64::min);
        // A wavelength without data is refused by the plan itself.
        let seen = scene.medium.seen_outside(shortest).unwrap_or(shortest);
        let x = TAU * self.radius / seen;
        let orders = self.orders.len() as f64;
        match self.engine {
            Engine::Patches => {
                let spokes = self.spokes + CHECK_SPOKES.min(self.spokes);
                PATCH * (self.rings * spokes) as f64 * orders
            }
            Engine::Meridians if self.symmetry == Symmetry::Rotational => 0.05 * MERIDIANS * orders,
            Engine::Meridians if x < self.thresholds.partial_waves_below => PARTIAL_WAVES * x * x,
            Engine::Meridians => {
                let tangled = match &self.shape.body {
                    Body::Raindrop(_) => {
                        TANGLED * ((self.radius - TANGLED_FROM) / TANGLED_OVER).clamp(0.0, 1.0)
                    }
                    _ => 0.0,
                };
                let others = scene.wavelengths.len().saturating_sub(1) as f64;
                let left = 1.0 + LEFT_BETWEEN * (others / (LEFT_AFTER - 1.0)).min(1.0);
                (MERIDIANS + tangled) * orders * left
            }
            // values (f64) of every replica, and of the pieces of one
            Engine::Facets => REPLICAS_AND_PIECES * self.directions(scene),
            Engine::TMatrix => {
                let degrees = expectation(&self.shape, x).map_or(0.0, |e| e.degrees as f64);
                T_MATRIX * degrees.powi(3) + self.directions(scene)
            }
            Engine::LorenzMie | Engine::Debye => {
                let many = scene.size_distribution.is_some() || scene.bandwidth > 0.0;
                SERIES_SIZE * x + if many { MEANS } else { 0.0 }
            }
        }
    }
}

/// Memory that is free, bytes; `None` where the system does not say.
pub fn available_memory() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes << 10)
}
