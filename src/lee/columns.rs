//! The columns of a diagram, each on its own: spheres by Lorenz–Mie, raindrops by rays.

use super::{Diagram, LeeError, Raindrops, Request, spheres};
use rayon::prelude::*;

/// What stands in the columns.
#[derive(Clone, Debug)]
pub enum Bodies {
    Spheres,
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
    let mut order: Vec<usize> = (0..request.radii.len()).collect();
    order.sort_by(|&i, &j| request.radii[j].total_cmp(&request.radii[i]));
    let mut columns = order
        .par_iter()
        .with_max_len(1)
        .map(|&i| {
            let one = Request { radii: vec![request.radii[i]], ..request.clone() };
            let column = match bodies {
                Bodies::Raindrops(drops) if drops.is_flattened(one.radii[0])? => {
                    drops.diagram(&one)?
                }
                _ => spheres(&one)?,
            };
            done();
            Ok((i, column.xyz))
        })
        .collect::<Result<Vec<_>, LeeError>>()?;
    columns.sort_by_key(|(i, _)| *i);
    Ok(Diagram {
        radii: request.radii.clone(),
        theta: request.theta.clone(),
        xyz: columns.into_iter().flat_map(|(_, column)| column).collect(),
    })
}
