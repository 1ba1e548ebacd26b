//! Ranges as they are typed, the same everywhere: `FROM:TO:n400` has 400 values, both ends in; `FROM:TO:s0.5` has
//! steps of 0.5. Without a letter the third number is what the flag or key has had ever since, a number of values or a
//! step, as its help says.

/// What the third part of a range is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Third {
    /// The number of values, both ends among them.
    Count(f64),
    /// The distance from one to the next.
    Step(f64),
}

/// What a number stands for: one of the cases of [`Third`].
type Kind = fn(f64) -> Third;

/// A range as typed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// First value.
    pub from: f64,
    /// Last value, or what the last does not pass.
    pub to: f64,
    /// How many values there are.
    pub third: Third,
}

/// Shares of a step by which rounding may miss the last value: 380:780:0.1 shall hold 780.
const ROUNDING: (f64, f64) = (1e-12, 1e-9);

impl Range {
    /// Of three words; the third is of the kind of `usual` where no letter tells.
    ///
    /// ```
    /// use gonio::scene::{Range, Third};
    /// let range = Range::parse(["0", "180", "s0.5"], Third::Count).unwrap();
    /// assert_eq!((range.third, range.steps()), (Third::Step(0.5), 360.0));
    /// assert_eq!(Range::parse(["0", "1", "5"], Third::Count).unwrap().step(), 0.25);
    /// assert_eq!(Range::parse(["0", "1", "x5"], Third::Count), Err("x5"));
    /// ```
    ///
    /// # Errors
    /// The word that is no finite number.
    pub fn parse(words: [&str; 3], usual: Kind) -> Result<Self, &str> {
        let [from, to, third] = words;
        let kinds: [(&str, Kind); 2] = [("n", Third::Count), ("s", Third::Step)];
        let lettered = kinds.into_iter().find_map(|(letter, kind)| {
            third.trim().strip_prefix(letter).map(|rest| number(rest).map(kind))
        });
        let third = match lettered {
            Some(found) => found,
            None => number(third).map(usual),
        };
        let third = third.ok_or(words[2])?;
        Ok(Self { from: number(from).ok_or(from)?, to: number(to).ok_or(to)?, third })
    }

    /// Distance from one value to the next; of one value 0.
    pub fn step(&self) -> f64 {
        match self.third {
            Third::Step(step) => step,
            Third::Count(1.0) => 0.0,
            Third::Count(count) => (self.to - self.from) / (count - 1.0),
        }
    }

    /// Number of steps from the first value to the last; below 0 or no number where they lead away.
    pub fn steps(&self) -> f64 {
        match self.third {
            Third::Step(step) => {
                ((self.to - self.from) / step * (1.0 + ROUNDING.0) + ROUNDING.1).floor()
            }
            Third::Count(count) => count - 1.0,
        }
    }

    /// The values, as many as [`Range::steps`] says, and one.
    pub fn values(self) -> impl Iterator<Item = f64> {
        (0..=self.steps() as usize).map(move |i| self.from + i as f64 * self.step())
    }
}

/// The finite number that a word is.
fn number(word: &str) -> Option<f64> {
    word.trim().parse::<f64>().ok().filter(|value| value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(words: [&str; 3], usual: fn(f64) -> Third) -> Vec<f64> {
        Range::parse(words, usual).unwrap().values().collect()
    }

    #[test]
    fn letters_tell_what_the_third_number_is() {
        let [count, step] = [["1", "2", "n3"], ["1", "2", "s0.5"]];
        for usual in [Third::Count as fn(f64) -> Third, Third::Step] {
            assert_eq!(values(count, usual), [1.0, 1.5, 2.0]);
            assert_eq!(values(step, usual), [1.0, 1.5, 2.0]);
        }
        assert_eq!(values(["1", "2", "3"], Third::Count).len(), 3);
        assert_eq!(values(["1", "4", "3"], Third::Step), [1.0, 4.0]);
        assert_eq!(values(["2", "1", "s-0.5"], Third::Count), [2.0, 1.5, 1.0]);
        assert_eq!(values(["2", "2", "n1"], Third::Step), [2.0]);
        // a step that does not divide ends before
        assert_eq!(values(["0", "1", "s0.4"], Third::Count), [0.0, 0.4, 0.8]);
    }

    #[test]
    fn words_that_are_no_numbers_are_named() {
        assert_eq!(Range::parse(["a", "1", "2"], Third::Count), Err("a"));
        assert_eq!(Range::parse(["1", "inf", "2"], Third::Count), Err("inf"));
        assert_eq!(Range::parse(["1", "2", "n"], Third::Count), Err("n"));
    }
}
