//! The report as one HTML page that opens offline: tables, drawings in SVG, and curves to zoom in
//! (uPlot, embedded; `data/web/`).

use super::{Case, CaseReport, Curve, energy};
use maud::{DOCTYPE, Markup, PreEscaped, html};

const UPLOT: &str = include_str!("../../data/web/uPlot.iife.min.js");
const UPLOT_STYLE: &str = include_str!("../../data/web/uPlot.min.css");
const STYLE: &str = "
body{font:15px/1.45 system-ui,sans-serif;margin:0 auto;max-width:1100px;padding:12px;color:#222;background:#fff}
h1{font-size:1.5em}h2{margin-top:2em;border-bottom:1px solid #ccc}
.wide{overflow-x:auto}table{border-collapse:collapse;font-variant-numeric:tabular-nums}
th,td{padding:2px 10px;text-align:right;border-bottom:1px solid #e5e5e5}th:first-child,td:first-child{text-align:left}
pre{background:#f6f6f6;padding:8px;overflow-x:auto;font-size:12px}svg{max-width:100%;height:auto}
.note{color:#555}.bad{background:#fde3df}.chart{width:100%}.u-legend{font-size:13px}";
/// Draws every chart of the page; sizes follow the window.
const SCRIPT: &str = r#"
const draw=(d,i)=>{const el=document.getElementById('chart'+i);
const colors=['#000000','#0072b2','#d55e00','#009e73','#cc79a7','#e69f00','#56b4e9','#777777'];
const size=()=>({width:Math.max(280,el.clientWidth),height:380});
const log=v=>v==null?'--':v.toExponential(3);
const u=new uPlot({...size(),scales:{x:{time:false},y:{distr:3}},cursor:{drag:{x:true,y:false}},
series:[{label:'θ (°)',value:(u,v)=>v==null?'--':v.toFixed(3)},...d.series.map((s,k)=>({label:s.name,stroke:colors[k%colors.length],width:k?1.2:2,dash:k?[]:[],value:(u,v)=>log(v),show:s.show}))],
axes:[{label:'scattering angle θ (°)'},{label:'P (sr⁻¹)',size:70}]},[d.theta,...d.series.map(s=>s.values)],el);
addEventListener('resize',()=>u.setSize(size()));};
charts.forEach(draw);document.body.dataset.ready='yes';"#;

/// The page.
pub fn html(cases: &[Case], reports: &[CaseReport], command_line: &str) -> String {
    let charts: Vec<serde_json::Value> =
        cases.iter().zip(reports).map(|(case, report)| chart(case, report)).collect();
    // Numbers and names only; "</" cannot close the script early once its slash is escaped.
    let data = serde_json::Value::from(charts).to_string().replace("</", "<\\/");
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                link rel="icon" href="data:,";
                title { "gonio compare" }
                style { (PreEscaped(UPLOT_STYLE)) (PreEscaped(STYLE)) }
            }
            body {
                h1 { "How far apart?" }
                p .note {
                    "Relative error |test − reference| / reference of the scattered power by bands of \
                     scattering angle. Drag across a chart to zoom, double-click to reset, click a \
                     name below it to switch a curve on or off."
                }
                @for (i, (case, report)) in cases.iter().zip(reports).enumerate() {
                    (section(i, case, report))
                }
                p .note { "gonio " (env!("CARGO_PKG_VERSION")) ", " code { (command_line) } }
                script { (PreEscaped(UPLOT)) }
                script { "const charts=" (PreEscaped(data)) ";" (PreEscaped(SCRIPT)) }
            }
        }
    };
    page.into_string()
}

/// Curves of a case on the angles of the reference.
fn chart(case: &Case, report: &CaseReport) -> serde_json::Value {
    let wavelength = report.wavelength_nm * 1e-9;
    let reference = Curve::of(&case.reference.table, wavelength);
    let mut series = Vec::new();
    let entries = std::iter::once(&case.reference).chain(&case.tests);
    for (k, entry) in entries.enumerate() {
        let curve = Curve::relative_to(&entry.table, &case.reference.table, wavelength);
        for (which, (polarisation, _)) in curve.intensity.iter().enumerate() {
            let values: Vec<Option<f64>> = reference
                .theta
                .iter()
                .map(|&t| curve.at(which, t).filter(|v| *v > 0.0).map(rounded))
                .collect();
            series.push(serde_json::json!({
                "name": format!("{}, {polarisation}", entry.name),
                "values": values,
                "show": which == 0 && k < 2,
            }));
        }
    }
    serde_json::json!({ "theta": reference.theta, "series": series })
}

/// Five digits are more than a screen shows.
fn rounded(value: f64) -> f64 {
    format!("{value:.4e}").parse().unwrap_or(value)
}

fn section(i: usize, case: &Case, report: &CaseReport) -> Markup {
    html! {
        h2 { (case.name) }
        p {
            "Reference: " b { (report.reference) } (time(report.reference_seconds))
            ". Curves at " (format!("{:.1}", report.wavelength_nm)) " nm."
        }
        div .chart id=(format!("chart{i}")) {}
        @for (entry, test) in case.tests.iter().zip(&report.tests) {
            h3 { (test.name) (time(test.seconds)) }
            div .wide { table {
                tr { th { "band (°)" } th { "polarisation" } th { "samples" } th { "median" }
                     th { "99 %" } th { "max" } th { "L2" } }
                @for band in &test.bands { tr .bad[band.l2 > 0.05] {
                    td { (band.from_deg) " – " (band.to_deg) }
                    td { (band.polarisation) } td { (band.samples) }
                    @for value in [band.median, band.q99, band.max, band.l2] {
                        td { (percent(value)) }
                    }
                } }
            } }
            @if !test.maxima.is_empty() {
                h4 { "Shift of the bows' maxima" }
                div .wide { table {
                    tr { th { "maximum of the reference (°)" } th { "shift (°)" } }
                    @for m in &test.maxima { tr {
                        td { (format!("{:.3}", m.reference_deg)) }
                        td { (format!("{:+.4}", m.shift_deg)) }
                    } }
                } }
            }
            @if let Some(budget) = energy(&entry.table) {
                h4 { "Energy by fate" }
                div .wide { table {
                    @for (p, share) in budget.left_by_order.iter().enumerate() {
                        tr { td { "left after " (p) " chords" } td { (format!("{share:.6}")) } }
                    }
                    tr { td { "absorbed" } td { (format!("{:.6}", budget.absorbed)) } }
                    tr { td { "totally reflected, still inside" }
                         td { (format!("{:.6}", budget.totally_reflected)) } }
                    tr { td { "left after later orders" } td { (format!("{:.6}", budget.truncated)) } }
                } }
            }
            details { summary { "the scene" } pre { (entry.table.header.scene_toml) } }
        }
        h3 { "All around" }
        (polar(case, report))
    }
}

fn time(seconds: Option<f64>) -> String {
    seconds.map_or(String::new(), |s| format!(" ({s:.2} s)"))
}

fn percent(value: f64) -> String {
    if value < 1e-4 { format!("{:.1e}", value) } else { format!("{:.2} %", 100.0 * value) }
}

/// Polar view on a log scale: the reference above the axis, the first test below.
fn polar(case: &Case, report: &CaseReport) -> Markup {
    const SIZE: f64 = 460.0;
    const DECADES: f64 = 6.0;
    let wavelength = report.wavelength_nm * 1e-9;
    let curve = |table| Curve::relative_to(table, &case.reference.table, wavelength);
    let reference = curve(&case.reference.table);
    let radius = |value: f64| {
        let decades = (value.max(1e-12).log10() + 4.0).clamp(0.0, DECADES);
        0.42 * SIZE * decades / DECADES
    };
    let path = |curve: &Curve, sign: f64| -> String {
        let Some((_, values)) = curve.intensity.first() else { return String::new() };
        curve
            .theta
            .iter()
            .zip(values)
            .enumerate()
            .map(|(i, (t, v))| {
                let (s, c) = t.to_radians().sin_cos();
                let (x, y) = (0.5 * SIZE + radius(*v) * c, 0.5 * SIZE - sign * radius(*v) * s);
                format!("{}{x:.1} {y:.1}", if i == 0 { 'M' } else { 'L' })
            })
            .collect()
    };
    html! {
        svg viewBox=(format!("0 0 {SIZE} {SIZE}")) width=(SIZE) height=(SIZE) role="img"
            aria-label="phase function in polar coordinates, log scale" {
            @for decade in 0..=(DECADES as i32) {
                @let r = 0.42 * SIZE * f64::from(decade) / DECADES;
                circle cx=(0.5 * SIZE) cy=(0.5 * SIZE) r=(format!("{r:.1}")) fill="none" stroke="#ddd" {}
                text x=(0.5 * SIZE + 2.0) y=(format!("{:.1}", 0.5 * SIZE - r - 2.0)) font-size="10" fill="#777" {
                    "1e" (decade - 4)
                }
            }
            line x1="0" x2=(SIZE) y1=(0.5 * SIZE) y2=(0.5 * SIZE) stroke="#ddd" {}
            path d=(path(&reference, 1.0)) fill="none" stroke="#000" stroke-width="0.8" {}
            @if let Some(test) = case.tests.first() {
                path d=(path(&curve(&test.table), -1.0)) fill="none" stroke="#0072b2" stroke-width="0.8" {}
                text x="8" y=(SIZE - 8.0) font-size="12" fill="#0072b2" { "below: " (test.name) }
            }
            text x="8" y="16" font-size="12" { "above: " (report.reference) ", P in sr⁻¹, log scale" }
            text x=(SIZE - 60.0) y=(0.5 * SIZE - 4.0) font-size="11" fill="#555" { "forward" }
            text x="4" y=(0.5 * SIZE - 4.0) font-size="11" fill="#555" { "back" }
        }
    }
}
