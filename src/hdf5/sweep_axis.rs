//! The swept dimensions of a file of many tables, and the place of a table in it.

/// Values along a swept dimension.
#[derive(Clone, Debug, PartialEq)]
pub enum AxisValues {
    /// Numbers, ascending or not.
    Numbers(Vec<f64>),
    /// Words, such as names of media.
    Texts(Vec<String>),
}

/// A coordinate of a swept dimension.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepCoordinate {
    /// Name of the variable, such as `radius_um`.
    pub name: String,
    /// Units after UDUNITS; empty for text.
    pub units: String,
    /// One per table along the dimension.
    pub values: AxisValues,
}

/// A swept dimension: it bears the name of its first coordinate, paired values follow.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepAxis {
    /// Further values along the same dimension.
    pub coordinates: Vec<SweepCoordinate>,
}

impl SweepAxis {
    /// Number of values.
    pub fn len(&self) -> usize {
        self.coordinates.first().map_or(0, |coordinate| match &coordinate.values {
            AxisValues::Numbers(values) => values.len(),
            AxisValues::Texts(values) => values.len(),
        })
    }

    /// True where the dimension has no value.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    pub(super) fn name(&self) -> &str {
        self.coordinates.first().map_or("", |coordinate| &coordinate.name)
    }
}

/// Index per axis of a table by its number, in a sweep of this shape; the last axis is the fastest.
pub fn position_of(number: usize, shape: &[usize]) -> Vec<usize> {
    let mut rest = number;
    let mut position = vec![0; shape.len()];
    for (index, length) in position.iter_mut().zip(shape).rev() {
        *index = rest % length;
        rest /= length;
    }
    position
}
