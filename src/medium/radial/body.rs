//! A sphere's index along the radius at one wavelength.

use super::profile::Smooth;
use num_complex::Complex64;

/// The innermost part.
#[derive(Clone, Debug)]
pub enum Core {
    /// The same everywhere.
    Constant(Complex64),
    /// Over radii in units of the core's.
    Smooth(Smooth),
}

/// A core and layers around it; radii in units of the particle's, indices relative to the outside.
#[derive(Clone, Debug)]
pub struct Body {
    /// The innermost part.
    pub core: Core,
    /// Its radius.
    pub core_radius: f64,
    /// Outer radius and index, from inside out; the last reaches 1.
    pub layers: Vec<(f64, Complex64)>,
}

impl Body {
    /// One index throughout.
    pub fn homogeneous(index: Complex64) -> Self {
        Self { core: Core::Constant(index), core_radius: 1.0, layers: Vec::new() }
    }

    /// A profile from centre to surface.
    pub fn smooth(profile: Smooth) -> Self {
        Self { core: Core::Smooth(profile), core_radius: 1.0, layers: Vec::new() }
    }

    /// All radii smaller by a factor, to make room for more layers.
    pub fn shrink(&mut self, factor: f64) {
        self.core_radius *= factor;
        self.layers.iter_mut().for_each(|(radius, _)| *radius *= factor);
    }

    /// Index at a radius; on a jump, that inside.
    pub fn index(&self, radius: f64) -> Complex64 {
        if radius <= self.core_radius {
            return match &self.core {
                Core::Constant(index) => *index,
                Core::Smooth(smooth) => smooth.index(radius / self.core_radius),
            };
        }
        let layer = self.layers.iter().find(|(outer, _)| radius <= *outer);
        layer.or(self.layers.last()).map_or(Complex64::ONE, |(_, index)| *index)
    }

    /// Index of the outermost part at its surface.
    pub fn surface(&self) -> Complex64 {
        self.index(1.0)
    }

    /// Radii of jumps and kinks.
    pub fn breaks(&self) -> Vec<f64> {
        let mut breaks = match &self.core {
            Core::Constant(_) => Vec::new(),
            Core::Smooth(smooth) => {
                smooth.breaks().into_iter().map(|r| r * self.core_radius).collect()
            }
        };
        breaks.push(self.core_radius);
        breaks.extend(self.layers.iter().map(|(radius, _)| *radius));
        breaks
    }

    /// Whether nothing inside absorbs.
    pub fn transparent(&self) -> bool {
        let core = match &self.core {
            Core::Constant(index) => index.im == 0.0,
            Core::Smooth(smooth) => smooth.transparent(),
        };
        core && self.layers.iter().all(|(_, index)| index.im == 0.0)
    }
}
