//! The report as one HTML page that opens offline: tables, drawings in SVG, and curves to zoom in
//! (uPlot, embedded; `data/web/`).

use super::charts::{charts, polar};
use super::{BandReport, Case, CaseReport, EnergyReport, Maxima, TestReport};
use maud::{DOCTYPE, Markup, PreEscaped, html};

const UPLOT: &str = include_str!("../../data/web/uPlot.iife.min.js");
const UPLOT_STYLE: &str = include_str!("../../data/web/uPlot.min.css");
const STYLE: &str = "
body{font:15px/1.45 system-ui,sans-serif;margin:0 auto;max-width:1100px;padding:12px;color:#222;background:#fff}
h1{font-size:1.5em}h2{margin-top:2em;border-bottom:1px solid #ccc}
.wide{overflow-x:auto}table{border-collapse:collapse;font-variant-numeric:tabular-nums}
th,td{padding:2px 10px;text-align:right;white-space:nowrap;border-bottom:1px solid #e5e5e5}th:first-child,td:first-child{text-align:left}
pre{background:#f6f6f6;padding:8px;overflow-x:auto;font-size:12px}svg{max-width:100%;height:auto}
code{overflow-wrap:anywhere}
.note{color:#555}.bad{background:#fde3df}.chart{width:100%}.u-legend{font-size:13px}";
/// Draws every chart of the page; sizes follow the window. In a chart of orders a curve and its
/// exact term, dashed, have one colour.
const SCRIPT: &str = r#"
const draw=(d,i)=>{const el=document.getElementById('chart'+d.id);
const colors=['#000000','#0072b2','#d55e00','#009e73','#cc79a7','#e69f00','#56b4e9','#777777'];
const size=()=>({width:Math.max(280,el.clientWidth),height:380});
const log=v=>v==null?'--':v.toExponential(3);
const look=(s,k)=>d.pairs?{stroke:colors[(k>>1)%colors.length],dash:s.reference?[5,4]:[]}:{stroke:colors[k%colors.length],width:s.reference?2:1.2};
const u=new uPlot({...size(),scales:{x:{time:false},y:{distr:3}},cursor:{drag:{x:true,y:false}},
series:[{label:'θ (°)',value:(u,v)=>v==null?'--':v.toFixed(3)},...d.series.map((s,k)=>({label:s.name,...look(s,k),value:(u,v)=>log(v),show:s.show}))],
axes:[{label:'scattering angle θ (°)'},{label:'P (sr⁻¹)',size:70,values:(u,vs)=>vs.map(v=>v==null?'':v>=0.01&&v<1e4?+v:v.toExponential(0))}]},[d.theta,...d.series.map(s=>s.values)],el);
addEventListener('resize',()=>u.setSize(size()));};
charts.forEach(draw);document.body.dataset.ready='yes';"#;
/// Bands with an L2 error above this are marked.
const MARKED: f64 = 0.05;

/// The page.
pub fn html(cases: &[Case], reports: &[CaseReport], command_line: &str) -> String {
    let mut data = Vec::new();
    for (i, (case, report)) in cases.iter().zip(reports).enumerate() {
        for (k, mut chart) in charts(case, report).into_iter().enumerate() {
            chart["id"] = format!("{i}-{k}").into();
            chart["pairs"] = (k == 1).into();
            data.push(chart);
        }
    }
    // Numbers and names only; "</" cannot close the script early once its slash is escaped.
    let data = serde_json::Value::from(data).to_string().replace("</", "<\\/");
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

fn section(i: usize, case: &Case, report: &CaseReport) -> Markup {
    html! {
        h2 { (case.name) }
        p {
            "Reference: " b { (report.reference) } ". Curves and maxima at "
            (format!("{:.1}", report.wavelength_nm)) " nm, first azimuth."
        }
        (summary(report))
        h3 { "Intensity" }
        div .chart id=(format!("chart{i}-0")) {}
        @if !report.orders.is_empty() { (orders(i, report)) }
        h3 { "All around" }
        (polar(case, report))
        @for test in &report.tests {
            h3 { (test.name) }
            p .note {
                (test.wavelengths) " wavelength(s) and " (test.azimuths) " azimuth(s) compared."
            }
            @if !test.differences.is_empty() {
                p .bad { "Not of the same particles: " (test.differences.join("; ")) "." }
            }
            (bands(&test.bands))
            (maxima(&test.maxima))
            @if !test.scene.is_empty() {
                details { summary { "the scene of this run" } pre { (test.scene) } }
            }
        }
        h3 { "Energy" }
        (energy(report))
        h3 { "The scene" }
        pre { (if report.scene.is_empty() { "unknown" } else { &report.scene }) }
    }
}

/// Run time and largest error of each run.
fn summary(report: &CaseReport) -> Markup {
    let worst = |test: &TestReport| {
        let unpolarised = test.bands.iter().filter(|b| b.polarisation == "unpolarised");
        unpolarised.max_by(|a, b| a.l2.total_cmp(&b.l2)).map_or_else(String::new, |band| {
            format!("{} ({}–{}°)", percent(band.l2), band.from_deg, band.to_deg)
        })
    };
    html! { div .wide { table {
        tr { th { "run" } th { "run time" } th { "largest L2 error of a band" } }
        tr { td { (report.reference) } td { (time(report.reference_seconds)) } td { "reference" } }
        @for test in &report.tests {
            tr { td { (test.name) } td { (time(test.seconds)) } td { (worst(test)) } }
        }
    } } }
}

fn bands(bands: &[BandReport]) -> Markup {
    html! { div .wide { table {
        tr { th { "band (°)" } th { "polarisation" } th { "samples" } th { "median" }
             th { "99 %" } th { "max" } th { "L2" } }
        @for band in bands { tr .bad[band.l2 > MARKED] {
            td { (band.from_deg) " – " (band.to_deg) }
            td { (band.polarisation) } td { (band.samples) }
            @for value in [band.median, band.q99, band.max, band.l2] {
                td { (percent(value)) }
            }
        } }
    } } }
}

fn maxima(maxima: &Maxima) -> Markup {
    let list =
        |angles: &[f64]| angles.iter().map(|t| format!("{t:.2}°")).collect::<Vec<_>>().join(", ");
    html! {
        @if !maxima.pairs.is_empty() {
            h4 { "Shift of the bows' maxima" }
            div .wide { table {
                tr { th { "maximum" } th { "reference (°)" } th { "shift (°)" } }
                @for m in &maxima.pairs { tr {
                    td { (m.name) }
                    td { (format!("{:.3}", m.reference_deg)) }
                    td { (format!("{:+.4}", m.shift_deg)) }
                } }
            } }
        }
        @if !maxima.missing_deg.is_empty() {
            p { "Maxima of the reference that are not here: " (list(&maxima.missing_deg)) "." }
        }
        @if !maxima.extra_deg.is_empty() {
            p { "Maxima that the reference has not: " (list(&maxima.extra_deg)) "." }
        }
    }
}

/// Single orders: a chart, and their errors against the exact terms.
fn orders(i: usize, report: &CaseReport) -> Markup {
    html! {
        h3 { "Order by order" }
        p .note {
            "Each order alone, against the Debye term of the same order (dashed); order 0 of the \
             exact series is external reflection without diffraction. L2 errors by band; where an \
             order sends next to no light, they say nothing."
        }
        div .chart id=(format!("chart{i}-1")) {}
        div .wide { table {
            tr { th { "order" } th { "run time" } th { "Debye's" }
                 @for (from, to) in super::BANDS { th { (from) "–" (to) "°" } } }
            @for order in &report.orders { tr {
                td { (order.order) } td { (time(order.seconds)) } td { (time(order.exact_seconds)) }
                @for band in order.bands.iter().filter(|b| b.polarisation == "unpolarised") {
                    td { (percent(band.l2)) }
                }
            } }
        } }
    }
}

/// One column per run.
fn energy(report: &CaseReport) -> Markup {
    let runs: Vec<(&str, &EnergyReport)> =
        std::iter::once((&report.reference, &report.reference_energy))
            .chain(report.tests.iter().map(|test| (&test.name, &test.energy)))
            .filter_map(|(name, energy)| Some((name.as_str(), energy.as_ref()?)))
            .collect();
    let number = |value: Option<f64>| value.map_or_else(|| "–".to_string(), |v| format!("{v:.6}"));
    let row = |name: String, value: &dyn Fn(&EnergyReport) -> Option<f64>| {
        html! { tr { td { (name) } @for (_, energy) in &runs { td { (number(value(energy))) } } } }
    };
    let counted = |energy: &&(&str, &EnergyReport)| energy.1.fates.is_some();
    let orders = runs.iter().filter_map(|(_, e)| e.fates.as_ref()).map(|f| f.left_by_order.len());
    html! {
        div .wide { table {
            tr { th { "" } @for (name, _) in &runs { th { (name) } } }
            (row("Q scattering".into(), &|e| Some(e.q_sca)))
            (row("Q extinction".into(), &|e| Some(e.q_ext)))
            (row("Q absorption".into(), &|e| Some(e.q_abs)))
            (row("asymmetry".into(), &|e| Some(e.asymmetry)))
            @if runs.iter().any(|run| counted(&run)) {
                @for p in 0..orders.max().unwrap_or(0) {
                    (row(format!("left after {p} chords"),
                         &|e| e.fates.as_ref()?.left_by_order.get(p).copied()))
                }
                (row("absorbed".into(), &|e| Some(e.fates.as_ref()?.absorbed)))
                (row("totally reflected, still inside".into(),
                     &|e| Some(e.fates.as_ref()?.totally_reflected)))
                (row("left after later orders".into(), &|e| Some(e.fates.as_ref()?.truncated)))
                (row("unaccounted for".into(), &|e| Some(e.fates.as_ref()?.residual)))
            }
        } }
        p .note { "Q: cross-section over that of the sphere of equal volume; the rest: shares of the \
                   light that met the particle, counted on the rays." }
    }
}

fn time(seconds: Option<f64>) -> String {
    seconds.map_or_else(|| "–".into(), |s| format!("{s:.2} s"))
}

fn percent(value: f64) -> String {
    match value {
        v if v < 1e-4 => format!("{v:.1e}"),
        v if v > 100.0 => "> 100 ×".into(),
        v => format!("{:.2} %", 100.0 * v),
    }
}
