//! Cases to compare: a sphere by Lorenz–Mie, by rays with parts of the method switched off, and order
//! by order against Debye's terms.

use super::{Case, Entry, OrderPair};
use crate::fault::{Blame, Fault};
use crate::phase_table::{ForwardPeak, Quantity};
use crate::plan::{Plan, PlanError};
use crate::scene::{
    Choice, Diffraction, Grid, Interference, Method, Orders, Particle, Scene, SceneError,
    SceneFile, SceneText, ShapeName,
};
use crate::simulate::{self, SimulateError};
use std::path::Path;
use std::time::Instant;

/// Why a case cannot be computed.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
pub enum CaseError {
    #[error(transparent)]
    Scene(#[from] SceneError),
    #[error(transparent)]
    Plan(#[from] PlanError),
    #[error("{name}: shape: Lorenz–Mie is the reference, so a sphere is needed")]
    NotASphere { name: String },
    #[error(
        "{name}: a case is computed by rays too, which see one sphere in one wavelength from a \
         point-like sun; take the key out, or compare two finished tables with --table and --reference"
    )]
    NotForRays { name: String, source: Box<SceneError> },
    #[error("{name}")]
    Run { name: String, source: Box<SimulateError> },
}

impl Blame for CaseError {
    fn fault(&self) -> Fault {
        match self {
            CaseError::Run { source, .. } => source.fault(),
            CaseError::Plan(error) => error.fault(),
            CaseError::Scene(_) | CaseError::NotASphere { .. } | CaseError::NotForRays { .. } => {
                Fault::Input
            }
        }
    }
}

/// Radii of the built-in spheres, millimetres.
const BUILT_IN: [f64; 2] = [0.1, 0.3];
/// Highest order that is shown alone.
const LAST_ALONE: u32 = 7;

/// Where the keys of a case come from.
enum Source {
    File(SceneText),
    Keys(SceneFile),
}

impl Source {
    /// The scene with some keys replaced.
    fn with(&self, change: impl Fn(&mut SceneFile)) -> Result<Scene, SceneError> {
        let mut flags = SceneFile::default();
        change(&mut flags);
        match self {
            Self::File(text) => Scene::from_text(text.clone(), &flags),
            Self::Keys(keys) => keys.clone().overridden_by(&flags).validate(),
        }
    }
}

fn built_in(radius_mm: f64) -> SceneFile {
    let mut file = SceneFile::default();
    file.particle.shape = Some(Choice(ShapeName::Sphere));
    file.particle.radius_mm = Some(radius_mm);
    file.light.wavelengths_nm = Some(Grid::List(vec![550.0]));
    file.table.theta_deg = Some(Grid::Range { from: 0.0, to: 180.0, count: 7201 });
    file.table.azimuth_deg = Some(Grid::List(vec![0.0]));
    file.table.quantity = Some(Choice(Quantity::Mueller));
    file.table.forward_peak = Some(Choice(ForwardPeak::Point));
    file
}

/// The scenes of one case, all checked: whatever is wrong with one is said before anything is computed.
pub struct SphereRuns {
    name: String,
    reference: Scene,
    tests: Vec<(&'static str, Scene)>,
    /// By rays and by Debye.
    orders: Vec<(u32, Scene, Scene)>,
}

impl SphereRuns {
    /// The case of a scene file; its method is not used.
    ///
    /// # Errors
    /// A scene that is wrong, that is no sphere, or that rays cannot see.
    pub fn of_file(path: &Path) -> Result<Self, CaseError> {
        Self::new(&path.display().to_string(), &Source::File(SceneText::load(path)?))
    }

    /// Spheres of 0.1 and 0.3 mm at 550 nm.
    ///
    /// # Errors
    /// None; those of [`SphereRuns::of_file`] in form.
    pub fn built_in() -> Result<Vec<Self>, CaseError> {
        let run = |mm: &f64| {
            Self::new(&format!("Sphere of {mm} mm, water, 550 nm"), &Source::Keys(built_in(*mm)))
        };
        BUILT_IN.iter().map(run).collect()
    }

    /// Rays with everything, with the first orders only, without diffraction, without interference;
    /// and each order alone.
    fn new(name: &str, source: &Source) -> Result<Self, CaseError> {
        let reference = source.with(|flags| method(flags, Method::Mie))?;
        if !matches!(reference.particle, Particle::Sphere { .. }) {
            return Err(CaseError::NotASphere { name: name.to_string() });
        }
        let rays = |change: &dyn Fn(&mut SceneFile)| {
            source
                .with(|flags| {
                    method(flags, Method::Rays);
                    change(flags);
                })
                .map_err(|source| CaseError::NotForRays {
                    name: name.to_string(),
                    source: source.into(),
                })
        };
        let list = |orders: &[u32]| Some(Orders::List(orders.to_vec()));
        let whole = rays(&|_| ())?;
        let orders = Plan::new(&whole)?.orders;
        let tests = vec![
            ("rays, orders 0 to 3", rays(&|f| f.model.orders = list(&[0, 1, 2, 3]))?),
            ("rays, without order 2", rays(&|f| f.model.orders = list(&[0, 1, 3]))?),
            (
                "rays, diffraction off",
                rays(&|f| f.model.diffraction = Some(Choice(Diffraction::None)))?,
            ),
            (
                "rays, interference off",
                rays(&|f| f.model.interference = Some(Interference::Powers))?,
            ),
        ];
        let orders = orders
            .into_iter()
            .filter(|&order| order <= LAST_ALONE)
            .map(|order| {
                let exact = source.with(|flags| {
                    method(flags, Method::Debye);
                    flags.model.orders = list(&[order]);
                })?;
                let alone = rays(&|f| {
                    f.model.orders = list(&[order]);
                    f.table.forward_peak = Some(Choice(ForwardPeak::Separate));
                })?;
                Ok((order, alone, exact))
            })
            .collect::<Result<Vec<_>, CaseError>>()?;
        let tests = std::iter::once(("rays", whole)).chain(tests).collect();
        Ok(Self { name: name.to_string(), reference, tests, orders })
    }

    /// Number of tables to compute.
    pub fn count(&self) -> usize {
        1 + self.tests.len() + 2 * self.orders.len()
    }

    /// What the readers of the medium's files have to say.
    pub fn notes(&self) -> Vec<String> {
        self.reference.medium.notes()
    }

    /// Compute all tables; `done` hears of each as it ends.
    ///
    /// # Errors
    /// A table that cannot be computed.
    pub fn compute(&self, done: impl Fn()) -> Result<Case, CaseError> {
        let entry = |name: String, scene: &Scene| {
            let start = Instant::now();
            let table = simulate::table(scene)
                .map_err(|source| CaseError::Run { name: name.clone(), source: source.into() })?;
            done();
            Ok::<_, CaseError>(Entry { name, table, seconds: Some(start.elapsed().as_secs_f64()) })
        };
        let tests = self.tests.iter().map(|(name, scene)| entry((*name).into(), scene));
        let orders = self.orders.iter().map(|(order, rays, exact)| {
            Ok::<_, CaseError>(OrderPair {
                order: *order,
                test: entry(format!("order {order}, rays"), rays)?,
                exact: entry(format!("order {order}, Debye"), exact)?,
            })
        });
        Ok(Case {
            name: self.name.clone(),
            reference: entry("Lorenz–Mie".into(), &self.reference)?,
            tests: tests.collect::<Result<_, CaseError>>()?,
            orders: orders.collect::<Result<_, CaseError>>()?,
        })
    }
}

fn method(flags: &mut SceneFile, method: Method) {
    flags.model.method = Some(Choice(method));
}
