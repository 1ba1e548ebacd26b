//! Directions in which light is followed: the nodes of a hemisphere, directions that are looked at, the sun's.

use crate::math::gauss_legendre;

/// Cosines to the layer's normal, Stokes components of each, and the weights of the nodes.
#[derive(Clone, Debug)]
pub(super) struct Directions {
    /// The nodes, ascending, then the views, then the sun's.
    cosine: Vec<f64>,
    /// Of the nodes; they add up to 1.
    pub weight: Vec<f64>,
    views: usize,
    /// Components that are followed: I; I, Q, U; or I, Q, U, V.
    pub stokes: usize,
}

impl Directions {
    /// Gauss–Legendre nodes on 0 to 1, so that sums over a hemisphere are exact for polynomials up to the
    /// degree 2 `streams` − 1 (double Gauss: Sykes 1951).
    pub fn new(streams: usize, stokes: usize, views: &[f64], sun: f64) -> Self {
        let nodes = gauss_legendre::nodes(streams);
        let mut cosine: Vec<f64> = nodes.iter().map(|(x, _)| 0.5 * (1.0 + x)).collect();
        let weight = nodes.iter().map(|(_, w)| 0.5 * w).collect();
        cosine.extend_from_slice(views);
        cosine.push(sun);
        Self { cosine, weight, views: views.len(), stokes }
    }

    pub fn nodes(&self) -> &[f64] {
        &self.cosine[..self.weight.len()]
    }

    pub fn sun(&self) -> f64 {
        self.cosine[self.cosine.len() - 1]
    }

    /// Components of the nodes: what light is scattered from and to again.
    pub fn inner(&self) -> usize {
        self.weight.len() * self.stokes
    }

    /// Components of nodes and views: where light is looked at.
    pub fn rows(&self) -> usize {
        self.inner() + self.views * self.stokes
    }

    /// Components of the nodes, and the sun's unpolarised light: where light comes from.
    pub fn columns(&self) -> usize {
        self.inner() + 1
    }

    /// Cosine and Stokes component of each row.
    pub fn of_rows(&self) -> Vec<(f64, usize)> {
        (0..self.rows()).map(|i| (self.cosine[i / self.stokes], i % self.stokes)).collect()
    }

    /// Cosine and Stokes component of each column.
    pub fn of_columns(&self) -> Vec<(f64, usize)> {
        let inner = self.of_rows().into_iter().take(self.inner());
        inner.chain([(self.sun(), 0)]).collect()
    }

    /// Weight of each component of the nodes.
    pub fn weights(&self) -> Vec<f64> {
        (0..self.inner()).map(|i| self.weight[i / self.stokes]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fluxes through a plane are ∫μ dμ = 1/2; rows are nodes and views, the sun is the last column.
    #[test]
    fn a_hemisphere() {
        let directions = Directions::new(5, 3, &[1.0, 0.2], 0.4);
        let flux: f64 =
            directions.nodes().iter().zip(&directions.weight).map(|(mu, w)| mu * w).sum();
        assert!((flux - 0.5).abs() < 1e-15);
        assert_eq!((directions.inner(), directions.rows(), directions.columns()), (15, 21, 16));
        assert_eq!(directions.of_rows()[16], (1.0, 1));
        assert_eq!(directions.of_columns()[15], (0.4, 0));
    }
}
