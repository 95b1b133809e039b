//! `wheels.csv`, `patches.csv`, `strips.csv`, `across.csv`.

use super::across::GrowthAcross;
use super::rows::WheelRow;
use railcrack::rolling::{PlacedPatch, StripPoint};

const WHEELS: &str = "wheel,representative,share,p0_mpa,a_mm,b_mm,fx_kn,fy_kn,slip_share,tgamma_n,delta_keq_mpa_sqrt_m,growth_share,tgamma_with_spin_n,y_rail_mm,rate_mm_per_cycle,vertical_kn,lateral_kn";

/// A number, or nothing.
fn or_blank(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| value.to_string())
}

/// `wheels.csv`: a row per wheel.
pub fn wheels_table(rows: &[WheelRow]) -> String {
    let mut text = format!("{WHEELS}\n");
    for row in rows {
        let representative = row.represented_by.map(|other| rows[other].number);
        let cells = [
            row.number.to_string(),
            representative.map_or_else(String::new, |number| number.to_string()),
            row.share.to_string(),
            row.peak_pressure.to_string(),
            row.along.to_string(),
            or_blank(row.across),
            or_blank(row.force.map(|force| 1e-3 * force[0])),
            or_blank(row.force.map(|force| 1e-3 * force[1])),
            or_blank(row.slip_share),
            or_blank(row.t_gamma),
            row.delta_keq.to_string(),
            row.growth_share.to_string(),
            or_blank(row.t_gamma_with_spin),
            or_blank(row.y_rail),
            row.rate.to_string(),
            or_blank(row.upright_force.map(|force| 1e-3 * force[0])),
            or_blank(row.upright_force.map(|force| 1e-3 * force[1])),
        ];
        text.push_str(&cells.join(","));
        text.push('\n');
    }
    text
}

/// Strips across each patch.
const STRIPS: usize = 31;
/// Intervals along each strip.
pub const PATCH_INTERVALS: usize = 48;
/// Intervals along the strip above the crack.
const STRIP_INTERVALS: usize = 160;

/// y of the strips of a patch between its `ends`, mm.
pub fn patch_strips([from, to]: [f64; 2]) -> impl Iterator<Item = f64> {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    (0..STRIPS).map(move |i| middle + half * ((2 * i + 1) as f64 / STRIPS as f64 - 1.0))
}

/// `patches.csv`: tractions of the whole patches of the wheels `drawn`.
pub fn patches_table(rows: &[WheelRow], drawn: &[usize]) -> String {
    let mut text = String::from("wheel,patch,x_mm,y_mm,p_mpa,qx_mpa,qy_mpa,slips\n");
    for (row, number, own) in placed(rows, drawn) {
        let wheel = format!("{},{number},", row.number);
        patch_strips(own.patch.ends()).for_each(|y| push_strip(&mut text, &wheel, own, y));
    }
    text
}

/// Tractions of one patch.
pub fn patch_table(own: &PlacedPatch) -> String {
    let mut text = String::from(
        "# pressure and shear on the rail, x with the travel and y across from the middle of the patch\n\
         x_mm,y_mm,p_mpa,qx_mpa,qy_mpa,slips\n",
    );
    patch_strips(own.patch.ends()).for_each(|y| push_strip(&mut text, "", own, y));
    text
}

/// `strips.csv`: tractions of the strips above the crack.
pub fn strips_table(rows: &[WheelRow], drawn: &[usize]) -> String {
    let mut text = String::from("wheel,patch,x_mm,p_mpa,qx_mpa,qy_mpa,slips\n");
    for (row, number, own) in placed(rows, drawn) {
        let Ok(strip) = own.patch.strip(own.y, STRIP_INTERVALS) else { continue };
        for StripPoint { x, pressure, shear: [along, over], slips } in strip.points {
            let (wheel, slips) = (row.number, u8::from(slips));
            text.push_str(&format!("{wheel},{number},{x},{pressure},{along},{over},{slips}\n"));
        }
    }
    text
}

fn placed<'a>(
    rows: &'a [WheelRow],
    drawn: &'a [usize],
) -> impl Iterator<Item = (&'a WheelRow, usize, &'a PlacedPatch)> {
    drawn.iter().flat_map(|wheel| {
        let row = &rows[*wheel];
        row.patches.iter().enumerate().map(move |(i, own)| (row, i + 1, own))
    })
}

/// The strip of a patch at `y` (mm), after what says of which `wheel`.
fn push_strip(text: &mut String, wheel: &str, own: &PlacedPatch, y: f64) {
    let Ok(strip) = own.patch.strip(y, PATCH_INTERVALS) else { return };
    for StripPoint { x, pressure, shear: [along, over], slips } in strip.points {
        text.push_str(&format!("{wheel}{x},{y},{pressure},{along},{over},{}\n", u8::from(slips)));
    }
}

/// `across.csv`: growth by the lateral place of the crack.
pub fn across_table(across: &GrowthAcross) -> String {
    let mut text = format!(
        "# relative_rate: mean growth rate over that at lateral_mm of the case, by {}\nlateral_mm,relative_rate,share_over_crack\n",
        across.by
    );
    for [place, rate, met] in &across.places {
        text.push_str(&format!("{place},{rate},{met}\n"));
    }
    text
}
