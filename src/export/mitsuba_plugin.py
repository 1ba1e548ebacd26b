"""Mitsuba 3 phase function from a gonio table: mean over azimuth, every wavelength.

Use in a spectral variant (llvm_ad_spectral, scalar_spectral):

    import mitsuba as mi
    mi.set_variant("llvm_ad_spectral")
    import gonio_phase                      # registers the plugin "gonio"
    phase = {"type": "gonio", "filename": "phase.csv"}
"""

import drjit as dr
import mitsuba as mi
import numpy as np

SAMPLES = 14401  # per wavelength, uniform in the scattering angle: 1/80 degree


class GonioPhase(mi.PhaseFunction):
    """P(theta, wavelength) in 1/sr from phase.csv; linear between samples and wavelengths."""

    def __init__(self, props):
        mi.PhaseFunction.__init__(self, props)
        path = str(props["filename"])
        with open(path) as file:
            self.nm = np.array([float(word) for word in file.readline().split(",")[1:]])
        rows = np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
        theta = np.arccos(np.clip(rows[::-1, 0], -1.0, 1.0))
        even = np.linspace(0.0, np.pi, SAMPLES)
        values = [np.interp(even, theta, rows[::-1, 1 + i]) for i in range(len(self.nm))]
        # One uniform axis of wavelengths makes the look-up a multiplication.
        self.low, self.high = float(self.nm[0]), float(self.nm[-1])
        self.lines = max(2, int(np.ceil((self.high - self.low) / 2.0)) + 1)
        wanted = np.linspace(self.low, self.high, self.lines)
        table = np.array(values)
        table = np.array([np.interp(wanted, self.nm, table[:, j]) for j in range(SAMPLES)]).T
        self.table = mi.Float(np.ascontiguousarray(table, dtype=np.float32).ravel()) \
            if not mi.variant().startswith("scalar") else table.ravel()
        self.m_flags = mi.PhaseFunctionFlags.Anisotropic

    def _look_up(self, line, sample):
        index = line * SAMPLES + sample
        if isinstance(self.table, np.ndarray):
            return float(self.table[int(index)])
        return dr.gather(mi.Float, self.table, index)

    def _value(self, cosine, wavelengths, active):
        x = dr.acos(dr.clip(cosine, -1.0, 1.0)) / dr.pi * (SAMPLES - 1)
        i = dr.clip(mi.UInt32(x), 0, SAMPLES - 2)
        t = x - mi.Float(i)
        result = mi.UnpolarizedSpectrum(0.0)
        for c in range(len(wavelengths)):
            y = (wavelengths[c] - self.low) / (self.high - self.low) * (self.lines - 1)
            inside = (y >= 0.0) & (y <= self.lines - 1)
            y = dr.clip(y, 0.0, self.lines - 1.0)
            j = dr.clip(mi.UInt32(y), 0, self.lines - 2)
            s = y - mi.Float(j)
            low = self._look_up(j, i) * (1 - t) + self._look_up(j, i + 1) * t
            high = self._look_up(j + 1, i) * (1 - t) + self._look_up(j + 1, i + 1) * t
            result[c] = dr.select(inside, low * (1 - s) + high * s, 0.0)
        return result & active

    def sample(self, ctx, mei, sample1, sample2, active=True):
        wo = mi.warp.square_to_uniform_sphere(sample2)
        pdf = mi.Float(1.0 / (4.0 * np.pi))
        # mei.wi points back to the light: cos(scattering angle) = -wi . wo
        weight = self._value(-dr.dot(mei.wi, wo), mei.wavelengths, active) / pdf
        return wo, weight, pdf

    def eval_pdf(self, ctx, mei, wo, active=True):
        value = self._value(-dr.dot(mei.wi, wo), mei.wavelengths, active)
        return value, dr.select(active, mi.Float(1.0 / (4.0 * np.pi)), 0.0)

    def to_string(self):
        return f"GonioPhase[{len(self.nm)} wavelengths, {self.low} to {self.high} nm]"


mi.register_phasefunction("gonio", GonioPhase)
