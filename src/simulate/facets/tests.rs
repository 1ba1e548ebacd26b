//! Tests of `facets`.

use crate::plan::{Engine, Plan, PlanError, Symmetry};
use crate::scene::{Scene, SceneFile};
use crate::simulate;

fn scene(particle: &str, more: &str) -> Result<Scene, String> {
    let text = format!(
        "[particle]\n{particle}\n[light]\nwavelengths_nm = [550]\nsun_elevation_deg = 20\n[table]\n\
         theta_deg = {{ from = 0, to = 180, count = 46 }}\nquantity = \"mueller\"\n{more}"
    );
    let text = crate::scene::SceneText::parse("test", text).map_err(|e| e.to_string())?;
    Scene::from_text(text, &SceneFile::default()).map_err(|e| e.to_string())
}

const COLUMN: &str =
    "shape = \"hexagonal-column\"\naxis_ratio = 1.2\nradius_um = 2.2\nmedium = \"ice\"";

/// Every stand makes a table that passes all checks of tables (which `simulate` asks), by the plan's method.
#[test]
fn every_stand_makes_a_sound_table() {
    for (orientation, canting, symmetry) in [
        ("{ kind = \"random\", count = 16 }", "", Symmetry::Rotational),
        ("{ kind = \"upright\", count = 16 }", "canting = { deviation_deg = 2 }", Symmetry::Mirror),
        ("{ kind = \"horizontal\", count = 16 }", "", Symmetry::Mirror),
        ("{ kind = \"fixed\", zenith_deg = 40, spin_deg = 10 }", "", Symmetry::None),
    ] {
        let particle = format!("{COLUMN}\norientation = {orientation}\n{canting}");
        let azimuths = "azimuth_deg = { from = 0, to = 360, count = 25 }";
        let scene = scene(&particle, azimuths).unwrap();
        let plan = Plan::new(&scene).unwrap();
        assert_eq!((plan.engine, plan.symmetry), (Engine::Facets, symmetry));
        let table = simulate::table(&scene).unwrap();
        let slab = &table.slabs[0];
        assert!((slab.sum(&table.header.axes) - 1.0).abs() < 1e-3);
        assert_eq!(
            (table.header.method.as_str(), table.header.shape.as_str()),
            ("facets", "hexagonal-column")
        );
        assert!(slab.error_estimate > 0.1 && slab.asymmetry > 0.5, "{orientation}");
        // a column alone is not its own mirror image
        let (a, b) = (
            slab.values[(0, 20, 3 % table.header.axes.phi.len())],
            slab.values[(0, 20, table.header.axes.phi.len() - 1 - 3 % table.header.axes.phi.len())],
        );
        assert_eq!(a == b, symmetry != Symmetry::None, "{orientation}: {a} {b}");
    }
}

/// Crystals and drops in one volume add up.
#[test]
fn crystals_and_drops_mix() {
    let text = format!(
        "[[particles]]\n{COLUMN}\norientation = {{ kind = \"random\", count = 16 }}\nnumber_fraction = 0.5\n\
         [[particles]]\nshape = \"sphere\"\nradius_um = 2\nnumber_fraction = 0.5\n[light]\nwavelengths_nm = [550]\n\
         [table]\ntheta_deg = {{ from = 0, to = 180, count = 181 }}\nazimuth_deg = [0]"
    );
    let text = crate::scene::SceneText::parse("test", text).unwrap();
    let scene = Scene::from_text(text, &SceneFile::default()).unwrap();
    let table = simulate::table(&scene).unwrap();
    assert_eq!(table.header.method, "facets + mie");
}

/// Below its end, for thin bodies, and for bodies that are less dense the method is refused with numbers.
#[test]
fn what_the_method_does_not_serve_is_refused() {
    let refused = |particle: &str| Plan::new(&scene(particle, "").unwrap()).unwrap_err();
    let small = refused(&COLUMN.replace("2.2", "0.9"));
    assert!(matches!(small, PlanError::SmallCrystal { .. }), "{small}");
    assert!(small.to_string().contains("from 20 and 5 on"), "{small}");
    let thin = refused(&COLUMN.replace("1.2", "0.03"));
    assert!(matches!(thin, PlanError::SmallCrystal { .. }), "{thin}");
    let fine = refused("shape = \"brilliant\"\nradius_um = 2.5\nmedium = \"ice\"");
    assert!(matches!(fine, PlanError::SmallFacets { facets: 73, .. }), "{fine}");
    let bubble = refused(&COLUMN.replace("\"ice\"", "1.0\noutside = 1.31"));
    assert!(matches!(bubble, PlanError::ThinnerBody { .. }), "{bubble}");
}

/// Keys that do not go together are named.
#[test]
fn wrong_keys_are_named() {
    for (particle, more, word) in [
        (COLUMN.replace("1.2", "99"), "", "0.02 to 50"),
        (format!("{COLUMN}\napex_deg = 60"), "", "apex"),
        (COLUMN.replace("hexagonal-column", "bullet"), "", "apex_deg is missing"),
        (COLUMN.replace("hexagonal-column", "octahedron"), "", "axis ratio"),
        (COLUMN.into(), "[model]\nmethod = \"rays\"", "facets"),
        (COLUMN.into(), "[model]\norders = [1]", "all orders"),
        (COLUMN.into(), "forward_peak = \"separate\"", "cell_average"),
        (
            format!("{COLUMN}\norientation = \"random\"\ncanting = {{ deviation_deg = 1 }}"),
            "",
            "tilts",
        ),
        (COLUMN.replace("hexagonal-column", "hollow-column"), "", "not convex"),
        (COLUMN.replace("hexagonal-column", "mesh"), "", "axis ratio"),
        ("shape = \"mesh\"\nradius_um = 5".into(), "", "particle.file is missing"),
        ("shape = \"mesh\"\nfile = \"a.step\"\nradius_um = 5".into(), "", ".obj, .stl, .ply"),
        ("shape = \"sphere\"\nfile = \"a.obj\"\nradius_um = 5".into(), "", "only shape = \"mesh\""),
        ("shape = \"harmonics\"\nradius_um = 5".into(), "", "coefficients is missing"),
        (
            "shape = \"harmonics\"\ncoefficients = [1, 0, 0, 0, 0.3]\nradius_um = 50".into(),
            "[model]\nmethod = \"rays\"",
            "dented",
        ),
        (
            "shape = \"superellipsoid\"\naxis_ratio = 1\nexponent = 1.5\nradius_um = 5".into(),
            "",
            "2 to 4",
        ),
        ("shape = \"sphere\"\nradius_um = 5".into(), "[model]\nmethod = \"facets\"", "crystals"),
        ("shape = \"sphere\"\nradius_um = 5\norientation = \"horizontal\"".into(), "", "upright"),
    ] {
        let error = scene(&particle, more).unwrap_err();
        assert!(error.contains(word), "{error}");
    }
}
