//! Stress that the rail of a case carries, and how near its wheels come to yielding it.

use super::row::Row;
use crate::numbers::short;
use crate::setup::{HeaviestWheel, WheelBounds};
use crate::simulation::{plastic_stress_left_out, rolled_by};
use railcrack::shakedown::DepthBounds;
use railcrack::words::Choice;
use railcrack_case::{Case, PlasticSource};

/// The balanced residual stress.
pub(super) fn residual(case: &Case) -> Vec<Row> {
    let Some(file) = &case.residual_stress else { return Vec::new() };
    let rows = file.content().rows();
    let extreme = |pick: fn(f64, f64) -> f64| rows.iter().map(|r| r.1).reduce(pick).unwrap_or(0.0);
    let deepest = rows.last().map_or(0.0, |r| r.0);
    vec![
        Row::text("profile", file.given_name()),
        Row::with(
            "rows",
            "{rows} to depth {depth}",
            [("rows", rows.len() as f64, ""), ("depth", deepest, "mm")],
        ),
        Row::with(
            "sigma_xx",
            "{least:} to {most}",
            [("least", extreme(f64::min), "MPa"), ("most", extreme(f64::max), "MPa")],
        ),
    ]
}

/// The plastic stress, or why there is none.
pub(super) fn plastic(case: &Case) -> Vec<Row> {
    match case.plastic_stress() {
        Some(PlasticSource::Field(file)) => {
            let (left, right, depth) = file.content().extent();
            vec![
                Row::text("field", file.given_name()),
                Row::with(
                    "extent",
                    "x = {left:} to {right}, to depth {depth}",
                    [("left", left, "mm"), ("right", right, "mm"), ("depth", depth, "mm")],
                ),
            ]
        }
        Some(PlasticSource::Profile(file)) => vec![Row::text("profile", file.given_name())],
        Some(PlasticSource::Rolled) => {
            let mut rows = vec![Row::text("stabilised state", "computed first, from [shakedown]")];
            rows.extend(rolled_by(case).map(Row::line));
            rows
        }
        None => plastic_stress_left_out(case).map(|note| Row::text("none", note)).into_iter().collect(),
    }
}

/// The stabilised plastic state that `railcrack shakedown` would compute.
pub(super) fn plastic_state(case: &Case) -> Vec<Row> {
    let shakedown = &case.shakedown;
    let hardening = &shakedown.hardening;
    let steel =
        shakedown.steel.map_or_else(String::new, |steel| format!(" ({}, 0.2 % proof stress)", steel.name));
    let mut rows = vec![
        Row::with(
            "yield, hardening",
            &format!("{{yield}}{steel}, C = {{C}}"),
            [("yield", hardening.yield_stress(), "MPa"), ("C", hardening.modulus(), "MPa")],
        ),
        Row::text(
            "method",
            format!("{}, at most {} passages", shakedown.method.word(), shakedown.max_passes),
        ),
        Row::with(
            "Dang Van",
            "a = {a}, b = {b}",
            [("a", shakedown.dang_van.slope, ""), ("b", shakedown.dang_van.limit, "MPa")],
        ),
    ];
    let initial = shakedown.initial_residual.as_ref();
    rows.extend(initial.map(|file| Row::text("initial residual", file.given_name())));
    rows
}

/// The fate of a rail under p0/k = `ratio`.
pub(super) fn yielding(ratio: f64, first_yield: f64, limit: f64) -> &'static str {
    if ratio <= first_yield {
        "the virgin rail stays elastic"
    } else if ratio <= limit {
        "the rail yields; elastic shakedown is possible"
    } else {
        "beyond elastic shakedown: every passage yields"
    }
}

/// Depths over the half-width of the contact at which bounds are printed.
const BOUND_DEPTHS: [f64; 8] = [0.0, 0.125, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0];

/// Peak pressure compared with first yield and the shakedown limit, of the heaviest wheel.
pub(super) fn bounds(case: &Case) -> Vec<Row> {
    let shear_yield = case.shakedown.hardening.shear_yield_stress();
    let HeaviestWheel { wheel: number, of_limit } = HeaviestWheel::of_case(case);
    let heaviest = &case.wheels[number];
    let Some(contact) = heaviest.wheel.contact() else { return Vec::new() };
    let ratio = contact.peak_pressure() / shear_yield;
    let Some(all) = WheelBounds::of(case, number) else { return Vec::new() };
    let WheelBounds { first_yield, shakedown, .. } = all;
    let a = contact.half_width();
    let limit = |name: &'static str, ratio: f64, depth_over_a: f64| {
        let text = format!("p0 / k = {ratio:.4}, depth {{depth}}");
        Row::with(name, &text, [("depth", depth_over_a * a, "mm")])
    };
    let mut rows = Vec::new();
    if case.is_mix() {
        let text = format!("{}: {of_limit:.2} of its shakedown limit", heaviest.name);
        rows.push(Row::text("heaviest wheel", text));
    }
    let state = yielding(ratio, first_yield.ratio, shakedown.ratio);
    rows.extend([
        Row::number("shear yield stress k", shear_yield, "MPa"),
        Row::with("p0 / k", &format!("{{p0/k}}: {state}"), [("p0/k", ratio, "")]),
        limit("first yield", first_yield.ratio, first_yield.depth_over_a),
        limit("shakedown limit", shakedown.ratio, shakedown.depth_over_a),
        Row::line("depth mm   first yield   shakedown limit   p0 / k of the case"),
    ]);
    rows.extend(all.by_depth(&BOUND_DEPTHS).iter().map(|bounds| at_depth(bounds, a, ratio)));
    rows
}

/// The bounds at a depth, under p0/k = `ratio` and a contact of half-width `a` (mm).
fn at_depth(bounds: &DepthBounds, a: f64, ratio: f64) -> Row {
    let verdict = if ratio <= bounds.first_yield {
        "elastic"
    } else if ratio <= bounds.shakedown {
        "yields, shakedown possible"
    } else {
        "no elastic shakedown"
    };
    Row::line(format!(
        "{:>8}   {:>11.4}   {:>15.4}   {verdict}",
        short(bounds.depth_over_a * a),
        bounds.first_yield,
        bounds.shakedown
    ))
}
