//! The report of a comparison, opened in headless Chromium: no script error, no network, nothing
//! wider than the window. Skipped with a message where Chromium is missing.

use crate::tables::{degrees, sphere};
use gonio::compare::{Case, Entry, OrderPair, measure, page, worst};
use gonio::phase_table::Quantity;
use std::process::Command;

fn case() -> Case {
    let table = |radius| sphere(radius, vec![550e-9], degrees(0.0, 180.0, 3601), Quantity::Mueller);
    let entry =
        |name: &str, radius| Entry { name: name.into(), table: table(radius), seconds: None };
    Case {
        name: "two spheres </script>".into(),
        reference: entry("0.1 mm", 1e-4),
        tests: vec![entry("the same", 1e-4), entry("0.2 mm", 2e-4)],
        orders: vec![OrderPair {
            order: 2,
            test: entry("order 2", 1e-4),
            exact: entry("order 2, exact", 1e-4),
        }],
    }
}

#[test]
fn a_table_agrees_with_itself_and_not_with_another() {
    let report = measure(&case()).unwrap();
    for band in &report.tests[0].bands {
        assert_eq!((band.max, band.l2), (0.0, 0.0), "{band:?}");
    }
    let same = &report.tests[0].maxima;
    assert!(same.pairs.iter().all(|m| m.shift_deg == 0.0) && !same.pairs.is_empty());
    assert!(same.missing_deg.is_empty() && same.extra_deg.is_empty(), "{same:?}");
    // A larger drop draws its primary bow in towards the angle of ray optics, here by 0.24° (miepython
    // 3 on the same index and angles, smoothed alike; Airy's theory says 0.33°, but single
    // wavelengths of single drops lie up to 0.1° off it).
    let moved = report.tests[1].maxima.pairs.iter().find(|m| m.name == "primary").unwrap();
    assert!((moved.reference_deg - 138.98).abs() < 0.02, "{moved:?}");
    assert!((moved.shift_deg + 0.24).abs() < 0.03, "{moved:?}");
    assert_eq!(worst(&[report]), 0.0);
}

#[test]
fn the_page_opens_offline_without_errors() {
    let Some(chromium) = ["chromium", "chromium-browser", "google-chrome"]
        .into_iter()
        .find(|name| Command::new(name).arg("--version").output().is_ok())
    else {
        eprintln!("skipped: no Chromium found");
        return;
    };
    let case = case();
    let report = measure(&case).unwrap();
    let text = page::html(&[case], &[report], "gonio compare");
    // Every address in the page is a name space or an anchor in a comment, none is loaded.
    for loader in ["src=\"http", "href=\"http", "url(http", "@import"] {
        assert!(!text.contains(loader), "{loader}");
    }
    let folder = tempfile::tempdir().unwrap();
    // A probe at the end of the page writes what went wrong, and how wide the page is.
    let probe = "<script>addEventListener('error',e=>document.body.dataset.error=e.message);\
                 addEventListener('load',()=>{document.body.dataset.requests=\
                 performance.getEntriesByType('resource').filter(r=>!r.name.startsWith('data:'))\
                 .length;document.body.dataset.over=\
                 document.documentElement.scrollWidth-innerWidth;});</script>";
    let path = folder.path().join("report.html");
    std::fs::write(&path, text.replacen("<body>", &format!("<body>{probe}"), 1)).unwrap();
    for width in [1280, 400] {
        let output = Command::new(chromium)
            .args(["--headless", "--no-sandbox", "--disable-gpu", "--dump-dom"])
            .arg(format!("--window-size={width},1200"))
            .arg(format!("--user-data-dir={}", folder.path().join("profile").display()))
            .arg(format!("file://{}", path.display()))
            .output()
            .unwrap();
        let dom = String::from_utf8_lossy(&output.stdout);
        assert!(dom.contains("data-ready=\"yes\""), "the script ran to its end at {width} px");
        assert!(!dom.contains("data-error="), "a script error at {width} px");
        assert!(dom.contains("data-requests=\"0\""), "a request at {width} px");
        let over = dom.split("data-over=\"").nth(1).and_then(|rest| rest.split('"').next());
        let over: i32 = over.and_then(|text| text.parse().ok()).unwrap();
        assert!(over <= 0, "{over} px wider than {width}");
    }
}
