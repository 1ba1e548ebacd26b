//! The columns of a diagram in parallel, the largest drops first, since they take longest.

use crate::math::parallel::*;

/// What `column` makes of each radius, in the order of the radii.
///
/// # Errors
/// Those of `column`.
pub(super) fn largest_first<T: Send, E: Send>(
    radii: &[f64],
    column: impl Fn(f64) -> Result<T, E> + Sync,
) -> Result<Vec<T>, E> {
    let mut order: Vec<usize> = (0..radii.len()).collect();
    order.sort_by(|&i, &j| radii[j].total_cmp(&radii[i]));
    let mut columns = order
        .par_iter()
        .with_max_len(1)
        .map(|&i| Ok((i, column(radii[i])?)))
        .collect::<Result<Vec<_>, E>>()?;
    columns.sort_by_key(|(i, _)| *i);
    Ok(columns.into_iter().map(|(_, column)| column).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_come_in_the_order_of_the_radii() {
        let radii = [0.3, 2.0, 0.1, 1.0];
        let twice = largest_first(&radii, |radius| Ok::<_, ()>(2.0 * radius)).unwrap();
        assert_eq!(twice, [0.6, 4.0, 0.2, 2.0]);
        assert_eq!(largest_first(&radii, |r| if r > 1.5 { Err(r) } else { Ok(r) }), Err(2.0));
    }
}
