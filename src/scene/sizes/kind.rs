//! The kinds of distributions and the names of their keys.

/// A kind with the keys it knows.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Kind {
    pub name: &'static str,
    /// Lengths; `{}` stands for `radius` or `diameter`, a unit follows.
    lengths: &'static [&'static str],
    /// Everything else.
    others: &'static [&'static str],
    /// Whether it takes limits.
    limits: bool,
}

const LIMITS: [&str; 2] = ["from_{}", "to_{}"];

const fn kind(
    name: &'static str,
    lengths: &'static [&'static str],
    others: &'static [&'static str],
) -> Kind {
    Kind { name, lengths, others, limits: true }
}

const KINDS: [Kind; 12] = [
    Kind { name: "delta", lengths: &["{}"], others: &[], limits: false },
    kind("normal", &["mean_{}", "deviation"], &[]),
    kind("log-normal", &["median_{}"], &["spread", "geometric_standard_deviation", "by"]),
    kind("gamma", &["effective_{}"], &["effective_variance"]),
    kind("modified-gamma", &["mode_{}"], &["alpha", "gamma", "b"]),
    kind("exponential", &["mean_{}"], &["slope_per_mm"]),
    kind("marshall-palmer", &[], &["rain_rate_mm_h"]),
    kind("normalised-gamma", &["median_volume_{}", "mass_weighted_{}"], &["mu"]),
    kind("power-law", &[], &["exponent"]),
    kind("rosin-rammler", &["{}"], &["exponent"]),
    kind("histogram", &["edges_{}"], &["number", "file"]),
    kind("table", &[], &["file"]),
];

/// Units of lengths, and metres in them.
const UNITS: [(&str, f64); 3] = [("um", 1e-6), ("mm", 1e-3), ("nm", 1e-9)];

/// All names of a length with the metres of radius in one unit of it.
pub(super) fn spellings(base: &str) -> Vec<(String, f64)> {
    let what: &[(&str, f64)] =
        if base.contains("{}") { &[("radius", 1.0), ("diameter", 0.5)] } else { &[("", 1.0)] };
    let each = |&(word, half): &(&str, f64)| {
        UNITS.map(|(unit, metres)| (format!("{}_{unit}", base.replace("{}", word)), half * metres))
    };
    what.iter().flat_map(each).collect()
}

impl Kind {
    pub(super) fn of_table(keys: &toml::Table) -> Result<&'static Kind, String> {
        let name = match keys.get("kind") {
            None => return Err("missing field `kind`".into()),
            Some(toml::Value::String(name)) => name,
            Some(other) => return Err(format!("kind = {other}: {} is accepted", others(""))),
        };
        let unknown = || {
            let names: Vec<String> = KINDS.iter().map(|kind| format!("`{}`", kind.name)).collect();
            format!("unknown variant `{name}`, expected one of {}", names.join(", "))
        };
        KINDS.iter().find(|kind| kind.name == name).ok_or_else(unknown)
    }

    fn bases(&self) -> impl Iterator<Item = &'static str> {
        let limits: &[&str] = if self.limits { &LIMITS } else { &[] };
        self.lengths.iter().chain(limits).copied()
    }

    pub(super) fn knows(&self, key: &str) -> bool {
        self.others.contains(&key)
            || self.bases().any(|base| spellings(base).iter().any(|(name, _)| name == key))
    }

    /// The keys for a message: lengths as radii in micrometres.
    pub(super) fn words(&self) -> String {
        let lengths = self.bases().map(|base| base.replace("{}", "radius") + "_um");
        let others = self.others.iter().map(|name| (*name).to_string());
        let mut names: Vec<String> =
            lengths.chain(others).map(|name| format!("`{name}`")).collect();
        if self.bases().any(|base| base.contains("{}")) {
            names.push("(lengths also as `diameter`, in `_mm` or `_nm`)".into());
        }
        names.join(", ")
    }
}

/// The names of all kinds but one.
pub(super) fn others(name: &str) -> String {
    let names: Vec<&str> = KINDS.iter().map(|kind| kind.name).filter(|one| *one != name).collect();
    names.join(", ")
}
