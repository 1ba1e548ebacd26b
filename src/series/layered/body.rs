//! A [`Body`] of the media, solved: layers where all of it is constant, else a profile.

use super::{Layer, Layered, RadialIndex};
use crate::medium::radial::{Body, Core, Profile, Smooth};
use crate::series::SeriesError;
use num_complex::Complex64;

impl RadialIndex for Body {
    fn squared(&self, radius: f64) -> Complex64 {
        let index = self.index(radius);
        index * index
    }

    fn breaks(&self) -> Vec<f64> {
        Body::breaks(self)
    }
}

impl Layered {
    /// Solve a body of size parameter `x = 2πr/λ` outside; a profile to the tolerance.
    ///
    /// # Errors
    /// As [`Self::layers`] and [`Self::profile`]; the inverse profile, whose waves have no end at
    /// the centre.
    pub fn body(size_parameter: f64, body: &Body, tolerance: f64) -> Result<Self, SeriesError> {
        match &body.core {
            Core::Constant(index) => {
                let core = Layer { radius: body.core_radius, index: *index };
                let rest = body.layers.iter().map(|&(radius, index)| Layer { radius, index });
                let layers: Vec<Layer> = [core].into_iter().chain(rest).collect();
                Self::layers(size_parameter, &layers)
            }
            Core::Smooth(Smooth::Profile { profile: Profile::Inverse { k }, .. }) => {
                Err(SeriesError::Invalid {
                    field: "medium: profile inverse, k",
                    value: k.to_string(),
                    accepted: "a profile that is finite at the centre: here waves wind about it \
                               without end, and the exact series has no regular solution",
                })
            }
            Core::Smooth(_) => Self::profile(size_parameter, body, tolerance),
        }
    }
}
