//! Tests of `sweep`.

use super::*;
use proptest::prelude::*;

const SWEEP: &str = "[particle]\nshape = \"raindrop\"\nradius_mm = { from = 0.1, to = 1, count = 10 }\n\
    medium = [\"water\", { index = [1.33, 0.0] }]\n[light]\nsun_elevation_deg = [0, 20]\n\
    wavelengths_nm = [400, 500]\n[model]\norders = [0, 1, 2]\n";

#[test]
fn lists_and_ranges_multiply() {
    let sweep = Sweep::parse(SWEEP).unwrap();
    let keys: Vec<_> = sweep.axes.iter().map(|axis| axis.keys[0].as_str()).collect();
    assert_eq!(keys, ["particle.medium", "particle.radius_mm", "light.sun_elevation_deg"]);
    assert_eq!((sweep.shape(), sweep.points()), (vec![2, 10, 2], 40));
    assert_eq!(sweep.position(39), [1, 9, 1]);
    assert_eq!(sweep.position(2), [0, 1, 0]);
    let scene: Table = sweep.scene(&[1, 2, 1]).parse().unwrap();
    assert_eq!(scene["particle"]["radius_mm"].as_float(), Some(0.3));
    assert_eq!(scene["light"]["sun_elevation_deg"].as_integer(), Some(20));
    assert_eq!(scene["light"]["wavelengths_nm"].as_array().unwrap().len(), 2);
    assert_eq!(scene["model"]["orders"].as_array().unwrap().len(), 3);
    assert!(scene["particle"]["medium"].is_table());
}

#[test]
fn parameters_of_a_distribution_are_swept() {
    let text = "[particle]\nshape = \"sphere\"\nsize_distribution = { kind = \"gamma\", \
        effective_radius_um = [5, 10], effective_variance = { from = 0.05, to = 0.1, count = 2 } }";
    let sweep = Sweep::parse(text).unwrap();
    let keys: Vec<_> = sweep.axes.iter().map(|axis| axis.keys[0].as_str()).collect();
    assert_eq!(
        keys,
        [
            "particle.size_distribution.effective_radius_um",
            "particle.size_distribution.effective_variance",
        ]
    );
    let scene: Table = sweep.scene(&[1, 0]).parse().unwrap();
    let sizes = &scene["particle"]["size_distribution"];
    assert_eq!(sizes["effective_radius_um"].as_integer(), Some(10));
    assert_eq!(sizes["effective_variance"].as_float(), Some(0.05));
    assert_eq!(sizes["kind"].as_str(), Some("gamma"));
}

#[test]
fn ranges_by_step_and_by_logarithm() {
    let values = |range: &str| {
        let sweep = Sweep::parse(&format!("[particle]\nradius_mm = {range}"))?;
        let values: Vec<f64> =
            sweep.axes[0].values[0].iter().map(|v| v.as_float().unwrap()).collect();
        Ok::<_, BatchError>(values)
    };
    assert_eq!(values("{ from = 0.1, to = 0.5, step = 0.1 }").unwrap(), [0.1, 0.2, 0.3, 0.4, 0.5]);
    assert_eq!(
        values("{ from = 0.01, to = 1, count = 3, spacing = \"log\" }").unwrap(),
        [0.01, 0.1, 1.0]
    );
    assert_eq!(values("{ from = 5, to = 9, count = 1 }").unwrap(), [5.0]);
    for bad in [
        "{ from = 0, to = 1, count = 3, spacing = \"log\" }",
        "{ from = 0, to = 1, count = 0 }",
        "{ from = 0, to = 1, count = 1.5 }",
        "{ from = 0, to = 1, step = -1 }",
        "{ from = 0, to = nan, count = 2 }",
        "{ from = 0, to = 1, count = 1e9 }",
        "{ from = 0, to = 1, count = 2, bogus = 1 }",
        "[]",
    ] {
        assert!(values(bad).is_err(), "{bad}");
    }
}

#[test]
fn a_value_twice_is_refused() {
    let twice = SWEEP.replace("[0, 20]", "[0, 20, 0]");
    let error = Sweep::parse(&twice).unwrap_err().to_string();
    assert!(error.contains("light.sun_elevation_deg = 0: each value once"), "{error}");
}

#[test]
fn zipped_values_go_together() {
    let text = SWEEP.replace("count = 10", "count = 2");
    let zip = "[sweep]\nzip = [\"particle.radius_mm\", \"light.sun_elevation_deg\"]\n";
    let sweep = Sweep::parse(&format!("{text}{zip}")).unwrap();
    assert_eq!(sweep.shape(), [2, 2]);
    assert_eq!(sweep.axes[1].keys, ["particle.radius_mm", "light.sun_elevation_deg"]);
    let error = Sweep::parse(&format!("{SWEEP}{zip}")).unwrap_err().to_string();
    assert!(error.contains("2 values: 10 values, as many as particle.radius_mm"), "{error}");
    let twice = zip.replace("light.sun_elevation_deg", "particle.radius_mm");
    let error = Sweep::parse(&format!("{text}{twice}")).unwrap_err().to_string();
    assert!(error.contains("each key once"), "{error}");
    let error = Sweep::parse("[sweep]\nzip = [\"particle.shape\"]").unwrap_err().to_string();
    assert!(error.starts_with("sweep.zip = particle.shape"), "{error}");
}

proptest! {
    #[test]
    fn any_text_is_answered(text in "\\PC{0,200}") {
        let _ = Sweep::parse(&text);
    }

    #[test]
    fn any_range_is_answered(from in any::<f64>(), to in any::<f64>(), count in any::<f64>()) {
        let _ = Sweep::parse(&format!(
            "[particle]\nradius_mm = {{ from = {from:e}, to = {to:e}, count = {count:e} }}"
        ));
    }
}
