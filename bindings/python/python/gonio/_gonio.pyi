from collections.abc import Callable
from pathlib import Path
from typing import Any

__version__: str

class Scene:
    def __init__(
        self, *, path: str | None = None, toml: str | None = None, json: str | None = None
    ) -> None: ...
    @property
    def toml(self) -> str: ...
    @property
    def files(self) -> list[Path]: ...
    @property
    def notes(self) -> list[str]: ...
    @property
    def wavelengths(self) -> int: ...
    def plan(self, threads: int | None) -> str: ...
    def table(
        self, *, command_line: str, threads: int | None = None, progress: Callable[[int], None] | None = None
    ) -> dict[str, Any]: ...
    def scatter(
        self, wavelength_nm: list[float], theta_deg: list[float], azimuth_deg: list[float], threads: int | None = None
    ) -> dict[str, Any]: ...

class Medium:
    def __init__(self, *, name: str | None = None, json: str | None = None) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def source(self) -> str: ...
    @property
    def notes(self) -> list[str]: ...
    @property
    def range_nm(self) -> tuple[float, float]: ...
    @property
    def abbe(self) -> tuple[float, float] | None: ...
    def index(self, wavelength_nm: Any) -> Any: ...

class TMatrix:
    def __init__(
        self,
        x: float,
        m: complex,
        *,
        shape: str,
        axis_ratio: str | None,
        diameter_mm: float,
        model: str | None,
        tolerance: float,
        threads: int | None,
    ) -> None: ...
    @property
    def error(self) -> float: ...
    @property
    def solver(self) -> tuple[str, int]: ...
    def amplitudes(self, theta_deg: Any, azimuth_deg: Any, elevation_deg: float) -> list[Any]: ...
    def efficiencies(self, elevation_deg: float) -> list[float]: ...
    def random(self, tolerance: float, threads: int | None) -> RandomMean: ...

class RandomMean:
    @property
    def efficiencies(self) -> list[float]: ...
    def coefficients(self) -> Any: ...
    def elements(self, theta_deg: Any) -> Any: ...

def media() -> list[tuple[str, str, str]]: ...
def threads(threads: int | None = None) -> int: ...
def mie_amplitudes(x: Any, m: Any, theta_deg: Any, threads: int | None = None) -> Any: ...
def mie_efficiencies(x: Any, m: Any, threads: int | None = None) -> tuple[Any, Any, Any, Any, Any]: ...
def mie_legendre(x: Any, m: Any, count: int | None = None, threads: int | None = None) -> Any: ...
def debye_amplitudes(x: Any, m: Any, theta_deg: Any, order: Any, threads: int | None = None) -> tuple[Any, Any]: ...
def lee(
    *,
    radius_mm: list[float],
    theta_deg: list[float],
    shape: str,
    medium_name: str | None,
    medium_json: str | None,
    sun_elevation_deg: float,
    azimuth_deg: float,
    polarisation: str,
    sun_disc: bool,
    size_spread: float,
    illuminant: str,
    observer: str,
    fineness: float,
    threads: int | None,
    progress: Callable[[int], None] | None,
) -> tuple[Any, Any, Any]: ...
def colour_weights(wavelength_nm: list[float], illuminant: str, observer: str) -> Any: ...
def srgb_of(xyz: Any, exposure: float) -> Any: ...
def radar(
    *,
    band: list[str] | None,
    frequency_ghz: list[float] | None,
    wavelength_mm: list[float] | None,
    temperature_c: list[float],
    water: str,
    index: complex | None,
    diameter_mm: list[float] | None,
    number_per_m3: list[float],
    together: bool,
    marshall_palmer_mm_h: float | None,
    exponential: tuple[float, float] | None,
    normalised_gamma: tuple[float, float, float] | None,
    from_diameter_mm: float | None,
    to_diameter_mm: float | None,
    shape: str,
    model: str | None,
    axis_ratio: str | None,
    canting_deg: float,
    elevation_deg: float,
    k_squared: float,
    tolerance: float,
    threads: int | None,
    progress: Callable[[int], None] | None,
) -> dict[str, Any]: ...
