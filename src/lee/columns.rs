//! The columns of a diagram, each on its own: spheres by Lorenz–Mie, raindrops by rays.

use super::largest_first::largest_first;
use super::{Diagram, LeeError, Raindrops, Request, airy_spheres, spheres};

/// What stands in the columns.
#[derive(Clone, Debug)]
pub enum Bodies {
    /// Spheres, by Lorenz–Mie.
    Spheres,
    /// Spheres, by Airy's theory of both bows.
    Airy,
    /// Falling raindrops, by rays.
    Raindrops(Raindrops),
}

/// All columns, the largest drops first, since they take longest; `done` hears of each as it ends.
///
/// # Errors
/// Those of [`spheres`], and drops that rays cannot serve.
pub fn columns(
    request: &Request,
    bodies: &Bodies,
    done: impl Fn() + Sync,
) -> Result<Diagram, LeeError> {
    let columns = largest_first(&request.radii, |radius| {
        let one = Request { radii: vec![radius], ..request.clone() };
        let column = match bodies {
            Bodies::Airy => airy_spheres(&one)?,
            Bodies::Raindrops(drops) if drops.is_flattened(radius)? => drops.diagram(&one)?,
            _ => spheres(&one)?,
        };
        done();
        Ok::<_, LeeError>(column.xyz)
    })?;
    Ok(Diagram {
        radii: request.radii.clone(),
        theta: request.theta.clone(),
        xyz: columns.into_iter().flatten().collect(),
    })
}
