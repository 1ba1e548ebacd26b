//! Spheres computed by Lorenz–Mie, by rays with parts of the method switched off, and order by
//! order.

use crate::cli::{UsageError, notes, progress};
use anyhow::Context;
use gonio::compare::{Case, Entry, OrderPair};
use gonio::phase_table::{ForwardPeak, Quantity};
use gonio::plan::Plan;
use gonio::scene::{
    Choice, Diffraction, Grid, Method, Orders, Particle, Scene, SceneFile, SceneText, ShapeName,
};
use gonio::simulate;
use indicatif::ProgressBar;
use std::path::PathBuf;
use std::time::Instant;

/// Radii of the built-in spheres, millimetres.
const BUILT_IN: [f64; 2] = [0.1, 0.3];
/// Highest order that is shown alone.
const LAST_ALONE: u32 = 7;

/// The cases of these files, or the built-in ones.
pub fn against_mie(files: &[PathBuf]) -> anyhow::Result<Vec<Case>> {
    let mut scenes: Vec<(String, Source)> = Vec::new();
    for path in files {
        scenes.push((path.display().to_string(), Source::File(SceneText::load(path)?)));
    }
    if files.is_empty() {
        scenes = BUILT_IN
            .iter()
            .map(|&mm| (format!("Sphere of {mm} mm, water, 550 nm"), Source::Keys(built_in(mm))))
            .collect();
    }
    // Whatever is wrong with a scene is said before anything is computed.
    let checked = scenes
        .iter()
        .map(|(name, source)| Runs::new(name, source))
        .collect::<anyhow::Result<Vec<_>>>()?;
    let bar = progress::bar(checked.iter().map(Runs::count).sum(), "runs");
    let cases = checked.into_iter().map(|runs| runs.compute(&bar)).collect();
    bar.finish_and_clear();
    cases
}

/// Where the keys of a case come from.
enum Source {
    File(SceneText),
    Keys(SceneFile),
}

impl Source {
    /// The scene with some keys replaced.
    fn with(&self, change: impl Fn(&mut SceneFile)) -> anyhow::Result<Scene> {
        let mut flags = SceneFile::default();
        change(&mut flags);
        let scene = match self {
            Self::File(text) => Scene::from_text(text.clone(), &flags)?,
            Self::Keys(keys) => keys.clone().overridden_by(&flags).validate()?,
        };
        notes::tell(scene.medium.notes());
        Ok(scene)
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

/// The scenes of one case, all checked.
struct Runs {
    name: String,
    reference: Scene,
    tests: Vec<(&'static str, Scene)>,
    /// By rays and by Debye.
    orders: Vec<(u32, Scene, Scene)>,
}

impl Runs {
    /// Rays with everything, with the first orders only, without diffraction, without interference;
    /// and each order alone.
    fn new(name: &str, source: &Source) -> anyhow::Result<Self> {
        let reference = source.with(|flags| method(flags, Method::Mie))?;
        if !matches!(reference.particle, Particle::Sphere { .. }) {
            let message =
                format!("{name}: shape: Lorenz–Mie is the reference, so a sphere is needed");
            return Err(UsageError(message).into());
        }
        let rays = |change: &dyn Fn(&mut SceneFile)| {
            source
                .with(|flags| {
                    method(flags, Method::Rays);
                    change(flags);
                })
                .with_context(|| {
                    format!(
                        "{name}: a case is computed by rays too, which see one sphere in one \
                         wavelength from a point-like sun; take the key out, or compare two \
                         finished tables with --table and --reference"
                    )
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
            ("rays, interference off", rays(&|f| f.model.interference = Some(false))?),
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
            .collect::<anyhow::Result<Vec<_>>>()?;
        let tests = std::iter::once(("rays", whole)).chain(tests).collect();
        Ok(Self { name: name.to_string(), reference, tests, orders })
    }

    fn count(&self) -> usize {
        1 + self.tests.len() + 2 * self.orders.len()
    }

    fn compute(&self, bar: &ProgressBar) -> anyhow::Result<Case> {
        let entry = |name: String, scene: &Scene| {
            let start = Instant::now();
            let table = simulate::table(scene).with_context(|| name.clone())?;
            bar.inc(1);
            anyhow::Ok(Entry { name, table, seconds: Some(start.elapsed().as_secs_f64()) })
        };
        let tests = self.tests.iter().map(|(name, scene)| entry((*name).into(), scene));
        let orders = self.orders.iter().map(|(order, rays, exact)| {
            Ok(OrderPair {
                order: *order,
                test: entry(format!("order {order}, rays"), rays)?,
                exact: entry(format!("order {order}, Debye"), exact)?,
            })
        });
        Ok(Case {
            name: self.name.clone(),
            reference: entry("Lorenz–Mie".into(), &self.reference)?,
            tests: tests.collect::<anyhow::Result<_>>()?,
            orders: orders.collect::<anyhow::Result<_>>()?,
        })
    }
}

fn method(flags: &mut SceneFile, method: Method) {
    flags.model.method = Some(Choice(method));
}
