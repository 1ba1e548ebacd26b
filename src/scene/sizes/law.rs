//! From keys to a law of sizes between its limits.

use super::columns::{self, Columns};
use super::{Length, SizeKeys, kind, within};
use crate::size_distribution::{SizeDistribution, SizeLaw};
use std::path::Path;
use std::sync::Arc;

impl SizeKeys {
    /// In metres, every number within what is accepted; files are looked for in `folder`.
    ///
    /// # Errors
    /// The first number that is not, and what would be.
    pub fn checked(&self, folder: &Path) -> Result<SizeDistribution, String> {
        let law = self.law(folder)?;
        if let SizeLaw::Delta { radius } = law {
            return Ok(SizeDistribution::delta(radius));
        }
        let limit = |base| self.length(base)?.map(Length::checked).transpose();
        let (from, to) = (limit("from_{}")?, limit("to_{}")?);
        if let (Some(from), Some(to)) = (&from, &to)
            && from.radius() >= to.radius()
        {
            return Err(format!(
                "{} = {} and {} = {}: the first must be less than the second",
                from.key, from.value, to.key, to.value
            ));
        }
        let metres =
            |limit: &Option<Length>, none: f64| limit.as_ref().map_or(none, Length::radius);
        SizeDistribution::between(law, metres(&from, 0.0), metres(&to, f64::INFINITY))
            .map_err(|error| error.to_string())
    }

    fn law(&self, folder: &Path) -> Result<SizeLaw, String> {
        Ok(match self.kind()?.name {
            "delta" => SizeLaw::Delta { radius: self.radius("{}")?.radius() },
            "normal" => self.normal()?,
            "log-normal" => self.log_normal()?,
            "gamma" => SizeLaw::gamma(
                self.radius("effective_{}")?.radius(),
                self.needed("effective_variance", (1e-6, 0.45))?,
            ),
            "modified-gamma" => self.modified_gamma()?,
            "exponential" => self.exponential()?,
            "marshall-palmer" => {
                SizeLaw::marshall_palmer(self.needed("rain_rate_mm_h", (1e-3, 1e3))?)
            }
            "normalised-gamma" => self.normalised_gamma()?,
            "power-law" => SizeLaw::PowerExponential {
                exponent: self.needed("exponent", (-20.0, 20.0))?,
                scale: f64::INFINITY,
                power: 1.0,
            },
            "rosin-rammler" => {
                // of the volume `1 - exp(-(D/X)^q)` lies below D: the number goes as D^(q-4) exp(…)
                let power = self.needed("exponent", (0.3, 20.0))?;
                let scale = self.radius("{}")?.radius();
                SizeLaw::PowerExponential { exponent: power - 4.0, scale, power }
            }
            "histogram" => self.histogram(folder)?,
            _ => self.table(folder)?,
        })
    }

    fn normal(&self) -> Result<SizeLaw, String> {
        let mean = self.radius("mean_{}")?;
        let missing = || "missing field `deviation_um`".to_string();
        let deviation = self.length("deviation")?.ok_or_else(missing)?;
        // of the same length as the mean: of diameters, if that is one
        let half = if mean.key.contains("diameter") { 0.5 } else { 1.0 };
        let metres = deviation.unit * half;
        let end = |share: f64| share * mean.radius() / metres;
        within(&deviation.key, deviation.value, (end(1e-4), end(0.5)))?;
        Ok(SizeLaw::Normal { mean: mean.radius(), deviation: deviation.value * metres })
    }

    fn log_normal(&self) -> Result<SizeLaw, String> {
        let median = self.radius("median_{}")?.radius();
        let spread = match (self.number("spread")?, self.number("geometric_standard_deviation")?) {
            (Some(_), Some(_)) => {
                return Err("spread and geometric_standard_deviation say the same; keep one".into());
            }
            (None, Some(sigma)) => {
                within("geometric_standard_deviation", sigma, (1.0001, 2.72))?.ln()
            }
            _ => self.needed("spread", (1e-4, 1.0))?,
        };
        let power = match self.text("by")?.unwrap_or("number") {
            "number" => 0.0,
            "area" => 2.0,
            "volume" => 3.0,
            other => return Err(format!("by = \"{other}\": number, area or volume is accepted")),
        };
        Ok(SizeLaw::LogNormal { median: median * (-power * spread * spread).exp(), spread })
    }

    /// `r^α exp(-b r^γ)`, r in µm.
    fn modified_gamma(&self) -> Result<SizeLaw, String> {
        let exponent = self.needed("alpha", (-0.99, 1000.0))?;
        let power = self.needed("gamma", (0.05, 20.0))?;
        let scale = match (self.number("b")?, self.length("mode_{}")?) {
            (Some(_), Some(mode)) => {
                return Err(format!("{} and b say the same; keep one", mode.key));
            }
            (Some(b), None) => 1e-6 * within("b", b, (1e-30, 1e30))?.powf(-1.0 / power),
            (None, Some(mode)) => {
                within("alpha", exponent, (1e-3, 1000.0))?;
                mode.checked()?.radius() * (exponent / power).powf(-1.0 / power)
            }
            (None, None) => return Err("missing field `mode_radius_um` or `b`".into()),
        };
        Ok(SizeLaw::PowerExponential { exponent, scale, power })
    }

    fn exponential(&self) -> Result<SizeLaw, String> {
        let scale = match (self.number("slope_per_mm")?, self.length("mean_{}")?) {
            (Some(_), Some(mean)) => {
                return Err(format!("{} and slope_per_mm say the same; keep one", mean.key));
            }
            (Some(slope), None) => 0.5e-3 / within("slope_per_mm", slope, (1e-2, 1e6))?,
            (None, Some(mean)) => mean.checked()?.radius(),
            (None, None) => return Err("missing field `mean_radius_um` or `slope_per_mm`".into()),
        };
        Ok(SizeLaw::PowerExponential { exponent: 0.0, scale, power: 1.0 })
    }

    /// `D^μ exp(-(3.67 + μ) D/D₀)`, or `exp(-(4 + μ) D/D_m)`.
    fn normalised_gamma(&self) -> Result<SizeLaw, String> {
        let exponent = self.needed("mu", (-0.99, 100.0))?;
        let scale = match (self.length("median_volume_{}")?, self.length("mass_weighted_{}")?) {
            (Some(a), Some(b)) => return Err(format!("{} and {}: keep one", a.key, b.key)),
            (Some(median), None) => median.checked()?.radius() / (3.67 + exponent),
            (None, Some(mean)) => mean.checked()?.radius() / (4.0 + exponent),
            (None, None) => {
                let names = "`median_volume_diameter_mm` or `mass_weighted_diameter_mm`";
                return Err(format!("missing field {names}"));
            }
        };
        Ok(SizeLaw::PowerExponential { exponent, scale, power: 1.0 })
    }

    /// Counts per bin, evenly by radius inside each.
    fn histogram(&self, folder: &Path) -> Result<SizeLaw, String> {
        let (edges, number) = match self.text("file")? {
            Some(file) => {
                if self.keys.len() > 2 + self.limits() {
                    return Err("file holds edges and numbers; leave out the lists".into());
                }
                Columns::read(&folder.join(file))?.bins()?
            }
            None => (self.edges()?, self.list("number")?.ok_or("missing field `number`")?),
        };
        columns::ascend("edges", &edges)?;
        columns::counts("number", &number)?;
        if number.len() + 1 != edges.len() {
            let bins = edges.len().saturating_sub(1);
            return Err(format!(
                "number: {} numbers for {} edges, which bound {bins} bins",
                number.len(),
                edges.len()
            ));
        }
        Ok(SizeLaw::Histogram { edges: Arc::from(edges), numbers: Arc::from(number) })
    }

    /// How many limits are written.
    fn limits(&self) -> usize {
        self.keys.keys().filter(|key| key.starts_with("from_") || key.starts_with("to_")).count()
    }

    fn edges(&self) -> Result<Vec<f64>, String> {
        for (key, unit) in kind::spellings("edges_{}") {
            if let Some(list) = self.list(&key)? {
                return Ok(list.into_iter().map(|value| value * unit).collect());
            }
        }
        Err("missing field `edges_radius_um`".into())
    }

    /// Number per radius, straight lines between the rows of a file.
    fn table(&self, folder: &Path) -> Result<SizeLaw, String> {
        let file = self.text("file")?.ok_or("missing field `file`")?;
        let (radii, densities) = Columns::read(&folder.join(file))?.densities()?;
        columns::ascend("radii", &radii)?;
        columns::counts("number", &densities)?;
        Ok(SizeLaw::Table { radii: Arc::from(radii), densities: Arc::from(densities) })
    }
}
