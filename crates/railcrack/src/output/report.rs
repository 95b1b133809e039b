//! The report: one page with everything in it.

use super::shakedown::ShakedownSummary;
use std::fmt::Write;

pub(crate) const REPORT_FILE: &str = "report.html";

const STYLE: &str = "body{font-family:Helvetica,Arial,sans-serif;max-width:60em;margin:2em auto;padding:0 1em;color:#222}\
table{border-collapse:collapse;margin:1em 0}td,th{padding:.25em .8em;border-bottom:1px solid #ddd;text-align:left}\
svg{max-width:100%;height:auto;margin:1em 0}";

/// The page of a stabilised plastic state, with its `pictures` (file name and SVG) in it.
pub(crate) fn shakedown_report(summary: &ShakedownSummary, pictures: &[(&'static str, String)]) -> String {
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{0}</title>\n<style>{STYLE}</style>\n\
         </head>\n<body>\n<h1>{0}</h1>\n<p>Stabilised plastic state under repeated passages, by railcrack {1}.</p>\n<table>\n",
        escaped(&summary.title),
        escaped(&summary.version)
    );
    for (name, value) in rows(summary) {
        // Writing to a string does not fail.
        let _ = writeln!(page, "<tr><th>{}</th><td>{}</td></tr>", escaped(name), escaped(&value));
    }
    page.push_str("</table>\n");
    for warning in &summary.warnings {
        let _ = writeln!(page, "<p>Note: {}</p>", escaped(warning));
    }
    for (_, picture) in pictures {
        page.push_str(picture);
    }
    page.push_str("</body>\n</html>\n");
    page
}

fn rows(summary: &ShakedownSummary) -> Vec<(&'static str, String)> {
    let dang_van = &summary.dang_van;
    let mut rows = vec![
        ("state", summary.state.clone()),
        (
            "method",
            format!(
                "{}, {} passages, {} redistributions",
                summary.method, summary.passes, summary.redistributions
            ),
        ),
        ("p0 / k", format!("{:.4}", summary.p0_over_k)),
        (
            "first yield",
            format!(
                "p0 / k = {:.4}, depth {:.3} mm",
                summary.first_yield.p0_over_k, summary.first_yield.depth_mm
            ),
        ),
        (
            "shakedown limit",
            format!(
                "p0 / k = {:.4}, depth {:.3} mm",
                summary.shakedown_limit.p0_over_k, summary.shakedown_limit.depth_mm
            ),
        ),
        (
            "largest residual stress",
            format!(
                "{} = {:.1} MPa, depth {:.3} mm",
                summary.peak_residual_stress.component,
                summary.peak_residual_stress.stress_mpa,
                summary.peak_residual_stress.depth_mm
            ),
        ),
        (
            "Dang Van",
            format!(
                "{:.1} MPa at depth {:.3} mm, margin to b = {} MPa: {:.1} MPa",
                dang_van.critical_value_mpa, dang_van.critical_depth_mm, dang_van.b_mpa, dang_van.margin_mpa
            ),
        ),
        (
            "Dang Van at the surface",
            format!("{:.1} MPa, margin {:.1} MPa", dang_van.surface.value_mpa, dang_van.surface.margin_mpa),
        ),
    ];
    if let Some(below) = dang_van.subsurface {
        let text = format!(
            "{:.1} MPa at depth {:.3} mm, margin {:.1} MPa",
            below.value_mpa, below.depth_mm, below.margin_mpa
        );
        rows.push(("Dang Van below it", text));
    }
    if let Some(zone) = summary.alternating_zone {
        let text = format!(
            "depth {:.3} to {:.3} mm, plastic strain per passage up to {:.3e}",
            zone.from_depth_mm, zone.to_depth_mm, zone.plastic_strain_per_pass
        );
        rows.push(("alternating zone", text));
    }
    if let Some(other) = &summary.direct_against_pass_by_pass {
        let text = format!(
            "{:.1} MPa at most; pass-by-pass: {}, {} passages, {} redistributions",
            other.stress_difference_mpa, other.state, other.passes, other.redistributions
        );
        rows.push(("difference from pass-by-pass", text));
    }
    rows
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
