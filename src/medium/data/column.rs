//! The columns that optical data may have, and what may stand in them: n is positive, k and absorbance are
//! not negative.

/// A column of values besides the wavelength.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::medium) enum Column {
    N,
    K,
    Absorbance,
}

impl Column {
    pub(in crate::medium) fn name(self) -> &'static str {
        match self {
            Self::N => "n",
            Self::K => "k",
            Self::Absorbance => "absorbance",
        }
    }

    /// Whether a value below zero may be noise about zero.
    pub(in crate::medium) fn is_absorption(self) -> bool {
        self != Self::N
    }

    /// Refuses a value that the column cannot hold.
    pub(in crate::medium) fn check(self, value: f64) -> Result<(), String> {
        if !value.is_finite() {
            return Err(format!("{value} is not a finite number"));
        }
        let (accepted, bound) = match self {
            Self::N => (
                (1e-4..=1e4).contains(&value),
                if value <= 0.0 { "positive" } else { "1e-4 to 1e4" },
            ),
            Self::K => (
                (0.0..=1e4).contains(&value),
                if value > 0.0 { "at most 1e4" } else { "0 or more" },
            ),
            Self::Absorbance => (value >= 0.0, "0 or more"),
        };
        if accepted {
            return Ok(());
        }
        // Three hundred digits would help nobody.
        let value = if value < 1e15 { value.to_string() } else { format!("{value:e}") };
        Err(format!("{} = {value} must be {bound}", self.name()))
    }
}
