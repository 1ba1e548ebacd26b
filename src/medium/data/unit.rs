//! The quantity that a file of optical data counts wavelengths in: a length, a wavenumber, a photon
//! energy or a frequency, from the names people give such columns.

/// The unit of a file's first column. All stand for a wavelength in vacuum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    Nanometre,
    Micrometre,
    Millimetre,
    Metre,
    Angstrom,
    PerCentimetre,
    PerMetre,
    ElectronVolt,
    Hertz,
    Gigahertz,
    Terahertz,
}

/// Speed of light, m/s, and `hc` in eV m (CODATA 2018, exact).
const LIGHT: f64 = 299_792_458.0;
const ENERGY: f64 = 1.239_841_984_332_002_6e-6;

impl Unit {
    /// The unit of a name such as `nm`, `um`, `µm`, `Å`, `cm-1`, `eV`, `THz`, in small letters.
    pub(in crate::medium) fn parse(text: &str) -> Option<Self> {
        Some(match text {
            "nm" | "nanometre" | "nanometer" | "nanometres" | "nanometers" => Self::Nanometre,
            "um" | "µm" | "μm" | "micron" | "microns" | "micrometre" | "micrometer"
            | "micrometres" | "micrometers" => Self::Micrometre,
            "mm" | "millimetre" | "millimeter" | "millimetres" | "millimeters" => Self::Millimetre,
            "m" | "metre" | "meter" | "metres" | "meters" => Self::Metre,
            "å" | "\u{212b}" | "a\u{30a}" | "angstrom" | "angstroms" | "ångström" | "ångstrom" => {
                Self::Angstrom
            }
            "cm-1" | "cm^-1" | "cm**-1" | "cm⁻¹" | "1/cm" => Self::PerCentimetre,
            "m-1" | "m^-1" | "m**-1" | "m⁻¹" | "1/m" => Self::PerMetre,
            "ev" => Self::ElectronVolt,
            "hz" => Self::Hertz,
            "ghz" => Self::Gigahertz,
            "thz" => Self::Terahertz,
            _ => return None,
        })
    }

    pub(in crate::medium) fn symbol(self) -> &'static str {
        match self {
            Self::Nanometre => "nm",
            Self::Micrometre => "µm",
            Self::Millimetre => "mm",
            Self::Metre => "m",
            Self::Angstrom => "Å",
            Self::PerCentimetre => "cm⁻¹",
            Self::PerMetre => "m⁻¹",
            Self::ElectronVolt => "eV",
            Self::Hertz => "Hz",
            Self::Gigahertz => "GHz",
            Self::Terahertz => "THz",
        }
    }

    /// Wavelength in metres. Division keeps round numbers round (589.3 / 1e9).
    pub(in crate::medium) fn to_metres(self, value: f64) -> f64 {
        match self {
            Self::Nanometre => value / 1e9,
            Self::Micrometre => value / 1e6,
            Self::Millimetre => value / 1e3,
            Self::Metre => value,
            Self::Angstrom => value / 1e10,
            Self::PerCentimetre => 0.01 / value,
            Self::PerMetre => 1.0 / value,
            Self::ElectronVolt => ENERGY / value,
            Self::Hertz => LIGHT / value,
            Self::Gigahertz => LIGHT / 1e9 / value,
            Self::Terahertz => LIGHT / 1e12 / value,
        }
    }

    /// The unit that a wavelength would be in the range of, were the file's numbers in it: what to
    /// suspect where a wavelength lies outside (metres).
    pub(in crate::medium) fn suspect(self, wavelength: f64, range: (f64, f64)) -> Option<Self> {
        let lengths = [Self::Nanometre, Self::Micrometre, Self::Angstrom, Self::Metre];
        if !lengths.contains(&self) {
            return None;
        }
        lengths.into_iter().filter(|unit| *unit != self).find(|unit| {
            let scale = unit.to_metres(1.0) / self.to_metres(1.0);
            (scale * range.0..=scale * range.1).contains(&wavelength)
        })
    }

    /// The unit in the name of a column: `wavelength_nm`, `Wavelength (µm)`, `lambda/nm`, `E [eV]`,
    /// `wavenumber cm^-1`, `f (THz)`; a bare `wl` is that of refractiveindex.info, in micrometres.
    pub(in crate::medium) fn of_column(name: &str) -> Option<Self> {
        let lower = name.to_lowercase();
        if lower.trim() == "wl" {
            return Some(Self::Micrometre);
        }
        // The stroke separates (`lambda/nm`) but in 1/cm and 1/m.
        let lower = lower.replace("1/cm", "cm-1").replace("1/m", "m-1");
        let words: Vec<&str> =
            lower.split(|c: char| "()[]{}_/,:; ".contains(c)).filter(|w| !w.is_empty()).collect();
        let (last, quantity) = words.split_last()?;
        let unit = Self::parse(last)?;
        let fits: &[&str] = match unit {
            Self::PerCentimetre | Self::PerMetre => {
                &["wavenumber", "wave", "number", "k0", "ν", "nu"]
            }
            Self::ElectronVolt => &["photon", "energy", "e", "ev"],
            Self::Hertz | Self::Gigahertz | Self::Terahertz => {
                &["frequency", "freq", "f", "ν", "nu"]
            }
            _ => &["wavelength", "wave", "length", "lambda", "λ", "wl", "vacuum", "wvl", "wavel"],
        };
        let free = ["in", "vacuum"];
        quantity.iter().all(|w| fits.contains(w) || free.contains(w)).then_some(unit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn five_hundred_nanometres_in_every_unit() {
        let cases = [
            ("wavelength_nm", 500.0),
            ("Wavelength (µm)", 0.5),
            ("lambda/um", 0.5),
            ("wl", 0.5),
            ("wl [mm]", 5e-4),
            ("vacuum wavelength in m", 5e-7),
            ("Wavelength, Å", 5000.0),
            ("wavelength_angstrom", 5000.0),
            ("wavenumber_cm-1", 20_000.0),
            ("Wavenumber (1/cm)", 20_000.0),
            ("wavenumber [m^-1]", 2e6),
            ("Photon energy (eV)", 2.479_683_968_664),
            ("E_eV", 2.479_683_968_664),
            ("frequency_Hz", 5.995_849_16e14),
            ("f (GHz)", 5.995_849_16e5),
            ("frequency (THz)", 599.584_916),
        ];
        for (name, value) in cases {
            let unit = Unit::of_column(name).unwrap_or_else(|| panic!("{name}"));
            let metres = unit.to_metres(value);
            assert!((metres - 500e-9).abs() < 1e-20, "{name}: {metres:e}");
        }
        for name in ["wavelength", "n", "energy_nm", "wavelength in air (nm)", "frequency_eV", ""] {
            assert_eq!(Unit::of_column(name), None, "{name}");
        }
    }

    #[test]
    fn a_wrong_unit_is_suspected_where_the_wavelength_would_then_be_inside() {
        let micro = Unit::Micrometre;
        assert_eq!(micro.suspect(550e-9, (400e-6, 700e-6)), Some(Unit::Nanometre));
        assert_eq!(Unit::Nanometre.suspect(550e-9, (0.4e-9, 0.7e-9)), Some(micro));
        assert_eq!(micro.suspect(550e-9, (0.6e-6, 0.7e-6)), None);
        assert_eq!(Unit::ElectronVolt.suspect(550e-9, (1e-3, 2e-3)), None);
    }
}
